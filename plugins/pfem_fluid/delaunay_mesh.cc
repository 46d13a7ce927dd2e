#include "delaunay_mesh.h"

#include "predicates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
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
    has_cells_.assign(n_nodes_, 0);
    for (Cell &cell : cells_)
      for (unsigned int &i : cell.node)
        if (i < n_nodes_)
          {
            i             = first[i];
            has_cells_[i] = 1;
          }
    state_.assign(cells_.size(), State::positive);
    unused_.clear();
    sort_cells();
    to_check_.clear();
    stuck_.clear();
    report_ = {};
  }


  template <int dim>
  typename DelaunayMesh<dim>::Report DelaunayMesh<dim>::update(const std::vector<Vec<dim>> &position,
                                                               const std::vector<Vec<dim>> &on_the_way)
  {
    if (!is_framed(position) || !repair(position, on_the_way))
      rebuild(position);
    return report_;
  }


  template <int dim>
  bool DelaunayMesh<dim>::repair(const std::vector<Vec<dim>> &position, const std::vector<Vec<dim>> &on_the_way)
  {
    report_         = {};
    report_.is_full = false;

    // Of nodes at one place only the first has cells.
    const auto                first = first_at_place(position);
    std::vector<char>         is_hidden(n_nodes_, 0);
    std::vector<unsigned int> inserted;
    std::size_t               n_changes = 0;
    for (unsigned int i = 0; i < n_nodes_; ++i)
      {
        is_hidden[i] = first[i] != i;
        if (!is_hidden[i] && !has_cells_[i])
          inserted.push_back(i);
        n_changes += is_hidden[i] == has_cells_[i];
      }
    if (is_too_much(n_changes) || !remove_nodes(is_hidden))
      return false;

    if (!on_the_way.empty())
      move_to(on_the_way);
    move_to(position);
    while (!stuck_.empty())
      {
        const std::vector<Facet> seeds = stuck_;
        stuck_.clear();
        for (const Facet &facet : seeds)
          if (needs_flip(facet) && !rebuild_around(facet.cell))
            return false;
        flip_all();
      }
    for (const unsigned int i : inserted)
      if (!insert_node(i))
        return false;
    to_check_.clear(); // what surrounds an inserted node is right
    return true;
  }


  template <int dim>
  void DelaunayMesh<dim>::move_to(const std::vector<Vec<dim>> &position)
  {
    std::vector<char> has_moved(position_.size(), 0);
    for (std::size_t i = 0; i < position.size(); ++i)
      for (int d = 0; d < dim; ++d)
        has_moved[i] = has_moved[i] || position_[i][d] != position[i][d];
    std::copy(position.begin(), position.end(), position_.begin());
    find_bad_facets(has_moved);
    flip_all();
  }


  template <int dim>
  void DelaunayMesh<dim>::find_bad_facets(const std::vector<char> &has_moved)
  {
    std::vector<char> moves(cells_.size(), 0); // the cells
    for (unsigned int c = 0; c < cells_.size(); ++c)
      for (const unsigned int i : cells_[c].node)
        moves[c] |= has_moved[i];
    for (unsigned int c = 0; c < cells_.size(); ++c)
      {
        if (!moves[c])
          continue;
        const Cell             &cell = cells_[c];
        const Circumsphere<dim> sphere(corners_of(cell.node));
        const bool              is_positive = sphere.orientation() > 0;
        state_[c]                           = is_positive ? State::positive : State::inverted;
        for (unsigned int a = 0; a <= dim; ++a)
          {
            const unsigned int neighbor = cell.neighbor[a];
            if (neighbor == no_cell)
              continue;
            // Between positive cells, one side's sphere tells.
            if (!is_positive ||
                ((neighbor > c || !moves[neighbor]) && !sphere.is_surely_outside(position_[node_across(cell, a)])))
              to_check_.push_back({c, a});
          }
      }
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
  Simplex<dim> DelaunayMesh<dim>::corners_of(const std::array<unsigned int, dim + 1> &node) const
  {
    // An even permutation with a near node first: differences to a far one would lose the others' places.
    unsigned int first = 0;
    while (first < dim && node[first] >= n_nodes_)
      ++first;
    Simplex<dim> x;
    for (int a = 0; a <= dim; ++a)
      x[a] = position_[node[a]];
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
  unsigned int DelaunayMesh<dim>::new_cell()
  {
    if (unused_.empty())
      {
        cells_.emplace_back();
        state_.push_back(State::positive);
        return cells_.size() - 1;
      }
    const unsigned int cell = unused_.back();
    unused_.pop_back();
    state_[cell] = State::positive;
    return cell;
  }


  template <int dim>
  void DelaunayMesh<dim>::delete_cell(const unsigned int cell)
  {
    state_[cell] = State::unused;
    cells_[cell].node.fill(n_nodes_);
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
  void DelaunayMesh<dim>::renumber(const std::vector<unsigned int> &order)
  {
    std::vector<char> is_removed(n_nodes_, 1), has_cells(order.size(), 0);
    for (unsigned int k = 0; k < order.size(); ++k)
      if (order[k] != no_node)
        {
          is_removed[order[k]] = 0;
          has_cells[k]         = has_cells_[order[k]];
        }
    const std::size_t n_changes =
      std::count(order.begin(), order.end(), no_node) + std::count(is_removed.begin(), is_removed.end(), 1);
    if (is_too_much(n_changes) || !remove_nodes(is_removed))
      {
        *this = {};
        return;
      }
    has_cells_.swap(has_cells);

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
    state_.assign(cells_.size(), State::positive);
    unused_.clear();
  }

  template class DelaunayMesh<2>;
  template class DelaunayMesh<3>;
} // namespace Breakwater
