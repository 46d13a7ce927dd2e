#pragma once

#include <cstddef>

namespace Breakwater
{
  /// The law p = A [(rho / rho_z)^gamma - 1], written around the density rho_z of zero pressure: what Tait's equation
  /// and the isentrope of a stiffened gas have in common.
  struct PowerLaw
  {
    double modulus      = 0; ///< A [Pa], > 0
    double zero_density = 0; ///< rho_z [kg/m^3], > 0
    double gamma        = 1; ///< >= 1

    /// The law with pressure p0 [Pa] at density rho0 [kg/m^3]: rho_z = rho0 (1 + p0 / A)^(-1 / gamma).
    /// @pre modulus + pressure > 0
    static PowerLaw through(double density, double pressure, double modulus, double gamma);

    /// Pressure [Pa] of n densities [kg/m^3].
    void pressure_of(const double *density, double *pressure, std::size_t n) const;
    /// [kg/m^3] at a pressure [Pa] > -A.
    double density_at(double pressure) const;
    /// [m/s]
    double sound_speed_at(double density) const;
    /// Integral of p / rho^2 drho from rho_z [J/kg].
    double specific_energy_at(double density) const;
  };
} // namespace Breakwater
