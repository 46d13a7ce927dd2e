#pragma once

#include "star_mesh.h"

#include <vector>

namespace Breakwater
{
  /// Takes slender cells off the free surface: those whose nodes all lie on the boundary, where neither flips nor moves
  /// of nodes help.
  ///
  /// A cell goes if r is below the target, at least one of its facets is on the boundary and each such facet has a node
  /// that slides on the surface or lies between nodes on the line where surface and wall meet, it is flat (height
  /// 3 V / A_max at most 0.35 h; in 2D 2 A / longest edge), no node loses its last cell, and the volume taken in all
  /// stays below a part of the mesh's. Films against a wall, at most 0.05 h high, with a node on the surface and none
  /// that is fixed, go whatever their facets.
  template <int dim>
  class Peel
  {
  public:
    using Facet = typename SimplexMesh<dim>::Facet;

    /// @param largest_part of the mesh's volume that may be taken away
    Peel(StarMesh<dim> &mesh, double largest_part);

    /// The entry for the largest part.
    static void declare(ParameterReader &reader, double &largest_part);

    /// @return whether the cell was taken away
    bool try_cell(unsigned int cell);

    /// Tries all bad cells, the worst first. @return whether one was taken away
    bool worst_first();

    /// Updates the boundary of the mesh and reports.
    void finish(SmoothingReport &report);

  private:
    bool   is_exposed(unsigned int cell, const Facet &facet) const;
    double height(unsigned int cell) const; ///< [m]
    bool   may_open(const Facet &facet);

    StarMesh<dim>     &mesh_;
    double             allowed_volume_ = 0; ///< [m^dim]
    std::vector<Facet> opened_, closed_;    ///< facets that came to the boundary, and that left it
    std::vector<Facet> around_;             ///< a node, in may_open()
    unsigned int       n_cells_ = 0;
    double             volume_  = 0;
  };
} // namespace Breakwater
