#include <couplers/gravouil_combescure.h>
#include <couplers/prakash_hjelmstad.h>
#include <couplers/staggered.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "coupled_pair.h"

using namespace Breakwater;

namespace
{
  // The multiplier is linear in time: at the interface nothing is lost, whatever m.
  TEST(PrakashHjelmstad, LosesNothingAtTheInterface)
  {
    for (const bool first_is_coarse : {true, false})
      for (const unsigned int m : {1u, 2u, 5u, 20u})
        {
          double loss[2];
          for (const unsigned int k : {0u, 1u})
            {
              auto          pair    = two_bars<PrakashHjelmstad<2>>(40u << k, m, first_is_coarse, m);
              const Outcome outcome = run_bars(pair, 20);
              loss[k]               = 1 - outcome.energy;
              std::printf("%s coarse, m = %2u: energy lost %.2e, at most %.7f, W %.1e to %.1e, pseudo-energy %.1e, gap "
                          "%.1e, passes %u\n",
                          first_is_coarse ? "first " : "second", m, loss[k], outcome.largest_energy,
                          outcome.interface_energy, outcome.largest_interface_energy,
                          pair.coupling.pseudo_energy() / pair.start_energy, outcome.gap,
                          pair.coupling.balance(0).n_iterations);
              EXPECT_LT(std::abs(pair.coupling.pseudo_energy()) / pair.start_energy, 1e-10);
              EXPECT_LT(outcome.gap, 1e-11);
              EXPECT_LT(std::abs(outcome.interface_energy), 1e-10);
              EXPECT_LT(outcome.largest_interface_energy, 1e-10);
              EXPECT_LT(std::abs(loss[k]), 1e-7);
              EXPECT_LT(std::abs(pair.coupling.balance(0).momentum[0]), 1e-12);
            }
        }
  }

  /// A point mass on a spring with a force that jumps whenever the velocity changes by 0.5 mm/s.
  class Rubbing : public Chain
  {
  public:
    using Chain::Chain;
    void advance_free(const double time_step) override
    {
      Chain::advance_free(time_step);
      const double v = wet_surface().velocity[0][0];
      add_link_force({{{std::fmod(std::abs(v), 1e-3) > 5e-4 ? -0.1 : 0.1, 0.}}}, time_step);
    }
  };


  // Repetitions can't agree on what jumps: the step is made with fewer fine steps, at last with one.
  TEST(PrakashHjelmstad, TakesFewerFineStepsWhereAnswersJump)
  {
    Chain               first = point_mass(1, 1, 0.08);
    Rubbing             second({0.}, {1.}, {{0, Chain::ground(), 1.}}, 0, 0.01);
    PrakashHjelmstad<2> coupling;
    RunContext          context(std::filesystem::temp_directory_path());
    GivenParameters::read(coupling, {{"Coarse domain", "first"}});
    first.displacement()[0] = second.displacement()[0] = 1;
    first.setup();
    second.setup();
    coupling.adopt_surfaces({&first, &second}, {{"pair", 0, 1}});
    coupling.setup(context);
    unsigned int fewest = 8, most = 0;
    const double start = first.energy() + second.energy();
    for (double time = 0; time < 20;)
      {
        time += coupling.advance(1.);
        fewest = std::min(fewest, coupling.balance(0).n_substeps);
        most   = std::max(most, coupling.balance(0).n_substeps);
        EXPECT_LT(first.energy() + second.energy(), 2 * start);
      }
    std::printf("fine steps: %u to %u, %.0f steps made anew, energy %.3f of the first\n", fewest, most,
                context.summary().at("coarse_steps_made_shorter"), (first.energy() + second.energy()) / start);
    EXPECT_EQ(most, 8u);
    EXPECT_EQ(fewest, 1u);
    EXPECT_LT(coupling.balance(0).largest_gap, 1e-6);
  }


  TEST(PrakashHjelmstad, ResumedRunHasTheSameBits)
  {
    auto whole = two_bars<PrakashHjelmstad<2>>(20, 5, true, 5), resumed = two_bars<PrakashHjelmstad<2>>(20, 5, true, 5);
    expect_same_bits_after_resume(whole, resumed);
  }


  /// Two bars of 200 cells and length 1, the second one with twice the density and modulus; a pulse in the first one runs to the
  /// tie. The coarse step is that of a CFL number of 0.4. Relative errors of the reflected and
  /// transmitted amplitudes.
  template <class Coupling>
  std::pair<double, double> pulse_errors(const unsigned int m)
  {
    const unsigned int n = 200;
    const double       h = 1. / n, width = 0.1;
    // the second bar is the coarse one, as the staggered scheme's leader must be
    const double          step = 0.4 * h;
    CoupledPair<Coupling> pair(bar(0, 1, n, 1, 1, true, step / m), bar(1, 2, n, 2, 2, false, step), m,
                               m == 1 ? "automatic" : "second");
    const auto            shape = [width](const double s) {
      return std::abs(s) < width ? std::pow(std::cos(M_PI / 2 * s / width), 4) : 0.;
    };
    for (unsigned int i = 0; i < n; ++i) // u = f(x - t), v = -f'
      {
        const double x = (i + 1) * h, e = 1e-6;
        pair.first.displacement()[i] = shape(x - 0.5);
        pair.first.velocity()[i]     = -(shape(x - 0.5 + e) - shape(x - 0.5 - e)) / (2 * e);
      }
    pair.start();
    for (double time = 0; time < 0.75 - 1e-12;)
      time += pair.coupling.advance(0.75 - time);
    // At t = 0.75 the reflected pulse is at 0.75 and the transmitted one beyond the tie.
    const double impedance = 2; // of the second bar, by that of the first one
    const double reflected = (1 - impedance) / (1 + impedance), transmitted = 2 / (1 + impedance);
    double       lowest = 0, highest = 0, beyond = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        lowest  = std::min(lowest, pair.first.displacement()[i]);
        highest = std::max(highest, pair.first.displacement()[i]);
        beyond  = std::max(beyond, std::abs(pair.second.displacement()[i]));
      }
    const double back = reflected < 0 ? lowest : highest;
    return {back / reflected - 1, beyond / transmitted - 1};
  }


  // Impedances 1 and 2: of the amplitude a third is reflected, two thirds go on.
  TEST(Schemes, PulseIsReflectedAndTransmitted)
  {
    for (const unsigned int m : {1u, 5u, 20u})
      {
        const auto gravouil = pulse_errors<GravouilCombescure<2>>(m), prakash = pulse_errors<PrakashHjelmstad<2>>(m),
                   staggered = pulse_errors<Staggered<2>>(m);
        std::printf("m = %2u: errors of reflection and transmission: Gravouil-Combescure %.4f %.4f, Prakash-Hjelmstad "
                    "%.4f %.4f, staggered %.4f %.4f\n",
                    m, gravouil.first, gravouil.second, prakash.first, prakash.second, staggered.first,
                    staggered.second);
        for (const auto &errors : {gravouil, prakash, staggered})
          {
            EXPECT_LT(std::abs(errors.first), 0.01);
            EXPECT_LT(std::abs(errors.second), 0.01);
          }
      }
  }


  // Free masses of a follower and a leader: the multiplier does not care, the staggered scheme may not be used with a
  // follower that is heavier than the leader.
  TEST(Schemes, StaggeredIsUnstableForHeavyFollowers)
  {
    const auto largest_energy = [](auto &&pair) {
      pair.first.displacement()[0] = pair.second.displacement()[0] = 1;
      pair.start();
      double largest = 1;
      for (unsigned int i = 0; i < 2000; ++i)
        {
          pair.coupling.advance(1.);
          largest = std::max(largest, pair.energy() / pair.start_energy);
        }
      return largest;
    };
    const auto masses = [](const double follower) {
      return std::make_pair(point_mass(follower, 1, 0.01), point_mass(1, 1, 0.01));
    };
    for (const double follower : {0.1, 0.5, 2.})
      {
        const auto   chains    = masses(follower);
        const double gravouil  = largest_energy(CoupledPair<GravouilCombescure<2>>(chains.first, chains.second)),
                     staggered = largest_energy(CoupledPair<Staggered<2>>(chains.first, chains.second));
        std::printf(
          "follower of %.1f times the leader's mass: largest energy %.4f with the multiplier, %.3g staggered\n",
          follower, gravouil, staggered);
        EXPECT_LT(gravouil, 1.001);
        if (follower > 1)
          EXPECT_GT(staggered, 1e6);
        else
          EXPECT_LT(staggered, 2.);
      }
  }
} // namespace
