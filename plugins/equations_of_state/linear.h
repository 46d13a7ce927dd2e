#pragma once

#include <breakwater/interfaces/equation_of_state.h>

namespace Breakwater
{
  /// Pressure proportional to the change of density, p = c0^2 (rho - rho0): sound travels at c0 at any density.
  class LinearEquationOfState : public EquationOfState
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    double reference_density() const override { return reference_density_; }
    void   pressure(const double *density, double *pressure, std::size_t n) const override;
    double density(double pressure) const override;
    double sound_speed(double density) const override;
    double specific_energy(double density) const override;

  private:
    double reference_density_ = 1000; ///< rho0 [kg/m^3]
    double bulk_modulus_      = 0;    ///< rho0 c0^2 [Pa], 0: not given
    double sound_speed_       = 0;    ///< c0 [m/s], 0: not given

    double speed_squared_ = 0; ///< c0^2 [m^2/s^2]
  };
} // namespace Breakwater
