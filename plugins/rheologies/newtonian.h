#pragma once

#include <breakwater/interfaces/fluid_rheology.h>

namespace Breakwater
{
  /// A fluid whose viscosity does not depend on the shear rate: water 0.001 Pa s, air 0.000018 Pa s.
  class Newtonian : public FluidRheology
  {
  public:
    void declare_parameters(ParameterReader &reader) override;

    bool   is_viscous() const override { return viscosity_ > 0; }
    bool   is_newtonian() const override { return true; }
    void   viscosity(const double *shear_rate, double *viscosity, std::size_t n) const override;
    double largest_viscosity() const override { return viscosity_; }

  private:
    double viscosity_ = 0.001; ///< mu [Pa s]
  };
} // namespace Breakwater
