#pragma once

#include <gtest/gtest.h>
#include <unit/plugins/given_parameters.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include "chain.h"

namespace Breakwater
{
  /// Two coupled chains.
  template <class Coupling>
  struct CoupledPair
  {
    Chain                       first, second;
    Coupling                    coupling;
    std::unique_ptr<RunContext> context      = std::make_unique<RunContext>(std::filesystem::temp_directory_path());
    double                      start_energy = 0;

    CoupledPair(Chain a, Chain b, const unsigned int n_substeps = 0, const std::string &coarse = "automatic")
      : first(std::move(a))
      , second(std::move(b))
    {
      GivenParameters::read(coupling, {{"Substeps", std::to_string(n_substeps)}, {"Coarse domain", coarse}});
    }
    void start()
    {
      first.setup();
      second.setup();
      coupling.adopt_surfaces({&first, &second}, {{"pair", 0, 1}});
      coupling.setup(*context);
      start_energy = energy();
    }
    double energy() const { return first.energy() + second.energy(); }
  };


  /// What a run showed: error of the displacement, and energies as fractions of that at the start.
  struct Outcome
  {
    double error = 0, energy = 0, largest_energy = 0, interface_energy = 0, largest_interface_energy = -1,
           largest_pseudo_growth = -1, gap = 0;
  };

  template <class Coupling>
  void observe(const CoupledPair<Coupling> &pair, const double pseudo_before, Outcome &outcome)
  {
    outcome.energy                   = pair.energy() / pair.start_energy;
    outcome.largest_energy           = std::max(outcome.largest_energy, outcome.energy);
    outcome.interface_energy         = pair.coupling.balance(0).energy / pair.start_energy;
    outcome.largest_interface_energy = std::max(outcome.largest_interface_energy, outcome.interface_energy);
    outcome.largest_pseudo_growth =
      std::max(outcome.largest_pseudo_growth, (pair.coupling.pseudo_energy() - pseudo_before) / pair.start_energy);
    outcome.gap = pair.coupling.balance(0).largest_gap;
  }


  /// Two bars of length 1 and n cells each, coarse CFL number 0.5, in the first mode of the pair.
  template <class Coupling>
  CoupledPair<Coupling> two_bars(const unsigned int n, const unsigned int m, const bool first_is_coarse,
                                 const unsigned int n_substeps, const double mass_of_the_first_tied_node = 1)
  {
    const double          h = 1. / n, step = 0.5 * h;
    CoupledPair<Coupling> pair(bar(0, 1, n, 1, 1, true, first_is_coarse ? step : step / m),
                               bar(1, 2, n, 1, 1, false, first_is_coarse ? step / m : step), n_substeps,
                               n_substeps == 0 ? "automatic" :
                               first_is_coarse ? "first" :
                                                 "second");
    pair.first.mass()[n - 1] *= mass_of_the_first_tied_node;
    for (unsigned int i = 0; i < n; ++i)
      {
        pair.first.displacement()[i]  = std::sin(M_PI / 2 * (i + 1) * h);
        pair.second.displacement()[i] = std::sin(M_PI / 2 * (1 + i * h));
      }
    return pair;
  }

  template <class Coupling>
  Outcome run_bars(CoupledPair<Coupling> &pair, const double duration, const bool with_random_steps = false)
  {
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> fraction(0.3, 1.);
    const double first_step = pair.first.stable_time_step(), second_step = pair.second.stable_time_step();
    pair.start();
    Outcome outcome;
    for (double time = 0; time < duration;)
      {
        if (with_random_steps)
          {
            pair.first.set_stable_time_step(first_step * fraction(generator));
            pair.second.set_stable_time_step(second_step * fraction(generator));
          }
        const double pseudo_before = pair.coupling.pseudo_energy();
        time += pair.coupling.advance(1.);
        observe(pair, pseudo_before, outcome);
      }
    return outcome;
  }


  /// Ten coarse steps; the other pair goes on from a checkpoint of the first one for ten more, as that one does.
  template <class Coupling>
  void expect_same_bits_after_resume(CoupledPair<Coupling> &whole, CoupledPair<Coupling> &resumed)
  {
    whole.start();
    for (unsigned int i = 0; i < 10; ++i)
      whole.coupling.advance(1.);
    std::stringstream checkpoint;
    whole.first.save(checkpoint);
    whole.second.save(checkpoint);
    whole.coupling.save(checkpoint);
    resumed.start();
    resumed.first.load(checkpoint);
    resumed.second.load(checkpoint);
    resumed.coupling.load(checkpoint);
    for (CoupledPair<Coupling> *pair : {&whole, &resumed})
      for (unsigned int i = 0; i < 10; ++i)
        pair->coupling.advance(1.);
    EXPECT_EQ(whole.first.displacement(), resumed.first.displacement());
    EXPECT_EQ(whole.second.velocity(), resumed.second.velocity());
    EXPECT_EQ(whole.coupling.balance(0).energy, resumed.coupling.balance(0).energy);
  }
} // namespace Breakwater
