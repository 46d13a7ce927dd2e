#pragma once

#include "tied_coupler.h"

#include <string>
#include <vector>

namespace Breakwater
{
  /// Ties the velocities of domains at the ends of coarse steps; within one the multiplier is linear in time.
  ///
  /// The scheme of Prakash and Hjelmstad, A FETI-based multi-time-step coupling method for Newmark schemes in structural
  /// dynamics, Int. J. Numer. Meth. Engng 61 (2004) 2183-2204. Nothing is lost at the interface whatever m: the forces on
  /// both sides change in proportion to time and the velocities by the same, so that the pseudo-energy that they give is
  /// zero. The multiplier at the end depends on the answer of the fine domains over all their steps. That answer is not
  /// known in a formula: the fine steps are repeated from a copy of the state until the velocities agree, with the
  /// interface quasi-Newton method of least squares (Degroote, Bathe and Vierendeels, Performance of a new partitioned
  /// procedure versus a monolithic procedure in fluid-structure interaction, Computers and Structures 87 (2009) 793-801),
  /// which remembers the answers of earlier coarse steps. Where they do not agree after 45 repetitions (a fluid that
  /// splashes answers with jumps) the coarse step is made anew with half as many fine steps; a single one needs no
  /// repetition. Later steps may have one fine step more each. Fine domains end their steps (remesh) at the end of the
  /// coarse one only.
  template <int dim>
  class PrakashHjelmstad : public TiedCoupler<dim>
  {
  public:
    double advance(double max_time_step) override;
    void   save(std::ostream &stream) const override;
    void   load(std::istream &stream) override;

  protected:
    std::string description() const override { return "Prakash-Hjelmstad"; }

  private:
    using Base     = TiedCoupler<dim>;
    using Vectors  = typename Base::Vectors;
    using Side     = typename Base::Side;
    using Start    = typename Base::Start;
    using Numbers  = std::vector<double>;
    using Schedule = typename Base::Schedule;

    /// The state at the start of a coarse step, to begin anew from it.
    struct Snapshot
    {
      std::vector<std::string>      domains;
      std::vector<Vectors>          multipliers;
      std::vector<InterfaceBalance> balances;
      double                        pseudo_energy = 0;
    };
    Snapshot take_snapshot() const;
    void     go_back_to(const Snapshot &snapshot, bool of_coarse);

    /// @return false if the velocities do not agree: all is as before then
    bool make_step(const Schedule &schedule);

    void    make_fine_steps(const Vectors &start, const Vectors &end, double coarse_step, unsigned int n_steps);
    Vectors residual(const std::vector<Vectors> &free_velocity, const Vectors &multiplier, double coarse_step);
    Numbers next_guess(const Numbers &guess, const Numbers &residual);
    void    remember(const Numbers &guess, const Numbers &residual);

    // Differences between two passes: of the residuals and of guess + residual.
    std::vector<Numbers> residual_changes_, target_changes_;
    Numbers              last_residual_, last_target_;
    Vectors              last_change_; ///< of the multiplier in a coarse step [N]

    unsigned int allowed_substeps_ = 1000000; ///< in the next coarse step
    unsigned int n_shortened_      = 0;       ///< coarse steps that were made anew with fewer fine steps
  };
} // namespace Breakwater
