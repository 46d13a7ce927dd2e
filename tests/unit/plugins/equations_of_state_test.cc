#include <equations_of_state/linear.h>
#include <equations_of_state/tait.h>
#include <gtest/gtest.h>

#include <cmath>

#include "given_parameters.h"

using namespace Breakwater;

namespace
{
  double pressure_at(const EquationOfState &state, const double density)
  {
    double pressure = 0;
    state.pressure(&density, &pressure, 1);
    return pressure;
  }

  /// What any equation of state must fulfil, by central differences around a density.
  void check_consistency(const EquationOfState &state, const double density)
  {
    const double p = pressure_at(state, density), c = state.sound_speed(density);
    EXPECT_NEAR(state.density(p), density, 1e-12 * density);

    const double d     = 1e-4 * density;
    const double slope = (pressure_at(state, density + d) - pressure_at(state, density - d)) / (2 * d);
    EXPECT_NEAR(std::sqrt(slope), c, 1e-6 * c);
    const double energy_slope = (state.specific_energy(density + d) - state.specific_energy(density - d)) / (2 * d);
    EXPECT_NEAR(energy_slope, p / (density * density), 1e-6 * c * c / density);
  }

  void check_rest(const EquationOfState &state)
  {
    const double density = state.reference_density();
    EXPECT_NEAR(pressure_at(state, density), 0, 1e-10);
    EXPECT_EQ(state.specific_energy(density), 0.);
    // c^2 l^2 / 2 for small compressions l, without loss of digits
    const double c = state.sound_speed(density);
    EXPECT_NEAR(state.specific_energy(density * (1 + 1e-6)) / (0.5e-12 * c * c), 1, 1e-5);
  }

  TEST(Tait, AgreesWithItsFormula)
  {
    Tait tait;
    GivenParameters::read(tait, {{"Reference density", "1000"}, {"Bulk modulus", "2e5"}});
    std::vector<double> density, pressure;
    for (unsigned int i = 0; i < 131; ++i) // more than two blocks
      density.push_back(900 + 2 * i);
    pressure.resize(density.size());
    tait.pressure(density.data(), pressure.data(), density.size());
    for (std::size_t i = 0; i < density.size(); ++i)
      EXPECT_NEAR(pressure[i], 2e5 * (std::pow(density[i] / 1000, 7) - 1), 1e-8);
    check_rest(tait);
    for (const double rho : {950., 1001., 1200.})
      check_consistency(tait, rho);
  }

  TEST(Tait, SoundSpeedGivesTheBulkModulus)
  {
    Tait tait;
    GivenParameters::read(tait, {{"Sound speed", "30"}});
    EXPECT_NEAR(tait.sound_speed(1000), 30, 1e-12);
    EXPECT_NEAR(pressure_at(tait, 1010), 1000. * 30 * 30 / 7 * (std::pow(1.01, 7) - 1), 1e-8);
  }

  TEST(Tait, TakesAnyExponentAndReferencePressure)
  {
    for (const std::string gamma : {"1", "1.4", "7", "7.15"})
      {
        Tait tait;
        GivenParameters::read(tait, {{"Bulk modulus", "3e5"}, {"Gamma", gamma}, {"Reference pressure", "1e5"}});
        EXPECT_NEAR(pressure_at(tait, 1000), 1e5, 1e-8);
        EXPECT_LT(tait.reference_density(), 1000);
        check_rest(tait);
        check_consistency(tait, 1020);
      }
  }

  TEST(Linear, AgreesWithItsFormula)
  {
    LinearEquationOfState linear;
    GivenParameters::read(linear, {{"Reference density", "800"}, {"Sound speed", "20"}});
    EXPECT_NEAR(pressure_at(linear, 801), 400, 1e-9);
    check_rest(linear);
    check_consistency(linear, 790);
    check_consistency(linear, 900);
    GivenParameters::read(linear, {{"Bulk modulus", "80000"}, {"Sound speed", "0"}});
    EXPECT_NEAR(linear.sound_speed(800), 10, 1e-12);
  }

  template <class State>
  void check_that_one_stiffness_is_given()
  {
    State both, none;
    EXPECT_THROW(GivenParameters::read(both, {{"Bulk modulus", "1e5"}, {"Sound speed", "30"}}), InputError);
    EXPECT_THROW(GivenParameters::read(none, {}), InputError);
  }

  TEST(EquationsOfState, WantEitherBulkModulusOrSoundSpeed)
  {
    check_that_one_stiffness_is_given<Tait>();
    check_that_one_stiffness_is_given<LinearEquationOfState>();
    Tait tait;
    EXPECT_THROW(GivenParameters::read(tait, {{"Bulk modulus", "1e5"}, {"Reference pressure", "1e5"}}), InputError);
  }
} // namespace
