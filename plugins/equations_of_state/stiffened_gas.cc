#include "stiffened_gas.h"

#include <breakwater/base/parameter_reader.h>

#include <string>

namespace Breakwater
{
  void StiffenedGas::declare_parameters(ParameterReader &reader)
  {
    reader.add("Reference density", reference_density_, "Density at the reference pressure, rho0 [kg/m^3]",
               Range::positive());
    reader.add("Reference pressure", reference_pressure_, "Pressure at the reference density, p0 [Pa]");
    reader.add("Gamma", gamma_, "Exponent gamma [-]; water 4.4, air 1.4", {1., 100.});
    reader.add("Stiffness pressure", stiffness_pressure_,
               "p_inf [Pa]; 0: follows from the sound speed. Water with gamma = 4.4: 6e8", Range::not_negative());
    reader.add("Sound speed", sound_speed_,
               "c0 = sqrt(gamma (p0 + p_inf) / rho0) at the reference density [m/s]; 0: follows from the stiffness "
               "pressure. Usual choice: 10 to 20 times the largest velocity",
               Range::not_negative());
  }


  // p_inf = rho0 c0^2 / gamma - p0;  A = p_inf
  void StiffenedGas::check_parameters(ParameterReader &reader)
  {
    if (stiffness_pressure_ > 0 && sound_speed_ > 0)
      reader.fail("Stiffness pressure", "give either \"Stiffness pressure\" or \"Sound speed\", not both: one follows "
                                        "from the other, c0 = sqrt(gamma (p0 + p_inf) / rho0)");
    if (!(stiffness_pressure_ > 0) && !(sound_speed_ > 0))
      reader.fail("Sound speed", "the fluid's stiffness is missing: give \"Sound speed\" [m/s] (usually 10 to 20 times "
                                 "the largest velocity) or \"Stiffness pressure\" [Pa]");
    const double total = stiffness_pressure_ > 0 ? stiffness_pressure_ + reference_pressure_ :
                                                   reference_density_ * sound_speed_ * sound_speed_ / gamma_;
    if (!(total > 0))
      reader.fail("Reference pressure", "must be above minus the stiffness pressure, " +
                                          std::to_string(-stiffness_pressure_) + " Pa: no sound would travel");
    const double stiffness = stiffness_pressure_ > 0 ? stiffness_pressure_ : total - reference_pressure_;
    if (!(stiffness > 0))
      reader.fail("Reference pressure", "must be below rho0 c0^2 / gamma, " + std::to_string(total) +
                                          " Pa: the fluid would have a pressure at any density");
    law_ = PowerLaw::through(reference_density_, reference_pressure_, stiffness, gamma_);
  }
} // namespace Breakwater
