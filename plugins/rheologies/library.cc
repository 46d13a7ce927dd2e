#include <breakwater/base/plugin_export.h>

#include "inviscid.h"
#include "newtonian.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<FluidRheology, Inviscid>("Inviscid", "no viscosity: no viscous force is computed");
  registry.add<FluidRheology, Newtonian>("Newtonian", "constant viscosity");
}
