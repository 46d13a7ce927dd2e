#include "insphere.h"
#include "spectral.h"

#include <breakwater/base/plugin_export.h>

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<TimeStepBound<2>, InsphereBound<2>>("Insphere", "smallest insphere radius over the sound speed");
  registry.add<TimeStepBound<3>, InsphereBound<3>>("Insphere", "smallest insphere radius over the sound speed");
  registry.add<TimeStepBound<2>, SpectralBound<2>>("Spectral", "from the largest frequency of the fluid's operator");
  registry.add<TimeStepBound<3>, SpectralBound<3>>("Spectral", "from the largest frequency of the fluid's operator");
}
