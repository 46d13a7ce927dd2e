#pragma once

#include <breakwater/base/vec.h>
#include <breakwater/mesh/simplex_mesh.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace Breakwater
{
  /// The corners of one simplex.
  template <int dim>
  using Simplex = std::array<Vec<dim>, dim + 1>;

  /// The corners of a cell of a mesh.
  template <int dim>
  inline Simplex<dim> corners(const std::vector<Vec<dim>> &position, const typename SimplexMesh<dim>::Cell &cell)
  {
    Simplex<dim> x;
    for (int a = 0; a <= dim; ++a)
      x[a] = position[cell[a]];
    return x;
  }

  /// Area vectors dV/dx_a of the corners a of a simplex [m^(dim-1)]: each is the inward normal of the opposite facet
  /// times that facet's measure over dim. They add up to zero.
  template <int dim>
  inline Simplex<dim> area_vectors(const Simplex<dim> &x)
  {
    Simplex<dim> area;
    if constexpr (dim == 2)
      {
        const Vec<2> e1 = x[1] - x[0], e2 = x[2] - x[0];
        area[1] = {{0.5 * e2[1], -0.5 * e2[0]}};
        area[2] = {{-0.5 * e1[1], 0.5 * e1[0]}};
      }
    else
      {
        const Vec<3> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
        area[1] = cross(e2, e3) * (1. / 6.);
        area[2] = cross(e3, e1) * (1. / 6.);
        area[3] = cross(e1, e2) * (1. / 6.);
      }
    for (int a = 1; a <= dim; ++a)
      area[0] -= area[a];
    return area;
  }

  /// Signed volume [m^dim]: positive for a positively oriented simplex.
  template <int dim>
  inline double signed_volume(const Simplex<dim> &x)
  {
    if constexpr (dim == 2)
      {
        const Vec<2> e1 = x[1] - x[0], e2 = x[2] - x[0];
        return 0.5 * (e1[0] * e2[1] - e1[1] * e2[0]);
      }
    else
      return dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])) / 6.;
  }

  /// Radius [m] of the largest ball inside: V / sum |dV/dx_a|, as the sum of the facets' measures over dim is
  /// the sum of the lengths of the area vectors. Signed as the volume.
  template <int dim>
  inline double insphere_radius(const Simplex<dim> &x)
  {
    const Simplex<dim> area = area_vectors(x);
    double             sum  = 0;
    for (int a = 0; a <= dim; ++a)
      sum += norm(area[a]);
    return sum > 0 ? signed_volume(x) / sum : 0.;
  }

  /// Radius [m] of the ball through the corners; infinite for a flat simplex.
  template <int dim>
  inline double circumradius(const Simplex<dim> &x)
  {
    const double volume = std::abs(signed_volume(x));
    if (!(volume > 0))
      return std::numeric_limits<double>::infinity();
    if constexpr (dim == 2)
      return norm(x[1] - x[0]) * norm(x[2] - x[1]) * norm(x[0] - x[2]) / (4 * volume);
    else
      {
        const Vec<3> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
        return norm(cross(e2, e3) * dot(e1, e1) + cross(e3, e1) * dot(e2, e2) + cross(e1, e2) * dot(e3, e3)) /
               (12 * volume);
      }
  }

  /// Space of one node at a spacing h, h^dim [m^dim].
  template <int dim>
  constexpr double regular_volume(const double spacing)
  {
    return dim == 2 ? spacing * spacing : spacing * spacing * spacing;
  }

  /// Insphere radius of the regular simplex whose share of space is that of n nodes at spacing h: the unit in which
  /// mesh quality is measured, h / (2 sqrt 6) in 3D and h / (2 sqrt 3) in 2D.
  template <int dim>
  constexpr double reference_insphere_radius(const double spacing)
  {
    return spacing * (dim == 2 ? 0.28867513459481288 : 0.20412414523193151);
  }
} // namespace Breakwater
