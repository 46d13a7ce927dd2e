#pragma once

#include <breakwater/mesh/simplex_mesh.h>

#include <functional>
#include <vector>

namespace Breakwater
{
  /// Delaunay triangulation of a cloud of nodes, cut to the shape of the fluid: kept are the cells whose circumradius
  /// is at most `largest_circumradius` (alpha times the spacing) and that `keep` accepts.
  ///
  /// The cells are sorted by their highest node number, which is the order in which the element passes are fastest
  /// when the nodes are numbered along a space-filling curve. Same positions, same mesh, to the bit.
  ///
  /// @param position of the nodes [m]; of nodes at the same place only one gets cells
  /// @param keep tells for a cell (positively oriented) whether it is fluid; asked only for cells small enough
  /// @param is_small_anyway tells for a cell beyond the largest circumradius whether it counts as small enough; the
  /// default is that none does
  template <int dim>
  SimplexMesh<dim> alpha_shape(
    const std::vector<Vec<dim>> &position, double largest_circumradius,
    const std::function<bool(const typename SimplexMesh<dim>::Cell &)> &keep,
    const std::function<bool(const typename SimplexMesh<dim>::Cell &)> &is_small_anyway = {});

  /// The numbers of the points in the order of a Hilbert curve.
  template <int dim>
  std::vector<unsigned int> hilbert_order(const std::vector<Vec<dim>> &position);
} // namespace Breakwater
