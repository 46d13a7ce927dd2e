#include <breakwater/base/plugin_export.h>

#include "elastic_analogy.h"
#include "elastic_analogy_then_getme.h"
#include "flips_and_optimization.h"
#include "getme.h"

namespace
{
  using namespace Breakwater;

  template <template <int> class Smoother>
  void add(PluginRegistry &registry, const char *name, const char *description)
  {
    registry.add<MeshSmoother<2>, Smoother<2>>(name, description);
    registry.add<MeshSmoother<3>, Smoother<3>>(name, description);
  }
} // namespace

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  add<ElasticAnalogy>(registry, "Elastic analogy", "bad cells blow themselves up in an elastic solid");
  add<ElasticAnalogyThenGetme>(registry, "Elastic analogy then GETMe", "the two one after the other, as in the paper");
  add<FlipsAndOptimization>(registry, "Flips and optimization",
                            "flips edges, then moves nodes of what is still bad, then peels the surface");
  add<Getme>(registry, "GETMe",
             "makes the worst cell more regular, again and again (geometric element transformation)");
}
