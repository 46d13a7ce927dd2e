#include "insphere.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>

namespace Breakwater
{
  template <int dim>
  double InsphereBound<dim>::bound(const LinearizedFluid<dim> &fluid)
  {
    double bound = std::numeric_limits<double>::infinity();
    for (const auto &cell : fluid.mesh.cells)
      {
        double sound_speed = 0;
        for (const unsigned int i : cell)
          sound_speed = std::max(sound_speed, fluid.sound_speed[i]);
        bound = std::min(bound, std::abs(insphere_radius(corners(fluid.position, cell))) / sound_speed);
      }
    return bound;
  }

  template class InsphereBound<2>;
  template class InsphereBound<3>;
} // namespace Breakwater
