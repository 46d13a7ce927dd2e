#pragma once

#include "size_field.h"

#include <functional>
#include <vector>

namespace Breakwater
{
  /// Distance of neighbouring nodes along a surface, in units of the spacing h.
  constexpr double surface_spacing = 1.1;

  /// Distance of the rows in which nodes stand on a surface, in the same units: triangles of equal sides.
  constexpr double surface_row_spacing = 0.866 * surface_spacing;

  /// A curve in space: the place [m] at a parameter from 0 to 1.
  template <int dim>
  using Curve = std::function<Vec<dim>(double)>;

  /// Places along a curve, equally spaced in the length measured by the local spacing, ends included.
  template <int dim>
  std::vector<Vec<dim>> sample_open_curve(const Curve<dim> &curve, const SizeField<dim> &size);

  /// The same for a closed curve, curve(1) = curve(0). @param phase where the first node stands, as a part of the
  /// distance of two nodes
  template <int dim>
  std::vector<Vec<dim>> sample_closed_curve(const Curve<dim> &curve, const SizeField<dim> &size, double phase = 0);

  /// Parameters of the rows of nodes that run across a curve on a surface, equally spaced in the length measured by
  /// the local spacing. @param first of the first row from the curve's start, in units of the distance of two rows:
  /// 0.5 puts none on the ends of the curve and is right where the rows there are points; with 1 the ends are rows too,
  /// which are left out
  template <int dim>
  std::vector<double> sample_rows(const Curve<dim> &curve, const SizeField<dim> &size, double first);

  /// The straight line between two places.
  template <int dim>
  Curve<dim> segment(const Vec<dim> &a, const Vec<dim> &b)
  {
    return [a, b](const double t) {
      return a * (1 - t) + b * t;
    };
  }

  /// Places on a disc in space: those on its rim and those inside, on rings around its center.
  /// @param e1, e2 unit vectors in its plane
  void sample_disc(const Vec<3> &center, const Vec<3> &e1, const Vec<3> &e2, double radius, const SizeField<3> &size,
                   std::vector<Vec<3>> &on_rim, std::vector<Vec<3>> &inside);

  /// The circle of a disc; t = 0 is at e1.
  Curve<3> circle(const Vec<3> &center, const Vec<3> &e1, const Vec<3> &e2, double radius);

  /// Two unit vectors that are normal to a unit vector and to each other.
  void make_frame(const Vec<3> &normal, Vec<3> &e1, Vec<3> &e2);

  /// Places on a plane polygon in space: those on its edges, corners included, and those in its face.
  void sample_polygon(const std::vector<Vec<3>> &vertices, const SizeField<3> &size, std::vector<Vec<3>> &on_edges,
                      std::vector<Vec<3>> &in_face);
} // namespace Breakwater
