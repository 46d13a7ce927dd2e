#pragma once

#include <breakwater/base/vec.h>
#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// What one rank holds of a fluid: its own nodes, the cells that touch one of them, and the ghosts, which are the other
  /// nodes of these cells.
  ///
  /// The sums over cells are complete at the rank's own nodes without any exchange of sums: cells between two ranks are
  /// computed by both. What a ghost needs is the value at its owner: positions and velocities before the volumes,
  /// pressures (and densities) before the forces.
  template <int dim>
  struct RankPart
  {
    /// Local numbers of what goes to and comes from another rank; in the same order on both sides.
    struct Neighbor
    {
      unsigned int              rank = 0;
      std::vector<unsigned int> sent;     ///< own nodes
      std::vector<unsigned int> received; ///< ghosts
    };

    /// Numbers in the whole: [0, n_owned) the rank's own nodes, in their order (that along a Hilbert curve stays one),
    /// then the ghosts, by owner and then in their order.
    std::vector<unsigned int>                    nodes;
    std::size_t                                  n_owned = 0;
    std::vector<typename SimplexMesh<dim>::Cell> cells; ///< local numbers, in the order of the whole
    std::vector<Neighbor>                        neighbors;
  };

  /// The owner of each node by recursive coordinate bisection: parts of equal numbers of nodes (up to one), cut across
  /// the longest extent.
  /// @pre n_ranks >= 1
  template <int dim>
  std::vector<unsigned int> owners_by_bisection(const std::vector<Vec<dim>> &position, unsigned int n_ranks);

  /// The parts of all ranks.
  /// @pre owner < n_ranks for every node
  template <int dim>
  std::vector<RankPart<dim>> partition(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                       const std::vector<unsigned int> &owner, unsigned int n_ranks);
} // namespace Breakwater
