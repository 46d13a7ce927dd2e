#pragma once

#include "star_mesh.h"
#include "volume_budget.h"

#include <vector>

namespace Breakwater
{
  /// Takes slender cells off the free surface: those whose nodes all lie on the boundary, where neither flips nor moves
  /// of nodes help.
  ///
  /// A cell goes if r is below the target, at least one of its facets is on the boundary and each such facet has a node
  /// that slides on the surface or lies between nodes on the line where surface and wall meet, it is flat (height
  /// 3 V / A_max at most 0.35 h; in 2D 2 A / longest edge), no node loses its last cell, and the mesh's volume, with
  /// what lifted nodes add, changes by no more than a part. Films against a wall, at most 0.05 h high, go as long as
  /// interfaces stay closed. Where walls may be bared, films go up to a height of 0.15 h, also those that lie over one
  /// inner node: what is shut in between a wall and nodes that have come down to it is cured by nothing else.
  template <int dim>
  class Peel
  {
  public:
    using Facet = typename SimplexMesh<dim>::Facet;

    /// @param budget by which the mesh's volume may change
    Peel(StarMesh<dim> &mesh, const VolumeBudget &budget);

    /// The entry for the largest part.
    static void declare(ParameterReader &reader, double &largest_part);

    struct Limits
    {
      double part           = 1;     ///< of the budget that may be spent
      bool   may_bare_walls = false; ///< whether a facet at a wall may open that has one node on the surface,
                                     ///< and films of more height
    };

    /// @return whether the cell was taken away
    bool try_cell(unsigned int cell, const Limits &limits);

    /// Takes a cell away even if nodes on the surface lose their last cell by that, as droplets of their own. Of the
    /// budget it takes nothing where it hangs together with no other cell. @return whether the cell was taken away
    bool free_nodes(unsigned int cell);

    VolumeBudget &budget() { return budget_; }

    /// Tries all bad cells, the worst first. @return whether one was taken away
    bool worst_first();

    /// Updates the boundary of the mesh and reports.
    void finish(SmoothingReport &report);

  private:
    void   take(unsigned int cell, const std::vector<Facet> &opened, const std::vector<Facet> &closed);
    bool   is_exposed(unsigned int cell, const Facet &facet) const;
    double height(unsigned int cell) const; ///< [m]
    /// Facets inside the mesh that come to its boundary without the cell, and those on it that go.
    void sort_facets(unsigned int cell, std::vector<Facet> &opened, std::vector<Facet> &closed) const;
    bool may_open(const Facet &facet) const;
    bool may_bare_wall(const Facet &facet) const;
    bool is_fixed(const Facet &facet) const; ///< true for facets of an interface

    StarMesh<dim>     &mesh_;
    VolumeBudget       budget_;
    std::vector<Facet> opened_, closed_; ///< facets that came to the boundary, and that left it
    unsigned int       n_cells_ = 0, n_freed_ = 0;
    double             volume_ = 0;
  };
} // namespace Breakwater
