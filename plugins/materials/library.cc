#include "linear_elastic.h"
#include "mooney_rivlin.h"
#include "neo_hookean.h"
#include "saint_venant_kirchhoff.h"

#include <breakwater/base/plugin_export.h>

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  const char *linear        = "Hooke's law for small strains and rotations; plane strain in 2D";
  const char *kirchhoff     = "Linear law between Green-Lagrange strain and stress: any rotation, moderate strain";
  const char *neo_hookean   = "Rubber-like law for any strain, with the constants of a linear one";
  const char *mooney_rivlin = "Rubber with three constants that are fitted to tests, for any strain";
  registry.add<Material<2>, LinearElastic<2>>("Linear elastic", linear);
  registry.add<Material<3>, LinearElastic<3>>("Linear elastic", linear);
  registry.add<Material<2>, SaintVenantKirchhoff<2>>("Saint Venant Kirchhoff", kirchhoff);
  registry.add<Material<3>, SaintVenantKirchhoff<3>>("Saint Venant Kirchhoff", kirchhoff);
  registry.add<Material<2>, NeoHookean<2>>("Neo Hookean", neo_hookean);
  registry.add<Material<3>, NeoHookean<3>>("Neo Hookean", neo_hookean);
  registry.add<Material<2>, MooneyRivlin<2>>("Mooney Rivlin", mooney_rivlin);
  registry.add<Material<3>, MooneyRivlin<3>>("Mooney Rivlin", mooney_rivlin);
}
