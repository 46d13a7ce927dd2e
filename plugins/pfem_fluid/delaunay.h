#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <limits>
#include <vector>

namespace Breakwater
{
  /// A cell of a triangulation with its neighbours: number a is across the facet opposite to node a.
  template <int dim>
  struct LinkedCell
  {
    std::array<unsigned int, dim + 1> node;     ///< positively oriented
    std::array<unsigned int, dim + 1> neighbor; ///< no_cell on the hull
  };

  constexpr unsigned int no_cell = std::numeric_limits<unsigned int>::max();

  /// The Delaunay triangulation of points, by CGAL: the finite cells. Exact; of cospherical points it is the one that
  /// CGAL's symbolic perturbation chooses, which depends on the places alone.
  /// @return no cells for points on a line or plane; of points at the same place only one gets cells
  template <int dim>
  std::vector<LinkedCell<dim>> delaunay(const std::vector<Vec<dim>> &points);

  /// Sign of det(x_1 - x_0, ..., x_dim - x_0), exact.
  template <int dim>
  int exact_orientation(const std::array<Vec<dim>, dim + 1> &x);

  /// Whether a point lies in the circumsphere of a positively oriented cell, exact. A point on the sphere is in or out
  /// as CGAL's symbolic perturbation has it (Devillers and Teillaud, Perturbations and vertex removal in a 3D Delaunay
  /// triangulation, 2003).
  template <int dim>
  bool exact_in_sphere(const std::array<Vec<dim>, dim + 1> &x, const Vec<dim> &point);

  /// The numbers of the points in the order of a Hilbert curve.
  template <int dim>
  std::vector<unsigned int> hilbert_order(const std::vector<Vec<dim>> &position);
} // namespace Breakwater
