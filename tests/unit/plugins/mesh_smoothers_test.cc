#include <breakwater/mesh/quality.h>
#include <gtest/gtest.h>
#include <mesh_smoothers/getme.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>

#include "given_parameters.h"

using namespace Breakwater;

namespace
{
  template <int dim>
  struct TestMesh
  {
    SimplexMesh<dim>         mesh;
    std::vector<Vec<dim>>    position;
    std::vector<NodeFreedom> freedom;

    /// Insphere radius of a cell over that of a regular one.
    double radius(const std::size_t cell) const
    {
      Simplex<dim> x;
      for (int a = 0; a <= dim; ++a)
        x[a] = position[mesh.cells[cell][a]];
      return insphere_radius(x) / reference_insphere_radius<dim>(1.);
    }
    double smallest_radius() const
    {
      double smallest = 1;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        smallest = std::min(smallest, radius(c));
      return smallest;
    }
  };

  /// A lattice of n^dim cubes, each cut into dim! simplices along its diagonal, whose inner nodes are thrown about
  /// several times, as long as no cell is inverted: a valid mesh with many slivers.
  template <int dim>
  TestMesh<dim> random_mesh(const unsigned int n, const unsigned int seed)
  {
    TestMesh<dim> result;
    unsigned int  n_nodes = 1, stride[dim];
    for (int d = 0; d < dim; ++d)
      {
        stride[d] = n_nodes;
        n_nodes *= n + 1;
      }
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        Vec<dim> x;
        bool     is_boundary = false;
        for (int d = 0; d < dim; ++d)
          {
            const unsigned int coordinate = i / stride[d] % (n + 1);
            x[d]                          = coordinate;
            is_boundary                   = is_boundary || coordinate == 0 || coordinate == n;
          }
        result.position.push_back(x);
        result.freedom.push_back(is_boundary ? NodeFreedom::fixed : NodeFreedom::free);
      }
    std::vector<std::vector<std::size_t>> cells_at(n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        bool is_corner = true;
        for (int d = 0; d < dim; ++d)
          is_corner = is_corner && i / stride[d] % (n + 1) < n;
        int order[dim];
        std::iota(order, order + dim, 0);
        if (is_corner)
          do
            {
              typename SimplexMesh<dim>::Cell cell;
              cell[0] = i;
              for (int a = 0; a < dim; ++a)
                cell[a + 1] = cell[a] + stride[order[a]];
              result.mesh.cells.push_back(cell);
              if (result.radius(result.mesh.cells.size() - 1) < 0)
                std::swap(result.mesh.cells.back()[dim], result.mesh.cells.back()[dim - 1]);
              for (const unsigned int node : cell)
                cells_at[node].push_back(result.mesh.cells.size() - 1);
            }
          while (std::next_permutation(order, order + dim));
      }

    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> move(-0.3, 0.3);
    for (unsigned int pass = 0; pass < 4; ++pass)
      for (unsigned int i = 0; i < n_nodes; ++i)
        if (result.freedom[i] == NodeFreedom::free)
          {
            const Vec<dim> before = result.position[i];
            for (int d = 0; d < dim; ++d)
              result.position[i][d] += move(generator);
            for (const std::size_t cell : cells_at[i])
              if (result.radius(cell) < 1e-4)
                result.position[i] = before;
          }
    return result;
  }

  /// Smooths random meshes and checks what GETMe promises. @return mean smallest radius before and after
  template <int dim>
  std::pair<double, double> fuzz(const unsigned int n, const unsigned int n_meshes, const double target)
  {
    double before = 0, after = 0;
    for (unsigned int seed = 0; seed < n_meshes; ++seed)
      {
        TestMesh<dim>         mesh     = random_mesh<dim>(n, seed);
        const TestMesh<dim>   original = mesh;
        Getme<dim>            getme;
        const SmoothingReport report = getme.smooth(mesh.mesh, mesh.position, {mesh.freedom, 1., target});

        before += original.smallest_radius() / n_meshes;
        after += mesh.smallest_radius() / n_meshes;
        EXPECT_GT(original.smallest_radius(), 0.);
        EXPECT_GE(mesh.smallest_radius(), original.smallest_radius());
        EXPECT_EQ(mesh.mesh.cells, original.mesh.cells);
        unsigned int n_moved = 0;
        for (std::size_t i = 0; i < mesh.position.size(); ++i)
          {
            const double distance = norm(mesh.position[i] - original.position[i]);
            n_moved += distance > 0;
            EXPECT_TRUE(distance == 0 || mesh.freedom[i] == NodeFreedom::free);
            EXPECT_LE(distance, report.largest_move);
          }
        EXPECT_EQ(n_moved, report.n_moved_nodes);
      }
    return {before, after};
  }

  TEST(Getme, NeverMakesTheWorstCellWorse)
  {
    const auto [before_2d, after_2d] = fuzz<2>(20, 20, 0.3);
    const auto [before_3d, after_3d] = fuzz<3>(8, 10, 0.3);
    std::printf("mean smallest radius, of a regular cell's: 2D %.5f to %.3f, 3D %.5f to %.3f\n", before_2d, after_2d,
                before_3d, after_3d);
    EXPECT_GT(after_2d, 0.1);
    EXPECT_GT(after_3d, 0.1);
    EXPECT_LT(before_2d, 0.02);
    EXPECT_LT(before_3d, 0.005);
  }

  // Four nodes nearly in a plane, their neighbours far away: the sliver opens.
  TEST(Getme, OpensASliver)
  {
    TestMesh<3> sliver;
    sliver.position = {{{1, 0, 0.01}}, {{0, 1, -0.01}}, {{-1, 0, 0.01}}, {{0, -1, -0.01}}};
    sliver.mesh.cells.push_back({0, 1, 2, 3});
    if (sliver.radius(0) < 0)
      std::swap(sliver.mesh.cells[0][2], sliver.mesh.cells[0][3]);
    sliver.freedom.assign(4, NodeFreedom::free);
    EXPECT_LT(sliver.radius(0), 0.06);
    Getme<3> getme;
    GivenParameters::read(getme, {{"Moves per cell", "100"}});
    getme.smooth(sliver.mesh, sliver.position, {sliver.freedom, 1., 0.9});
    EXPECT_GT(sliver.radius(0), 0.9);
  }

  TEST(Getme, LeavesAGoodMeshAndFixedNodesAlone)
  {
    TestMesh<2> mesh     = random_mesh<2>(6, 1);
    const auto  position = mesh.position;
    Getme<2>    getme;
    EXPECT_EQ(getme.smooth(mesh.mesh, mesh.position, {mesh.freedom, 1., 0.}).n_moved_nodes, 0u);
    std::fill(mesh.freedom.begin(), mesh.freedom.end(), NodeFreedom::fixed);
    EXPECT_EQ(getme.smooth(mesh.mesh, mesh.position, {mesh.freedom, 1., 0.9}).n_moved_nodes, 0u);
    for (std::size_t i = 0; i < position.size(); ++i)
      EXPECT_EQ(norm(mesh.position[i] - position[i]), 0.);
  }
} // namespace
