#include "linear.h"

#include <breakwater/base/parameter_reader.h>

#include <cmath>

namespace Breakwater
{
  void LinearEquationOfState::declare_parameters(ParameterReader &reader)
  {
    reader.add("Reference density", reference_density_, "Density at zero pressure, rho0 [kg/m^3]", Range::positive());
    reader.add("Bulk modulus", bulk_modulus_, "rho0 c0^2 [Pa]; 0: follows from the sound speed", Range::not_negative());
    reader.add("Sound speed", sound_speed_,
               "c0 [m/s]; 0: follows from the bulk modulus. Usual choice: 10 to 20 times the largest velocity",
               Range::not_negative());
  }


  void LinearEquationOfState::check_parameters(ParameterReader &reader)
  {
    if (bulk_modulus_ > 0 && sound_speed_ > 0)
      reader.fail("Bulk modulus", "give either \"Bulk modulus\" or \"Sound speed\", not both: "
                                  "one follows from the other, c0 = sqrt(K / rho0)");
    if (!(bulk_modulus_ > 0) && !(sound_speed_ > 0))
      reader.fail("Sound speed", "the fluid's stiffness is missing: give \"Sound speed\" [m/s] "
                                 "(usually 10 to 20 times the largest velocity) or \"Bulk modulus\" [Pa]");
    speed_squared_ = bulk_modulus_ > 0 ? bulk_modulus_ / reference_density_ : sound_speed_ * sound_speed_;
  }


  // p = c0^2 (rho - rho0)
  void LinearEquationOfState::pressure(const double *density, double *pressure, const std::size_t n) const
  {
    for (std::size_t i = 0; i < n; ++i)
      pressure[i] = speed_squared_ * (density[i] - reference_density_);
  }


  double LinearEquationOfState::density(const double pressure) const
  {
    return reference_density_ + pressure / speed_squared_;
  }


  double LinearEquationOfState::sound_speed(const double) const
  {
    return std::sqrt(speed_squared_);
  }


  // e = c0^2 [ln r + 1 / r - 1],  r = rho / rho0 = exp(l): written with expm1, as the leading terms l cancel
  double LinearEquationOfState::specific_energy(const double density) const
  {
    const double l = std::log1p((density - reference_density_) / reference_density_);
    return speed_squared_ * (l + std::expm1(-l));
  }
} // namespace Breakwater
