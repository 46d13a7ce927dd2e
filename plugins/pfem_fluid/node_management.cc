#include "node_management.h"

#include "kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace Breakwater
{
  namespace
  {
    /// Other nodes than this [spacings] away from the place of a new one: with fewer it would soon be merged again.
    constexpr double clearance = 0.5;
    /// Least mass of a new node, in units of a regular node's.
    constexpr double least_mass = 0.5;

    /// An edge of one cell, and the cell.
    struct Edge
    {
      unsigned int first, second; ///< first < second
      unsigned int cell;
      double       square; ///< of the length [m^2]

      bool is_same(const Edge &other) const { return first == other.first && second == other.second; }
    };

    template <int dim>
    class NodeManager
    {
    public:
      using Cells = std::vector<typename SimplexMesh<dim>::Cell>;

      NodeManager(FluidNodes<dim> &nodes, const Cells &cells, const SizeField<dim> &size, Walls<dim> &walls,
                  const double reference_density, const NodeLimits<dim> &limits)
        : nodes_(nodes)
        , cells_(cells)
        , size_(size)
        , walls_(walls)
        , reference_density_(reference_density)
        , limits_(limits)
        , is_changed_(nodes.n, 0)
        , is_removed_(nodes.n, 0)
      {
      }

      NodeChanges run()
      {
        find_edges();
        find_isolated_pairs();
        NodeChanges changes;
        std::sort(close_.begin(), close_.end(), [](const Edge &a, const Edge &b) {
          return std::tie(a.square, a.first, a.second) < std::tie(b.square, b.first, b.second);
        });
        for (const Edge &edge : close_)
          changes.n_removed += merge(edge);

        std::sort(long_.begin(), long_.end(), [](const Edge &a, const Edge &b) {
          return std::tie(b.square, a.first, a.second, a.cell) < std::tie(a.square, b.first, b.second, b.cell);
        });
        for (auto begin = long_.begin(); begin != long_.end();)
          {
            const auto end = std::find_if(begin, long_.end(), [&](const Edge &edge) {
              return !edge.is_same(*begin);
            });
            changes.n_inserted += split(begin, end);
            begin = end;
          }
        if (changes.n_removed > 0)
          nodes_.remove(is_removed_);
        return changes;
      }

    private:
      void find_edges()
      {
        if (cells_.empty())
          return;
        std::vector<double> shortest(cells_.size()), longest(cells_.size());
        element_passes<dim>().edge_squares(cells_.front().data(), cells_.size(), nodes_.xp.data(), shortest.data(),
                                           longest.data());
        const double in_doubt = 1 + 1e-9; // round-off is another here than there
        for (unsigned int c = 0; c < cells_.size(); ++c)
          {
            const Simplex<dim> x     = nodes_.corners(cells_[c]);
            const double       h     = size_(x[0]);
            const double       close = std::pow(limits_.smallest_distance * h, 2);
            const double       far   = limits_.longest_edge > 0 ? std::pow(limits_.longest_edge * h, 2) :
                                                                  std::numeric_limits<double>::infinity();
            if (shortest[c] > in_doubt * close && in_doubt * longest[c] < far)
              continue;
            for (int a = 1; a <= dim; ++a)
              for (int b = 0; b < a; ++b)
                {
                  const Vec<dim> e      = x[a] - x[b];
                  const double   square = dot(e, e);
                  if (square >= close && square <= far)
                    continue;
                  const auto [first, second] = std::minmax(cells_[c][a], cells_[c][b]);
                  if (!nodes_.is_driven(first) && !nodes_.is_driven(second))
                    (square < close ? close_ : long_).push_back({first, second, c, square});
                }
          }
      }

      /// Pairs of a node without cells and another one. Buckets are as large as the smallest distance; a node without
      /// cells stands in its own and all around, so that each other node looks into one.
      void find_isolated_pairs()
      {
        const double size = limits_.smallest_distance * size_.largest();
        if (!(size > 0))
          return;
        const auto bucket = [&](const unsigned int i, const int neighbor) {
          std::uint64_t key = 0; // 21 bits for each coordinate
          for (int d = 0, rest = neighbor; d < dim; ++d, rest /= 3)
            key = key << 21 | (static_cast<std::uint64_t>(
                                 static_cast<std::int64_t>(std::floor(nodes_.xp[i][d] / size)) + rest % 3 - 1) &
                               0x1fffff);
          return key;
        };
        constexpr int                                                n_neighbors = dim == 2 ? 9 : 27;
        std::unordered_map<std::uint64_t, std::vector<unsigned int>> isolated;
        for (unsigned int i = nodes_.n_interface; i < nodes_.n; ++i)
          if (!nodes_.has_cells[i] && !nodes_.is_driven(i))
            for (int k = 0; k < n_neighbors; ++k)
              isolated[bucket(i, k)].push_back(i);
        if (isolated.empty())
          return;
        for (unsigned int i = nodes_.n_interface; i < nodes_.n; ++i)
          if (!nodes_.is_driven(i))
            {
              const auto found = isolated.find(bucket(i, n_neighbors / 2));
              if (found != isolated.end())
                for (const unsigned int j : found->second)
                  if (i != j && (nodes_.has_cells[i] || i < j))
                    add_pair(std::min(i, j), std::max(i, j));
            }
      }

      void add_pair(const unsigned int first, const unsigned int second)
      {
        const Vec<dim> e = nodes_.position(second) - nodes_.position(first);
        if (norm(e) >= limits_.smallest_distance * size_(nodes_.position(first)))
          return;
        Simplex<dim> edge; // no edge through a thin wall
        edge.fill(nodes_.position(first));
        edge[1] = nodes_.position(second);
        if (!walls_.any_has_surface() || !walls_.separate(edge))
          close_.push_back({first, second, 0, dot(e, e)});
      }

      /// How firmly a node belongs to its place.
      int rank(const unsigned int i) const
      {
        return 2 * static_cast<int>(nodes_.walls[i].end() - nodes_.walls[i].begin()) + nodes_.is_surface[i];
      }

      bool merge(const Edge &edge)
      {
        if (is_changed_[edge.first] || is_changed_[edge.second])
          return false;
        const bool         first_stays = rank(edge.first) >= rank(edge.second);
        const unsigned int stays       = first_stays ? edge.first : edge.second,
                           goes        = first_stays ? edge.second : edge.first;
        const double mass = nodes_.mass[stays] + nodes_.mass[goes], part = nodes_.mass[goes] / mass;
        const auto   mix = [&](double &value, const double other) {
          value += part * (other - value);
        };
        for (int d = 0; d < dim; ++d)
          {
            mix(nodes_.v[stays][d], nodes_.v[goes][d]);
            mix(nodes_.a[stays][d], nodes_.a[goes][d]);
            if (rank(stays) == rank(goes))
              mix(nodes_.xp[stays][d], nodes_.xp[goes][d]);
          }
        nodes_.density[stays] =
          mass / (nodes_.mass[stays] / nodes_.density[stays] + nodes_.mass[goes] / nodes_.density[goes]);
        nodes_.mass[stays] = mass;
        is_changed_[stays] = is_changed_[goes] = is_removed_[goes] = 1;
        return true;
      }

      /// Splits an edge, given as its appearances in the cells around.
      bool split(const std::vector<Edge>::const_iterator begin, const std::vector<Edge>::const_iterator end)
      {
        const Vec<dim> place = 0.5 * (nodes_.position(begin->first) + nodes_.position(begin->second));
        const double   h     = size_(place);
        donors_.clear();
        blockers_.clear();
        for (auto edge = begin; edge != end; ++edge)
          for (const unsigned int i : cells_[edge->cell])
            {
              if (is_changed_[i])
                return false;
              if (norm(nodes_.position(i) - place) < clearance * h &&
                  std::find(blockers_.begin(), blockers_.end(), i) == blockers_.end())
                blockers_.push_back(i);
              if (!nodes_.is_driven(i) && std::find(donors_.begin(), donors_.end(), i) == donors_.end())
                donors_.push_back(i);
            }
        if (!blockers_.empty())
          {
            if (blockers_.size() == 1 && is_outer(begin, end) && can_be_raised(blockers_.front()))
              put_on_edge(blockers_.front(), *begin, place);
            return false;
          }
        const double part = 1. / (donors_.size() + 1);
        double       mass = 0, volume = 0;
        Vec<dim>     momentum, acceleration;
        for (const unsigned int i : donors_)
          {
            const double given = part * nodes_.mass[i];
            mass += given;
            volume += given / nodes_.density[i];
            momentum += given * nodes_.velocity(i);
            acceleration += given * FluidNodes<dim>::vec(nodes_.a[i]);
          }
        if (mass < least_mass * reference_density_ * regular_volume<dim>(h))
          return false;
        for (const unsigned int i : donors_)
          {
            nodes_.mass[i] *= 1 - part;
            is_changed_[i] = 1;
          }

        const std::size_t i = nodes_.n;
        nodes_.resize(i + 1);
        is_removed_.push_back(0);
        nodes_.mass[i]    = mass;
        nodes_.density[i] = mass / volume;
        for (int d = 0; d < dim; ++d)
          {
            nodes_.xp[i][d] = place[d];
            nodes_.v[i][d]  = momentum[d] / mass;
            nodes_.a[i][d]  = acceleration[d] / mass;
          }
        join_walls_of(*begin, i);
        return true;
      }

      /// A node on an edge is on the walls that both of its ends are on.
      void join_walls_of(const Edge &edge, const std::size_t i)
      {
        nodes_.contacts[i] = common(nodes_.contacts[edge.first], nodes_.contacts[edge.second]);
        Quad unused;
        walls_.stop(nodes_.position(edge.first), nodes_.xp[i].c, unused.c, 0., nodes_.contacts[i]);
      }

      /// True for an edge on the boundary of the mesh: the cells around it do not close.
      bool is_outer(const std::vector<Edge>::const_iterator begin, const std::vector<Edge>::const_iterator end)
      {
        if constexpr (dim == 2)
          return end - begin == 1;
        ring_.clear();
        for (auto edge = begin; edge != end; ++edge)
          for (const unsigned int i : cells_[edge->cell])
            if (i != edge->first && i != edge->second)
              ring_.push_back(i);
        std::sort(ring_.begin(), ring_.end());
        for (std::size_t k = 0; k < ring_.size(); k += 2)
          if (k + 1 == ring_.size() || ring_[k] != ring_[k + 1])
            return true;
        return false;
      }

      bool can_be_raised(const unsigned int i) const
      {
        return i >= nodes_.n_interface && !nodes_.is_driven(i) && rank(i) == 0;
      }

      void put_on_edge(const unsigned int i, const Edge &edge, const Vec<dim> &place)
      {
        for (int d = 0; d < dim; ++d)
          nodes_.xp[i][d] = place[d];
        join_walls_of(edge, i);
        is_changed_[i] = is_changed_[edge.first] = is_changed_[edge.second] = 1;
      }

      FluidNodes<dim>          &nodes_;
      const Cells              &cells_;
      const SizeField<dim>     &size_;
      Walls<dim>               &walls_;
      const double              reference_density_;
      const NodeLimits<dim>     limits_;
      std::vector<Edge>         close_, long_;
      std::vector<char>         is_changed_; ///< a node changes once per call
      std::vector<char>         is_removed_;
      std::vector<unsigned int> donors_, blockers_, ring_;
    };
  } // namespace


  template <int dim>
  NodeChanges manage_nodes(FluidNodes<dim> &nodes, const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                           const SizeField<dim> &size, Walls<dim> &walls, const double reference_density,
                           const NodeLimits<dim> &limits)
  {
    return NodeManager<dim>(nodes, cells, size, walls, reference_density, limits).run();
  }

  template NodeChanges manage_nodes<2>(FluidNodes<2> &, const std::vector<SimplexMesh<2>::Cell> &, const SizeField<2> &,
                                       Walls<2> &, double, const NodeLimits<2> &);
  template NodeChanges manage_nodes<3>(FluidNodes<3> &, const std::vector<SimplexMesh<3>::Cell> &, const SizeField<3> &,
                                       Walls<3> &, double, const NodeLimits<3> &);
} // namespace Breakwater
