#include <couplers/gravouil_combescure.h>
#include <gtest/gtest.h>
#include <unit/plugins/given_parameters.h>

#include <cstdio>

#include "coupled_pair.h"

using namespace Breakwater;

namespace
{
  using Coupling = GravouilCombescure<2>;
  using Pair     = CoupledPair<Coupling>;

  /// Two bars tied by this coupler; see there.
  template <class... Arguments>
  Pair bars(Arguments... arguments)
  {
    return two_bars<Coupling>(arguments...);
  }

  /// Masses 1 and 0.5 kg on springs of 1 and 3 N/m, tied: u = cos(w t), w^2 = 4 / 1.5, over 10 periods.
  Outcome run_two_masses(const bool first_is_coarse, const unsigned int m, const unsigned int steps_per_period)
  {
    const double frequency = std::sqrt(4 / 1.5);
    const double step      = 2 * M_PI / frequency / steps_per_period;
    Pair         pair(point_mass(1, 1, first_is_coarse ? step : step / m),
                      point_mass(0.5, 3, first_is_coarse ? step / m : step), m, first_is_coarse ? "first" : "second");
    pair.first.displacement()[0] = pair.second.displacement()[0] = 1;
    pair.start();

    Outcome outcome;
    double  time = 0;
    for (unsigned int i = 0; i < 10 * steps_per_period; ++i)
      {
        const double pseudo_before = pair.coupling.pseudo_energy();
        time += pair.coupling.advance(1.);
        EXPECT_EQ(pair.coupling.balance(0).n_substeps, m);
        for (const Chain *chain : {&pair.first, &pair.second})
          outcome.error = std::max(outcome.error, std::abs(chain->tied_displacement() - std::cos(frequency * time)));
        observe(pair, pseudo_before, outcome);
      }
    return outcome;
  }

  TEST(GravouilCombescure, TwoMassesConvergeToTheExactSolution)
  {
    for (const bool first_is_coarse : {true, false})
      for (const unsigned int m : {1u, 2u, 10u})
        {
          const Outcome coarse = run_two_masses(first_is_coarse, m, 200),
                        fine   = run_two_masses(first_is_coarse, m, 400);
          const double rate    = std::log2(coarse.error / fine.error);
          std::printf("%s coarse, m = %2u: error %.2e, rate %.2f, energy %.4f\n", first_is_coarse ? "first " : "second",
                      m, fine.error, rate, fine.energy);
          EXPECT_GT(rate, m == 1 ? 1.95 : 0.9);
          EXPECT_LT(fine.error, m == 1 ? 1e-3 : 5e-2);
        }
  }


  TEST(GravouilCombescure, InterfaceEnergyIsZeroAtEqualStepsAndNeverPositive)
  {
    for (const bool first_is_coarse : {true, false})
      for (const unsigned int m : {1u, 2u, 5u, 10u})
        {
          const Outcome outcome = run_two_masses(first_is_coarse, m, 100);
          if (m == 1)
            EXPECT_LT(std::abs(outcome.interface_energy), 1e-14);
          else
            EXPECT_LT(outcome.interface_energy, -0.1);
          EXPECT_LE(outcome.largest_interface_energy, 1e-14);
          EXPECT_LE(outcome.largest_pseudo_growth, m == 1 ? 1e-17 : 0.);
          EXPECT_LT(outcome.gap, 1e-14);
          // what the domains lost went through the interface
          EXPECT_NEAR(outcome.energy - 1, outcome.interface_energy, 5e-4); // to O(dt^2)
        }
  }


  // Interpolating from the corrected velocity leaves 0.39 (m = 5) and 0.27 (m = 10) of the energy at any n.
  TEST(GravouilCombescure, BarsKeepTheirEnergy)
  {
    for (const unsigned int m : {1u, 2u, 5u, 10u})
      {
        double loss[3];
        for (unsigned int i = 0; i < 3; ++i)
          {
            Pair pair = bars(20u << i, m, true, m);
            loss[i]   = 1 - run_bars(pair, 20).energy;
          }
        std::printf("m = %2u: energy lost %.5f, %.5f, %.5f at 20, 40, 80 cells\n", m, loss[0], loss[1], loss[2]);
        EXPECT_LT(loss[2], m == 1 ? 1e-8 : 1e-3);
        if (m > 1)
          {
            EXPECT_GT(loss[0] / loss[1], 3.);
            EXPECT_GT(loss[1] / loss[2], 3.);
          }
      }
  }


  TEST(GravouilCombescure, StepsMayVaryAndDomainsMayChangeRoles)
  {
    for (const unsigned int m : {1u, 3u, 10u})
      for (const bool first_is_coarse : {true, false})
        {
          Pair          pair    = bars(40, m, first_is_coarse, 0);
          const Outcome outcome = run_bars(pair, 40, true);
          EXPECT_LE(outcome.largest_energy, 1 + 1e-4);
          EXPECT_GT(outcome.energy, 0.995);
          EXPECT_LE(outcome.largest_interface_energy, 1e-7);
          EXPECT_LE(outcome.largest_pseudo_growth, 1e-17);
          EXPECT_LT(outcome.gap, 1e-14);
        }
  }


  TEST(GravouilCombescure, AThousandFineStepsInACoarseOne)
  {
    for (const bool first_is_coarse : {true, false})
      {
        Pair pair = bars(20, 1000, first_is_coarse, 0, 1e-9);
        pair.first.set_adopts(true);
        const Outcome outcome = run_bars(pair, 10);
        std::printf("m = %u: energy kept %.5f\n", pair.coupling.balance(0).n_substeps, outcome.energy);
        EXPECT_EQ(pair.coupling.balance(0).n_substeps, 1000u);
        EXPECT_NEAR(outcome.energy, 1, 5e-3);
        EXPECT_LT(outcome.largest_energy, 1.001);
        EXPECT_LE(outcome.largest_pseudo_growth, 1e-17);
      }
  }


  // The work itself may be positive for some steps at first; what the theory bounds falls at every step.
  TEST(GravouilCombescure, PseudoEnergyFallsAtEveryStep)
  {
    const unsigned int n = 40;
    const double       h = 1. / n, cfl = 0.9;
    for (const double density : {0.05, 1.})
      for (const unsigned int m : {2u, 5u, 10u})
        {
          // the first bar has m times the wave speed of the second one
          Pair pair(bar(0, 1, n, density, density * m * m, true, cfl * h / m), bar(1, 2, n, 1, 1, false, cfl * h), m,
                    "second");
          for (unsigned int i = 0; i < n; ++i)
            {
              pair.first.displacement()[i]  = std::sin(M_PI / 2 * (i + 1) * h);
              pair.second.displacement()[i] = std::sin(M_PI / 2 * (1 + i * h));
            }
          const Outcome outcome = run_bars(pair, 40);
          EXPECT_LT(outcome.largest_pseudo_growth, 0.);
          EXPECT_LT(outcome.largest_interface_energy, 1e-5);
          EXPECT_LT(outcome.interface_energy, -1e-3);
          EXPECT_LT(outcome.largest_energy, 1.05);
        }
  }


  // A bound that falls within the coarse step: more fine steps, and the coarse step stays.
  TEST(GravouilCombescure, FineStepsFollowTheirBound)
  {
    class Falling : public Chain
    {
    public:
      using Chain::Chain;
      void end_step() override
      {
        Chain::end_step();
        set_stable_time_step(0.04);
      }
    };
    Chain      first = point_mass(1, 1, 0.5);
    Falling    second({0.}, {0.5}, {{0, Chain::ground(), 3.}}, 0, 0.1);
    Coupling   coupling;
    RunContext context(std::filesystem::temp_directory_path());
    GivenParameters::read(coupling, {});
    first.setup();
    second.setup();
    coupling.adopt_surfaces({&first, &second}, {{"pair", 0, 1}});
    coupling.setup(context);
    EXPECT_DOUBLE_EQ(coupling.advance(1.), 0.5);
    EXPECT_EQ(coupling.balance(0).n_substeps, 11u); // 0.1, then 0.4 in steps of 0.04
    EXPECT_DOUBLE_EQ(coupling.advance(0.3), 0.3);
    EXPECT_EQ(coupling.balance(0).n_substeps, 8u);
    EXPECT_EQ(first.n_ended_steps(), 2u);
    EXPECT_EQ(second.n_ended_steps(), 19u);
  }


  // A fluid's copies of a structure's nodes have hardly any mass of their own: they carry half of their owners'.
  TEST(GravouilCombescure, CopiesThatShareMassAreOrdinaryNodes)
  {
    for (const double mass : {1., 1e-9})
      for (const bool first_is_coarse : {true, false})
        for (const unsigned int m : {1u, 2u, 5u, 20u})
          for (const bool with_random_steps : {false, true})
            {
              Pair pair = bars(40, m, first_is_coarse, 0, mass);
              pair.first.set_adopts(true);
              const Outcome           outcome = run_bars(pair, 40, with_random_steps);
              const InterfaceBalance &balance = pair.coupling.balance(0);
              std::printf("mass %.0e, %s coarse, m = %2u%s: energy kept %.5f, at most %.5f, W %.1e, at most %.1e, "
                          "pseudo %.1e, drift %.1e, taken back %.1e, momentum %.1e\n",
                          mass, first_is_coarse ? "copy " : "owner", m, with_random_steps ? ", random" : "",
                          outcome.energy, outcome.largest_energy, outcome.interface_energy,
                          outcome.largest_interface_energy, outcome.largest_pseudo_growth, balance.largest_drift,
                          balance.largest_taken_back, balance.momentum[0]);
              EXPECT_GT(outcome.energy, 0.98);
              EXPECT_LT(outcome.largest_energy, 1.001);
              EXPECT_LE(outcome.largest_interface_energy, mass == 1 ? 1e-7 : 1e-4); // a little in the first steps
              EXPECT_LE(outcome.largest_pseudo_growth, 1e-17);
              EXPECT_LT(outcome.gap, 1e-13);
              EXPECT_LT(balance.largest_drift, 1e-15);
              EXPECT_LT(balance.largest_taken_back, m == 1 && !with_random_steps ? 1e-13 : 3e-4);
              EXPECT_NEAR(pair.first.wet_surface().position[0][0], pair.second.wet_surface().position[0][0], 1e-15);
            }
  }


  // A massless node under load at time 0: 1e9 m/s^2 if it were left to itself.
  TEST(GravouilCombescure, FirstStepStartsFromBalancedAccelerations)
  {
    Pair pair(point_mass(1e-9, 1, 0.01), point_mass(1, 1, 0.01));
    pair.first.displacement()[0] = pair.second.displacement()[0] = 1;
    pair.first.set_adopts(true);
    pair.start();
    double time = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        time += pair.coupling.advance(0.01);
        EXPECT_NEAR(pair.first.tied_displacement(), std::cos(std::sqrt(2.) * time), 1e-7);
        EXPECT_NEAR(pair.coupling.interface_force(0)[0], -std::cos(std::sqrt(2.) * time), 1e-4);
      }
  }


  TEST(GravouilCombescure, HeldNodesHoldTheirPartners)
  {
    Pair pair(bar(-1, 0, 10, 1, 1, true, 0.05), point_mass(std::numeric_limits<double>::infinity(), 1, 0.05));
    for (unsigned int i = 0; i < 9; ++i)
      pair.first.displacement()[i] = 0.01 * i;
    pair.first.setup();
    pair.second.setup();
    pair.coupling.adopt_surfaces({&pair.first, &pair.second}, {{"pair", 0, 1}});
    pair.coupling.setup(*pair.context);
    for (unsigned int i = 0; i < 200; ++i)
      pair.coupling.advance(1.);
    EXPECT_NEAR(pair.first.tied_displacement(), 0, 1e-12);
    EXPECT_EQ(pair.second.tied_displacement(), 0.);
    EXPECT_EQ(pair.coupling.interface_force(0)[1], 0.); // y is held on both sides
    EXPECT_NE(pair.coupling.interface_force(0)[0], 0.);
  }


  TEST(GravouilCombescure, ResumedRunHasTheSameBits)
  {
    Pair whole = bars(20, 5, true, 5), resumed = bars(20, 5, true, 5);
    expect_same_bits_after_resume(whole, resumed);
  }


  TEST(GravouilCombescure, RefusesNodesThatDoNotMatch)
  {
    Pair pair(point_mass(1, 1, 0.1), point_mass(1, 1, 0.1));
    pair.first.displacement()[0] = 1e-3;
    EXPECT_THROW(pair.start(), InputError);
    EXPECT_THROW(GivenParameters::read(pair.coupling, {{"Interface", "non matching"}}), InputError);
  }


  TEST(GravouilCombescure, StopsWhenABoundIsLost)
  {
    Pair pair(point_mass(1, 1, 0.1), point_mass(1, 1, 0.1));
    pair.start();
    pair.second.set_stable_time_step(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(pair.coupling.advance(1.), BreakdownError);
  }
} // namespace
