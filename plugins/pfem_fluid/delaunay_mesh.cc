#include "delaunay_mesh.h"

#include "predicates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numeric>

namespace Breakwater
{
  namespace
  {
    /// Corners of a simplex around all nodes. Its size is a power of two, so that it seldom changes, and in no symmetry
    /// with the nodes, so that no spheres are tied.
    template <int dim>
    std::array<Vec<dim>, dim + 1> far_nodes(const std::vector<Vec<dim>> &position)
    {
      double largest = 1e-100;
      for (const Vec<dim> &x : position)
        for (int d = 0; d < dim; ++d)
          largest = std::max(largest, std::abs(x[d]));
      const double size = std::exp2(std::ceil(std::log2(15 * largest)));
      if constexpr (dim == 2)
        return {{{{-1.73 * size, -1.03 * size}}, {{1.71 * size, -0.97 * size}}, {{0.013 * size, 2.01 * size}}}};
      else
        return {{{{1.01 * size, 1.07 * size, 0.93 * size}},
                 {{1.03 * size, -0.98 * size, -1.05 * size}},
                 {{-0.97 * size, 1.02 * size, -1.06 * size}},
                 {{-0.99 * size, -1.04 * size, 0.96 * size}}}};
    }

    /// For each node the first one at the same place, mostly itself.
    template <int dim>
    std::vector<unsigned int> first_at_place(const std::vector<Vec<dim>> &position)
    {
      // A hash table of node numbers, twice as large as it need be.
      std::size_t size = 1;
      while (size < 2 * position.size())
        size *= 2;
      std::vector<unsigned int> table(size, no_cell), first(position.size());
      for (unsigned int i = 0; i < position.size(); ++i)
        {
          std::uint64_t hash = 0;
          for (int d = 0; d < dim; ++d)
            {
              const double  x = position[i][d] + 0.; // no negative zero
              std::uint64_t bits;
              std::memcpy(&bits, &x, sizeof(bits));
              hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
              hash ^= hash >> 32;
            }
          std::size_t place = hash & (size - 1);
          while (table[place] != no_cell && norm(position[table[place]] - position[i]) > 0)
            place = (place + 1) & (size - 1);
          if (table[place] == no_cell)
            table[place] = i;
          first[i] = table[place];
        }
      return first;
    }
  } // namespace


  template <int dim>
  bool DelaunayMesh<dim>::is_framed(const std::vector<Vec<dim>> &position) const
  {
    return position_.size() == position.size() + dim + 1 && norm(position_[n_nodes_] - far_nodes(position)[0]) == 0;
  }


  template <int dim>
  void DelaunayMesh<dim>::rebuild(const std::vector<Vec<dim>> &position)
  {
    const auto far   = far_nodes(position);
    const auto first = first_at_place(position);
    n_nodes_         = position.size();
    position_        = position;
    position_.insert(position_.end(), far.begin(), far.end());
    cells_ = delaunay(position_);
    for (Cell &cell : cells_)
      for (unsigned int &i : cell.node)
        if (i < n_nodes_)
          i = first[i];
    unused_.clear();
    sort_cells();
    to_check_.clear();
    stuck_.clear();
    taken_out_.clear();
    report_ = {};
  }


  template <int dim>
  typename DelaunayMesh<dim>::Report DelaunayMesh<dim>::update(const std::vector<Vec<dim>> &position)
  {
    if (!is_framed(position) || !repair(position))
      rebuild(position);
    return report_;
  }


  template <int dim>
  bool DelaunayMesh<dim>::repair(const std::vector<Vec<dim>> &position)
  {
    report_         = {};
    report_.is_full = false;

    // Of nodes at one place only the first has cells.
    const auto                first = first_at_place(position);
    std::vector<unsigned int> inserted, removed;
    for (unsigned int i = 0; i < n_nodes_; ++i)
      if ((first[i] != i) == has_cells(i))
        (has_cells(i) ? removed : inserted).push_back(i);
    if (is_too_much(inserted.size() + removed.size()) || !remove_nodes(removed))
      return false;

    // Where the triangulation is not Delaunay, a node can't always be taken out: those of facets that can't be mended
    // are taken out in another try, before the motion.
    constexpr unsigned int    n_tries = 3;
    const State               before  = {position_, cells_, cell_of_, unused_};
    std::vector<unsigned int> suspects;
    bool                      is_mended = false;
    for (unsigned int k = 0; k < n_tries && !is_mended; ++k)
      {
        if (k > 0)
          go_back_to(before);
        for (const unsigned int i : suspects)
          if (!take_out(i))
            return false;
        if (!move_to(position))
          return false;
        is_mended = mend();
        if (!is_mended)
          add_nodes_of_stuck_facets(suspects);
      }
    if (!is_mended)
      return false;

    // The last one first: what was beside it then is there again.
    report_.n_reinserted = taken_out_.size();
    for (auto taken = taken_out_.rbegin(); taken != taken_out_.rend(); ++taken)
      if (!insert_node(taken->node, cell_of_[taken->beside]))
        return false;
    unsigned int last = n_nodes_; // a far node
    for (const unsigned int i : inserted)
      {
        if (!insert_node(i, cell_of_[last]))
          return false;
        last = i;
      }
    taken_out_.clear();
    return true;
  }


  template <int dim>
  bool DelaunayMesh<dim>::mend()
  {
    flip_all();
    while (!stuck_.empty())
      {
        const std::vector<Facet> seeds = stuck_;
        stuck_.clear();
        std::size_t n_loosened = 0;
        for (const Facet &facet : seeds)
          if (!needs_flip(facet) || loosen(facet))
            ++n_loosened;
          else
            stuck_.push_back(facet);
        if (4 * n_loosened < seeds.size())
          return false;
        flip_all();
      }
    return true;
  }


  template <int dim>
  void DelaunayMesh<dim>::add_nodes_of_stuck_facets(std::vector<unsigned int> &nodes) const
  {
    for (const Facet &facet : stuck_)
      {
        const Cell &cell = cells_[facet.cell];
        if (cell.neighbor[facet.opposite] == no_cell) // the cell has gone
          continue;
        nodes.insert(nodes.end(), cell.node.begin(), cell.node.end());
        nodes.push_back(node_across(cell, facet.opposite));
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    nodes.erase(std::lower_bound(nodes.begin(), nodes.end(), n_nodes_), nodes.end()); // far ones
  }


  template <int dim>
  void DelaunayMesh<dim>::go_back_to(const State &state)
  {
    position_ = state.position;
    cells_    = state.cells;
    cell_of_  = state.cell_of;
    unused_   = state.unused;
    taken_out_.clear();
    to_check_.clear();
    stuck_.clear();
  }


  template <int dim>
  bool DelaunayMesh<dim>::move_to(const std::vector<Vec<dim>> &position)
  {
    auto other_position = position_; // the new one, then the old one
    std::copy(position.begin(), position.end(), other_position.begin());
    position_.swap(other_position);
    const auto inverted = find_bad_facets();
    if (inverted.empty())
      return true;
    // Where the nodes were, the triangulation is Delaunay: any of them can be taken out there.
    position_.swap(other_position);
    const bool is_done = take_out_of(inverted, other_position);
    position_.swap(other_position);
    return is_done;
  }


  template <int dim>
  std::vector<unsigned int> DelaunayMesh<dim>::find_bad_facets()
  {
    std::vector<unsigned int>      inverted;
    std::vector<Circumsphere<dim>> spheres; // of a block of cells
    constexpr unsigned int         block_size = 64;
    Facet                          facets[block_size * (dim + 1)]; // of the block, each to be seen from one side
    for (unsigned int begin = 0; begin < cells_.size(); begin += block_size)
      {
        const unsigned int end      = std::min<std::size_t>(begin + block_size, cells_.size());
        unsigned int       n_facets = 0;
        spheres.clear();
        for (unsigned int c = begin; c < end; ++c)
          {
            const Cell &cell = cells_[c];
            spheres.emplace_back(corners_of(cell.node));
            if (!spheres.back().is_surely_positive() && (is_unused(c) || spheres.back().orientation() <= 0))
              {
                if (!is_unused(c))
                  inverted.push_back(c);
                continue;
              }
            // Between positive cells, one side's sphere tells. Without branches, which would be guessed wrongly.
            for (unsigned int a = 0; a <= dim; ++a)
              {
                facets[n_facets] = {c, a};
                n_facets += cell.neighbor[a] > c && cell.neighbor[a] != no_cell;
              }
          }
        for (unsigned int k = 0; k < n_facets; ++k)
          if (!spheres[facets[k].cell - begin].is_surely_outside(
                position_[node_across(cells_[facets[k].cell], facets[k].opposite)]))
            to_check_.push_back(facets[k]);
      }
    return inverted;
  }


  template <int dim>
  unsigned int DelaunayMesh<dim>::node_across(const Cell &cell, const unsigned int corner) const
  {
    // The exclusive or of all numbers, as those on the facet come twice.
    unsigned int node = cell.node[corner];
    for (unsigned int a = 0; a <= dim; ++a)
      node ^= cell.node[a] ^ cells_[cell.neighbor[corner]].node[a];
    return node;
  }


  template <int dim>
  Simplex<dim> DelaunayMesh<dim>::corners_from_near(const std::array<unsigned int, dim + 1> &node,
                                                    const std::vector<Vec<dim>>             &position) const
  {
    // An even permutation with a near node first.
    unsigned int first = 0;
    while (first < dim && node[first] >= n_nodes_)
      ++first;
    Simplex<dim> x;
    for (int a = 0; a <= dim; ++a)
      x[a] = position[node[a]];
    if (first != 0)
      {
        std::swap(x[0], x[first]);
        if constexpr (dim == 2)
          std::swap(x[1], x[2]);
        else
          std::swap(x[first == 1 ? 2 : 1], x[first == 3 ? 2 : 3]);
      }
    return x;
  }


  template <int dim>
  unsigned int DelaunayMesh<dim>::new_cell(const std::array<unsigned int, dim + 1> &node)
  {
    unsigned int cell = cells_.size();
    if (unused_.empty())
      cells_.emplace_back();
    else
      {
        cell = unused_.back();
        unused_.pop_back();
      }
    set_nodes(cell, node);
    return cell;
  }


  template <int dim>
  void DelaunayMesh<dim>::set_nodes(const unsigned int cell, const std::array<unsigned int, dim + 1> &node)
  {
    cells_[cell].node = node;
    for (const unsigned int i : node)
      cell_of_[i] = cell;
  }


  template <int dim>
  void DelaunayMesh<dim>::delete_cell(const unsigned int cell)
  {
    cells_[cell].node.fill(n_nodes_); // see is_unused()
    cells_[cell].neighbor.fill(no_cell);
    unused_.push_back(cell);
  }


  template <int dim>
  unsigned int DelaunayMesh<dim>::corner_towards(const unsigned int cell, const unsigned int neighbor) const
  {
    unsigned int a = 0;
    while (a < dim && cells_[cell].neighbor[a] != neighbor)
      ++a;
    return a;
  }


  template <int dim>
  unsigned int DelaunayMesh<dim>::corner_at(const unsigned int cell, const unsigned int node) const
  {
    unsigned int a = 0;
    while (a < dim && cells_[cell].node[a] != node)
      ++a;
    return a;
  }


  template <int dim>
  bool DelaunayMesh<dim>::remove_nodes(const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int i : nodes)
      if (has_cells(i) && !remove_node(i))
        return false;
    to_check_.clear(); // what surrounds the place of a node is right
    return true;
  }


  template <int dim>
  void DelaunayMesh<dim>::renumber(const std::vector<unsigned int> &order)
  {
    std::vector<char> stays(n_nodes_, 0);
    for (const unsigned int i : order)
      if (i != no_node)
        stays[i] = 1;
    std::vector<unsigned int> removed;
    for (unsigned int i = 0; i < n_nodes_; ++i)
      if (!stays[i])
        removed.push_back(i);
    if (is_too_much(removed.size() + std::count(order.begin(), order.end(), no_node)) || !remove_nodes(removed))
      {
        *this = {};
        return;
      }

    std::vector<unsigned int>   new_number(position_.size());
    const std::vector<Vec<dim>> old_position = position_;
    position_.resize(order.size());
    for (unsigned int k = 0; k < order.size(); ++k)
      if (order[k] != no_node)
        {
          new_number[order[k]] = k;
          position_[k]         = old_position[order[k]];
        }
    for (unsigned int far = 0; far <= dim; ++far)
      {
        new_number[n_nodes_ + far] = order.size() + far;
        position_.push_back(old_position[n_nodes_ + far]);
      }
    n_nodes_ = order.size();
    to_check_.clear();
    for (Cell &cell : cells_)
      for (unsigned int &i : cell.node)
        i = new_number[i];
    std::vector<unsigned int> kept;
    std::remove_copy(order.begin(), order.end(), std::back_inserter(kept), no_node);
    if (std::is_sorted(kept.begin(), kept.end()))
      find_cells();
    else
      sort_cells();
  }


  template <int dim>
  void DelaunayMesh<dim>::sort_cells()
  {
    // Counting sort of the used cells.
    std::vector<unsigned int> start(position_.size() + 1, 0), place(cells_.size(), no_cell);
    const auto                highest = [](const Cell &cell) {
      return *std::max_element(cell.node.begin(), cell.node.end());
    };
    for (unsigned int c = 0; c < cells_.size(); ++c)
      if (!is_unused(c))
        ++start[highest(cells_[c]) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (unsigned int c = 0; c < cells_.size(); ++c)
      if (!is_unused(c))
        place[c] = start[highest(cells_[c])]++;

    std::vector<Cell> sorted(cells_.size() - unused_.size());
    for (unsigned int c = 0; c < cells_.size(); ++c)
      if (!is_unused(c))
        {
          Cell &cell = sorted[place[c]];
          cell       = cells_[c];
          for (unsigned int &neighbor : cell.neighbor)
            neighbor = neighbor == no_cell ? no_cell : place[neighbor];
        }
    cells_.swap(sorted);
    unused_.clear();
    find_cells();
  }


  template <int dim>
  void DelaunayMesh<dim>::find_cells()
  {
    cell_of_.assign(position_.size(), no_cell);
    for (unsigned int c = 0; c < cells_.size(); ++c)
      if (!is_unused(c))
        for (const unsigned int i : cells_[c].node)
          cell_of_[i] = c;
  }

  template class DelaunayMesh<2>;
  template class DelaunayMesh<3>;
} // namespace Breakwater
