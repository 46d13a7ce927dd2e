#include "pfem_fluid.h"

#include <breakwater/base/plugin_export.h>

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  const char *description = "weakly compressible fluid by the explicit particle finite element method";
  registry.add<ExplicitDomain<2>, PfemFluid<2>>("Pfem", description);
  registry.add<ExplicitDomain<3>, PfemFluid<3>>("Pfem", description);
}
