#include <breakwater/base/plugin_export.h>

#include "front.h"
#include "gauge.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<Postprocessor<2>, Front<2>>("Front", "position of a fluid's foremost node in a direction");
  registry.add<Postprocessor<3>, Front<3>>("Front", "position of a fluid's foremost node in a direction");
  registry.add<Postprocessor<2>, Gauge<2>>("Gauge", "height of water over a place");
  registry.add<Postprocessor<3>, Gauge<3>>("Gauge", "height of water over a place");
}
