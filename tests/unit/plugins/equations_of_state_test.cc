#include <equations_of_state/linear.h>
#include <equations_of_state/stiffened_gas.h>
#include <equations_of_state/tait.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "given_parameters.h"
#include "unit/base/message_of.h"

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

  TEST(StiffenedGas, IsTheIsentropeOfTheFullLaw)
  {
    // p = (gamma - 1) rho e - gamma p_inf along de = p / rho^2 drho, integrated from (rho0, p0) by Runge and Kutta.
    const double gamma = 4.4, p_inf = 6e8, p0 = 1e5, rho0 = 1000;
    StiffenedGas gas;
    GivenParameters::read(gas, {{"Stiffness pressure", "6e8"}, {"Reference pressure", "1e5"}});
    const auto slope = [&](const double rho, const double e) {
      return ((gamma - 1) * rho * e - gamma * p_inf) / (rho * rho);
    };
    double             e = (p0 + gamma * p_inf) / ((gamma - 1) * rho0), rho = rho0;
    const unsigned int n_steps = 200;
    const double       d       = 100. / n_steps;
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        const double k1 = slope(rho, e), k2 = slope(rho + d / 2, e + d / 2 * k1);
        const double k3 = slope(rho + d / 2, e + d / 2 * k2), k4 = slope(rho + d, e + d * k3);
        e += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        rho += d;
      }
    const double expected = (gamma - 1) * rho * e - gamma * p_inf;
    EXPECT_NEAR(pressure_at(gas, rho) / expected, 1, 1e-9);
    EXPECT_NEAR(gas.sound_speed(rho), std::sqrt(gamma * (expected + p_inf) / rho), 1e-6);
    // The two energies differ by a constant.
    EXPECT_NEAR((gas.specific_energy(rho) - gas.specific_energy(rho0)) /
                  (e - (p0 + gamma * p_inf) / ((gamma - 1) * rho0)),
                1, 1e-9);
  }

  TEST(StiffenedGas, IsConsistentForAnyConstants)
  {
    for (const std::string gamma : {"1", "1.4", "4.4", "7"})
      for (const std::string reference_pressure : {"0", "1e5", "-1e5"})
        {
          StiffenedGas gas;
          GivenParameters::read(
            gas, {{"Stiffness pressure", "3e5"}, {"Gamma", gamma}, {"Reference pressure", reference_pressure}});
          EXPECT_NEAR(pressure_at(gas, 1000), std::stod(reference_pressure), 1e-8);
          check_rest(gas);
          for (const double rho : {950., 1001., 1200.})
            check_consistency(gas, rho);
        }
  }

  TEST(StiffenedGas, IsTaitWithTheSumOfPressuresAsBulkModulus)
  {
    StiffenedGas gas;
    GivenParameters::read(gas, {{"Stiffness pressure", "2e5"}, {"Gamma", "7"}, {"Reference pressure", "1e5"}});
    Tait tait;
    GivenParameters::read(tait, {{"Bulk modulus", "3e5"}, {"Gamma", "7"}, {"Reference pressure", "1e5"}});
    for (const double rho : {900., 1000., 1100.})
      {
        EXPECT_NEAR(pressure_at(gas, rho), pressure_at(tait, rho), 1e-9 * 3e5);
        EXPECT_NEAR(gas.specific_energy(rho), tait.specific_energy(rho), 1e-12 * 300);
      }
  }

  TEST(StiffenedGas, PerfectGasRelativeToTheAmbientPressure)
  {
    StiffenedGas air;
    GivenParameters::read(air, {{"Reference density", "1.2"}, {"Gamma", "1.4"}, {"Stiffness pressure", "1e5"}});
    EXPECT_NEAR(pressure_at(air, 2.4), 1e5 * (std::pow(2, 1.4) - 1), 1e-8);
    EXPECT_NEAR(air.sound_speed(1.2), std::sqrt(1.4 * 1e5 / 1.2), 1e-10);
  }

  TEST(StiffenedGas, SoundSpeedGivesTheStiffnessPressure)
  {
    StiffenedGas gas;
    GivenParameters::read(gas, {{"Sound speed", "30"}, {"Reference pressure", "5e4"}});
    EXPECT_NEAR(gas.sound_speed(1000), 30, 1e-12);
    EXPECT_NEAR(pressure_at(gas, 1000), 5e4, 1e-8);
  }

  TEST(StiffenedGas, RefusesConstantsWithoutMeaning)
  {
    using Values             = std::map<std::string, std::string>;
    const auto message_about = [](const Values &values) {
      StiffenedGas gas;
      return message_of([&] {
        GivenParameters::read(gas, values);
      });
    };
    const auto starts_with = [](const std::string &text, const std::string &start) {
      return text.compare(0, start.size(), start) == 0;
    };
    const Values both = {{"Stiffness pressure", "1e5"}, {"Sound speed", "30"}};
    EXPECT_TRUE(starts_with(message_about(both), "Stiffness pressure: give either"));
    EXPECT_TRUE(starts_with(message_about({}), "Sound speed: the fluid's stiffness is missing"));
    const Values silent = {{"Stiffness pressure", "1e5"}, {"Reference pressure", "-1e5"}};
    EXPECT_TRUE(starts_with(message_about(silent), "Reference pressure: must be above minus"));
    const Values hard = {{"Sound speed", "10"}, {"Gamma", "4"}, {"Reference pressure", "25000"}};
    EXPECT_TRUE(starts_with(message_about(hard), "Reference pressure: must be below"));
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
