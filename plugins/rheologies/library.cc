#include <breakwater/base/plugin_export.h>

#include "bingham.h"
#include "herschel_bulkley.h"
#include "inviscid.h"
#include "newtonian.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<FluidRheology, Inviscid>("Inviscid", "no viscosity: no viscous force is computed");
  registry.add<FluidRheology, Newtonian>("Newtonian", "constant viscosity");
  registry.add<FluidRheology, Bingham>("Bingham", "a yield stress, then constant viscosity, regularised");
  registry.add<FluidRheology, HerschelBulkley>("Herschel Bulkley",
                                               "a yield stress, then a power of the shear rate, regularised");
}
