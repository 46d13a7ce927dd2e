#include <breakwater/base/plugin_export.h>

#include "gravity.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<BodyForce<2>, Gravity<2>>("Gravity", "the same constant acceleration everywhere");
  registry.add<BodyForce<3>, Gravity<3>>("Gravity", "the same constant acceleration everywhere");
}
