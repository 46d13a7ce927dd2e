#include <breakwater/base/plugin_export.h>

#include "expression_force.h"
#include "gravity.h"
#include "shaking_table.h"

namespace
{
  template <int dim>
  void add_body_forces(Breakwater::PluginRegistry &registry)
  {
    using namespace Breakwater;
    registry.add<BodyForce<dim>, Gravity<dim>>("Gravity", "the same constant acceleration everywhere");
    registry.add<BodyForce<dim>, ExpressionForce<dim>>("Expression", "expressions of place and time");
    registry.add<BodyForce<dim>, ShakingTable<dim>>("Shaking table",
                                                    "a sinusoidal or tabulated acceleration along one line");
  }
} // namespace

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  add_body_forces<2>(registry);
  add_body_forces<3>(registry);
}
