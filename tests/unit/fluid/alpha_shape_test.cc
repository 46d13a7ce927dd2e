#include "cloud.h"

#include <algorithm>
#include <set>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class AlphaShape : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(AlphaShape, Dimensions);

  /// Out of the mesh, its length the facet's measure.
  template <int dim>
  Vec<dim> area_of(const std::vector<Vec<dim>> &x, const typename SimplexMesh<dim>::Facet &facet)
  {
    const Vec<dim> e = x[facet[1]] - x[facet[0]];
    if constexpr (dim == 2)
      return {{e[1], -e[0]}};
    else
      return cross(e, x[facet[2]] - x[facet[0]]) * 0.5;
  }

  /// The cells as sets of places, which do not depend on how the nodes are numbered.
  template <int dim>
  auto cells_by_place(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &x)
  {
    using Place = std::array<double, dim>;
    std::set<std::set<Place>> cells;
    for (const auto &cell : mesh.cells)
      {
        std::set<Place> places;
        for (const unsigned int i : cell)
          {
            Place place;
            std::copy_n(x[i].c, dim, place.begin());
            places.insert(place);
          }
        cells.insert(places);
      }
    return cells;
  }
} // namespace


TYPED_TEST(AlphaShape, FillsABox)
{
  constexpr int dim = TypeParam::value;
  for (unsigned int seed = 1; seed <= 5; ++seed)
    {
      const auto state    = box_state<dim>({}, seed);
      const auto position = fill_box(state, spacing);
      const auto mesh     = mesh_of<dim>(position);
      EXPECT_NEAR(volume_of(mesh, position) / box_volume(state), 1., 1e-12) << "seed " << seed;
      for (const auto &cell : mesh.cells)
        EXPECT_GT(signed_volume(corners<dim>(position, cell)), 0.);
    }
}


TYPED_TEST(AlphaShape, SortsCellsByTheirHighestNode)
{
  constexpr int dim     = TypeParam::value;
  const auto    mesh    = mesh_of<dim>(fill_box(box_state<dim>(), spacing));
  const auto    highest = [](const auto &cell) {
    return *std::max_element(cell.begin(), cell.end());
  };
  ASSERT_GT(mesh.cells.size(), 50u);
  EXPECT_TRUE(std::is_sorted(mesh.cells.begin(), mesh.cells.end(), [&](const auto &a, const auto &b) {
    return highest(a) < highest(b);
  }));
}


TYPED_TEST(AlphaShape, HasAClosedBoundaryWithNormalsOutwards)
{
  constexpr int  dim      = TypeParam::value;
  const auto     state    = box_state<dim>();
  const auto     position = fill_box(state, spacing);
  const auto     mesh     = mesh_of<dim>(position);
  const Vec<dim> center   = (state.shape.lower + state.shape.upper) * 0.5;
  Vec<dim>       sum;
  double         volume = 0, surface = 0, expected_surface = 0;
  for (const auto &facet : mesh.boundary)
    {
      const Vec<dim> area = area_of<dim>(position, facet);
      EXPECT_GT(dot(area, position[facet[0]] - center), 0.);
      sum += area;
      surface += norm(area);
      volume += dot(area, position[facet[0]]) / dim; // Gauss: integral of div x over dim
    }
  for (int d = 0; d < dim; ++d)
    expected_surface += 2 * box_volume(state) / (state.shape.upper[d] - state.shape.lower[d]);
  EXPECT_LT(norm(sum), 1e-14);
  EXPECT_NEAR(surface, expected_surface, 1e-12);
  EXPECT_NEAR(volume, box_volume(state), 1e-12);
}


TYPED_TEST(AlphaShape, GivesTheSameBitsForTheSamePlaces)
{
  constexpr int dim      = TypeParam::value;
  const auto    position = fill_box(box_state<dim>(), spacing);
  const auto    one = mesh_of<dim>(position), two = mesh_of<dim>(position);
  EXPECT_EQ(one.cells, two.cells);
  EXPECT_EQ(one.boundary, two.boundary);
}


TYPED_TEST(AlphaShape, DoesNotDependOnTheNumberingEvenForAPerfectLattice)
{
  constexpr int dim    = TypeParam::value;
  auto          state  = box_state<dim>();
  state.lattice.jitter = 0;
  auto       position  = fill_box(state, spacing);
  const auto cells     = cells_by_place<dim>(mesh_of<dim>(position), position);
  std::shuffle(position.begin(), position.end(), std::mt19937(3));
  EXPECT_EQ(cells, cells_by_place<dim>(mesh_of<dim>(position), position));
}


TYPED_TEST(AlphaShape, DoesNotBridgeAGapOfMoreThanTwoRadii)
{
  constexpr int dim      = TypeParam::value;
  const auto    state    = box_state<dim>();
  auto          position = fill_box(state, spacing);
  const auto    n        = position.size();
  Vec<dim>      lower;
  lower[0] = state.shape.upper[0] + 2.6 * spacing;
  for (const auto &x : fill_box(box_state<dim>(lower, 2), spacing))
    position.push_back(x);
  const auto mesh = mesh_of<dim>(position);
  for (const auto &cell : mesh.cells)
    EXPECT_EQ(std::count_if(cell.begin(), cell.end(),
                            [n](const unsigned int i) {
                              return i < n;
                            }) %
                (dim + 1),
              0);
  EXPECT_NEAR(volume_of(mesh, position), 2 * box_volume(state), 1e-12);
}


TYPED_TEST(AlphaShape, AsksTheCallerAboutEveryCell)
{
  constexpr int dim      = TypeParam::value;
  const auto    position = fill_box(box_state<dim>(), spacing);
  const auto    is_left  = [&](const typename SimplexMesh<dim>::Cell &cell) {
    return std::all_of(cell.begin(), cell.end(), [&](const unsigned int i) {
      return position[i][0] < 0.35;
    });
  };
  const auto whole = mesh_of<dim>(position);
  const auto left  = alpha_shape<dim>(triangulation_of<dim>(position), 1.25 * spacing, is_left);
  EXPECT_EQ(left.cells.size(),
            static_cast<std::size_t>(std::count_if(whole.cells.begin(), whole.cells.end(), is_left)));
  EXPECT_GT(left.cells.size(), 0u);
  Vec<dim> sum;
  for (const auto &facet : left.boundary)
    sum += area_of<dim>(position, facet);
  EXPECT_LT(norm(sum), 1e-14);
}


TYPED_TEST(AlphaShape, GivesCellsToOneOfTheNodesAtAPlace)
{
  constexpr int dim      = TypeParam::value;
  const auto    state    = box_state<dim>();
  auto          position = fill_box(state, spacing);
  const auto    n        = position.size();
  for (const unsigned int i : {0u, 7u, 7u, 11u})
    position.push_back(position[i]);
  const auto mesh = mesh_of<dim>(position);
  EXPECT_NEAR(volume_of(mesh, position), box_volume(state), 1e-12);
  std::set<unsigned int> used;
  for (const auto &cell : mesh.cells)
    used.insert(cell.begin(), cell.end());
  EXPECT_EQ(used.size(), n);
}


TYPED_TEST(AlphaShape, IsEmptyWithoutACellsWorthOfNodes)
{
  constexpr int         dim = TypeParam::value;
  Noise                 noise(1);
  std::vector<Vec<dim>> few, flat;
  for (int n = 0; n <= dim; ++n)
    {
      EXPECT_TRUE(mesh_of<dim>(few).cells.empty()) << n << " nodes";
      EXPECT_TRUE(mesh_of<dim>(few).boundary.empty()) << n << " nodes";
      few.push_back(noise.vec<dim>() * (0.5 * spacing));
    }
  for (int n = 0; n < 20; ++n)
    {
      flat.push_back(noise.vec<dim>() * spacing);
      flat.back()[0] = 0;
    }
  EXPECT_TRUE(mesh_of<dim>(flat).cells.empty()) << "nodes on a plane";
}


TYPED_TEST(AlphaShape, HilbertOrderIsAPermutationThatKeepsNeighboursClose)
{
  constexpr int dim      = TypeParam::value;
  const auto    position = fill_box(box_state<dim>(), spacing);
  auto          order    = hilbert_order<dim>(position);
  double        length   = 0;
  for (std::size_t k = 1; k < order.size(); ++k)
    length += norm(position[order[k]] - position[order[k - 1]]);
  EXPECT_LT(length / (order.size() - 1), 2 * spacing);
  EXPECT_EQ(order, hilbert_order<dim>(position));
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), position.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    EXPECT_EQ(order[k], k);
}
