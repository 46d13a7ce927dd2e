#pragma once

#include "tied_coupler.h"

namespace Breakwater
{
  /// Ties the velocities of domains by Lagrange multipliers at every fine step; each domain has its own time step.
  ///
  /// The scheme of Gravouil and Combescure, Multi-time-step explicit-implicit method for non-linear structural
  /// dynamics, Int. J. Numer. Meth. Engng 50 (2001) 199-225, for explicit domains; doc/coupling.md has the formulas and
  /// what was measured. No energy is made if each domain is stable on its own; with m > 1 a little is lost.
  template <int dim>
  class GravouilCombescure : public TiedCoupler<dim>
  {
  public:
    double advance(double max_time_step) override;

  protected:
    std::string description() const override { return "Gravouil-Combescure"; }

  private:
    using Base    = TiedCoupler<dim>;
    using Vectors = typename Base::Vectors;
    using Side    = typename Base::Side;
    using Start   = typename Base::Start;

    Vectors free_velocity_at_start(const Side &coarse, double coarse_step) const;
  };
} // namespace Breakwater
