#pragma once

#include "former_fluid.h"
#include "pfem_parameters.h"
#include "structure_contact.h"

#include <functional>
#include <vector>

namespace Breakwater
{
  /// Which cells of a new triangulation are fluid: asked cell by cell by alpha_shape().
  template <int dim>
  class FluidCells
  {
  public:
    using Cell = typename SimplexMesh<dim>::Cell;

    /// All arguments must stay until this is gone.
    /// @param nodes at their new places, with has_cells and is_surface of the former mesh
    /// @param former the mesh before
    /// @param is_inside of the initial state, where all that is true for was fluid; empty at a remesh
    FluidCells(const FluidNodes<dim> &nodes, const PfemParameters<dim> &parameters, const AdoptedSurface<dim> &adopted,
               const FormerFluid<dim> &former, const std::function<bool(const Cell &)> &is_inside);

    /// Whether a cell that is small enough is fluid: not if it lies flat in a wall, reaches through a wall or a
    /// structure, or is a sliver between walls.
    bool keeps(const Cell &cell) const;

    /// Whether a cell whose circumradius [m] is larger than alpha times the spacing is small enough: with another
    /// spacing there, or if it was fluid or is a flat one along a wall.
    bool is_small(const Cell &cell, double circumradius) const;

  private:
    bool keeps_at_boundary(const Cell &cell) const;
    bool is_interface(const unsigned int node) const { return node < nodes_.n_interface; }

    const FluidNodes<dim>                   &nodes_;
    const PfemParameters<dim>               &parameters_;
    const AdoptedSurface<dim>               &adopted_;
    const FormerFluid<dim>                  &former_;
    const std::function<bool(const Cell &)> &is_inside_;
    static constexpr unsigned char           held  = 1;     ///< by a wall or the interface
    static constexpr unsigned char           plain = 2;     ///< cells around need no closer look, unless all are held
    std::vector<unsigned char>               kind_;         ///< of the nodes: held, plain
    std::vector<char>                        near_surface_; ///< of a wall that is not a plane
    std::vector<Contacts>                    near_walls_;
  };
} // namespace Breakwater
