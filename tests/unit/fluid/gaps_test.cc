#include "cloud.h"

#include <pfem_fluid/gaps.h>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class GapsTest : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(GapsTest, Dimensions);

  /// Two boxes of fluid, one above the other, with ten spacings between them.
  template <int dim>
  struct TwoBodies
  {
    std::vector<Vec<dim>> position;
    std::size_t           n_lower;
    Gaps<dim>             gaps;

    TwoBodies()
    {
      position     = fill_box(box_state<dim>({}, 1), spacing);
      n_lower      = position.size();
      const auto h = box_state<dim>().shape;
      for (std::size_t i = 0; i < n_lower; ++i)
        {
          Vec<dim> x = position[i];
          x[1] += h.upper[1] - h.lower[1] + 10 * spacing;
          position.push_back(x);
        }
      const auto                                   triangulation = triangulation_of<dim>(position);
      std::vector<typename SimplexMesh<dim>::Cell> around;
      alpha_shape<dim>(
        triangulation, 1.4 * spacing,
        [](const auto &) {
          return true;
        },
        {}, &around);
      gaps = Gaps<dim>(around, position.size(), 0);
    }

    /// How much of what closes the gaps is done when the lower and the upper body fall by some spacings.
    double closure(const double lower_fall, const double upper_fall) const
    {
      return gaps.closure(fallen(lower_fall, upper_fall), fallen(0, 0), spacing);
    }

    std::size_t n_closing(const double lower_fall, const double upper_fall) const
    {
      return gaps.n_closing(fallen(lower_fall, upper_fall), fallen(0, 0), spacing);
    }

    std::vector<Quad> fallen(const double lower_fall, const double upper_fall) const
    {
      std::vector<Quad> result(position.size());
      for (std::size_t i = 0; i < position.size(); ++i)
        {
          std::copy_n(position[i].c, dim, result[i].c);
          result[i][1] -= (i < n_lower ? lower_fall : upper_fall) * spacing;
        }
      return result;
    }
  };
} // namespace


TYPED_TEST(GapsTest, StayOpenWhenAllMovesTogether)
{
  EXPECT_NEAR(TwoBodies<TypeParam::value>().closure(100., 100.), 0., 1e-12);
}


TYPED_TEST(GapsTest, StayOpenUntilHalfTheDistanceIsGone)
{
  EXPECT_LT(TwoBodies<TypeParam::value>().closure(0., 4.5), 1.);
}


TYPED_TEST(GapsTest, MayCloseWhenMoreThanHalfTheDistanceIsGone)
{
  EXPECT_GT(TwoBodies<TypeParam::value>().closure(0., 5.6), 1.);
}


TYPED_TEST(GapsTest, NoneIsClosingBeforeHalfTheDistanceIsGone)
{
  EXPECT_EQ(TwoBodies<TypeParam::value>().n_closing(0., 4.5), 0u);
}


TYPED_TEST(GapsTest, TheCellsOfANodeThatFliesAwayAreClosing)
{
  constexpr int           dim = TypeParam::value;
  const TwoBodies<dim>    bodies;
  const std::vector<Quad> before = bodies.fallen(0, 0);
  const unsigned int      flying = bodies.gaps.cells.front().back();
  std::vector<Quad>       now    = before;
  now[flying][1] += 1000 * spacing;
  const auto n_cells = std::count_if(bodies.gaps.cells.begin(), bodies.gaps.cells.end(), [&](const auto &cell) {
    return std::count(cell.begin(), cell.end(), flying) > 0;
  });
  EXPECT_EQ(bodies.gaps.n_closing(now, before, spacing), static_cast<std::size_t>(n_cells));
}
