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
  /// Why the repair is exact: when all cells are positive and no facet's opposite nodes lie in each other's
  /// circumspheres, the triangulation is the Delaunay one (Delaunay's lemma). A flip whose new cells are positive keeps
  /// the sum of signed volumes over any place, so that cells which the motion has inverted may take part: when none is
  /// left, every place is covered once.
  template <int dim>
  class DelaunayMesh
  {
  public:
    using Cell = LinkedCell<dim>;

    /// What an update did.
    struct Report
    {
      bool        is_full         = true; ///< triangulated from nothing
      std::size_t n_flips         = 0;
      std::size_t n_rebuilt_cells = 0; ///< in cavities that flips could not repair
    };

    /// Triangulates from nothing.
    void rebuild(const std::vector<Vec<dim>> &position);

    /// Makes this the triangulation of nodes at new places [m]: by repair where it can, else from nothing, as for
    /// another number of nodes.
    /// @param on_the_way places that the nodes pass on their way, if not empty. It helps when flat cells between nodes
    /// near a plane become flatter there, in proportion: they go by flips, where they would be inverted by the thousand.
    Report update(const std::vector<Vec<dim>> &position, const std::vector<Vec<dim>> &on_the_way = {});

    /// The nodes have got new numbers: node k was order[k], or is new if that is no_node; nodes that do not appear are
    /// gone. New nodes get their cells in the next update(). Puts the cells into the order of their highest nodes.
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
    enum class State : char
    {
      unused,
      positive,
      inverted ///< or flat
    };
    struct CavityBoundary;

    /// A node to take out or put in costs as much as some 25 of a new triangulation.
    bool is_too_much(const std::size_t n_changes) const { return 25 * n_changes > n_nodes_; }

    // delaunay_mesh.cc
    void         sort_cells(); ///< by their highest nodes
    bool         is_framed(const std::vector<Vec<dim>> &position) const;
    bool         repair(const std::vector<Vec<dim>> &position, const std::vector<Vec<dim>> &on_the_way);
    void         move_to(const std::vector<Vec<dim>> &position);
    void         find_bad_facets(const std::vector<char> &has_moved);
    Simplex<dim> corners_of(const std::array<unsigned int, dim + 1> &node) const;
    bool         is_unused(const unsigned int cell) const { return state_[cell] == State::unused; }
    unsigned int new_cell();
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
    bool replace(const std::array<unsigned int, n_old> &old_cells, const std::array<Cell, n_new> &new_cells,
                 const std::array<std::array<Facet, dim + 1>, n_new> &outside);

    // delaunay_cavity.cc
    bool rebuild_around(unsigned int cell);
    void add_to_cavity(const std::vector<unsigned int> &cells, std::vector<unsigned int> &cavity);
    bool rebuild_cavity(const std::vector<unsigned int> &cavity, std::vector<unsigned int> &to_add,
                        unsigned int added_node = no_node, unsigned int removed_node = no_node);
    bool rebuild_cavity_of(unsigned int cell, bool (DelaunayMesh::*belongs)(unsigned int, unsigned int) const,
                           unsigned int added_node, unsigned int removed_node);
    bool remove_nodes(const std::vector<char> &is_removed);
    bool insert_node(unsigned int node);
    bool holds(unsigned int cell, unsigned int node) const;
    bool is_in_conflict(unsigned int cell, unsigned int node) const;

    std::size_t               n_nodes_ = 0;
    std::vector<char>         has_cells_; ///< of the nodes: not those that are new or at the place of another
    std::vector<unsigned int> new_nodes_; ///< without cells yet
    std::vector<Vec<dim>>     position_;
    std::vector<Cell>         cells_;
    std::vector<State>        state_;
    std::vector<unsigned int> unused_;
    std::vector<unsigned int> mark_; ///< of cells, equal to last_mark_ when in the cavity at work
    unsigned int              last_mark_ = 0;
    std::vector<Facet>        to_check_;
    std::vector<Facet>        stuck_; ///< need a flip that is not possible
    Report                    report_;
  };
} // namespace Breakwater
