#pragma once

#include "delaunay_mesh.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <functional>
#include <vector>

namespace Breakwater
{
  /// A Delaunay triangulation cut to the shape of the fluid: kept are the cells whose circumradius is at most
  /// `largest_circumradius` (alpha times the spacing) and that `keep` accepts.
  ///
  /// The cells are sorted by their highest node number, which is the order in which the element passes are fastest
  /// when the nodes are numbered along a space-filling curve, then by the others. Same positions, same mesh, to the
  /// bit, whether the triangulation is new or was repaired.
  ///
  /// @param keep tells for a cell (positively oriented) whether it is fluid; asked only for cells small enough
  /// @param is_small_anyway tells for a cell beyond the largest circumradius, and its circumradius, whether it counts as
  /// small enough; the default is that none does
  /// @param gaps if not null, gets the cells that are left out, those with far nodes included
  template <int dim>
  SimplexMesh<dim> alpha_shape(
    const DelaunayMesh<dim> &triangulation, double largest_circumradius,
    const std::function<bool(const typename SimplexMesh<dim>::Cell &)>         &keep,
    const std::function<bool(const typename SimplexMesh<dim>::Cell &, double)> &is_small_anyway = {},
    std::vector<typename SimplexMesh<dim>::Cell>                               *gaps            = nullptr);

  /// Puts cells into the order that alpha_shape() gives them; each is rotated so that its highest nodes are its last.
  template <int dim>
  void order_cells(std::vector<typename SimplexMesh<dim>::Cell> &cells, std::size_t n_nodes);
} // namespace Breakwater
