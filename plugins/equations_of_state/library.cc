#include <breakwater/base/plugin_export.h>

#include "linear.h"
#include "stiffened_gas.h"
#include "tait.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<EquationOfState, Tait>("Tait", "p = p0 + K [(rho / rho0)^gamma - 1]: a liquid");
  registry.add<EquationOfState, LinearEquationOfState>("Linear", "p = c0^2 (rho - rho0): constant speed of sound");
  registry.add<EquationOfState, StiffenedGas>("Stiffened gas",
                                              "p + p_inf = (p0 + p_inf) (rho / rho0)^gamma: without heat");
}
