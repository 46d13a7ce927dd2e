#include "pfem_fluid.h"

#include <breakwater/mesh/area_vector.h>

#include <cmath>

// Around a bend of a wall, the chords of the mesh cut off caps that belong to the solid. Their volume is taken from the
// fluid's: the energy of its pressure must not depend on where along the wall the nodes stand. If it did, pressure would
// drive nodes along a convex wall into heaps, where the chords beside them are long, and water at rest would not stay at
// rest. Inside of a bend the mesh lacks the caps, and pressure spreads the nodes evenly, which is left as it is.

namespace Breakwater
{
  template <int dim>
  void PfemFluid<dim>::collect_curved_facets()
  {
    curved_facets_.clear();
    if (!parameters_.walls.any_has_surface())
      return;
    for (const auto &facet : mesh_.boundary)
      {
        Contacts shared = nodes_.walls[facet[0]];
        for (const unsigned int i : facet)
          shared = common(shared, nodes_.walls[i]);
        if (parameters_.walls.is_curved(shared))
          curved_facets_.push_back({facet, shared});
      }
  }


  // Not positive. The distance d to the wall is 0 at the nodes and quadratic in between: its mean is 2/3 of that in the middle of a
  // chord, and the mean of those in the middle of a triangle's sides. volume = area * mean d.
  template <int dim>
  typename PfemFluid<dim>::Cap PfemFluid<dim>::cap_of(const CurvedFacet &facet) const
  {
    constexpr int             n_sides = dim == 2 ? 1 : 3;
    constexpr double          weight  = dim == 2 ? 2. / 3 : 1. / 3;
    std::array<Vec<dim>, dim> x, mean_gradient;
    for (int a = 0; a < dim; ++a)
      x[a] = nodes_.position(facet.nodes[a]);
    const Vec<dim> area_vector_of_facet = area_vector<dim>(x);
    const double   area                 = norm(area_vector_of_facet);

    Cap    cap;
    double mean = 0;
    for (int side = 0; side < n_sides; ++side)
      {
        const int a = side, b = (side + 1) % dim;
        double    distance = 0;
        Vec<dim>  normal;
        if (!parameters_.walls.distance_to_curved(facet.faces, 0.5 * (x[a] + x[b]), 0.5 * norm(x[a] - x[b]), distance,
                                                  normal))
          return {};
        mean += weight * distance;
        mean_gradient[a] += 0.5 * weight * normal;
        mean_gradient[b] += 0.5 * weight * normal;
      }
    if (mean >= 0)
      return {};
    cap.volume = area * mean;
    for (int a = 0; a < dim; ++a)
      {
        Vec<dim> area_gradient;
        if constexpr (dim == 2)
          area_gradient = (x[a] - x[1 - a]) * (1 / area);
        else
          area_gradient = cross(area_vector_of_facet, x[(a + 2) % 3] - x[(a + 1) % 3]) * (0.5 / area);
        cap.gradient[a] = mean * area_gradient + area * mean_gradient[a];
      }
    return cap;
  }


  template <int dim>
  void PfemFluid<dim>::update_volumes()
  {
    compute_volumes<dim>(mesh_.cells, nodes_.xp, nodes_.volume);
    for (const CurvedFacet &facet : curved_facets_)
      {
        const double share = cap_of(facet).volume / dim;
        for (const unsigned int i : facet.nodes)
          nodes_.volume[i] += share;
      }
    add_wedges();
  }


  // F = sum over nodes of p dV/dx, along the wall: each node of a facet has an equal share of its cap. Off the wall the
  // volume of mesh and cap together does not change; the wall carries what the pressure does on the mesh.
  template <int dim>
  void PfemFluid<dim>::add_cap_forces()
  {
    for (const CurvedFacet &facet : curved_facets_)
      {
        const Cap cap      = cap_of(facet);
        double    pressure = 0;
        for (const unsigned int i : facet.nodes)
          pressure += nodes_.xp[i][3] / dim;
        for (int a = 0; a < dim; ++a)
          {
            const unsigned int i        = facet.nodes[a];
            const Vec<dim>     x        = nodes_.position(i);
            double             distance = 0;
            Vec<dim>           normal;
            if (!parameters_.walls.distance_to_curved(facet.faces, x, parameters_.spacing, distance, normal))
              continue;
            const Vec<dim> force = pressure * (cap.gradient[a] - dot(cap.gradient[a], normal) * normal);
            for (int d = 0; d < dim; ++d)
              nodes_.force[i][d] += force[d];
            parameters_.walls.push(facet.faces, x, -1. * force);
          }
      }
  }

#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template void PfemFluid<dim>::collect_curved_facets();                                                               \
  template void PfemFluid<dim>::update_volumes();                                                                      \
  template void PfemFluid<dim>::add_cap_forces();
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
