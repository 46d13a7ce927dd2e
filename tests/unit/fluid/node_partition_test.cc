#include "cloud.h"

#include <pfem_fluid/node_partition.h>

#include <algorithm>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class NodePartition : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(NodePartition, Dimensions);

  constexpr unsigned int n_ranks = 3;

  /// A body of water that is compressed in proportion to its cells' volumes, and the arrays of its steps.
  template <int dim>
  struct Body
  {
    std::vector<typename SimplexMesh<dim>::Cell> cells;
    std::vector<Quad>                            xp, v, unused, force;
    std::vector<double>                          volume, start_volume, mass;
    std::size_t                                  n_owned = 0;

    explicit Body(const Block<dim> &block)
      : cells(block.mesh.cells)
      , xp(block.nodes.xp)
      , v(block.nodes.v)
      , unused(block.nodes.n)
      , force(block.nodes.n)
      , volume(block.nodes.volume)
      , start_volume(block.nodes.volume)
      , mass(block.nodes.mass)
      , n_owned(block.nodes.n)
    {
      Noise noise(3);
      for (Quad &velocity : v)
        for (int d = 0; d < dim; ++d)
          velocity[d] = 0.1 * noise();
    }

    /// The part of a rank.
    Body(const Body &whole, const RankPart<dim> &part)
      : cells(part.cells)
      , unused(part.nodes.size())
      , force(part.nodes.size())
      , volume(part.nodes.size())
      , n_owned(part.n_owned)
    {
      for (const unsigned int i : part.nodes)
        {
          xp.push_back(whole.xp[i]);
          v.push_back(whole.v[i]);
          start_volume.push_back(whole.start_volume[i]);
          mass.push_back(whole.mass[i]);
        }
    }

    void move(const double time_step)
    {
      for (std::size_t i = 0; i < n_owned; ++i)
        for (int d = 0; d < dim; ++d)
          xp[i][d] += time_step * v[i][d];
    }

    void update_pressure()
    {
      compute_volumes<dim>(cells, xp, volume);
      for (std::size_t i = 0; i < n_owned; ++i)
        xp[i][3] = 1e6 * (1 - volume[i] / start_volume[i]);
    }

    void accelerate(const double time_step)
    {
      ForceEffects effects;
      effects.viscous              = true;
      effects.viscosity            = 10;
      effects.least_viscous_volume = 1e-3 * regular_volume<dim>(spacing);
      compute_forces<dim>(cells, effects, xp, v, unused, force);
      for (std::size_t i = 0; i < n_owned; ++i)
        for (int d = 0; d < dim; ++d)
          v[i][d] += time_step * force[i][d] / mass[i];
    }
  };

  template <int dim>
  std::vector<RankPart<dim>> parts_of(const Block<dim> &block)
  {
    return partition<dim>(block.mesh.cells, owners_by_bisection(block.nodes.positions(), n_ranks), n_ranks);
  }

  /// Gives the ghosts of all ranks the values of their owners.
  template <int dim>
  void exchange(const std::vector<RankPart<dim>> &parts, std::vector<Body<dim>> &bodies)
  {
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      for (const auto &neighbor : parts[rank].neighbors)
        for (const auto &back : parts[neighbor.rank].neighbors)
          if (back.rank == rank)
            for (std::size_t k = 0; k < back.received.size(); ++k)
              {
                bodies[neighbor.rank].xp[back.received[k]] = bodies[rank].xp[neighbor.sent[k]];
                bodies[neighbor.rank].v[back.received[k]]  = bodies[rank].v[neighbor.sent[k]];
              }
  }
} // namespace


TYPED_TEST(NodePartition, EveryNodeHasOneOwner)
{
  const Block<TypeParam::value> block;
  std::vector<int>              n_owners(block.nodes.n, 0);
  for (const auto &part : parts_of(block))
    {
      EXPECT_NEAR(static_cast<double>(part.n_owned), static_cast<double>(block.nodes.n) / n_ranks, 1.);
      for (std::size_t i = 0; i < part.n_owned; ++i)
        ++n_owners[part.nodes[i]];
    }
  EXPECT_EQ(std::count(n_owners.begin(), n_owners.end(), 1), static_cast<std::ptrdiff_t>(block.nodes.n));
}


TYPED_TEST(NodePartition, ARankHasEveryCellThatTouchesANodeOfItsOwn)
{
  const Block<TypeParam::value> block;
  std::vector<int>              n_cells(block.nodes.n, 0), n_seen(block.nodes.n, 0);
  for (const auto &cell : block.mesh.cells)
    for (const unsigned int i : cell)
      ++n_cells[i];
  for (const auto &part : parts_of(block))
    for (const auto &cell : part.cells)
      for (const unsigned int i : cell)
        if (i < part.n_owned)
          ++n_seen[part.nodes[i]];
  EXPECT_EQ(n_seen, n_cells);
}


TYPED_TEST(NodePartition, StepsOfTheRanksAreThoseOfTheWhole)
{
  constexpr int          dim = TypeParam::value;
  const Block<dim>       block;
  Body<dim>              whole(block);
  const auto             parts = parts_of(block);
  std::vector<Body<dim>> bodies;
  for (const auto &part : parts)
    bodies.emplace_back(whole, part);

  const double time_step = 1e-4;
  for (unsigned int step = 0; step < 20; ++step)
    {
      whole.move(time_step);
      whole.update_pressure();
      whole.accelerate(time_step);
      for (auto &body : bodies)
        body.move(time_step);
      exchange(parts, bodies);
      for (auto &body : bodies)
        body.update_pressure();
      exchange(parts, bodies);
      for (auto &body : bodies)
        body.accelerate(time_step);
    }
  double difference = 0, motion = 0;
  for (unsigned int rank = 0; rank < n_ranks; ++rank)
    for (std::size_t i = 0; i < parts[rank].n_owned; ++i)
      for (int d = 0; d < dim; ++d)
        {
          const unsigned int k = parts[rank].nodes[i];
          difference           = std::max(difference, std::abs(bodies[rank].v[i][d] - whole.v[k][d]));
          motion               = std::max(motion, std::abs(whole.v[k][d]));
        }
  EXPECT_GT(motion, 0.05);
  EXPECT_LT(difference, 1e-12 * motion);
}
