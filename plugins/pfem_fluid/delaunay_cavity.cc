#include "delaunay_mesh.h"
#include "predicates.h"

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    /// Nodes of a facet in rising order, and whether they, followed by the opposite corner, are an even permutation of
    /// the cell.
    template <int dim>
    struct FacetKey
    {
      std::array<unsigned int, dim> node;
      bool                          is_even;

      FacetKey(const std::array<unsigned int, dim + 1> &cell, const unsigned int opposite)
      {
        for (unsigned int a = 0, k = 0; a <= dim; ++a)
          if (a != opposite)
            node[k++] = cell[a];
        // The rising order of corners without one is an even permutation with it if dim - opposite is even.
        is_even = (dim - opposite) % 2 == 0;
        for (int i = 1; i < dim; ++i)
          for (int k = i; k > 0 && node[k] < node[k - 1]; --k)
            {
              std::swap(node[k], node[k - 1]);
              is_even = !is_even;
            }
      }
    };
  } // namespace


  /// A facet between the cavity and a cell around it.
  template <int dim>
  struct DelaunayMesh<dim>::CavityBoundary
  {
    FacetKey<dim> key; ///< of a cell in the cavity
    Facet         outside;
    unsigned int  n_met_inside  = 0; ///< by cells of the new triangulation
    unsigned int  n_met_outside = 0;
  };


  template <int dim>
  bool DelaunayMesh<dim>::rebuild_around(const unsigned int cell)
  {
    mark_.resize(cells_.size(), 0);
    ++last_mark_;
    std::vector<unsigned int> cavity, to_add = {cell};
    // The cavity grows where the new triangulation of its nodes disagrees with the cells around it. Beyond a part of the
    // whole, the whole is cheaper.
    while (cavity.size() + report_.n_rebuilt_cells < cells_.size() / 20)
      {
        if (to_add.empty())
          to_add = cavity;
        add_to_cavity(to_add, cavity);
        if (rebuild_cavity(cavity, to_add))
          return true;
      }
    return false;
  }


  template <int dim>
  void DelaunayMesh<dim>::add_to_cavity(const std::vector<unsigned int> &cells, std::vector<unsigned int> &cavity)
  {
    const auto add = [&](const unsigned int cell) {
      if (mark_[cell] == last_mark_)
        return;
      mark_[cell] = last_mark_;
      cavity.push_back(cell);
    };
    std::size_t begin = cavity.size();
    for (const unsigned int cell : cells)
      add(cell);
    for (const unsigned int cell : cells)
      for (const unsigned int neighbor : cells_[cell].neighbor)
        if (neighbor != no_cell)
          add(neighbor);
    // Inverted cells can't be outside.
    for (; begin < cavity.size(); ++begin)
      for (const unsigned int neighbor : cells_[cavity[begin]].neighbor)
        if (neighbor != no_cell && state_[neighbor] == State::inverted)
          add(neighbor);
  }


  template <int dim>
  bool DelaunayMesh<dim>::rebuild_cavity(const std::vector<unsigned int> &cavity, std::vector<unsigned int> &to_add,
                                         const unsigned int added_node, const unsigned int removed_node)
  {
    to_add.clear();
    std::vector<unsigned int>   nodes;
    std::vector<CavityBoundary> boundary;
    for (const unsigned int c : cavity)
      for (unsigned int a = 0; a <= dim; ++a)
        {
          const Cell        &cell     = cells_[c];
          const unsigned int neighbor = cell.neighbor[a];
          nodes.push_back(cell.node[a]);
          if (neighbor == no_cell)
            boundary.push_back({FacetKey<dim>(cell.node, a), {no_cell, 0}, 0, 0});
          else if (mark_[neighbor] != last_mark_)
            boundary.push_back({FacetKey<dim>(cell.node, a), {neighbor, corner_towards(neighbor, c)}, 0, 0});
        }
    const auto is_before = [](const CavityBoundary &one, const CavityBoundary &two) {
      return one.key.node < two.key.node;
    };
    std::sort(boundary.begin(), boundary.end(), is_before);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    nodes.erase(std::remove(nodes.begin(), nodes.end(), removed_node), nodes.end());
    if (added_node != no_node)
      nodes.insert(std::lower_bound(nodes.begin(), nodes.end(), added_node), added_node);

    std::vector<Vec<dim>> points;
    for (const unsigned int i : nodes)
      points.push_back(position_[i]);
    std::vector<Cell> cells = delaunay(points);
    for (Cell &cell : cells)
      for (unsigned int &i : cell.node)
        i = nodes[i];

    // The cells inside the boundary, from the boundary inwards. A facet of it may be met from inside only.
    std::vector<unsigned int> found, number(cells.size(), no_cell);
    auto                      boundary_at = [&](const FacetKey<dim> &key) {
      const auto place = std::lower_bound(boundary.begin(), boundary.end(), key.node,
                                                               [](const CavityBoundary &one, const std::array<unsigned int, dim> &node) {
                                            return one.key.node < node;
                                          });
      return place != boundary.end() && place->key.node == key.node ? &*place : nullptr;
    };
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int a = 0; a <= dim && number[c] == no_cell; ++a)
        {
          const FacetKey<dim> key(cells[c].node, a);
          CavityBoundary     *facet = boundary_at(key);
          if (facet != nullptr && facet->key.is_even == key.is_even)
            {
              number[c] = 0;
              found.push_back(c);
            }
        }
    std::vector<std::array<const CavityBoundary *, dim + 1>> on_boundary;
    std::vector<unsigned int>                                used;
    bool                                                     is_inside = true;
    for (std::size_t k = 0; k < found.size(); ++k)
      {
        const Cell &cell = cells[found[k]];
        on_boundary.emplace_back();
        for (unsigned int a = 0; a <= dim; ++a)
          {
            used.push_back(cell.node[a]);
            const FacetKey<dim> key(cell.node, a);
            CavityBoundary     *facet = boundary_at(key);
            on_boundary[k][a]         = facet;
            if (facet != nullptr)
              ++(facet->key.is_even == key.is_even ? facet->n_met_inside : facet->n_met_outside);
            else if (cell.neighbor[a] == no_cell)
              is_inside = false;
            else if (number[cell.neighbor[a]] == no_cell)
              {
                number[cell.neighbor[a]] = 0;
                found.push_back(cell.neighbor[a]);
              }
          }
      }
    for (const CavityBoundary &facet : boundary)
      if (facet.n_met_inside != 1 || facet.n_met_outside != 0)
        {
          is_inside = false;
          if (facet.outside.cell != no_cell)
            to_add.push_back(facet.outside.cell);
        }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (!is_inside || used != nodes)
      return false;

    for (const unsigned int c : cavity)
      delete_cell(c);
    for (const unsigned int c : found)
      number[c] = new_cell();
    mark_.resize(cells_.size(), 0);
    for (std::size_t k = 0; k < found.size(); ++k)
      {
        const Cell        &from = cells[found[k]];
        const unsigned int c    = number[found[k]];
        cells_[c].node          = from.node;
        for (unsigned int a = 0; a <= dim; ++a)
          if (on_boundary[k][a] == nullptr)
            cells_[c].neighbor[a] = number[from.neighbor[a]];
          else
            {
              const Facet outside   = on_boundary[k][a]->outside;
              cells_[c].neighbor[a] = outside.cell;
              if (outside.cell != no_cell)
                cells_[outside.cell].neighbor[outside.opposite] = c;
              to_check_.push_back({c, a});
            }
      }
    report_.n_rebuilt_cells += found.size();
    return true;
  }


  template <int dim>
  bool DelaunayMesh<dim>::rebuild_cavity_of(const unsigned int cell,
                                            bool (DelaunayMesh::*belongs)(unsigned int, unsigned int) const,
                                            const unsigned int added_node, const unsigned int removed_node)
  {
    const unsigned int node = added_node != no_node ? added_node : removed_node;
    mark_.resize(cells_.size(), 0);
    ++last_mark_;
    std::vector<unsigned int> cavity = {cell}, unused;
    mark_[cell]                      = last_mark_;
    for (std::size_t k = 0; k < cavity.size(); ++k)
      for (const unsigned int neighbor : cells_[cavity[k]].neighbor)
        if (neighbor != no_cell && mark_[neighbor] != last_mark_ && (this->*belongs)(neighbor, node))
          {
            mark_[neighbor] = last_mark_;
            cavity.push_back(neighbor);
          }
    return rebuild_cavity(cavity, unused, added_node, removed_node);
  }


  template <int dim>
  bool DelaunayMesh<dim>::holds(const unsigned int cell, const unsigned int node) const
  {
    const auto &nodes = cells_[cell].node;
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }


  template <int dim>
  bool DelaunayMesh<dim>::is_in_conflict(const unsigned int cell, const unsigned int node) const
  {
    return Circumsphere<dim>(corners_of(cells_[cell].node)).contains(position_[node]);
  }


  template <int dim>
  bool DelaunayMesh<dim>::remove_nodes(const std::vector<char> &is_removed)
  {
    if (std::find(is_removed.begin(), is_removed.end(), 1) == is_removed.end())
      return true;
    std::vector<unsigned int> cell_of(n_nodes_, no_cell);
    for (unsigned int c = 0; c < cells_.size(); ++c)
      for (const unsigned int i : cells_[c].node)
        if (i < n_nodes_)
          cell_of[i] = c;
    for (unsigned int i = 0; i < n_nodes_; ++i)
      if (is_removed[i] && has_cells_[i])
        {
          // The cell may have gone with another node.
          unsigned int c = cell_of[i];
          if (!holds(c, i))
            for (c = 0; c < cells_.size() && !holds(c, i); ++c)
              ;
          if (c == cells_.size() || !rebuild_cavity_of(c, &DelaunayMesh::holds, no_node, i))
            return false;
          has_cells_[i] = 0;
        }
    to_check_.clear(); // what surrounds the place of a node is right
    return true;
  }


  template <int dim>
  bool DelaunayMesh<dim>::insert_node(const unsigned int node)
  {
    // A walk towards the node, through the facets that it is behind.
    unsigned int c = 0;
    while (c < cells_.size() && is_unused(c))
      ++c;
    bool is_there = false;
    for (std::size_t n_steps = 0; !is_there && n_steps < cells_.size(); ++n_steps)
      {
        is_there = true;
        for (unsigned int a = 0; a <= dim && is_there; ++a)
          {
            auto nodes = cells_[c].node;
            nodes[a]   = node;
            if (orientation(nodes) < 0)
              {
                is_there = false;
                c        = cells_[c].neighbor[a];
                if (c == no_cell)
                  return false;
              }
          }
      }
    if (!is_there || !rebuild_cavity_of(c, &DelaunayMesh::is_in_conflict, node, no_node))
      return false;
    has_cells_[node] = 1;
    return true;
  }

  template class DelaunayMesh<2>;
  template class DelaunayMesh<3>;
} // namespace Breakwater
