#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <string>
#include <vector>

namespace Breakwater
{
  /// The surface by which a domain touches others: the nodes that a coupler ties, and the facets between them.
  ///
  /// It may consist of several bodies' surfaces, one after the other.
  /// Facets are segments in 2D and quadrilaterals in 3D. Their node order gives the normal that points out of the
  /// domain: in 2D the tangent (b - a) turned by -90 degrees, in 3D by the right-hand rule.
  template <int dim>
  struct WetSurface
  {
    static constexpr unsigned int nodes_per_facet = dim == 2 ? 2 : 4;

    std::vector<Vec<dim>>                                  position;     ///< [m]
    std::vector<Vec<dim>>                                  velocity;     ///< [m/s]
    std::vector<Vec<dim>>                                  acceleration; ///< [m/s^2], link forces included
    std::vector<Vec<dim>>                                  inverse_mass; ///< [1/kg], 0 in a direction that is held
    std::vector<double>                                    mass;         ///< [kg], held or not
    std::vector<std::array<unsigned int, nodes_per_facet>> facets;
    std::vector<std::string>                               bodies; ///< whose surface this is, by name
    std::vector<unsigned int> body_of_facet; ///< [facet] number in `bodies`; empty if no body has a name
    /// [node] of a domain that owns its nodes: true in the middle of an edge or face of an element of degree 2, which
    /// may bend; empty: no such nodes.
    std::vector<char> is_middle;
    unsigned int      revision = 0; ///< grows when nodes, facets or masses change
  };
} // namespace Breakwater
