#include <breakwater/base/plugin_export.h>

#include "gravouil_combescure.h"
#include "prakash_hjelmstad.h"
#include "staggered.h"

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  const char *description = "velocities tied at every fine step, each domain with its own step; no energy is made";
  registry.add<Coupler<2>, GravouilCombescure<2>>("Gravouil Combescure", description);
  registry.add<Coupler<3>, GravouilCombescure<3>>("Gravouil Combescure", description);

  const char *linear = "velocities tied at coarse steps; nothing is lost, but fine steps are repeated";
  registry.add<Coupler<2>, PrakashHjelmstad<2>>("Prakash Hjelmstad", linear);
  registry.add<Coupler<3>, PrakashHjelmstad<3>>("Prakash Hjelmstad", linear);
  const char *staggered =
    "one domain after the other, without a multiplier: to compare with; unstable for heavy fluids";
  registry.add<Coupler<2>, Staggered<2>>("Staggered", staggered);
  registry.add<Coupler<3>, Staggered<3>>("Staggered", staggered);
}
