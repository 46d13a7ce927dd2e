#pragma once

#include <breakwater/interfaces/equation_of_state.h>

#include "power_law.h"

namespace Breakwater
{
  /// A stiffened gas that is compressed without heat: p + p_inf = (p0 + p_inf) (rho / rho0)^gamma.
  ///
  /// The full law p = (gamma - 1) rho e - gamma p_inf needs the internal energy; this is its isentrope through the
  /// reference state (rho0, p0), on which c^2 = gamma (p + p_inf) / rho. It is Tait's equation with K = p0 + p_inf: the
  /// two differ in the constants that the literature gives. With p0 = 0 pressures are relative to the ambient p_a;
  /// published constants then become p_inf + p_a, and a perfect gas has p_inf = p_a.
  /// Source: O. Le Metayer, J. Massoni and R. Saurel, International Journal of Thermal Sciences 43 (2004) 265.
  class StiffenedGas : public EquationOfState
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
    double reference_pressure_ = 0;    ///< p0 [Pa]
    double gamma_              = 4.4;
    double stiffness_pressure_ = 0; ///< p_inf [Pa], 0: not given
    double sound_speed_        = 0; ///< c0 [m/s], 0: not given

    PowerLaw law_; ///< A = p_inf
  };
} // namespace Breakwater
