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

  /// Two bars of 200 cells and length 1, the second one with 4 times the modulus, both with `density`; a pulse in the
  /// first one runs to the tie. Relative errors of the reflected and transmitted amplitudes.
  template <class Coupling>
  std::pair<double, double> pulse_errors(const unsigned int m, const double mass_ratio)
  {
    const unsigned int n = 200;
    const double       h = 1. / n, width = 0.1;
    // c = 1 and 2; the first bar is the coarse one for m > 1 with steps of the second one over m
    const double          step = 0.4 * h;
    CoupledPair<Coupling> pair(bar(0, 1, n, 1, 1, true, step),
                               bar(1, 2, n, mass_ratio, 4 / mass_ratio, false, step / m), m,
                               m == 1 ? "automatic" : "first");
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
    const double c = 2 / mass_ratio, impedance = mass_ratio * c;
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
        const auto gravouil = pulse_errors<GravouilCombescure<2>>(m, 1.),
                   prakash = pulse_errors<PrakashHjelmstad<2>>(m, 1.), staggered = pulse_errors<Staggered<2>>(m, 1.);
        std::printf("m = %2u: errors of reflection and transmission: Gravouil-Combescure %.4f %.4f, Prakash-Hjelmstad "
                    "%.4f %.4f, staggered %.4f %.4f\n",
                    m, gravouil.first, gravouil.second, prakash.first, prakash.second, staggered.first,
                    staggered.second);
        for (const auto &errors : {gravouil, prakash})
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
