#pragma once

#include <breakwater/interfaces/fluid_rheology.h>

namespace Breakwater
{
  /// A fluid with a yield stress whose stress above it grows with a power of the shear rate: tau = tau_y + K g^n.
  ///
  /// Regularised: eta(g) = K G^(n-1) + tau_y [1 - exp(-m g)] / g. G is g, but for
  ///   n < 1 (thinning): at least 1 / m, below which the power law would grow without bound;
  ///   n > 1 (thickening): at most the largest shear rate, above which it would.
  /// Without a yield stress it is a power-law fluid.
  class HerschelBulkley : public FluidRheology
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    bool is_viscous() const override { return true; }
    /// For n = 1 without a yield stress it is Newtonian.
    bool is_newtonian() const override { return flow_index_ == 1 && !(yield_stress_ > 0); }
    void viscosity(const double *shear_rate, double *viscosity, std::size_t n) const override;

    /// K m^(1-n) + tau_y m for n <= 1, the value at rest; for n > 1 the bound K g_max^(n-1) + tau_y m.
    double largest_viscosity() const override { return largest_viscosity_; }

  private:
    double consistency_        = 0;  ///< K [Pa s^n]
    double yield_stress_       = 0;  ///< tau_y [Pa]
    double flow_index_         = 1;  ///< n
    double regularization_     = 10; ///< m [s]
    double largest_shear_rate_ = 0;  ///< g_max [1/s], 0: none

    double power_law_from_    = 0; ///< G is g between these two shear rates [1/s]
    double power_law_to_      = 0;
    double largest_viscosity_ = 0; ///< [Pa s]
  };
} // namespace Breakwater
