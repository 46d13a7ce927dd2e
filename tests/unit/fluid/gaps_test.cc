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
      std::vector<Quad> before(position.size()), now;
      for (std::size_t i = 0; i < position.size(); ++i)
        for (int d = 0; d < dim; ++d)
          before[i][d] = position[i][d];
      now = before;
      for (std::size_t i = 0; i < position.size(); ++i)
        now[i][1] -= (i < n_lower ? lower_fall : upper_fall) * spacing;
      return gaps.closure(now, before, spacing);
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
