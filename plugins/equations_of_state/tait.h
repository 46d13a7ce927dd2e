#pragma once

#include <breakwater/interfaces/equation_of_state.h>

#include "power_law.h"

namespace Breakwater
{
  /// The Tait equation of a weakly compressible liquid, p = p0 + K [(rho / rho0)^gamma - 1].
  ///
  /// The speed of sound at the reference density is c0 = sqrt(gamma K / rho0); either K or c0 is given.
  class Tait : public EquationOfState
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    double reference_density() const override { return law_.zero_density; }
    void   pressure(const double *density, double *pressure, std::size_t n) const override
    {
      law_.pressure_of(density, pressure, n);
    }
    double density(double pressure) const override { return law_.density_at(pressure); }
    double sound_speed(double density) const override { return law_.sound_speed_at(density); }
    double specific_energy(double density) const override { return law_.specific_energy_at(density); }

  private:
    double reference_density_  = 1000; ///< rho0 [kg/m^3]
    double gamma_              = 7;
    double reference_pressure_ = 0; ///< p0 [Pa]
    double bulk_modulus_       = 0; ///< K [Pa], 0: not given
    double sound_speed_        = 0; ///< c0 [m/s], 0: not given

    PowerLaw law_; ///< A = K - p0
  };
} // namespace Breakwater
