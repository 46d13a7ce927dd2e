#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Breakwater
{
  /// Area of a facet times its normal [m^(dim - 1)]: a segment in 2D (the normal to its right), a triangle or a
  /// quadrilateral in 3D (right-hand rule). That of a quadrilateral that is not flat is the vector area of any surface
  /// between its edges.
  template <int dim, std::size_t n>
  inline Vec<dim> area_vector(const std::array<Vec<dim>, n> &corner)
  {
    static_assert(dim == 2 ? n == 2 : n == 3 || n == 4);
    if constexpr (dim == 2)
      {
        const Vec<2> e = corner[1] - corner[0];
        return {{e[1], -e[0]}};
      }
    else if constexpr (n == 3)
      return 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
    else
      return 0.5 * cross(corner[2] - corner[0], corner[3] - corner[1]);
  }

  /// The same of a facet between these places [m].
  template <int dim, std::size_t n>
  inline Vec<dim> area_vector(const std::vector<Vec<dim>> &place, const std::array<unsigned int, n> &facet)
  {
    std::array<Vec<dim>, n> corner;
    for (std::size_t k = 0; k < n; ++k)
      corner[k] = place[facet[k]];
    return area_vector<dim>(corner);
  }
} // namespace Breakwater
