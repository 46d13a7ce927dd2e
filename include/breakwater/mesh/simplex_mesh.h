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
} // namespace Breakwater
