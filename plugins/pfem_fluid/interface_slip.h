#pragma once

#include "structure_contact.h"
#include "walls.h"

#include <array>
#include <vector>

namespace Breakwater
{
  /// Free slip along adopted surfaces: the fluid's stresses act on them in normal direction only.
  ///
  /// Interface nodes belong to the other body and move with it, in all directions; the fluid's nodes slide past them.
  /// Pressure along the surface: what the fluid of the volume V_i at an interface node i would feel, V_i grad p. That
  /// fluid has no momentum of its own in this scheme, and the body must not get it: P_i f_i is left out, P_i the
  /// projection on the directions in which i may slide (none at an edge in 2D or a corner in 3D, along the edge only in
  /// 3D). Given to the fluid instead it would do work that no change of volume pays for. It is summed up and reported,
  /// so that momentum can be balanced. The weight of what fluid mass is tied at i is treated alike: at rest both cancel.
  /// Viscous stress: the fluid at i has the velocity v_i + P_i (sum_j w_ij v_j - v_i), j the fluid nodes that share
  /// cells with i, w_ij by the volumes of these cells; the force along the surface goes to j with the same weights. The
  /// operator stays symmetric, so it only dissipates.
  template <int dim>
  class InterfaceSlip
  {
  public:
    using Cells = std::vector<typename SimplexMesh<dim>::Cell>;

    /// Groups the facets around each node into smooth pieces: at an edge of more than 40 degrees a new piece begins.
    /// @param slips [facet] whether the fluid slips there; at a node with another facet it does not
    void set_up(const WetSurface<dim> &surface, const std::vector<char> &slips);

    bool is_on() const { return !pieces_.empty(); }

    /// [interface node] whether the fluid does not slip there; empty if slip is not free anywhere.
    const std::vector<char> &sticking_nodes() const { return sticks_; }

    /// Finds the fluid nodes around each interface node, after a remesh.
    void find_neighbours(const FluidNodes<dim> &nodes, const Cells &cells);

    /// Directions of sliding, from the present places of the interface nodes and the walls that they lie on.
    void update_directions(const FluidNodes<dim> &nodes, const Walls<dim> &walls);

    /// Gives interface nodes the velocity of the fluid there; take_slip_back() restores their own.
    void add_slip(FluidNodes<dim> &nodes);
    void take_slip_back(FluidNodes<dim> &nodes) const;

    /// Gives viscous forces along the surface to the fluid's nodes. @pre nodes.force holds the forces of the stresses
    void pass_viscous_forces_on(FluidNodes<dim> &nodes, const Cells &cells, const ForceEffects &effects) const;

    /// Takes forces along the surface off the interface nodes: all but minus the weight of their fluid mass.
    /// @param gravity [m/s^2], one for all nodes or one per node
    void take_forces_along(FluidNodes<dim> &nodes, const std::vector<Vec<dim>> &gravity);

    /// What take_forces_along() took last, one per interface node [N]; empty if slip is not free.
    const std::vector<Vec<dim>> &taken_forces() const { return taken_; }

    template <class Slip, class Visitor>
    static void visit_state(Slip &slip, const Visitor &visit)
    {
      visit(slip.sticks_);
      visit(slip.cells_);
      visit(slip.begin_);
      visit(slip.neighbour_);
      visit(slip.weight_);
      visit(slip.taken_);
    }

  private:
    using Facet = std::array<unsigned int, WetSurface<dim>::nodes_per_facet>;

    /// The part of a vector at node i in the directions of sliding.
    Vec<dim> along(std::size_t i, const Vec<dim> &vector) const;

    std::vector<std::vector<std::vector<Facet>>> pieces_;       ///< [node][piece]
    std::vector<char>                            sticks_;       ///< [node] it has a facet without slip
    std::vector<unsigned int>                    cells_;        ///< with interface nodes, by number
    std::vector<unsigned int>                    begin_;        ///< [node] of its neighbours
    std::vector<unsigned int>                    neighbour_;    ///< j
    std::vector<double>                          weight_;       ///< w_ij
    std::vector<Vec<dim>>                        own_velocity_; ///< since add_slip() [m/s]
    std::vector<Vec<dim>>                        taken_;        ///< [N]
    std::vector<std::array<Vec<dim>, dim>>       direction_;    ///< at right angles, in which a node does not slide
    std::vector<unsigned int>                    n_directions_;
  };
} // namespace Breakwater
