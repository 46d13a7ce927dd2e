#pragma once

#include <breakwater/interfaces/fluid_rheology.h>

#include <algorithm>

namespace Breakwater
{
  /// A fluid without viscosity.
  class Inviscid : public FluidRheology
  {
  public:
    bool   is_viscous() const override { return false; }
    bool   is_newtonian() const override { return true; }
    void   viscosity(const double *, double *viscosity, std::size_t n) const override { std::fill_n(viscosity, n, 0.); }
    double largest_viscosity() const override { return 0; }
  };
} // namespace Breakwater
