#pragma once

#include <breakwater/interfaces/mesh_smoother.h>
#include <breakwater/mesh/quality.h>

#include <array>
#include <vector>

namespace Breakwater
{
  /// A mesh while it is smoothed: knows the star of each node (the cells that have it) and the quality r of each cell,
  /// the insphere radius in units of the regular cell's.
  template <int dim>
  class StarMesh
  {
  public:
    using Cell  = typename SimplexMesh<dim>::Cell;
    using Facet = typename SimplexMesh<dim>::Facet;

    /// Works on the mesh and the positions in place; finish() must be called at the end.
    StarMesh(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task);

    std::size_t                  n_cells() const { return mesh_.cells.size(); }
    const Cell                  &cell(const unsigned int c) const { return mesh_.cells[c]; }
    double                       r(const unsigned int c) const { return r_[c]; }
    const Vec<dim>              &position(const unsigned int node) const { return position_[node]; }
    const std::vector<Vec<dim>> &positions() const { return position_; }
    NodeFreedom                  freedom(const unsigned int node) const { return freedom_[node]; }
    double                       spacing() const { return task_.spacing; }
    double                       target() const { return task_.target; }

    /// False for cells that have been replaced by fewer.
    bool is_alive(const unsigned int c) const { return mesh_.cells[c][0] != mesh_.cells[c][1]; }

    struct Star
    {
      const unsigned int *first, *last;
      const unsigned int *begin() const { return first; }
      const unsigned int *end() const { return last; }
      std::size_t         size() const { return last - first; }
    };
    Star star(const unsigned int node) const
    {
      const Row &row = rows_[node];
      return {entries_.data() + row.begin, entries_.data() + row.begin + row.size};
    }

    double volume() const; ///< [m^dim]

    Simplex<dim> corners_of(const unsigned int c) const { return corners(position_, mesh_.cells[c]); }

    /// r of a cell with these corners.
    double quality(const Simplex<dim> &x) const
    {
      const Simplex<dim> area = area_vectors(x);
      double             sum  = 0;
      for (int a = 0; a <= dim; ++a)
        sum += norm(area[a]);
      return sum > 0 ? dot(area[1], x[1] - x[0]) / sum * inverse_radius_ : 0.;
    }

    /// The cells below the target, the worst first.
    std::vector<unsigned int> bad_cells() const;

    /// The smallest r of a star.
    double smallest(const unsigned int node) const;

    /// Counts the changes of the mesh so far.
    unsigned int clock() const { return clock_; }

    /// When a cell of a node's star was last changed, by that clock.
    unsigned int changed_at(const unsigned int node) const { return changed_at_[node]; }

    /// Puts a node elsewhere.
    /// @param r of the cells of its star there, in their order
    void move(unsigned int node, const Vec<dim> &x, const std::vector<double> &r);

    /// Moves a node by what its freedom allows of a displacement [m], if every cell of its star keeps its r or stays
    /// above `least`, and no facet of the boundary turns over. @return whether it has moved
    bool try_move(unsigned int node, const Vec<dim> &displacement, double least);

    /// As much of a step as keeps a node within 0.5 h of where it was when this was constructed, 0.3 h where it slides on
    /// the free surface.
    Vec<dim> within_reach(unsigned int node, const Vec<dim> &step, bool keeps_volume = true) const;

    /// False if a wall is in the way of a node of the boundary to a place.
    bool is_reachable(const unsigned int node, const Vec<dim> &x) const
    {
      return !task_.is_reachable || freedom(node) == NodeFreedom::free || task_.is_reachable(node, x);
    }

    /// Replaces cells by others that fill the same place; numbers of the new ones are put into `numbers`.
    void replace(const std::vector<unsigned int> &old_cells, const std::vector<Cell> &new_cells,
                 std::vector<unsigned int> &numbers);

    /// Takes a cell away.
    void remove(unsigned int c);

    /// Makes an inner node one of the boundary, where cells that have covered it are taken away.
    void expose(const unsigned int node)
    {
      if (freedom_[node] == NodeFreedom::free) // else its wall holds it
        freedom_[node] = NodeFreedom::slides_on_surface;
      is_on_boundary_[node] = 1;
    }

    /// False for inner nodes that have been exposed since.
    bool was_on_surface(const unsigned int node) const { return Breakwater::is_on_surface(task_.freedom[node]); }

    /// Takes the part out of a vector that a node can't move along: nothing inside, the component along its area vector
    /// on the boundary, that along the wall's normal as well, all but that along an edge, all if it is fixed. A node of
    /// the free surface that need not keep the volume is kept by its wall or edge only.
    class Constraint
    {
    public:
      Constraint(const StarMesh &mesh, unsigned int node, bool keeps_volume = true);

      /// dV/dx [m^(dim - 1)]; zero inside.
      const Vec<dim> &area() const { return area_; }

      Vec<dim> allowed_part(const Vec<dim> &vector) const
      {
        if (is_fixed_)
          return {};
        return vector - across_[0] * dot(across_[0], vector) - across_[1] * dot(across_[1], vector);
      }

      /// True if all these facets of the boundary lie the same way up as the area vector with the node at x.
      bool faces_outward(const StarMesh &mesh, const std::vector<Facet> &facets, const Vec<dim> &x) const;

    private:
      void set_direction(const Vec<dim> &direction); ///< the only one that a node can move along

      unsigned int node_;
      bool         is_fixed_;
      Vec<dim>     area_;      ///< zero inside
      Vec<dim>     across_[2]; ///< orthogonal to each other, unit length or zero
    };

    /// True on the free surface, and where a wall or edge has been bared beside a node: its area vector tells.
    bool is_at_surface(unsigned int node) const;

    /// Area vector of a node, dV/dx [m^(dim - 1)]: it depends on its neighbours only.
    Vec<dim> area_vector(unsigned int node) const;

    /// The normal of a facet of the boundary with one of its nodes at x, out of the mesh, not of unit length.
    Vec<dim> normal_of(const Facet &facet, unsigned int node, const Vec<dim> &x) const;

    /// The facets of the boundary that have a node, with their normals out of the mesh.
    void boundary_facets(unsigned int node, std::vector<Facet> &facets) const;

    bool is_on_boundary(const unsigned int node) const { return is_on_boundary_[node]; }

    SimplexMesh<dim> &mesh() { return mesh_; }

    /// Nodes may go as far from their present places as they could from the first ones.
    void restart() { start_ = position_; }

    /// Takes dead cells out of the mesh, and reports what sliding nodes have changed of its volume.
    void finish(SmoothingReport &report);

  private:
    struct Row
    {
      unsigned int begin = 0, size = 0, capacity = 0;
    };
    void add_to_star(unsigned int node, unsigned int c);
    void note_change(unsigned int c);
    void remove_from_star(unsigned int node, unsigned int c);

    SimplexMesh<dim>         &mesh_;
    std::vector<Vec<dim>>    &position_;
    std::vector<Vec<dim>>     start_; ///< places before all moves, or at the last restart() [m]
    const SmoothingTask<dim> &task_;
    std::vector<NodeFreedom>  freedom_;
    const double              inverse_radius_; ///< [1/m]
    std::vector<double>       r_;
    std::vector<Row>          rows_;
    std::vector<unsigned int> entries_;
    std::vector<unsigned int> dead_;
    std::vector<unsigned int> bad_; ///< all cells below the target, and some that are no longer
    std::vector<unsigned int> changed_at_;
    unsigned int              clock_       = 0;
    double                    slid_volume_ = 0; ///< [m^dim]
    std::vector<char>         is_on_boundary_;  ///< true for all nodes of the boundary, also of what has been bared
    std::vector<double>       new_r_;           ///< of a star, in try_move()
    std::vector<Facet>        facets_;          ///< of the boundary, in try_move()
  };
} // namespace Breakwater
