#include "cloud.h"
#include "one_wall.h"

#include <pfem_fluid/fluid_cells.h>

using namespace Breakwater;

TEST(FluidCells, LongOnesThatWereFluidDoNotReachThroughAThinWall)
{
  OneWall reader(std::map<std::string, std::string>{{"Shape", "line(0, -1; 0, 1)"}, {"Fluid side", "both"}});

  PfemParameters<2> parameters;
  parameters.spacing = spacing;
  parameters.size    = SizeField<2>(spacing);
  parameters.walls.declare_parameters(reader);
  parameters.walls.check_parameters(reader);
  parameters.walls.set_spacing(spacing);

  // The line is farther from all three nodes than alpha times the spacing, and nearer than alpha of fluid times it.
  const double   d = 0.5 * (parameters.alpha + parameters.alpha_of_fluid) * spacing;
  FluidNodes<2>  nodes;
  const Vec<2>   places[] = {{{-d, 0.}}, {{d, 0.}}, {{-d, 0.5 * spacing}}};
  SimplexMesh<2> mesh;
  mesh.cells = {{0, 1, 2}};
  nodes.resize(3);
  for (unsigned int i = 0; i < 3; ++i)
    nodes.xp[i] = {places[i][0], places[i][1], 0, 0};

  const AdoptedSurface<2>                                nothing;
  const FormerFluid<2>                                   former(mesh, {0, 1, 2});
  const std::function<bool(const FluidCells<2>::Cell &)> no_initial_state;
  EXPECT_FALSE(FluidCells<2>(nodes, parameters, nothing, former, no_initial_state).keeps(mesh.cells[0]));
}
