#include <gtest/gtest.h>
#include <pfem_fluid/moved_nodes.h>

#include "cloud.h"

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class MovedNodes : public testing::Test
  {
  };
  TYPED_TEST_SUITE(MovedNodes, Dimensions);

  /// A block and its nodes moved by up to a part of the spacing, those on the surface not.
  template <int dim>
  struct Moved
  {
    Block<dim>            block;
    std::vector<Vec<dim>> position = block.nodes.positions();
    Walls<dim>            walls;

    /// @param every which nodes move: every second, third, ...
    Moved(const double part, const unsigned int every)
    {
      const BoxShape<dim> box = box_state<dim>().shape;
      Noise               noise(4);
      for (std::size_t i = 0; i < position.size(); i += every)
        {
          const Vec<dim> moved     = position[i] + noise.vec<dim>() * (part * spacing);
          bool           is_inside = !block.nodes.is_surface[i];
          for (int d = 0; d < dim; ++d)
            is_inside = is_inside && moved[d] > box.lower[d] && moved[d] < box.upper[d];
          if (is_inside)
            position[i] = moved;
        }
    }

    std::vector<double> transfer()
    {
      return transfer_to_moved_nodes<dim>(block.nodes, block.mesh.cells, position, walls, 900.);
    }
  };

  TYPED_TEST(MovedNodes, TakeTheDensityOfTheirPlace)
  {
    constexpr int dim = TypeParam::value;
    Moved<dim>    moved(0.6, 2);
    const auto    exact = [](const Vec<dim> &x) {
      return 1000 + 20 * x[0] - 30 * x[1];
    };
    for (std::size_t i = 0; i < moved.position.size(); ++i)
      moved.block.nodes.density[i] = exact(moved.block.nodes.position(i));
    const std::vector<double> density = moved.transfer();
    for (std::size_t i = 0; i < moved.position.size(); ++i)
      EXPECT_NEAR(density[i], exact(moved.position[i]), 1e-9);
  }

  TYPED_TEST(MovedNodes, KeepMomentumAndNeverGainKineticEnergy)
  {
    constexpr int dim = TypeParam::value;
    Moved<dim>    moved(0.6, 1);
    Noise         noise(5);
    for (std::size_t i = 0; i < moved.position.size(); ++i)
      for (int d = 0; d < dim; ++d)
        moved.block.nodes.v[i][d] = noise();
    const Totals<dim> before(moved.block.nodes);
    moved.transfer();
    const Totals<dim> after(moved.block.nodes);
    EXPECT_EQ(after.mass, before.mass);
    for (int d = 0; d < dim; ++d)
      EXPECT_NEAR(after.momentum[d], before.momentum[d], 1e-12 * before.mass);
    EXPECT_LT(after.kinetic_energy, before.kinetic_energy);
    EXPECT_GT(after.kinetic_energy, 0.1 * before.kinetic_energy);
  }

  // One node alone takes the velocity of its new place exactly; those that had it give the momentum.
  TYPED_TEST(MovedNodes, TakeTheVelocityOfTheirPlace)
  {
    constexpr int dim = TypeParam::value;
    Moved<dim>    moved(0.3, 1000000);
    std::size_t   i = 0;
    while (moved.block.nodes.is_surface[i])
      ++i;
    moved.position = moved.block.nodes.positions();
    moved.position[i][0] += 0.3 * spacing;
    const auto exact = [](const Vec<dim> &x) {
      return 2 * x[0] - x[1];
    };
    for (std::size_t k = 0; k < moved.position.size(); ++k)
      moved.block.nodes.v[k][1] = exact(moved.block.nodes.position(k));
    moved.transfer();
    EXPECT_NEAR(moved.block.nodes.v[i][1], exact(moved.position[i]), 1e-12);
  }
} // namespace
