#include "pfem_fluid.h"

// Where another body touches a wall, its nodes belong to facets of the fluid on that wall. What the fluid presses there
// is the wall's to bear: left to the nodes, it would push the body into the wall by pressure times half a facet.

namespace Breakwater
{
  template <int dim>
  void PfemFluid<dim>::collect_rim_facets()
  {
    rim_facets_.clear();
    if (nodes_.n_interface == 0)
      return;
    for (const auto &cell : mesh_.cells)
      for (int k = 0; k <= dim; ++k)
        {
          RimFacet facet{cell, {}, cell[k], {}};
          bool     has_interface = false;
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


  // A cell's pressure p pushes each node of a facet by p N / dim, N the area vector out of the fluid.
  template <int dim>
  void PfemFluid<dim>::give_rim_forces_to_walls()
  {
    for (const RimFacet &facet : rim_facets_)
      {
        std::array<Vec<dim>, dim> x;
        for (int a = 0; a < dim; ++a)
          x[a] = nodes_.position(facet.nodes[a]);
        Vec<dim> normal = area_vector<dim>(x);
        if (dot(normal, nodes_.position(facet.opposite) - x[0]) > 0)
          normal = -1. * normal;
        double pressure = 0;
        for (const unsigned int i : facet.cell)
          pressure += nodes_.xp[i][3] / (dim + 1);
        const Vec<dim> force = (pressure / dim) * normal;
        for (int a = 0; a < dim; ++a)
          if (facet.nodes[a] < nodes_.n_interface)
            {
              for (int d = 0; d < dim; ++d)
                nodes_.force[facet.nodes[a]][d] -= force[d];
              parameters_.walls.push(facet.faces, x[a], force);
            }
      }
  }

#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template void PfemFluid<dim>::collect_rim_facets();                                                                  \
  template void PfemFluid<dim>::give_rim_forces_to_walls();
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
