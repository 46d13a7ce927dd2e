#include "linear_elastic.h"
#include "saint_venant_kirchhoff.h"

#include <breakwater/base/plugin_export.h>

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  const char *linear    = "Hooke's law for small strains and rotations; plane strain in 2D";
  const char *kirchhoff = "Linear law between Green-Lagrange strain and stress: any rotation, moderate strain";
  registry.add<Material<2>, LinearElastic<2>>("Linear elastic", linear);
  registry.add<Material<3>, LinearElastic<3>>("Linear elastic", linear);
  registry.add<Material<2>, SaintVenantKirchhoff<2>>("Saint Venant Kirchhoff", kirchhoff);
  registry.add<Material<3>, SaintVenantKirchhoff<3>>("Saint Venant Kirchhoff", kirchhoff);
}
