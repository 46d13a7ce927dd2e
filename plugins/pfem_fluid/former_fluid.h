#pragma once

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// The mesh before a remesh, asked about cells of the new triangulation: fluid tears later than it closes.
  template <int dim>
  class FormerFluid
  {
  public:
    using Cell  = typename SimplexMesh<dim>::Cell;
    using Facet = typename SimplexMesh<dim>::Facet;

    /// @param mesh its cells sorted by their highest nodes
    /// @param old_number of the nodes in that mesh; larger than all for nodes that are new since
    FormerFluid(SimplexMesh<dim> mesh, std::vector<unsigned int> old_number);

    /// True if the cell was in the mesh.
    bool had(const Cell &cell) const;

    /// True if a facet of the cell was on the surface of the mesh, and the cell is on the side of the fluid.
    bool had_surface_of(const Cell &cell) const;

  private:
    const SimplexMesh<dim>          mesh_;
    const std::vector<unsigned int> old_number_;
    std::vector<Facet>              surface_; ///< in 3D rotated so that the lowest node is first; in rising order
  };
} // namespace Breakwater
