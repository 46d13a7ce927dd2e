#include "flips.h"

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    /// What the smallest r of the new cells must exceed, given that of the old ones.
    double least_gain(const double r)
    {
      return 1.02 * r + 0.001;
    }
  } // namespace


  template <int dim>
  unsigned int Flips<dim>::improve(unsigned int cell)
  {
    constexpr unsigned int n_most = 4;
    unsigned int           n      = 0;
    while (n < n_most && mesh_.r(cell) < mesh_.target() && flip(cell))
      {
        ++n;
        cell = *std::min_element(numbers_.begin(), numbers_.end(), [this](const unsigned int a, const unsigned int b) {
          return mesh_.r(a) < mesh_.r(b);
        });
      }
    return n;
  }


  template <int dim>
  bool Flips<dim>::apply_best()
  {
    if (best_new_cells_.empty())
      return false;
    mesh_.replace(best_old_cells_, best_new_cells_, numbers_);
    return true;
  }


  // An edge whose two cells are (a, p, q) and (q, p, d) goes to a, d.
  template <>
  bool Flips<2>::flip(const unsigned int c)
  {
    best_new_cells_.clear();
    best_ = 0;
    for (int a = 0; a < 3; ++a)
      {
        const auto [p, q] = outward_facet<2>(mesh_.cell(c), a);
        for (const unsigned int other : mesh_.star(p))
          {
            const Cell &cell = mesh_.cell(other);
            const int   k    = std::find(cell.begin(), cell.end(), q) - cell.begin();
            if (other == c || k == 3)
              continue;
            const unsigned int apex            = mesh_.cell(c)[a],
                               d               = cell[(k + 2) % 3] == p ? cell[(k + 1) % 3] : cell[(k + 2) % 3];
            const std::array<Cell, 2> cells    = {{{{apex, p, d}}, {{apex, d, q}}}};
            const double              smallest = std::min(mesh_.quality(corners(mesh_.positions(), cells[0])),
                                                          mesh_.quality(corners(mesh_.positions(), cells[1])));
            if (smallest > std::max(best_, least_gain(std::min(mesh_.r(c), mesh_.r(other)))))
              {
                best_           = smallest;
                best_old_cells_ = {c, other};
                best_new_cells_.assign(cells.begin(), cells.end());
              }
          }
      }
    return apply_best();
  }


  // In a positive cell (p, q, u, v) the ring goes from u to v, counterclockwise seen from q.
  template <>
  bool Flips<3>::find_ring(const unsigned int p, const unsigned int q)
  {
    std::array<unsigned int, largest_ring> from, to;
    old_cells_.clear();
    for (const unsigned int c : mesh_.star(p))
      {
        const Cell &cell = mesh_.cell(c);
        int         b    = 0;
        while (b < 4 && cell[b] != q)
          ++b;
        if (b == 4)
          continue;
        if (old_cells_.size() == largest_ring)
          return false;
        int a = 0;
        while (cell[a] != p)
          ++a;
        // (p, q, u, v) is an even permutation of the cell
        static constexpr int others[4][4][2] = {{{0, 0}, {2, 3}, {3, 1}, {1, 2}},
                                                {{3, 2}, {0, 0}, {0, 3}, {2, 0}},
                                                {{1, 3}, {3, 0}, {0, 0}, {0, 1}},
                                                {{2, 1}, {0, 2}, {1, 0}, {0, 0}}};
        from[old_cells_.size()]              = cell[others[a][b][0]];
        to[old_cells_.size()]                = cell[others[a][b][1]];
        old_cells_.push_back(c);
      }
    n_ring_ = old_cells_.size();
    if (n_ring_ < 3)
      return false;
    ring_[0] = from[0];
    for (int k = 0; k < n_ring_; ++k)
      {
        int j = 0;
        while (j < n_ring_ && from[j] != ring_[k])
          ++j;
        if (j == n_ring_)
          return false; // the ring is open
        if (k + 1 < n_ring_)
          ring_[k + 1] = to[j];
        else
          return to[j] == ring_[0];
        if (ring_[k + 1] == ring_[0])
          return false; // several rings
      }
    return false;
  }


  // best[i][j]: largest minimum of r over the triangulations of the polygon i, ..., j. What does not exceed `least` does
  // not count.
  template <>
  double Flips<3>::fill_ring(const unsigned int p, const unsigned int q, const double least)
  {
    double        best[largest_ring][largest_ring];
    const Vec<3> &top = mesh_.position(q), &bottom = mesh_.position(p);
    for (int i = 0; i + 1 < n_ring_; ++i)
      best[i][i + 1] = std::numeric_limits<double>::infinity();
    for (int length = 2; length < n_ring_; ++length)
      for (int i = 0, j = length; j < n_ring_; ++i, ++j)
        {
          best[i][j] = least;
          for (int k = i + 1; k < j; ++k)
            {
              double smallest = std::min(best[i][k], best[k][j]);
              if (!(smallest > best[i][j]))
                continue;
              const Vec<3> &u = mesh_.position(ring_[i]), &v = mesh_.position(ring_[k]), &w = mesh_.position(ring_[j]);
              smallest = std::min(smallest, mesh_.quality({u, v, w, top}));
              if (smallest > best[i][j])
                smallest = std::min(smallest, mesh_.quality({v, u, w, bottom}));
              if (smallest > best[i][j])
                {
                  best[i][j]   = smallest;
                  split_[i][j] = k;
                }
            }
        }
    return best[0][n_ring_ - 1] > least ? best[0][n_ring_ - 1] : 0.;
  }


  template <>
  void Flips<3>::collect_cells(const unsigned int p, const unsigned int q, const int first, const int last)
  {
    if (last == first + 1)
      return;
    const int          middle = split_[first][last];
    const unsigned int u = ring_[first], v = ring_[middle], w = ring_[last];
    best_new_cells_.push_back({{u, v, w, q}});
    best_new_cells_.push_back({{v, u, w, p}});
    collect_cells(p, q, first, middle);
    collect_cells(p, q, middle, last);
  }


  template <>
  void Flips<3>::try_edge(const unsigned int p, const unsigned int q)
  {
    if (!find_ring(p, q))
      return;
    double old_smallest = std::numeric_limits<double>::infinity();
    for (const unsigned int c : old_cells_)
      old_smallest = std::min(old_smallest, mesh_.r(c));
    const double smallest = fill_ring(p, q, std::max(best_, least_gain(old_smallest)));
    if (!(smallest > 0))
      return;
    best_           = smallest;
    best_old_cells_ = old_cells_;
    best_new_cells_.clear();
    collect_cells(p, q, 0, n_ring_ - 1);
  }


  // The edges by the product of the outward unit normals of the two faces that share them: largest first, where the
  // dihedral angle is close to 180 degrees.
  template <>
  bool Flips<3>::flip(const unsigned int c)
  {
    static constexpr int edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    best_new_cells_.clear();
    best_                 = 0;
    const Cell       cell = mesh_.cell(c);
    const Simplex<3> area = area_vectors(mesh_.corners_of(c));
    double           length[4];
    for (int a = 0; a < 4; ++a)
      length[a] = norm(area[a]);
    std::array<std::pair<double, int>, 6> order;
    for (int e = 0; e < 6; ++e)
      {
        // the faces that share an edge are those opposite to the two other corners
        int other[2], n = 0;
        for (int a = 0; a < 4; ++a)
          if (a != edges[e][0] && a != edges[e][1])
            other[n++] = a;
        const double product = length[other[0]] * length[other[1]];
        order[e]             = {product > 0 ? -dot(area[other[0]], area[other[1]]) / product : 0., e};
      }
    std::sort(order.begin(), order.end());
    for (const auto &entry : order)
      {
        try_edge(cell[edges[entry.second][0]], cell[edges[entry.second][1]]);
        if (best_ >= 1.1 * mesh_.target())
          break;
      }
    return apply_best();
  }

  template class Flips<2>;
  template class Flips<3>;
} // namespace Breakwater
