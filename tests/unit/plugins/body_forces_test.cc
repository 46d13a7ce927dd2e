#include <body_forces/gravity.h>
#include <gtest/gtest.h>

#include "given_parameters.h"

using namespace Breakwater;

namespace
{
  template <int dim>
  void check_gravity(const std::string &acceleration, const Vec<dim> &expected)
  {
    Gravity<dim> gravity;
    GivenParameters::read(gravity, {{"Acceleration", acceleration}});
    EXPECT_TRUE(gravity.is_uniform());

    const Vec<dim>        place = {{0.3, -0.2}};
    std::vector<Vec<dim>> sum(2, place);
    gravity.add_acceleration(0.5, {place, place}, sum);
    for (int d = 0; d < dim; ++d)
      {
        EXPECT_DOUBLE_EQ(sum[1][d], place[d] + expected[d]);
        // the force is minus the gradient of the potential
        Vec<dim> forward = place, backward = place;
        forward[d] += 0.5;
        backward[d] -= 0.5;
        EXPECT_NEAR(gravity.potential(backward) - gravity.potential(forward), expected[d], 1e-12);
      }
  }

  TEST(Gravity, AcceleratesAndHasAPotential)
  {
    check_gravity<2>("1.5, -9.81", {{1.5, -9.81}});
    check_gravity<3>("0, -9.81, 2", {{0, -9.81, 2}});
  }

  TEST(Gravity, WantsOneComponentPerDimension)
  {
    Gravity<2> gravity;
    EXPECT_THROW(GivenParameters::read(gravity, {{"Acceleration", "0, -9.81, 0"}}), InputError);
  }
} // namespace
