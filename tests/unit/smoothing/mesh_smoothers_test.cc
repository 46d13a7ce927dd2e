#include <gtest/gtest.h>
#include <mesh_smoothers/elastic_analogy.h>
#include <mesh_smoothers/elastic_analogy_then_getme.h>
#include <mesh_smoothers/flips_and_optimization.h>
#include <mesh_smoothers/getme.h>
#include <mesh_smoothers/peel.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "clouds.h"

using namespace Breakwater;

namespace
{
  /// Four nodes nearly in a plane that nothing holds.
  TestMesh<3> sliver()
  {
    TestMesh<3> result;
    result.position   = {{{0.7, 0, 0.01}}, {{0, 0.7, -0.01}}, {{-0.7, 0, 0.01}}, {{0, -0.7, -0.01}}};
    result.mesh.cells = {{{0, 1, 3, 2}}};
    for (int a = 0; a < 4; ++a)
      result.mesh.boundary.push_back(outward_facet<3>(result.mesh.cells[0], a));
    result.freedom.assign(4, NodeFreedom::free);
    return result;
  }

  /// The same four nodes inside of a box of fixed corners.
  TestMesh<3> sliver_in_a_box()
  {
    std::vector<Vec<3>> position = sliver().position;
    for (unsigned int corner = 0; corner < 8; ++corner)
      position.push_back({{corner & 1 ? 1. : -1., corner & 2 ? 1. : -1., corner & 4 ? 1. : -1.}});
    TestMesh<3> result = mesh_of_cloud<3>(position);
    std::fill(result.freedom.begin(), result.freedom.begin() + 4, NodeFreedom::free);
    std::fill(result.freedom.begin() + 4, result.freedom.end(), NodeFreedom::fixed);
    return result;
  }

  /// Smooths a mesh; the smoother must keep its promises.
  template <class Smoother, int dim>
  SmoothingReport smooth(TestMesh<dim> &mesh, const double target)
  {
    const TestMesh<dim>   before = mesh;
    const SmoothingReport report = Smoother().smooth(mesh.mesh, mesh.position, mesh.task(target));
    EXPECT_EQ(smoothing_violation(before.mesh, before.position, mesh.mesh, mesh.position, before.task(target), report),
              "");
    return report;
  }

  TEST(Getme, OpensASliver)
  {
    TestMesh<3> mesh = sliver_in_a_box();
    EXPECT_LT(mesh.smallest_r(), 0.06);
    Getme<3>().smooth(mesh.mesh, mesh.position, mesh.task(0.7));
    EXPECT_GT(mesh.smallest_r(), 0.5);
  }

  TEST(ElasticAnalogy, OpensASliver)
  {
    TestMesh<3> mesh = sliver_in_a_box();
    ElasticAnalogy<3>().smooth(mesh.mesh, mesh.position, mesh.task(0.7));
    EXPECT_GT(mesh.smallest_r(), 0.5);
  }

  // Four nodes of a splash that hang together with nothing else are droplets, if their cell is too flat.
  TEST(FlipsAndOptimization, TakesAFlatCellOnItsOwnAway)
  {
    TestMesh<3> mesh = sliver();
    mesh.freedom.assign(4, NodeFreedom::slides_on_surface);
    const auto report = smooth<FlipsAndOptimization<3>>(mesh, 0.7);
    EXPECT_TRUE(mesh.mesh.cells.empty());
    EXPECT_EQ(report.n_freed_nodes, 4u);
  }

  // The wall keeps a node whose wall has been bared beside it, whoever took the cell away.
  TEST(StarMesh, KeepsNodesOfBaredWallsOnTheWall)
  {
    Random       random(2);
    TestMesh<3>  mesh = mesh_of_cloud<3>(jittered_lattice<3>(4, 0.2, random));
    const auto   task = mesh.task(0.9);
    StarMesh<3>  work(mesh.mesh, mesh.position, task);
    unsigned int n_bared = 0;
    for (unsigned int i = 0; i < mesh.position.size(); ++i)
      if (mesh.freedom[i] == NodeFreedom::slides_on_wall)
        {
          work.remove(*work.star(i).begin());
          const Vec<3> allowed = StarMesh<3>::Constraint(work, i).allowed_part({{0.3, 0.2, 1.}});
          EXPECT_NEAR(allowed[2], 0., 1e-14);
          EXPECT_LE(std::abs(dot(allowed, work.area_vector(i))),
                    0.2 * norm(allowed) * norm(work.area_vector(i)) + 1e-14);
          ++n_bared;
        }
    EXPECT_GT(n_bared, 0u);
  }

  TEST(StarMesh, KeepsNodesOfBaredEdgesOnTheEdge)
  {
    Random      random(2);
    TestMesh<3> mesh = mesh_of_cloud<3>(jittered_lattice<3>(4, 0.2, random));
    for (unsigned int i = 0; i < mesh.position.size(); ++i)
      if (mesh.freedom[i] == NodeFreedom::slides_on_wall)
        {
          mesh.freedom[i]     = NodeFreedom::slides_on_edge;
          mesh.wall_normal[i] = {{1, 0, 0}};
        }
    const auto   task = mesh.task(0.9);
    StarMesh<3>  work(mesh.mesh, mesh.position, task);
    unsigned int n_sliding = 0, n_fixed = 0;
    for (unsigned int i = 0; i < mesh.position.size(); ++i)
      if (mesh.freedom[i] == NodeFreedom::slides_on_edge && work.star(i).size() > 2)
        {
          const Vec<3> along = StarMesh<3>::Constraint(work, i).allowed_part({{0.3, 0.2, 1.}});
          EXPECT_NEAR(norm(Vec<3>{{0, along[1], along[2]}}), 0., 1e-12);
          n_sliding += along[0] == 0.3;
          while (work.star(i).size() > 2)
            work.remove(*work.star(i).begin());
          const Vec<3> allowed = StarMesh<3>::Constraint(work, i).allowed_part({{0.3, 0.2, 1.}});
          EXPECT_NEAR(norm(Vec<3>{{0, allowed[1], allowed[2]}}), 0., 1e-12);
          n_fixed += norm(allowed) == 0;
        }
    EXPECT_GT(n_sliding, 0u);
    EXPECT_GT(n_fixed, 0u) << "where the edge is bared, to keep the volume";
  }

  // What a cell at a wall shuts in comes to the surface if nothing else helps.
  TEST(Peel, TakesAFilmOverAnInnerNodeAtAWallAsALastResort)
  {
    Random      random(2);
    auto        position = jittered_lattice<3>(5, 0.1, random);
    const auto  low      = position.size();
    TestMesh<3> mesh;
    position.push_back({{2.4, 2.4, 0.25}});
    mesh                     = mesh_of_cloud<3>(position);
    const TestMesh<3> before = mesh;
    SmoothingReport   report;

    const SmoothingTask<3> task = {mesh.freedom, mesh.wall_normal, 2., 0.6};
    StarMesh<3>            work(mesh.mesh, mesh.position, task);
    Peel<3>                peel(work, VolumeBudget(1.));
    EXPECT_EQ(work.freedom(low), NodeFreedom::free);
    unsigned int film = work.n_cells();
    for (const unsigned int c : work.star(low))
      if (std::count_if(work.cell(c).begin(), work.cell(c).end(), [&](const unsigned int node) {
            return mesh.freedom[node] == NodeFreedom::slides_on_wall;
          }) == 3)
        film = c;
    ASSERT_LT(film, work.n_cells());
    EXPECT_FALSE(peel.try_cell(film, {1., false}));
    EXPECT_TRUE(peel.try_cell(film, {1., true}));
    EXPECT_EQ(work.freedom(low), NodeFreedom::slides_on_surface);
    peel.finish(report);
    work.finish(report);
    EXPECT_EQ(report.n_peeled_cells, 1u);
    EXPECT_EQ(smoothing_violation(before.mesh, before.position, mesh.mesh, mesh.position, before.task(0.6), report),
              "");
  }

  // Nodes of a wall lie on it but for a little: what sliding over them changes is told.
  TEST(StarMesh, TellsWhatNodesOfAnUnevenWallChangeOfTheVolume)
  {
    Random       random(2);
    TestMesh<3>  mesh  = mesh_of_cloud<3>(jittered_lattice<3>(5, 0.2, random));
    unsigned int n_all = 0;
    for (std::size_t i = 0; i < mesh.position.size(); ++i)
      if (mesh.freedom[i] == NodeFreedom::slides_on_wall)
        mesh.position[i][2] = 0.05 * random(), ++n_all;
    ASSERT_GT(n_all, 0u);
    EXPECT_NE(smooth<FlipsAndOptimization<3>>(mesh, 0.8).slid_volume, 0.);
  }

  /// Smallest r before and after on a block of a jittered lattice, its floor at a wall.
  template <class Smoother, int dim>
  void expect_on_block(const std::string &name, const double target, const double expected)
  {
    Random              random(3);
    const TestMesh<dim> before =
      mesh_of_cloud<dim>(jittered_lattice<dim>(dim == 2 ? 40 : 14, dim == 2 ? 0.45 : 0.3, random));
    TestMesh<dim> mesh   = before;
    const auto    report = smooth<Smoother>(mesh, target);
    std::printf("%s, %dD: smallest r %.5f to %.3f, %u of %zu nodes moved, %u flips, %u cells peeled\n", name.c_str(),
                dim, before.smallest_r(), mesh.smallest_r(), report.n_moved_nodes, mesh.position.size(), report.n_flips,
                report.n_peeled_cells);
    EXPECT_LT(before.smallest_r(), dim == 2 ? 0.2 : 0.02);
    EXPECT_GT(mesh.smallest_r(), expected);
    EXPECT_LE(std::abs(report.volume_change), 1e-4 * std::pow(dim == 2 ? 40 : 14, dim));
    EXPECT_LE(report.largest_move, 0.5 + 1e-12);
  }

  TEST(MeshSmoothers, RepairABlock)
  {
    expect_on_block<FlipsAndOptimization<2>, 2>("flips and optimization", 0.6, 0.5);
    expect_on_block<FlipsAndOptimization<3>, 3>("flips and optimization", 0.6, 0.4);
    expect_on_block<ElasticAnalogyThenGetme<2>, 2>("elastic analogy then GETMe", 0.3, 0.25);
    expect_on_block<ElasticAnalogyThenGetme<3>, 3>("elastic analogy then GETMe", 0.2, 0.1);
  }

  TEST(MeshSmoothers, LeaveAGoodMeshAndFixedNodesAlone)
  {
    Random            random(1);
    const TestMesh<3> original = mesh_of_cloud<3>(jittered_lattice<3>(6, 0.3, random));
    TestMesh<3>       mesh     = original;
    const auto        is_same  = [&]() {
      for (std::size_t i = 0; i < mesh.position.size(); ++i)
        if (norm(mesh.position[i] - original.position[i]) > 0)
          return false;
      return true;
    };
    FlipsAndOptimization<3>().smooth(mesh.mesh, mesh.position, mesh.task(0.));
    EXPECT_EQ(mesh.mesh.cells, original.mesh.cells);
    std::fill(mesh.freedom.begin(), mesh.freedom.end(), NodeFreedom::fixed);
    ElasticAnalogyThenGetme<3>().smooth(mesh.mesh, mesh.position, mesh.task(0.9));
    EXPECT_EQ(mesh.mesh.cells, original.mesh.cells);
    FlipsAndOptimization<3>().smooth(mesh.mesh, mesh.position, mesh.task(0.9));
    EXPECT_TRUE(is_same());
  }

  TEST(SmoothingViolation, TellsWhatIsWrong)
  {
    Random            random(1);
    const TestMesh<3> before = mesh_of_cloud<3>(jittered_lattice<3>(5, 0.2, random));
    const auto        told   = [&](const TestMesh<3> &after) {
      return smoothing_violation(before.mesh, before.position, after.mesh, after.position, before.task(0.5), {});
    };
    EXPECT_EQ(told(before), "");
    TestMesh<3> after = before;
    after.mesh.cells.pop_back();
    EXPECT_NE(told(after), "");
    after = before;
    std::swap(after.mesh.cells[0][0], after.mesh.cells[0][1]);
    EXPECT_EQ(told(after), "a cell is inverted");
    after = before;
    after.mesh.boundary.pop_back();
    EXPECT_EQ(told(after), "the boundary is not that of the cells");
    after = before;
    after.position[before.mesh.boundary[0][0]] += {{0.01, 0.01, 0.01}};
    EXPECT_NE(told(after), "");
    after = before;
    const auto on_wall =
      std::find(before.freedom.begin(), before.freedom.end(), NodeFreedom::slides_on_wall) - before.freedom.begin();
    after.position[on_wall][2] += 1e-6;
    EXPECT_EQ(told(after), "node " + std::to_string(on_wall) + " has left its wall");
    TestMesh<3> emptier = before;
    while (emptier.mesh.cells.size() > 1)
      emptier.mesh.cells.pop_back();
    EXPECT_NE(smoothing_violation(emptier.mesh, before.position, before.mesh, before.position, before.task(0.5), {})
                .find("which had no cells, has got some"),
              std::string::npos);
  }
} // namespace
