#include <gtest/gtest.h>
#include <rheologies/inviscid.h>
#include <rheologies/newtonian.h>

#include "given_parameters.h"

using namespace Breakwater;

namespace
{
  TEST(Rheologies, ViscosityDoesNotDependOnTheShearRate)
  {
    Newtonian newtonian;
    GivenParameters::read(newtonian, {{"Viscosity", "0.25"}});
    const double shear_rate[3] = {0, 10, 1e6};
    double       viscosity[3]  = {};
    newtonian.viscosity(shear_rate, viscosity, 3);
    for (const double value : viscosity)
      EXPECT_EQ(value, 0.25);
    EXPECT_EQ(newtonian.largest_viscosity(), 0.25);
    EXPECT_TRUE(newtonian.is_viscous());
    EXPECT_THROW(GivenParameters::read(newtonian, {{"Viscosity", "-1"}}), InputError);

    const Inviscid inviscid;
    inviscid.viscosity(shear_rate, viscosity, 3);
    for (const double value : viscosity)
      EXPECT_EQ(value, 0.);
    EXPECT_FALSE(inviscid.is_viscous());
  }

  TEST(Rheologies, NewtonianWithoutViscosityIsNotViscous)
  {
    Newtonian newtonian;
    GivenParameters::read(newtonian, {{"Viscosity", "0"}});
    EXPECT_FALSE(newtonian.is_viscous());
  }
} // namespace
