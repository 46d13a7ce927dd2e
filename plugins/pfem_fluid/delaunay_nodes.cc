#include "delaunay_mesh.h"
#include "predicates.h"

#include <algorithm>
#include <cstdint>
#include <optional>

// Nodes that are taken out of the triangulation or put into it.

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


  /// A facet of a hole that lacks the cell on its inner side.
  template <int dim>
  struct DelaunayMesh<dim>::OpenFacet
  {
    FacetKey<dim>                     key;  ///< of the cell that it lacks
    std::array<unsigned int, dim + 1> node; ///< of that cell, but for the one opposite
    unsigned int                      opposite;
    Facet                             beyond;
  };


  template <int dim>
  void DelaunayMesh<dim>::join(const Facet &one, const Facet &two)
  {
    if (one.cell != no_cell)
      cells_[one.cell].neighbor[one.opposite] = two.cell;
    if (two.cell != no_cell)
      cells_[two.cell].neighbor[two.opposite] = one.cell;
  }


  template <int dim>
  void DelaunayMesh<dim>::find_cavity(const unsigned int cell, const unsigned int node,
                                      bool (DelaunayMesh::*belongs)(unsigned int, unsigned int) const)
  {
    mark_.resize(cells_.size(), 0);
    ++last_mark_;
    cavity_     = {cell};
    mark_[cell] = last_mark_;
    for (std::size_t k = 0; k < cavity_.size(); ++k)
      for (const unsigned int neighbor : cells_[cavity_[k]].neighbor)
        if (neighbor != no_cell && mark_[neighbor] != last_mark_ && (this->*belongs)(neighbor, node))
          {
            mark_[neighbor] = last_mark_;
            cavity_.push_back(neighbor);
          }
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
  unsigned int DelaunayMesh<dim>::apex_of(const OpenFacet &facet, const std::vector<unsigned int> &candidates) const
  {
    // Spheres through the facet are the larger the farther they reach inwards: the smallest with a node is empty.
    auto                             node = facet.node;
    unsigned int                     apex = no_node;
    std::optional<Circumsphere<dim>> sphere;
    for (const unsigned int candidate : candidates)
      {
        if (std::find(facet.key.node.begin(), facet.key.node.end(), candidate) != facet.key.node.end() ||
            (sphere && !sphere->contains(position_[candidate])))
          continue;
        node[facet.opposite] = candidate;
        const Circumsphere<dim> other(corners_of(node));
        if (other.orientation() > 0)
          {
            apex = candidate;
            sphere.emplace(other);
          }
      }
    return apex;
  }


  template <int dim>
  bool DelaunayMesh<dim>::remove_node(const unsigned int node)
  {
    find_cavity(cell_of_[node], node, &DelaunayMesh::holds);
    std::vector<OpenFacet>    open;
    std::vector<unsigned int> candidates;
    for (const unsigned int c : cavity_)
      {
        const Cell        &cell = cells_[c];
        const unsigned int a    = corner_at(c, node);
        open.push_back({FacetKey<dim>(cell.node, a), cell.node, a, outside_of(c, node)});
        candidates.insert(candidates.end(), open.back().key.node.begin(), open.back().key.node.end());
      }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

    // Each new cell closes an open facet. When none is left, the positive cells cover the hole once: their boundaries
    // add up to the hole's. Around a node of a triangulation that is not Delaunay, it may be that none can be found.
    const unsigned int                   first_new = cells_.size();
    std::vector<Cell>                    filling;
    std::vector<std::pair<Facet, Facet>> joints;
    while (!open.empty())
      {
        const OpenFacet    facet = open.back();
        const unsigned int apex  = apex_of(facet, candidates);
        if (apex == no_node || filling.size() > 3 * cavity_.size() + 20)
          return false;
        open.pop_back();
        const unsigned int number = first_new + filling.size();
        joints.push_back({{number, facet.opposite}, facet.beyond});
        filling.push_back({facet.node, {}});
        auto &cell           = filling.back().node;
        cell[facet.opposite] = apex;
        for (unsigned int b = 0; b <= dim; ++b)
          {
            if (b == facet.opposite)
              continue;
            const FacetKey<dim> key(cell, b);
            const auto          met = std::find_if(open.begin(), open.end(), [&](const OpenFacet &other) {
              return other.key.node == key.node;
            });
            if (met == open.end())
              {
                OpenFacet next   = {key, cell, b, {number, b}};
                next.key.is_even = !key.is_even;
                std::swap(next.node[(b + 1) % (dim + 1)], next.node[(b + 2) % (dim + 1)]);
                open.push_back(next);
              }
            else if (met->key.is_even == key.is_even)
              {
                joints.push_back({{number, b}, met->beyond});
                *met = open.back();
                open.pop_back();
              }
            else
              return false;
          }
      }

    for (const unsigned int c : cavity_)
      delete_cell(c);
    filling_.clear();
    for (const Cell &cell : filling)
      filling_.push_back(new_cell(cell.node));
    const auto real = [&](const Facet &facet) {
      return facet.cell == no_cell || facet.cell < first_new ? facet :
                                                               Facet{filling_[facet.cell - first_new], facet.opposite};
    };
    for (const auto &[one, two] : joints)
      {
        join(real(one), real(two));
        to_check_.push_back(real(one));
      }
    cell_of_[node] = no_cell;
    return true;
  }


  template <int dim>
  bool DelaunayMesh<dim>::take_out(const unsigned int node)
  {
    const auto        &around = cells_[cell_of_[node]].node;
    const unsigned int beside =
      *std::min_element(around.begin(), around.end(), [&](const unsigned int a, const unsigned int b) {
        return std::make_pair(a == node, a) < std::make_pair(b == node, b);
      });
    if (is_too_much(taken_out_.size()) || !remove_node(node))
      return false;
    taken_out_.push_back({node, beside});
    return true;
  }


  template <int dim>
  bool DelaunayMesh<dim>::take_out_of(std::vector<unsigned int> inverted, const std::vector<Vec<dim>> &new_position)
  {
    std::vector<char>         is_inverted(cells_.size(), 0);
    std::vector<unsigned int> n_inverted(position_.size(), 0); // cells, around each node
    const auto                note = [&](const unsigned int c) {
      is_inverted[c] = 1;
      for (const unsigned int i : cells_[c].node)
        ++n_inverted[i];
    };
    std::for_each(inverted.begin(), inverted.end(), note);
    for (std::size_t k = 0; k < inverted.size(); ++k)
      {
        const unsigned int c = inverted[k];
        if (!is_inverted[c])
          continue;
        unsigned int worst = no_node;
        for (const unsigned int i : cells_[c].node)
          if (i < n_nodes_ && (worst == no_node || n_inverted[i] > n_inverted[worst]))
            worst = i;
        if (worst == no_node)
          return false;
        find_cavity(cell_of_[worst], worst, &DelaunayMesh::holds);
        for (const unsigned int cell : cavity_)
          if (is_inverted[cell])
            {
              is_inverted[cell] = 0;
              for (const unsigned int i : cells_[cell].node)
                --n_inverted[i];
            }
        if (!take_out(worst))
          return false;
        is_inverted.resize(cells_.size(), 0);
        for (const unsigned int cell : filling_)
          if (Circumsphere<dim>(corners_of(cells_[cell].node, new_position)).orientation() <= 0)
            {
              note(cell);
              inverted.push_back(cell);
            }
      }
    return true;
  }


  template <int dim>
  bool DelaunayMesh<dim>::loosen(const Facet &facet)
  {
    const Cell                       &cell = cells_[facet.cell];
    std::array<unsigned int, dim + 2> nodes;
    nodes[0] = node_across(cell, facet.opposite);
    nodes[1] = cell.node[facet.opposite];
    for (unsigned int a = 1; a <= dim; ++a)
      nodes[1 + a] = cell.node[(facet.opposite + a) % (dim + 1)];
    return std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int i) {
      return i < n_nodes_ && take_out(i);
    });
  }


  template <int dim>
  bool DelaunayMesh<dim>::insert_node(const unsigned int node, const unsigned int start)
  {
    // A walk towards the node, through the facets that it is behind.
    unsigned int c        = start;
    bool         is_there = false;
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
    if (!is_there)
      return false;

    // The cells whose circumspheres hold the node become a star around it.
    find_cavity(c, node, &DelaunayMesh::is_in_conflict);
    std::vector<std::pair<Cell, Facet>> star; // cells with the node, and what is beyond the facet opposite to it
    std::vector<unsigned int>           corner;
    for (const unsigned int cavity_cell : cavity_)
      for (unsigned int a = 0; a <= dim; ++a)
        {
          const unsigned int neighbor = cells_[cavity_cell].neighbor[a];
          if (neighbor != no_cell && mark_[neighbor] == last_mark_)
            continue;
          Cell cell    = cells_[cavity_cell];
          cell.node[a] = node;
          if (orientation(cell.node) <= 0)
            return false;
          star.push_back({cell, {neighbor, neighbor == no_cell ? 0 : corner_towards(neighbor, cavity_cell)}});
          corner.push_back(a);
        }
    for (const unsigned int cavity_cell : cavity_)
      delete_cell(cavity_cell);

    // Two of its cells share each facet that has the node: found by its other nodes.
    std::vector<std::pair<std::uint64_t, Facet>> inner;
    for (std::size_t k = 0; k < star.size(); ++k)
      {
        const unsigned int number = new_cell(star[k].first.node);
        join({number, corner[k]}, star[k].second);
        for (unsigned int b = 0; b <= dim; ++b)
          if (b != corner[k])
            {
              std::uint64_t low = 0, high = 0; // of dim - 1 nodes
              for (unsigned int a = 0; a <= dim; ++a)
                if (a != b && a != corner[k])
                  {
                    const std::uint64_t i = cells_[number].node[a] + std::uint64_t(1);
                    low                   = high == 0 ? i : std::min(high, i);
                    high                  = std::max(high, i);
                  }
              inner.push_back({high << 32 | low, {number, b}});
            }
      }
    std::sort(inner.begin(), inner.end(), [](const auto &one, const auto &two) {
      return one.first < two.first;
    });
    for (std::size_t k = 0; k + 1 < inner.size(); k += 2)
      join(inner[k].second, inner[k + 1].second);
    return true;
  }

  template class DelaunayMesh<2>;
  template class DelaunayMesh<3>;
} // namespace Breakwater
