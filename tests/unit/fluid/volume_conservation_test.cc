#include "cloud.h"
#include "one_wall.h"

#include <pfem_fluid/mass_exchange.h>
#include <pfem_fluid/volume_conservation.h>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class VolumeConservation : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(VolumeConservation, Dimensions);

  /// Random masses from 0.05 to 2 times a regular node's, random velocities.
  template <int dim>
  Block<dim> uneven_block()
  {
    Block<dim> block;
    Noise      noise(3);
    for (std::size_t i = 0; i < block.nodes.n; ++i)
      {
        block.nodes.mass[i] = block.density * regular_volume<dim>(spacing) * (1.025 + 0.975 * noise());
        for (int d = 0; d < dim; ++d)
          block.nodes.v[i][d] = 1 + noise();
      }
    return block;
  }

  /// Far as long as it lifts the fluid by no more than this [m] under gravity.
  template <int dim>
  void exchange(Block<dim> &block, const double allowed_lift = 1e300)
  {
    std::vector<double> potential;
    double              weight = 0;
    for (std::size_t i = 0; i < block.nodes.n; ++i)
      {
        potential.push_back(9.81 * block.nodes.xp[i][1]);
        weight += 9.81 * block.nodes.mass[i];
      }
    const NodePairs<dim> pairs(block.nodes, block.mesh.cells);
    exchange_mass<dim>(block.nodes, block.mesh.cells, pairs, potential, allowed_lift * weight, block.density, spacing,
                       {});
  }

  /// The tank (0, 0, 0; 9, 9, 9).
  template <int dim>
  Walls<dim> one_tank()
  {
    return walls_of<dim>(OneWall(dim == 2 ? "box(0, 0; 9, 9)" : "box(0, 0, 0; 9, 9, 9)"));
  }

  /// A block whose interior nodes have too little room for their masses.
  template <int dim>
  Block<dim> packed_block(const double excess = 0.1)
  {
    Block<dim> block;
    for (std::size_t i = 0; i < block.nodes.n; ++i)
      if (!block.nodes.is_surface[i])
        block.nodes.mass[i] *= 1 + excess;
    return block;
  }

  template <int dim>
  std::vector<Quad> correction(const Block<dim> &block, const Walls<dim> &walls, const unsigned int n_iterations = 5)
  {
    return volume_correction<dim>(block.nodes, block.mesh.cells, walls, block.density, spacing, 0.3, n_iterations);
  }

  template <int dim>
  double length_of(const Quad &q)
  {
    return norm(FluidNodes<dim>::vec(q));
  }
} // namespace


// w (psi_a - mean psi) over the corners that take part, w = |V_c| / (2 (dim + 1)).
TYPED_TEST(VolumeConservation, ExchangeOperatorIsThatOfTheCells)
{
  constexpr int dim       = TypeParam::value;
  Block<dim>    block     = uneven_block<dim>();
  block.nodes.n_interface = 20;
  std::vector<double> psi(block.nodes.n), expected(block.nodes.n, 0.), image(block.nodes.n);
  Noise               noise(5);
  for (double &value : psi)
    value = noise();
  for (const auto &cell : block.mesh.cells)
    {
      double sum = 0, n = 0;
      for (const unsigned int i : cell)
        if (i >= 20)
          {
            sum += psi[i];
            ++n;
          }
      for (const unsigned int i : cell)
        if (i >= 20)
          expected[i] += std::abs(signed_volume(block.nodes.corners(cell))) / (2 * (dim + 1)) * (psi[i] - sum / n);
    }
  const NodePairs<dim> pairs(block.nodes, block.mesh.cells);
  const double         product     = pairs.exchange(pairs.conductance_sums(), psi, image);
  double               sum_of_both = 0;
  for (std::size_t i = 0; i < psi.size(); ++i)
    {
      EXPECT_NEAR(image[i], expected[i], 1e-14 * regular_volume<dim>(spacing));
      sum_of_both += psi[i] * expected[i];
    }
  EXPECT_NEAR(product / sum_of_both, 1., 1e-13);
}


TYPED_TEST(VolumeConservation, ExchangeKeepsMassAndMomentum)
{
  constexpr int dim   = TypeParam::value;
  Block<dim>    block = uneven_block<dim>();
  const Totals  before(block.nodes);
  exchange(block);
  const Totals after(block.nodes);
  EXPECT_NEAR(after.mass / before.mass, 1., 1e-14);
  for (int d = 0; d < dim; ++d)
    EXPECT_NEAR(after.momentum[d] / before.momentum[d], 1., 1e-13);
  EXPECT_LT(after.square_excess, 0.5 * before.square_excess) << "it evens out";
}


TYPED_TEST(VolumeConservation, ExchangeNeverMakesKineticEnergy)
{
  constexpr int dim    = TypeParam::value;
  Block<dim>    block  = uneven_block<dim>();
  double        energy = Totals(block.nodes).kinetic_energy;
  for (int sweep = 0; sweep < 8; ++sweep)
    {
      exchange(block);
      const double now = Totals(block.nodes).kinetic_energy;
      EXPECT_LT(now, energy);
      energy = now;
    }
}


TYPED_TEST(VolumeConservation, ExchangeKeepsARigidMotion)
{
  constexpr int dim   = TypeParam::value;
  Block<dim>    block = uneven_block<dim>();
  for (Quad &v : block.nodes.v)
    for (int d = 0; d < dim; ++d)
      v[d] = d + 1.;
  exchange(block);
  for (const Quad &v : block.nodes.v)
    for (int d = 0; d < dim; ++d)
      EXPECT_NEAR(v[d], d + 1., 1e-13);
}


TYPED_TEST(VolumeConservation, ExchangeLeavesAFluidInBalanceAlone)
{
  constexpr int dim = TypeParam::value;
  Block<dim>    block;
  Noise         noise(3);
  for (std::size_t i = 0; i < block.nodes.n; ++i)
    {
      block.nodes.density[i] = block.density * (1 + 0.01 * noise());
      block.nodes.mass[i]    = block.nodes.density[i] * block.nodes.volume[i];
      block.nodes.v[i][0]    = noise();
    }
  const auto mass = block.nodes.mass;
  const auto v    = block.nodes.v;
  exchange(block);
  EXPECT_EQ(block.nodes.mass, mass);
  for (std::size_t i = 0; i < block.nodes.n; ++i)
    EXPECT_NEAR(block.nodes.v[i][0], v[i][0], 1e-15);
}


TYPED_TEST(VolumeConservation, ExchangeGoesFarOnlyAsFarAsItMayLift)
{
  constexpr int dim    = TypeParam::value;
  const auto    height = [](const Block<dim> &block) {
    double moment = 0, mass = 0;
    for (std::size_t i = 0; i < block.nodes.n; ++i)
      {
        moment += block.nodes.mass[i] * block.nodes.xp[i][1];
        mass += block.nodes.mass[i];
      }
    return moment / mass;
  };
  // Too light below, too heavy above: the mass wants to sink.
  Block<dim> block;
  for (std::size_t i = 0; i < block.nodes.n; ++i)
    block.nodes.mass[i] *= 1 + 0.2 * (block.nodes.xp[i][1] / spacing - 3) / 10;
  Block<dim> near = block, bounded = block, far = block;
  exchange(near, 0.);
  exchange(bounded, 1e-4 * spacing);
  exchange(far);
  EXPECT_LT(height(far), height(near) - 1e-3 * spacing);
  EXPECT_NEAR(height(bounded), height(near) - 1e-4 * spacing, 1e-6 * spacing);
}


TYPED_TEST(VolumeConservation, ExchangeNeverMakesAVeryLightNode)
{
  constexpr int dim   = TypeParam::value;
  Block<dim>    block = uneven_block<dim>();
  // Pull mass out of every second node as hard as possible.
  for (std::size_t i = 0; i < block.nodes.n; ++i)
    block.nodes.density[i] = i % 2 == 0 ? 1e-3 * block.density : 20 * block.density;
  for (int k = 0; k < 20; ++k)
    exchange(block);
  const double regular_mass = block.density * regular_volume<dim>(spacing);
  EXPECT_GE(Totals(block.nodes).least_mass, 0.05 * regular_mass * (1 - 1e-12));
  EXPECT_LT(Totals(block.nodes).least_mass, 0.1 * regular_mass) << "the limit was not tried";
}


TYPED_TEST(VolumeConservation, ExchangeLeavesInterfaceNodesOut)
{
  constexpr int dim       = TypeParam::value;
  Block<dim>    block     = uneven_block<dim>();
  block.nodes.n_interface = 20;
  const auto   mass       = block.nodes.mass;
  const auto   v          = block.nodes.v;
  const Totals before(block.nodes);
  exchange(block);
  for (std::size_t i = 0; i < 20; ++i)
    {
      EXPECT_EQ(block.nodes.mass[i], mass[i]);
      EXPECT_EQ(block.nodes.v[i][0], v[i][0]);
    }
  EXPECT_NE(block.nodes.mass[20], mass[20]);
  EXPECT_NEAR(Totals(block.nodes).mass / before.mass, 1., 1e-14);
}


TYPED_TEST(VolumeConservation, DeficitIsThatOfTheInterior)
{
  constexpr int dim = TypeParam::value;
  EXPECT_NEAR(interior_volume_deficit(Block<dim>().nodes), 0., 1e-14);
  EXPECT_NEAR(interior_volume_deficit(packed_block<dim>(0.25).nodes), 1 - 1 / 1.25, 1e-14);
}


TYPED_TEST(VolumeConservation, CorrectionMakesRoomForAPackedInterior)
{
  constexpr int    dim   = TypeParam::value;
  Block<dim>       block = packed_block<dim>();
  const Walls<dim> no_walls;
  double           deficit = interior_volume_deficit(block.nodes);
  const double     start   = deficit;
  // Once less than 1 % is missing, nothing is done any more.
  int n_passes = 0;
  for (auto shift = correction(block, no_walls); !shift.empty(); shift = correction(block, no_walls))
    {
      ASSERT_EQ(shift.size(), block.nodes.n);
      ASSERT_LT(++n_passes, 20);
      for (std::size_t i = 0; i < shift.size(); ++i)
        {
          EXPECT_LE(length_of<dim>(shift[i]), 0.1 * spacing * (1 + 1e-12));
          for (int d = 0; d < dim; ++d)
            block.nodes.xp[i][d] += shift[i][d];
        }
      compute_volumes<dim>(block.mesh.cells, block.nodes.xp, block.nodes.volume);
      const double now = interior_volume_deficit(block.nodes);
      EXPECT_LT(now, deficit) << "pass " << n_passes;
      deficit = now;
    }
  EXPECT_LT(deficit, 0.25 * start);
  EXPECT_GT(deficit, -0.1 * start);
}


TYPED_TEST(VolumeConservation, CorrectionMovesNeitherInterfaceNodesNorThroughWalls)
{
  constexpr int    dim   = TypeParam::value;
  Block<dim>       block = packed_block<dim>();
  const Walls<dim> tank  = one_tank<dim>();
  // The block lies in the tank's corner: those faces are no free surface.
  for (std::size_t i = 0; i < block.nodes.n; ++i)
    block.nodes.contacts[i] = tank.faces_at(block.nodes.position(i), 1e-9);
  block.nodes.n_interface       = 10;
  const std::vector<Quad> shift = correction(block, tank);
  ASSERT_EQ(shift.size(), block.nodes.n);
  double       along_walls = 0;
  unsigned int n_at_walls  = 0;
  for (std::size_t i = 0; i < block.nodes.n; ++i)
    {
      if (i < block.nodes.n_interface)
        {
          EXPECT_EQ(length_of<dim>(shift[i]), 0.);
        }
      if (!block.nodes.contacts[i].empty())
        {
          ++n_at_walls;
          for (int d = 0; d < dim; ++d)
            if (block.nodes.xp[i][d] == 0)
              {
                EXPECT_EQ(shift[i][d], 0.);
              }
          along_walls = std::max(along_walls, length_of<dim>(shift[i]));
        }
    }
  EXPECT_GT(n_at_walls, 10u);
  EXPECT_GT(along_walls, 0.);
}


TYPED_TEST(VolumeConservation, CorrectionOfNothingIsEmpty)
{
  constexpr int    dim = TypeParam::value;
  const Walls<dim> no_walls;
  EXPECT_TRUE(correction(Block<dim>(), no_walls).empty());
  EXPECT_TRUE(correction(packed_block<dim>(0.005), no_walls).empty()) << "less than 1 % is not worth it";
  EXPECT_FALSE(correction(packed_block<dim>(), no_walls).empty());
  EXPECT_TRUE(correction(packed_block<dim>(), no_walls, 0).empty()) << "no iterations";
}
