#pragma once

#include <breakwater/base/plugin.h>

#include <cstddef>

namespace Breakwater
{
  /// Viscosity of a fluid as a function of its shear rate.
  class FluidRheology : public Plugin
  {
  public:
    static constexpr const char *interface_name = "rheology";
    static constexpr int         dimension      = 0;

    /// False: the fluid is inviscid, and no viscous work is done at all.
    virtual bool is_viscous() const = 0;

    /// True if the viscosity does not depend on the shear rate.
    virtual bool is_newtonian() const = 0;

    /// Dynamic viscosity [Pa s] at n shear rates [1/s], sqrt(2 D:D) with D the rate of deformation.
    virtual void viscosity(const double *shear_rate, double *viscosity, std::size_t n) const = 0;

    /// Upper bound on the viscosity [Pa s] at any shear rate, for the stable step.
    virtual double largest_viscosity() const = 0;
  };
} // namespace Breakwater
