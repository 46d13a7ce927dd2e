#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <vector>

namespace Breakwater
{
  /// A mesh of triangles or tetrahedra as plain data. Cells are positively oriented: det(x1-x0, ..., xd-x0) > 0.
  template <int dim>
  struct SimplexMesh
  {
    using Cell  = std::array<unsigned int, dim + 1>;
    using Facet = std::array<unsigned int, dim>;

    std::vector<Cell>  cells;    ///< node numbers
    std::vector<Facet> boundary; ///< facets with one cell, their normals out of the mesh (as in WetSurface)
  };

  /// Facet of a cell opposite to its corner `opposite`, its normal out of the cell.
  template <int dim>
  typename SimplexMesh<dim>::Facet outward_facet(const typename SimplexMesh<dim>::Cell &cell, const int opposite)
  {
    if constexpr (dim == 2)
      return {{cell[(opposite + 1) % 3], cell[(opposite + 2) % 3]}};
    else
      {
        static constexpr int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        return {{cell[corners[opposite][0]], cell[corners[opposite][1]], cell[corners[opposite][2]]}};
      }
  }
} // namespace Breakwater
