#pragma once

#include "star_mesh.h"

#include <array>
#include <limits>
#include <vector>

namespace Breakwater
{
  /// Improves a cell by connecting the same nodes in another way. In 2D an edge is flipped; in 3D an edge is removed: the
  /// ring of cells around it is filled anew from a triangulation of the ring's polygon, the one whose smallest r is
  /// largest (Klincsek's dynamic programme; see Freitag and Ollivier-Gooch, Tetrahedral mesh improvement using swapping
  /// and smoothing, Int. J. Numer. Meth. Engng 40 (1997) 3979-4002, and Shewchuk, Two discrete optimization algorithms
  /// for the topological improvement of tetrahedral meshes, 2002).
  ///
  /// Only edges that are surrounded by cells are removed, so that the boundary stays. As all new cells are positive and
  /// fill the place of the old ones, the mesh stays valid and its volume the same.
  template <int dim>
  class Flips
  {
  public:
    using Cell = typename SimplexMesh<dim>::Cell;

    explicit Flips(StarMesh<dim> &mesh)
      : mesh_(mesh)
    {
    }

    /// Flips a cell away, then the worst that came instead, up to four times.
    /// @return how many flips were made
    unsigned int improve(unsigned int cell);

  private:
    static constexpr int largest_ring = 7;

    /// Makes the best flip of a cell. @return false if none helps
    bool flip(unsigned int cell);

    bool apply_best();

    // In 3D: the best filling of the ring of cells around the edge pq, if it beats the best flip so far.
    void   try_edge(unsigned int p, unsigned int q);
    bool   find_ring(unsigned int p, unsigned int q);
    double fill_ring(unsigned int p, unsigned int q, double least); ///< @return 0 if none is better than `least`
    void   collect_cells(unsigned int p, unsigned int q, int first, int last);

    StarMesh<dim>            &mesh_;
    double                    best_ = 0; ///< smallest r after the best flip so far
    std::vector<unsigned int> old_cells_, best_old_cells_, numbers_;
    std::vector<Cell>         new_cells_, best_new_cells_;

    int                                    n_ring_ = 0;
    std::array<unsigned int, largest_ring> ring_   = {};
    int                                    split_[largest_ring][largest_ring]; ///< third corner over a side
  };
} // namespace Breakwater
