#include <breakwater/base/plugin_export.h>

#include "flips_and_optimization.h"
#include "getme.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  const char *getme = "makes the worst cell more regular, again and again (geometric element transformation)";
  registry.add<MeshSmoother<2>, Getme<2>>("GETMe", getme);
  registry.add<MeshSmoother<3>, Getme<3>>("GETMe", getme);
  const char *flips = "flips edges, then moves nodes of what is still bad, then peels the surface";
  registry.add<MeshSmoother<2>, FlipsAndOptimization<2>>("Flips and optimization", flips);
  registry.add<MeshSmoother<3>, FlipsAndOptimization<3>>("Flips and optimization", flips);
}
