#include "cloud.h"

#include <algorithm>
#include <cmath>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class DelaunayMeshTest : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(DelaunayMeshTest, Dimensions);

  /// All cells between nodes, each with its nodes in rising order.
  template <int dim>
  std::vector<typename SimplexMesh<dim>::Cell> cells_of(const DelaunayMesh<dim> &triangulation)
  {
    std::vector<typename SimplexMesh<dim>::Cell> cells;
    for (const auto &linked : triangulation.cells())
      {
        auto cell = linked.node;
        std::sort(cell.begin(), cell.end());
        if (cell[dim] < triangulation.n_nodes())
          cells.push_back(cell);
      }
    std::sort(cells.begin(), cells.end());
    return cells;
  }

  template <int dim>
  std::vector<Vec<dim>> jittered_box(const double jitter, const unsigned int seed)
  {
    auto state           = box_state<dim>({}, seed);
    state.lattice.jitter = jitter;
    // About 1000 nodes.
    return fill_box(state, dim == 2 ? 0.25 * spacing : 0.7 * spacing);
  }

  template <int dim>
  std::vector<Vec<dim>> random_cloud(const unsigned int n, const unsigned int seed)
  {
    Noise                 noise(seed);
    std::vector<Vec<dim>> cloud(n);
    for (auto &x : cloud)
      x = 0.3 * noise.vec<dim>();
    return cloud;
  }

  template <int dim>
  auto expect_exact_update(DelaunayMesh<dim> &triangulation, const std::vector<Vec<dim>> &position)
  {
    const auto report = triangulation.update(position);
    EXPECT_EQ(cells_of(triangulation), cells_of(triangulation_of<dim>(position)));
    return report;
  }

  template <int dim>
  void expect_exact_repair(DelaunayMesh<dim> &triangulation, const std::vector<Vec<dim>> &position)
  {
    EXPECT_FALSE(expect_exact_update(triangulation, position).is_full);
  }

  /// The same motion of a jittered box a number of times.
  template <int dim, class Motion>
  void expect_exact_repairs(const unsigned int n_times, const Motion &motion)
  {
    auto              position      = jittered_box<dim>(0.2, 1);
    DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
    for (unsigned int n = 0; n < n_times; ++n)
      {
        for (auto &x : position)
          motion(x);
        expect_exact_repair(triangulation, position);
      }
  }

  template <int dim>
  void expect_new_triangulation(DelaunayMesh<dim> &triangulation, const std::vector<Vec<dim>> &position)
  {
    EXPECT_TRUE(expect_exact_update(triangulation, position).is_full);
  }

  /// Displaces each node at random by up to `size` in each coordinate, those on the box's sides along the sides only.
  template <int dim>
  void shake(std::vector<Vec<dim>> &position, const double size, Noise &noise)
  {
    const auto state = box_state<dim>();
    for (auto &x : position)
      {
        const Vec<dim> move = size * noise.vec<dim>();
        for (int d = 0; d < dim; ++d)
          if (x[d] != state.shape.lower[d] && x[d] != state.shape.upper[d])
            x[d] = std::clamp(x[d] + move[d], state.shape.lower[d], state.shape.upper[d]);
      }
  }
} // namespace


TYPED_TEST(DelaunayMeshTest, RepairsAfterRandomMotion)
{
  constexpr int dim = TypeParam::value;
  const double  h   = dim == 2 ? 0.25 * spacing : 0.7 * spacing;
  for (const double size : {1e-4, 0.02, 0.1})
    {
      auto              position = jittered_box<dim>(0.2, 1);
      Noise             noise(3);
      DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
      for (int n = 0; n < 5; ++n)
        {
          shake(position, size * h, noise);
          expect_exact_repair(triangulation, position);
        }
    }
}


TYPED_TEST(DelaunayMeshTest, RepairsCloudsOfAnyDensity)
{
  constexpr int     dim      = TypeParam::value;
  auto              position = random_cloud<dim>(1000, 2);
  Noise             noise(3);
  DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
  for (int n = 0; n < 5; ++n)
    {
      for (auto &x : position)
        x += 1e-3 * noise.vec<dim>();
      expect_exact_repair(triangulation, position);
    }
}


TYPED_TEST(DelaunayMeshTest, RepairsAfterShear)
{
  expect_exact_repairs<TypeParam::value>(10, [](auto &x) {
    x[0] += 0.05 * x[1];
  });
}


TYPED_TEST(DelaunayMeshTest, RepairsALatticeThatMoves)
{
  constexpr int     dim           = TypeParam::value;
  auto              position      = jittered_box<dim>(0, 1);
  DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
  for (int n = 0; n < 3; ++n)
    {
      for (auto &x : position)
        x[0] += 0.03125;
      expect_exact_repair(triangulation, position);
    }
  for (int n = 0; n < 3; ++n)
    {
      for (auto &x : position)
        x[1] += 0.0625 * x[0];
      expect_exact_repair(triangulation, position);
    }
}


TYPED_TEST(DelaunayMeshTest, RepairsWhenNodesLandOnAPlaneAndLeaveIt)
{
  constexpr int     dim           = TypeParam::value;
  auto              position      = jittered_box<dim>(0.2, 1);
  DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
  for (const double gap : {0.05, 0.08, 0., 0.02})
    {
      auto moved = position;
      for (auto &x : moved)
        x[0] = gap == 0 ? std::max(x[0], 0.04 * spacing) : x[0] + gap * spacing * std::sin(40 * x[1]);
      expect_exact_update(triangulation, moved);
    }
}


TYPED_TEST(DelaunayMeshTest, RepairsAFlatLayerThatGetsAnotherShape)
{
  constexpr int dim        = TypeParam::value;
  const auto    flat       = jittered_box<dim>(0.2, 1);
  const auto    with_layer = [&](const double thickness, const unsigned int seed) {
    auto  position = flat;
    Noise noise(seed);
    for (auto &x : position)
      {
        const double height = thickness * std::max(0., noise());
        x[0] += x[0] == 0 ? height : 0.;
      }
    return position;
  };
  auto triangulation = triangulation_of<dim>(with_layer(1e-3, 1));
  for (unsigned int seed = 2; seed < 6; ++seed)
    {
      const auto position = with_layer(1e-3, seed);
      expect_exact_repair(triangulation, position);
    }
}


TYPED_TEST(DelaunayMeshTest, RepairsAPlateThatBendsBesideAJet)
{
  // Fluid shoots up along a plate between two lattices of nodes; on the other side of it there is nothing.
  constexpr int dim = TypeParam::value;
  for (unsigned int seed = 1; seed <= 4; ++seed)
    {
      Noise                 noise(seed);
      std::vector<Vec<dim>> start;
      for (int i = -8; i <= 1; ++i)
        for (int j = 0; j <= (i < 0 ? 9 : 12); ++j)
          for (int k = 0; k <= (dim == 3 ? 10 : 0); ++k)
            {
              Vec<dim> x;
              x[dim - 1] = spacing * k;
              x[0]       = spacing * (i < 0 ? i + 0.9 : 1.5 * i);
              x[1]       = spacing * j;
              if (i < -1)
                x[0] += 0.2 * spacing * noise();
              if (i < 0 && j > 0)
                x[1] += 0.2 * spacing * noise();
              if (dim == 3 && i < 0 && k > 0 && k < 10)
                x[dim - 1] += 0.2 * spacing * noise();
              start.push_back(x);
            }
      auto position      = start;
      auto triangulation = triangulation_of<dim>(position);
      for (int n = 1; n <= 20; ++n)
        {
          for (std::size_t i = 0; i < position.size(); ++i)
            if (start[i][0] >= 0)
              position[i][0] = start[i][0] + 0.01 * spacing * n * start[i][1] * start[i][1];
            else
              position[i][1] += 0.3 * spacing * std::max(0., 1 + start[i][0] / (3 * spacing));
          expect_exact_repair(triangulation, position);
        }
    }
}


TYPED_TEST(DelaunayMeshTest, RepairsWhenABodyOfNodesSplits)
{
  expect_exact_repairs<TypeParam::value>(10, [](auto &x) {
    x[1] += x[1] > 0.4 ? 0.1 * spacing : 0.;
  });
}


TYPED_TEST(DelaunayMeshTest, IsExactAfterMotionThatFlipsCannotFollow)
{
  constexpr int     dim           = TypeParam::value;
  auto              position      = random_cloud<dim>(500, 1);
  DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
  expect_new_triangulation(triangulation, random_cloud<dim>(500, 2));
}


TYPED_TEST(DelaunayMeshTest, StartsAnewWithAnotherNumberOfNodes)
{
  constexpr int     dim      = TypeParam::value;
  auto              position = jittered_box<dim>(0.2, 1);
  DelaunayMesh<dim> triangulation;
  expect_new_triangulation(triangulation, position);
  position.pop_back();
  expect_new_triangulation(triangulation, position);
}


TYPED_TEST(DelaunayMeshTest, RepairsWhenNodesMeetAtAPlaceAndPart)
{
  constexpr int dim           = TypeParam::value;
  const auto    position      = jittered_box<dim>(0.2, 1);
  auto          triangulation = triangulation_of<dim>(position);
  auto          met           = position;
  met[5] = met[17] = met[6];
  met[40]          = met[2];
  expect_exact_repair(triangulation, met);
  expect_exact_repair(triangulation, met);
  expect_exact_repair(triangulation, position);
}


TYPED_TEST(DelaunayMeshTest, StaysExactWhenNodesGetNewNumbers)
{
  constexpr int     dim      = TypeParam::value;
  auto              position = jittered_box<dim>(0.2, 1);
  Noise             noise(1);
  DelaunayMesh<dim> triangulation = triangulation_of<dim>(position);
  shake(position, 0.02 * spacing, noise);
  triangulation.update(position);
  std::vector<unsigned int> order(position.size());
  for (unsigned int k = 0; k < order.size(); ++k)
    order[k] = k;
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  const auto old = position;
  for (unsigned int k = 0; k < order.size(); ++k)
    position[k] = old[order[k]];
  triangulation.renumber(order);
  EXPECT_TRUE(
    std::is_sorted(triangulation.cells().begin(), triangulation.cells().end(), [](const auto &one, const auto &two) {
      return *std::max_element(one.node.begin(), one.node.end()) < *std::max_element(two.node.begin(), two.node.end());
    }));
  expect_exact_repair(triangulation, position);
}


TYPED_TEST(DelaunayMeshTest, StaysExactWhenNodesComeAndGo)
{
  constexpr int dim           = TypeParam::value;
  auto          position      = jittered_box<dim>(0.2, 1);
  auto          triangulation = triangulation_of<dim>(position);
  Noise         noise(7);
  for (unsigned int time = 0; time < 5; ++time)
    {
      // Every hundredth node goes, walls included; others come, between the rest in number.
      std::vector<Vec<dim>>     changed;
      std::vector<unsigned int> order;
      for (unsigned int i = 0; i < position.size(); ++i)
        {
          if (i % 100 != 13 * time)
            {
              changed.push_back(position[i]);
              order.push_back(i);
            }
          if (i % 120 == 5)
            {
              changed.push_back(position[i] + 0.3 * spacing * noise.vec<dim>());
              order.push_back(DelaunayMesh<dim>::no_node);
            }
        }
      position = changed;
      shake(position, 0.005 * spacing, noise);
      triangulation.renumber(order);
      EXPECT_EQ(triangulation.n_nodes(), position.size());
      expect_exact_repair(triangulation, position);
    }
}


TYPED_TEST(DelaunayMeshTest, StartsAnewWhenManyNodesChange)
{
  constexpr int             dim           = TypeParam::value;
  auto                      position      = jittered_box<dim>(0.2, 1);
  auto                      triangulation = triangulation_of<dim>(position);
  std::vector<unsigned int> order;
  position.resize(position.size() / 2);
  for (unsigned int i = 0; i < position.size(); ++i)
    order.push_back(i);
  triangulation.renumber(order);
  expect_new_triangulation(triangulation, position);
}
