#pragma once

#include "delaunay.h"

#include <breakwater/mesh/quality.h>

#include <cstddef>
#include <vector>

namespace Breakwater
{
  /// The Delaunay triangulation of nodes that move: kept from one remesh to the next, and repaired by flips where the
  /// motion has made it wrong. The result is the same as that of a new triangulation.
  ///
  /// Besides the nodes there are dim + 1 far ones, at 15 to 30 times the largest coordinate. They close the
  /// triangulation, so that the hull of the nodes, with its many coplanar ones at walls, is inside like all else. They
  /// change only flat cells on the hull, whose circumradius is as large as their distance.
  ///
  /// Nodes whose motion would turn a cell inside out are taken out before, where they were, and put back when all else
  /// is right. So are nodes around facets that no flip can mend.
  ///
  /// Why the repair is exact: when all cells are positive and no facet's opposite nodes lie in each other's
  /// circumspheres, the triangulation is the Delaunay one (Delaunay's lemma). A cavity between the neighbours of a node
  /// is filled by its Delaunay cells, and a node is put in by making a star of all cells whose circumspheres hold it
  /// (Bowyer 1981, Watson 1981). Ties of cospherical nodes are broken as CGAL does (exact_in_sphere()).
  template <int dim>
  class DelaunayMesh
  {
  public:
    using Cell = LinkedCell<dim>;

    /// What an update did.
    struct Report
    {
      bool        is_full      = true; ///< triangulated from nothing
      std::size_t n_flips      = 0;
      std::size_t n_reinserted = 0; ///< nodes taken out and put back
    };

    /// Triangulates from nothing.
    void rebuild(const std::vector<Vec<dim>> &position);

    /// Makes this the triangulation of nodes at new places [m]: by repair where it can, else from nothing, as for
    /// another number of nodes.
    Report update(const std::vector<Vec<dim>> &position);

    /// The nodes have got new numbers: node k was order[k], or is new if that is no_node; nodes that do not appear are
    /// gone. New nodes get their cells in the next update(). If the order of the others has changed, the cells are put into
    /// the order of their highest nodes.
    void renumber(const std::vector<unsigned int> &order);

    static constexpr unsigned int no_node = no_cell;

    std::size_t n_nodes() const { return n_nodes_; }

    /// Places of the nodes, then of the far ones [m].
    const std::vector<Vec<dim>> &position() const { return position_; }

    /// The cells; some have far nodes (from n_nodes() on), and unused entries have nothing but such.
    const std::vector<Cell> &cells() const { return cells_; }

  private:
    /// A facet by a cell and its corner opposite to it.
    struct Facet
    {
      unsigned int cell;
      unsigned int opposite;
    };
    struct OpenFacet;

    /// A node that has been taken out, and one that was beside it.
    struct TakenOut
    {
      unsigned int node, beside;
    };

    /// What a try to repair starts from.
    struct State
    {
      std::vector<Vec<dim>>     position;
      std::vector<Cell>         cells;
      std::vector<unsigned int> cell_of, unused;
    };

    /// A node to take out or put in costs as much as some 10 of a new triangulation.
    bool is_too_much(const std::size_t n_changes) const { return 10 * n_changes > n_nodes_; }

    // delaunay_mesh.cc
    void                      sort_cells(); ///< by their highest nodes
    void                      find_cells(); ///< of all nodes
    bool                      is_framed(const std::vector<Vec<dim>> &position) const;
    bool                      repair(const std::vector<Vec<dim>> &position);
    bool                      remove_nodes(const std::vector<unsigned int> &nodes);
    bool                      move_to(const std::vector<Vec<dim>> &position);
    bool                      mend(); ///< @return false if facets are stuck
    void                      add_nodes_of_stuck_facets(std::vector<unsigned int> &nodes) const;
    void                      go_back_to(const State &state);
    std::vector<unsigned int> find_bad_facets(); ///< @return inverted cells
    Simplex<dim> corners_of(const std::array<unsigned int, dim + 1> &node) const { return corners_of(node, position_); }
    Simplex<dim> corners_of(const std::array<unsigned int, dim + 1> &node, const std::vector<Vec<dim>> &position) const
    {
      // Differences to a far node would lose the others' places.
      return node[0] < n_nodes_ ? corners<dim>(position, node) : corners_from_near(node, position);
    }
    Simplex<dim> corners_from_near(const std::array<unsigned int, dim + 1> &node,
                                   const std::vector<Vec<dim>>             &position) const;
    bool         has_cells(const unsigned int node) const { return cell_of_[node] != no_cell; }
    bool         is_unused(const unsigned int cell) const { return cells_[cell].node[0] == cells_[cell].node[1]; }
    unsigned int new_cell(const std::array<unsigned int, dim + 1> &node);
    void         set_nodes(unsigned int cell, const std::array<unsigned int, dim + 1> &node);
    void         delete_cell(unsigned int cell);
    unsigned int corner_towards(unsigned int cell, unsigned int neighbor) const;
    unsigned int corner_at(unsigned int cell, unsigned int node) const;
    unsigned int node_across(const Cell &cell, unsigned int corner) const; ///< of the neighbor opposite to a corner

    // delaunay_flips.cc
    void  flip_all();
    bool  needs_flip(const Facet &facet) const;
    bool  try_flip(const Facet &facet);
    bool  try_flip_in_2d(const Facet &facet);
    bool  try_flip_in_3d(const Facet &facet);
    Facet outside_of(unsigned int cell, unsigned int node) const;
    int   orientation(const std::array<unsigned int, dim + 1> &node) const;
    template <std::size_t n_old, std::size_t n_new>
    void replace(const std::array<unsigned int, n_old> &old_cells, const std::array<Cell, n_new> &new_cells,
                 const std::array<std::array<Facet, dim + 1>, n_new> &outside);

    // delaunay_nodes.cc
    void         join(const Facet &one, const Facet &two); ///< as two sides of one facet
    void         find_cavity(unsigned int cell, unsigned int node,
                             bool (DelaunayMesh::*belongs)(unsigned int cell, unsigned int node) const);
    bool         holds(unsigned int cell, unsigned int node) const;
    bool         is_in_conflict(unsigned int cell, unsigned int node) const;
    unsigned int apex_of(const OpenFacet &facet, const std::vector<unsigned int> &candidates) const;
    bool         remove_node(unsigned int node);
    bool         take_out(unsigned int node);
    bool         take_out_of(std::vector<unsigned int> inverted, const std::vector<Vec<dim>> &new_position);
    bool         loosen(const Facet &facet); ///< takes a node of two cells out whose facet can't be flipped
    bool         insert_node(unsigned int node, unsigned int start);

    std::size_t               n_nodes_ = 0;
    std::vector<Vec<dim>>     position_;
    std::vector<Cell>         cells_;
    std::vector<unsigned int> cell_of_; ///< one that has the node; no_cell for new nodes and those at another's place
    std::vector<unsigned int> unused_;
    std::vector<unsigned int> mark_; ///< of cells, equal to last_mark_ when in the cavity at work
    unsigned int              last_mark_ = 0;
    std::vector<unsigned int> cavity_;  ///< cells that go
    std::vector<unsigned int> filling_; ///< cells that have come instead when a node was removed
    std::vector<TakenOut>     taken_out_;
    std::vector<Facet>        to_check_;
    std::vector<Facet>        stuck_; ///< need a flip that is not possible
    Report                    report_;
  };
} // namespace Breakwater
