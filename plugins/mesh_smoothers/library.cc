#include <breakwater/base/plugin_export.h>

#include "getme.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  const char *description = "makes the worst cell more regular, again and again (geometric element transformation)";
  registry.add<MeshSmoother<2>, Getme<2>>("GETMe", description);
  registry.add<MeshSmoother<3>, Getme<3>>("GETMe", description);
}
