#include <gtest/gtest.h>
#include <mesh_smoothers/node_step.h>

#include <cmath>

#include "clouds.h"

using namespace Breakwater;

namespace
{
  /// A node within an octahedron, cut into its eight (2D: four) cells, or a half of it with the node on the cut.
  template <int dim>
  TestMesh<dim> star(const Vec<dim> &place, const bool is_half)
  {
    TestMesh<dim> result;
    result.position.push_back(place);
    for (int d = 0; d < dim; ++d)
      for (const double sign : {-1., 1.})
        {
          Vec<dim> x;
          x[d] = sign;
          result.position.push_back(x);
        }
    for (unsigned int signs = 0; signs < (1u << dim); ++signs)
      {
        typename SimplexMesh<dim>::Cell cell{};
        for (int d = 0; d < dim; ++d)
          cell[d + 1] = 1 + 2 * d + (signs >> d & 1);
        if (signed_volume(corners(result.position, cell)) < 0)
          std::swap(cell[1], cell[2]);
        if (!is_half || (signs >> (dim - 1) & 1) == 0)
          result.mesh.cells.push_back(cell);
      }
    result.freedom.assign(result.position.size(), NodeFreedom::fixed);
    result.freedom[0] = is_half ? NodeFreedom::slides_on_surface : NodeFreedom::free;
    return result;
  }

  template <int dim>
  double volume_of(const TestMesh<dim> &mesh)
  {
    double sum = 0;
    for (const auto &cell : mesh.mesh.cells)
      sum += signed_volume(corners(mesh.position, cell));
    return sum;
  }

  template <int dim>
  void expect_centred(const Vec<dim> &place, const bool is_half)
  {
    const double  best = star<dim>({}, is_half).smallest_r();
    TestMesh<dim> mesh = star(place, is_half);
    EXPECT_LT(mesh.smallest_r(), 0.85 * best);
    const double  volume = volume_of(mesh);
    const auto    task   = mesh.task(0.9);
    StarMesh<dim> work(mesh.mesh, mesh.position, task);
    EXPECT_TRUE(NodeStep<dim>(work).improve(0, 10.));
    EXPECT_GT(mesh.smallest_r(), 0.96 * best);
    EXPECT_NEAR(volume_of(mesh), volume, 1e-14);
  }

  TEST(NodeStep, FindsTheMiddle)
  {
    expect_centred<2>({{0.3, 0.15}}, false);
    expect_centred<3>({{0.2, 0.15, -0.2}}, false);
  }

  TEST(NodeStep, SlidesOnTheSurfaceAndKeepsTheVolume)
  {
    expect_centred<2>({{0.25, 0}}, true);
    expect_centred<3>({{0.2, 0.15, 0}}, true);
  }

  // A node of the surface right above the opposite corner: only a larger volume helps.
  TEST(NodeStep, LiftsANodeOffTheSurfaceWithinTheBudget)
  {
    for (const double allowed : {0., 0.02, 10.})
      {
        TestMesh<3>  mesh   = star<3>({{0, 0, -0.9}}, true);
        const double before = mesh.smallest_r(), volume = volume_of(mesh);
        const auto   task = mesh.task(0.9);
        StarMesh<3>  work(mesh.mesh, mesh.position, task);
        NodeStep<3>  step(work);
        VolumeBudget budget(allowed);
        EXPECT_FALSE(step.improve(0, 10.));
        EXPECT_EQ(step.lift(0, 10., budget), allowed > 0);
        EXPECT_NEAR(volume_of(mesh), volume + step.lifted_volume(), 1e-14);
        EXPECT_LE(step.lifted_volume(), allowed);
        EXPECT_LE(norm(mesh.position[0] - Vec<3>{{0, 0, -0.9}}), 0.5 + 1e-12);
        EXPECT_EQ(step.n_lifts(), allowed > 0 ? 1u : 0u);
        const double gain = mesh.smallest_r() / before;
        EXPECT_TRUE(allowed > 1 ? gain > 2 : gain < 2) << gain;
      }
  }
} // namespace
