#include "pfem_fluid.h"

#include <breakwater/mesh/area_vector.h>

// Where another body touches a wall, its nodes belong to facets of the fluid on that wall. As such a node may leave the
// wall or pass into it, the wedge between the facet and the wall counts as fluid: the fluid ends at the wall. Its
// pressure, that of the facet's cell, pushes the node along the wall and the wall where the mesh alone would push the
// node into it. As forces are pressures times derivatives of volumes, the pressure still has an energy: with the force on
// the wall alone, and volumes of the mesh, the node took energy out of each swing along and off the wall.

namespace Breakwater
{
  template <int dim>
  void PfemFluid<dim>::collect_rim_facets()
  {
    rim_facets_.clear();
    for (const unsigned int c : interface_cells_)
      for (int k = 0; k <= dim; ++k)
        {
          const auto &cell = mesh_.cells[c];
          RimFacet    facet{cell, {}, cell[k], {}};
          bool        has_interface = false;
          for (int a = 0, n = 0; a <= dim; ++a)
            if (a != k)
              {
                const Contacts &walls = nodes_.walls[cell[a]];
                facet.faces           = n == 0 ? walls : common(facet.faces, walls);
                facet.nodes[n++]      = cell[a];
                has_interface         = has_interface || cell[a] < nodes_.n_interface;
              }
          if (has_interface && !facet.faces.empty())
            rim_facets_.push_back(facet);
        }
  }


  // Volume of the wedge: the facet's area as seen along the wall's normal, S, times the mean distance of its nodes. Those
  // of the fluid lie on the wall, or have left it and take the fluid along: their distance is 0.
  template <int dim>
  typename PfemFluid<dim>::Cap PfemFluid<dim>::wedge_of(const RimFacet &facet) const
  {
    Cap                       wedge;
    std::array<Vec<dim>, dim> x;
    Vec<dim>                  normal;
    double                    mean = 0;
    for (int a = 0; a < dim; ++a)
      {
        x[a]            = nodes_.position(facet.nodes[a]);
        double distance = 0;
        if (facet.nodes[a] >= nodes_.n_interface)
          continue;
        if (!parameters_.walls.distance_to(*facet.faces.begin(), x[a], parameters_.spacing, distance, normal))
          return {};
        mean += distance / dim;
      }
    if (dot(normal, nodes_.position(facet.opposite) - x[0]) < 0) // the other side of a thin wall
      {
        normal = -1. * normal;
        mean   = -mean;
      }
    const double seen = dot(normal, area_vector<dim>(x)), sign = seen < 0 ? -1 : 1;
    wedge.volume = std::abs(seen) * mean;
    for (int a = 0; a < dim; ++a)
      {
        if constexpr (dim == 2)
          wedge.gradient[a] = (sign * mean * (a == 0 ? 1 : -1)) * Vec<2>{{normal[1], -normal[0]}};
        else
          wedge.gradient[a] = (0.5 * sign * mean) * cross(normal, x[(a + 2) % 3] - x[(a + 1) % 3]);
        if (facet.nodes[a] < nodes_.n_interface)
          wedge.gradient[a] += (std::abs(seen) / dim) * normal;
      }
    return wedge;
  }


  template <int dim>
  void PfemFluid<dim>::add_wedges()
  {
    for (const RimFacet &facet : rim_facets_)
      {
        const double share = wedge_of(facet).volume / (dim + 1);
        for (const unsigned int i : facet.cell)
          nodes_.volume[i] += share;
      }
  }


  // F = sum over the cell's nodes of p dV/dx.
  template <int dim>
  void PfemFluid<dim>::add_wedge_forces()
  {
    for (const RimFacet &facet : rim_facets_)
      {
        const Cap wedge    = wedge_of(facet);
        double    pressure = 0;
        for (const unsigned int i : facet.cell)
          pressure += nodes_.xp[i][3] / (dim + 1);
        for (int a = 0; a < dim; ++a)
          {
            const unsigned int i     = facet.nodes[a];
            const Vec<dim>     force = pressure * wedge.gradient[a];
            for (int d = 0; d < dim; ++d)
              nodes_.force[i][d] += force[d];
            parameters_.walls.push(facet.faces, nodes_.position(i), -1. * force);
          }
      }
  }

#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template void                         PfemFluid<dim>::collect_rim_facets();                                          \
  template typename PfemFluid<dim>::Cap PfemFluid<dim>::wedge_of(const RimFacet &) const;                              \
  template void                         PfemFluid<dim>::add_wedges();                                                  \
  template void                         PfemFluid<dim>::add_wedge_forces();
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
