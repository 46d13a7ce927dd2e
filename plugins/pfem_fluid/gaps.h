#pragma once

#include "contacts.h"
#include "element_passes.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// The space between bodies of fluid, and between them and structures: the cells of a triangulation that are no
  /// fluid. No node can meet another body unless such a cell changes its shape, while all that moves together, however
  /// fast, leaves them as they are.
  template <int dim>
  class Gaps
  {
  public:
    using Cell = typename SimplexMesh<dim>::Cell;

    Gaps() = default;

    /// @param cells those that are no fluid; node numbers from n_nodes on are of far nodes
    /// @param n_interface the first nodes are of structures: cells between them alone do not matter
    Gaps(const std::vector<Cell> &cells, std::size_t n_nodes, std::size_t n_interface);

    /// How far nodes at a gap have moved against each other, over half the distance that they had, or over the spacing
    /// if that is more: the largest of all pairs. From 1 on they may soon meet.
    /// @param position now and before [m]
    /// @param spacing of the nodes [m]
    double closure(const std::vector<Quad> &position, const std::vector<Quad> &position_before, double spacing) const;

    /// How many cells have a pair of nodes that has moved so by more than 1.
    std::size_t n_closing(const std::vector<Quad> &position, const std::vector<Quad> &position_before,
                          double spacing) const;

    /// Cells at gaps; in place of far nodes they have another one of their own once more.
    std::vector<Cell> cells;
  };
} // namespace Breakwater
