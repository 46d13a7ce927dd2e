#pragma once

#include <breakwater/interfaces/fluid_rheology.h>

namespace Breakwater
{
  /// A fluid that flows only above a yield stress, and then with a constant plastic viscosity: mud, fresh concrete.
  ///
  /// The stress mu_p g + tau_y is regularised: eta(g) = mu_p + tau_y [1 - exp(-m g)] / g. Below about g = 1 / m it is a
  /// very viscous liquid, of eta(0) = mu_p + tau_y m, the largest viscosity: it creeps instead of standing still.
  class Bingham : public FluidRheology
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    bool is_viscous() const override { return true; }
    /// Without a yield stress it is Newtonian.
    bool   is_newtonian() const override { return !(yield_stress_ > 0); }
    void   viscosity(const double *shear_rate, double *viscosity, std::size_t n) const override;
    double largest_viscosity() const override { return plastic_viscosity_ + yield_stress_ * regularization_; }

  private:
    double plastic_viscosity_ = 0;  ///< mu_p [Pa s]
    double yield_stress_      = 0;  ///< tau_y [Pa]
    double regularization_    = 10; ///< m [s]
  };
} // namespace Breakwater
