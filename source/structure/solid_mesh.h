#pragma once

#include "mesh_description.h"

#include <breakwater/mesh/wet_surface.h>

#include <functional>
#include <vector>

namespace Breakwater
{
  /// A mesh of quadrilaterals or hexahedra of degree 1 or 2 as plain data: all that the explicit solver needs.
  ///
  /// Nodes of a cell and its Gauss points are numbered lexicographically, x fastest; there are (degree + 1)^dim of both.
  template <int dim>
  struct SolidMesh
  {
    struct Facet
    {
      unsigned int                                               boundary; ///< number in boundary_names()
      std::array<unsigned int, WetSurface<dim>::nodes_per_facet> nodes;    ///< normal out of the mesh, as in WetSurface
    };

    unsigned int              degree;
    std::vector<Vec<dim>>     nodes;            ///< undeformed positions [m]
    std::vector<unsigned int> cell_nodes;       ///< [cell][node]
    std::vector<double>       inverse_jacobian; ///< [cell][point][dim][dim], d xi_k / d X_j [1/m]
    std::vector<double>       point_volume;     ///< [cell][point], Gauss weight times det J [m^dim]
    std::vector<double>       node_volume;      ///< [cell][node], Gauss-Lobatto weight times det J [m^dim]
    std::vector<Facet>        facets; ///< of all boundaries; a facet of degree 2 is split into 2^(dim-1) linear ones

    unsigned int nodes_per_cell() const
    {
      return dim == 2 ? (degree + 1) * (degree + 1) : (degree + 1) * (degree + 1) * (degree + 1);
    }
    unsigned int n_cells() const { return cell_nodes.size() / nodes_per_cell(); }
    Vec<dim>     cell_centre(unsigned int cell) const; ///< undeformed [m]
  };

  /// @param place where the vertices of the box go [m], edges staying straight; empty: they stay
  /// @throws InputError if the program runs on more than one rank, or if a cell is turned inside out
  template <int dim>
  SolidMesh<dim> make_solid_mesh(const BoxMesh<dim> &box, unsigned int degree,
                                 const std::function<Vec<dim>(const Vec<dim> &)> &place = {});
} // namespace Breakwater
