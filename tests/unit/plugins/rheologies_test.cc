#include <gtest/gtest.h>
#include <rheologies/bingham.h>
#include <rheologies/herschel_bulkley.h>
#include <rheologies/inviscid.h>
#include <rheologies/newtonian.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "given_parameters.h"
#include "unit/base/message_of.h"

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

  double viscosity_at(const FluidRheology &rheology, const double shear_rate)
  {
    double viscosity = 0;
    rheology.viscosity(&shear_rate, &viscosity, 1);
    return viscosity;
  }

  /// Shear rates [1/s] from none at all to far beyond any flow's.
  std::vector<double> shear_rates()
  {
    std::vector<double> rates = {0, std::numeric_limits<double>::denorm_min(), 1e-300};
    for (double rate = 1e-20; rate < 1e13; rate *= 1.7)
      rates.push_back(rate);
    return rates;
  }

  /// No viscosity is above the largest one; where that is a supremum, it is reached at rest.
  void check_largest_viscosity(const FluidRheology &rheology, const bool is_reached_at_rest)
  {
    const double largest = rheology.largest_viscosity();
    ASSERT_TRUE(std::isfinite(largest));
    double found = 0;
    for (const double rate : shear_rates())
      {
        const double viscosity = viscosity_at(rheology, rate);
        EXPECT_TRUE(std::isfinite(viscosity) && viscosity >= 0) << "at " << rate;
        EXPECT_LE(viscosity, largest * (1 + 1e-15)) << "at " << rate;
        found = std::max(found, viscosity);
      }
    if (is_reached_at_rest)
      {
        EXPECT_DOUBLE_EQ(viscosity_at(rheology, 0), largest);
      }
    else
      EXPECT_GT(found, 0.5 * largest);
  }

  /// The shear stress grows with the shear rate.
  void check_stress_grows(const FluidRheology &rheology)
  {
    double previous = -1;
    for (const double rate : shear_rates())
      {
        const double stress = rate * viscosity_at(rheology, rate);
        EXPECT_GE(stress, previous * (1 - 1e-14)) << "at " << rate;
        previous = stress;
      }
  }

  TEST(Bingham, LimitsOfTheRegularisedLaw)
  {
    Bingham bingham;
    GivenParameters::read(bingham, {{"Plastic viscosity", "0.5"}, {"Yield stress", "20"}, {"Regularization", "50"}});
    EXPECT_FALSE(bingham.is_newtonian());
    EXPECT_TRUE(bingham.is_viscous());
    EXPECT_DOUBLE_EQ(viscosity_at(bingham, 0), 0.5 + 20 * 50);
    // x = m g = 1e-9: (1 - exp(-x)) / x = 1 - x / 2
    EXPECT_NEAR((viscosity_at(bingham, 2e-11) - 0.5) / 1000, 1 - 0.5e-9, 2e-15);
    EXPECT_NEAR(viscosity_at(bingham, 0.02), 0.5 + 20 * (1 - std::exp(-1)) / 0.02, 1e-10);
    // far above 1 / m the ideal law: stress tau_y + mu_p g
    EXPECT_NEAR(viscosity_at(bingham, 10) * 10, 20 + 0.5 * 10, 1e-12);
    check_largest_viscosity(bingham, true);
    check_stress_grows(bingham);
  }

  TEST(Bingham, WithoutYieldStressItIsNewtonian)
  {
    Bingham bingham;
    GivenParameters::read(bingham, {{"Plastic viscosity", "0.3"}});
    EXPECT_TRUE(bingham.is_newtonian());
    EXPECT_EQ(bingham.largest_viscosity(), 0.3);
    for (const double rate : shear_rates())
      EXPECT_EQ(viscosity_at(bingham, rate), 0.3);
  }

  TEST(HerschelBulkley, IsBinghamForFlowIndexOne)
  {
    HerschelBulkley bulkley;
    GivenParameters::read(bulkley, {{"Consistency", "0.5"}, {"Yield stress", "20"}});
    Bingham bingham;
    GivenParameters::read(bingham, {{"Plastic viscosity", "0.5"}, {"Yield stress", "20"}});
    for (const double rate : shear_rates())
      EXPECT_DOUBLE_EQ(viscosity_at(bulkley, rate), viscosity_at(bingham, rate));
    EXPECT_DOUBLE_EQ(bulkley.largest_viscosity(), bingham.largest_viscosity());
    EXPECT_FALSE(bulkley.is_newtonian());

    HerschelBulkley newtonian;
    GivenParameters::read(newtonian, {{"Consistency", "0.5"}});
    EXPECT_TRUE(newtonian.is_newtonian());
    EXPECT_EQ(newtonian.largest_viscosity(), 0.5);
  }

  TEST(HerschelBulkley, Thinning)
  {
    HerschelBulkley bulkley;
    GivenParameters::read(
      bulkley, {{"Consistency", "3"}, {"Yield stress", "20"}, {"Flow index", "0.4"}, {"Regularization", "50"}});
    EXPECT_FALSE(bulkley.is_newtonian());
    EXPECT_DOUBLE_EQ(bulkley.largest_viscosity(), 3 * std::pow(50, 0.6) + 20 * 50);
    EXPECT_NEAR(viscosity_at(bulkley, 10) * 10, 20 + 3 * std::pow(10, 0.4), 1e-12);
    check_largest_viscosity(bulkley, true);
    check_stress_grows(bulkley);
  }

  TEST(HerschelBulkley, PowerLawWithoutYieldStress)
  {
    HerschelBulkley power_law;
    GivenParameters::read(power_law, {{"Consistency", "3"}, {"Flow index", "0.5"}, {"Regularization", "100"}});
    EXPECT_FALSE(power_law.is_newtonian());
    EXPECT_NEAR(viscosity_at(power_law, 4), 1.5, 1e-14);
    EXPECT_NEAR(viscosity_at(power_law, 0), 30, 1e-13);
    // continuous at 1 / m
    EXPECT_NEAR(viscosity_at(power_law, 0.01 * (1 + 1e-12)), viscosity_at(power_law, 0.01 * (1 - 1e-12)), 1e-10);
    check_largest_viscosity(power_law, true);
    check_stress_grows(power_law);
  }

  TEST(HerschelBulkley, ThickeningUpToTheLargestShearRate)
  {
    for (const std::string flow_index : {"1.3", "2", "3"})
      {
        HerschelBulkley bulkley;
        GivenParameters::read(
          bulkley,
          {{"Consistency", "3"}, {"Yield stress", "20"}, {"Flow index", flow_index}, {"Largest shear rate", "500"}});
        const double n = std::stod(flow_index);
        EXPECT_DOUBLE_EQ(viscosity_at(bulkley, 0), 20 * 10);
        EXPECT_NEAR(viscosity_at(bulkley, 100) * 100, 20 + 3 * std::pow(100, n), 1e-12 * std::pow(100, n));
        EXPECT_NEAR(viscosity_at(bulkley, 1e5), 3 * std::pow(500, n - 1), 3e-4);
        check_largest_viscosity(bulkley, false);
        check_stress_grows(bulkley);
      }
  }

  template <class Rheology>
  std::string message_about(const std::map<std::string, std::string> &values)
  {
    Rheology rheology;
    return message_of([&] {
      GivenParameters::read(rheology, values);
    });
  }

  TEST(Rheologies, RefuseConstantsWithoutMeaning)
  {
    EXPECT_EQ(message_about<Bingham>({}).find("Plastic viscosity: the law is empty"), 0u);
    EXPECT_EQ(message_about<Bingham>({{"Yield stress", "-1"}}), "Yield stress: out of range");
    EXPECT_EQ(message_about<Bingham>({{"Yield stress", "1"}, {"Regularization", "0"}}), "Regularization: out of range");
    EXPECT_EQ(message_about<HerschelBulkley>({}).find("Consistency: the law is empty"), 0u);
    EXPECT_EQ(message_about<HerschelBulkley>({{"Consistency", "1"}, {"Flow index", "0"}}), "Flow index: out of range");
    EXPECT_EQ(message_about<HerschelBulkley>({{"Consistency", "1"}, {"Flow index", "1.5"}})
                .find("Largest shear rate: a flow index above 1 needs one"),
              0u);
    EXPECT_EQ(message_about<HerschelBulkley>({{"Consistency", "1"}, {"Largest shear rate", "5"}})
                .find("Largest shear rate: only a flow index above 1"),
              0u);
  }
} // namespace
