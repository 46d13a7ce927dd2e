#include "insphere.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>

namespace Breakwater
{
  template <int dim>
  double InsphereBound<dim>::bound(const LinearizedFluid<dim> &fluid)
  {
    double bound = std::numeric_limits<double>::infinity(), fastest = 0;
    for (const double sound_speed : fluid.sound_speed)
      fastest = std::max(fastest, sound_speed);
    for (const auto &cell : fluid.mesh.cells)
      {
        // r_in = V / sum |A_a| >= V / sqrt((dim + 1) sum |A_a|^2): most cells need neither roots nor divisions.
        const Simplex<dim> x      = corners(fluid.position, cell);
        const double       volume = std::abs(signed_volume(x));
        double             square = 0;
        for (const Vec<dim> &area : area_vectors(x))
          square += dot(area, area);
        const double least = bound * fastest * (1 + 1e-9); // of radii that matter, with room for round-off
        if (volume * volume > least * least * (dim + 1) * square)
          continue;
        double sound_speed = 0;
        for (const unsigned int i : cell)
          sound_speed = std::max(sound_speed, fluid.sound_speed[i]);
        bound = std::min(bound, std::abs(insphere_radius(x)) / sound_speed);
      }
    return bound;
  }

  template class InsphereBound<2>;
  template class InsphereBound<3>;
} // namespace Breakwater
