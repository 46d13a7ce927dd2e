#pragma once

#include <breakwater/base/plugin.h>

#include <cstddef>

namespace Breakwater
{
  /// Pressure of a barotropic fluid as a function of its density.
  class EquationOfState : public Plugin
  {
  public:
    static constexpr const char *interface_name = "equation of state";
    static constexpr int         dimension      = 0;

    /// Density at zero pressure [kg/m^3].
    virtual double reference_density() const = 0;

    /// Pressure [Pa] of n densities [kg/m^3].
    virtual void pressure(const double *density, double *pressure, std::size_t n) const = 0;

    /// Density [kg/m^3] at a pressure [Pa]: the inverse of pressure().
    virtual double density(double pressure) const = 0;

    /// Speed of sound [m/s], sqrt(dp/drho).
    virtual double sound_speed(double density) const = 0;

    /// Energy of compression of a unit mass [J/kg]: integral of p / rho^2 drho from the reference density.
    virtual double specific_energy(double density) const = 0;
  };
} // namespace Breakwater
