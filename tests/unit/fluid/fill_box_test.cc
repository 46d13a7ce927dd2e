#include "cloud.h"

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class FillBox : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(FillBox, Dimensions);

  template <int dim>
  bool same_bits(const std::vector<Vec<dim>> &a, const std::vector<Vec<dim>> &b)
  {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i)
      for (int d = 0; d < dim; ++d)
        same = same && a[i][d] == b[i][d];
    return same;
  }
} // namespace


TYPED_TEST(FillBox, PutsNodesExactlyOnEveryFaceAndCornerAndNoneOutside)
{
  constexpr int dim = TypeParam::value;
  Vec<dim>      lower;
  for (int d = 0; d < dim; ++d)
    lower[d] = 0.1 * (d + 1);
  const auto   state         = box_state<dim>(lower, 4);
  unsigned int on_lower[dim] = {}, on_upper[dim] = {}, n_corners = 0;
  for (const auto &x : fill_box(state, spacing))
    {
      EXPECT_TRUE(state.shape.contains(x));
      int n_faces = 0;
      for (int d = 0; d < dim; ++d)
        {
          on_lower[d] += x[d] == state.shape.lower[d];
          on_upper[d] += x[d] == state.shape.upper[d];
          n_faces += x[d] == state.shape.lower[d] || x[d] == state.shape.upper[d];
        }
      n_corners += n_faces == dim;
    }
  EXPECT_EQ(n_corners, 1u << dim);
  for (int d = 0; d < dim; ++d)
    {
      EXPECT_EQ(on_lower[d], on_upper[d]);
      EXPECT_GE(on_lower[d], dim == 2 ? 5u : 25u);
    }
}


// The nodes on faces stand for less than h^dim each: N h^dim / V goes to 1 with the first power of h.
TYPED_TEST(FillBox, SpendsOneNodePerCellOfSpace)
{
  constexpr int dim    = TypeParam::value;
  const auto    state  = box_state<dim>();
  const auto    excess = [&](const double h) {
    return fill_box(state, h).size() * std::pow(h, dim) / box_volume(state) - 1;
  };
  const double coarse = excess(0.04), fine = excess(0.02);
  EXPECT_LT(std::abs(fine), dim == 2 ? 0.05 : 0.12);
  EXPECT_LT(std::abs(fine), 0.7 * std::abs(coarse));
}


TYPED_TEST(FillBox, KeepsNodesApart)
{
  constexpr int dim   = TypeParam::value;
  auto          state = box_state<dim>();
  const auto    nodes = fill_box(state, spacing);
  double        least = 1e300;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, norm(nodes[i] - nodes[j]));
  EXPECT_GT(least, 0.5 * spacing);
}


TYPED_TEST(FillBox, DependsOnTheSeedAndOnNothingElse)
{
  constexpr int dim = TypeParam::value;
  EXPECT_TRUE(same_bits<dim>(fill_box(box_state<dim>({}, 7), spacing), fill_box(box_state<dim>({}, 7), spacing)));
  EXPECT_FALSE(same_bits<dim>(fill_box(box_state<dim>({}, 7), spacing), fill_box(box_state<dim>({}, 8), spacing)));
}
