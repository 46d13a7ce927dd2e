#pragma once

#include "fluid_nodes.h"
#include "size_field.h"
#include "walls.h"

#include <breakwater/mesh/simplex_mesh.h>

namespace Breakwater
{
  /// Limits on the distance of neighbouring nodes, in units of the spacing [-]; 0: no limit.
  template <int dim>
  struct NodeLimits
  {
    double smallest_distance = 0.35;
    double longest_edge      = dim == 2 ? 1.8 : 2.2;
  };

  /// What a call of manage_nodes() did.
  struct NodeChanges
  {
    unsigned int n_removed  = 0;
    unsigned int n_inserted = 0;

    bool any() const { return n_removed + n_inserted > 0; }
  };

  /// Merges pairs of nodes that have come too close and inserts nodes on edges that have become too long. Pairs are
  /// neighbours in a cell, or nodes without cells (which gather in corners, also at the same place) and any other.
  ///
  /// A pair becomes one node with the mass and momentum of both. It stays where the one that belongs to more walls, or
  /// to the surface, was; of two of a kind, at their centre of mass. A new node goes to the middle of its edge unless
  /// another node of the cells around is closer than half a spacing; every node of these cells gives the same part of
  /// its mass, with the momentum of that. So mass and momentum are exact, and the kinetic energy can only fall. Where
  /// the new node would have less than half of a regular node's mass, the fluid is left to tear. If the only node in
  /// the way lies inside the fluid and the edge on its boundary, that node itself goes to the middle of the edge: the
  /// mesh keeps its volume, and the flat cell between them can't tear later.
  ///
  /// Driven nodes are neither moved nor do they give. The numbers of the nodes change: `cells`, the mesh before,
  /// is of no use afterwards.
  template <int dim>
  NodeChanges manage_nodes(FluidNodes<dim> &nodes, const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                           const SizeField<dim> &size, Walls<dim> &walls, double reference_density,
                           const NodeLimits<dim> &limits);
} // namespace Breakwater
