#include "tait.h"

#include <breakwater/base/parameter_reader.h>

#include <string>

namespace Breakwater
{
  void Tait::declare_parameters(ParameterReader &reader)
  {
    reader.add("Reference density", reference_density_, "Density at the reference pressure, rho0 [kg/m^3]",
               Range::positive());
    reader.add("Gamma", gamma_, "Exponent gamma; 7 for water", {1., 100.});
    reader.add("Reference pressure", reference_pressure_, "Pressure at the reference density, p0 [Pa]");
    reader.add("Bulk modulus", bulk_modulus_, "K [Pa]; 0: follows from the sound speed", Range::not_negative());
    reader.add("Sound speed", sound_speed_,
               "c0 = sqrt(gamma K / rho0) at the reference density [m/s]; 0: follows from the bulk modulus. "
               "Usual choice: 10 to 20 times the largest velocity",
               Range::not_negative());
  }


  // K = rho0 c0^2 / gamma;  A = K - p0
  void Tait::check_parameters(ParameterReader &reader)
  {
    if (bulk_modulus_ > 0 && sound_speed_ > 0)
      reader.fail("Bulk modulus", "give either \"Bulk modulus\" or \"Sound speed\", not both: "
                                  "one follows from the other, c0 = sqrt(gamma K / rho0)");
    if (!(bulk_modulus_ > 0) && !(sound_speed_ > 0))
      reader.fail("Sound speed", "the fluid's stiffness is missing: give \"Sound speed\" [m/s] "
                                 "(usually 10 to 20 times the largest velocity) or \"Bulk modulus\" [Pa]");
    const double bulk_modulus =
      bulk_modulus_ > 0 ? bulk_modulus_ : reference_density_ * sound_speed_ * sound_speed_ / gamma_;
    if (!(bulk_modulus > reference_pressure_))
      reader.fail("Reference pressure", "must be below the bulk modulus, " + std::to_string(bulk_modulus) +
                                          " Pa: the liquid would have a pressure at any density");
    law_ = PowerLaw::through(reference_density_, reference_pressure_, bulk_modulus - reference_pressure_, gamma_);
  }
} // namespace Breakwater
