#include "cloud.h"
#include "one_wall.h"

#include <pfem_fluid/node_management.h>

#include <algorithm>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class NodeManagement : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(NodeManagement, Dimensions);

  template <int dim>
  NodeChanges manage(Block<dim> &block, const NodeLimits<dim> &limits = {})
  {
    Walls<dim> walls = walls_of<dim>(OneWall(dim == 2 ? "box(-9, -9; 9, 9)" : "box(-9, -9, -9; 9, 9, 9)"));
    return manage_nodes<dim>(block.nodes, block.mesh.cells, SizeField<dim>(spacing), walls, block.density, limits);
  }

  /// A block with random velocities, stretched along x by a factor.
  template <int dim>
  Block<dim> stretched_block(const double factor)
  {
    Block<dim> block;
    Noise      noise(7);
    for (std::size_t i = 0; i < block.nodes.n; ++i)
      {
        block.nodes.xp[i][0] *= factor;
        for (int d = 0; d < dim; ++d)
          block.nodes.v[i][d] = 1 + noise();
      }
    return block;
  }

  template <int dim>
  void expect_kept(const Totals<dim> &before, const Totals<dim> &after)
  {
    EXPECT_NEAR(after.mass / before.mass, 1., 1e-14);
    for (int d = 0; d < dim; ++d)
      EXPECT_NEAR(after.momentum[d] / before.momentum[d], 1., 1e-13);
    EXPECT_LE(after.kinetic_energy, before.kinetic_energy * (1 + 1e-14));
  }
} // namespace


TYPED_TEST(NodeManagement, LeavesARegularFluidAlone)
{
  Block<TypeParam::value> block;
  const std::size_t       n = block.nodes.n;
  EXPECT_FALSE(manage(block).any());
  EXPECT_EQ(block.nodes.n, n);
}


TYPED_TEST(NodeManagement, InsertionKeepsMassAndMomentum)
{
  constexpr int     dim   = TypeParam::value;
  Block<dim>        block = stretched_block<dim>(2.);
  const std::size_t n     = block.nodes.n;
  const Totals<dim> before(block.nodes);
  const NodeChanges changes = manage(block);
  EXPECT_GE(changes.n_inserted, 10u);
  EXPECT_EQ(changes.n_removed, 0u);
  EXPECT_EQ(block.nodes.n, n + changes.n_inserted);
  expect_kept(before, Totals<dim>(block.nodes));
}


TYPED_TEST(NodeManagement, MergingKeepsMassAndMomentum)
{
  constexpr int     dim   = TypeParam::value;
  Block<dim>        block = stretched_block<dim>(0.2);
  const std::size_t n     = block.nodes.n;
  const Totals<dim> before(block.nodes);
  const NodeChanges changes = manage(block);
  EXPECT_GT(changes.n_removed, 10u);
  EXPECT_EQ(changes.n_inserted, 0u);
  EXPECT_EQ(block.nodes.n, n - changes.n_removed);
  expect_kept(before, Totals<dim>(block.nodes));
}


TYPED_TEST(NodeManagement, ALoneNodeAtThePlaceOfAnotherIsTakenIn)
{
  constexpr int dim = TypeParam::value;
  Block<dim>    block;
  const auto    last          = block.nodes.n - 1;
  block.nodes.xp[last]        = block.nodes.xp[last / 2];
  auto &cells                 = block.mesh.cells;
  block.nodes.has_cells[last] = 0;
  cells.erase(std::remove_if(cells.begin(), cells.end(),
                             [&](const auto &cell) {
                               return std::find(cell.begin(), cell.end(), last) != cell.end();
                             }),
              cells.end());
  const double mass = Totals<dim>(block.nodes).mass;
  EXPECT_EQ(manage(block).n_removed, 1u);
  EXPECT_EQ(block.nodes.n, last);
  EXPECT_NEAR(Totals<dim>(block.nodes).mass / mass, 1., 1e-14);
}


namespace
{
  /// One cell with a long edge between the first two nodes, and the third, inside the fluid, close to its middle.
  template <int dim>
  Block<dim> cell_with_long_edge()
  {
    Block<dim> block;
    auto      &nodes = block.nodes;
    block.mesh.cells.resize(1);
    for (int i = 0; i <= dim; ++i)
      {
        block.mesh.cells[0][i] = i;
        nodes.is_surface[i]    = i != 2;
        nodes.xp[i]            = {};
      }
    nodes.xp[0][0]   = -1.2 * spacing;
    nodes.xp[1][0]   = 1.2 * spacing;
    nodes.xp[2][1]   = -0.3 * spacing;
    nodes.xp[dim][1] = dim == 2 ? -0.3 * spacing : -spacing;
    nodes.xp[dim][0] = 0.1 * spacing;
    return block;
  }
} // namespace


TYPED_TEST(NodeManagement, AnInnerNodeCloseToTheMiddleOfALongOuterEdgeGoesThere)
{
  Block<TypeParam::value> block = cell_with_long_edge<TypeParam::value>();
  EXPECT_FALSE(manage(block).any());
  EXPECT_EQ(norm(block.nodes.position(2)), 0.);
}


TYPED_TEST(NodeManagement, ASurfaceNodeCloseToTheMiddleOfALongEdgeStays)
{
  Block<TypeParam::value> block = cell_with_long_edge<TypeParam::value>();
  block.nodes.is_surface[2]     = 1;
  const auto before             = block.nodes.position(2);
  EXPECT_FALSE(manage(block).any());
  EXPECT_EQ(norm(block.nodes.position(2) - before), 0.);
}


TYPED_TEST(NodeManagement, InterfaceNodesStay)
{
  constexpr int dim       = TypeParam::value;
  Block<dim>    block     = stretched_block<dim>(0.2);
  block.nodes.n_interface = block.nodes.n;
  EXPECT_FALSE(manage(block).any());
}


TYPED_TEST(NodeManagement, IsOffWithLimitsOfZero)
{
  constexpr int dim = TypeParam::value;
  for (const double factor : {0.2, 2.})
    {
      Block<dim> block = stretched_block<dim>(factor);
      EXPECT_FALSE(manage(block, {0., 0.}).any());
    }
}
