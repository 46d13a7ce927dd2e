#include "alpha_shape.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <numeric>

namespace Breakwater
{
  namespace
  {
    /// Puts the numbers into rising order. @return whether that took an even number of exchanges
    template <std::size_t n>
    bool sort_evenly(std::array<unsigned int, n> &numbers)
    {
      // Without branches, which would be guessed wrongly half of the time.
      bool is_even = true;
      for (std::size_t i = 1; i < n; ++i)
        for (std::size_t k = i; k > 0; --k)
          {
            const unsigned int lower = std::min(numbers[k - 1], numbers[k]),
                               upper = std::max(numbers[k - 1], numbers[k]);
            is_even ^= numbers[k] < numbers[k - 1];
            numbers[k - 1] = lower;
            numbers[k]     = upper;
          }
      return is_even;
    }

    /// Sorts the cells by their highest node number, then by the others; a cell's highest node is among its last two.
    template <int dim>
    void sort_by_highest_node(std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::size_t n_nodes)
    {
      const auto highest = [](const typename SimplexMesh<dim>::Cell &cell) {
        return std::max(cell[dim - 1], cell[dim]);
      };
      std::vector<unsigned int> start(n_nodes + 1, 0);
      for (const auto &cell : cells)
        ++start[highest(cell) + 1];
      std::partial_sum(start.begin(), start.end(), start.begin());
      std::vector<typename SimplexMesh<dim>::Cell> sorted(cells.size());
      for (const auto &cell : cells)
        sorted[start[highest(cell)]++] = cell;
      // Now start[i] is the end of the cells of node i, which are few.
      const auto is_lower = [](const typename SimplexMesh<dim>::Cell &one, const typename SimplexMesh<dim>::Cell &two) {
        return one[0] != two[0] ? one[0] < two[0] : one < two;
      };
      for (std::size_t i = 0; i < n_nodes; ++i)
        for (unsigned int begin = i == 0 ? 0 : start[i - 1], c = begin + 1; c < start[i]; ++c)
          {
            const typename SimplexMesh<dim>::Cell cell = sorted[c];
            unsigned int                          k    = c;
            for (; k > begin && is_lower(cell, sorted[k - 1]); --k)
              sorted[k] = sorted[k - 1];
            sorted[k] = cell;
          }
      cells.swap(sorted);
    }

    /// Whether the circumradius of a cell is smaller than a length, without roots and divisions. False can also mean
    /// that round-off matters.
    template <int dim>
    bool has_surely_smaller_circumradius(const Simplex<dim> &x, const double length)
    {
      // With the edges e_a from the first corner and D their determinant, R = |n| / (2 D) in 3D (see circumradius());
      // in 2D the product of all three edges over 2 D.
      double determinant, square_of_n, product = 1; // of the squares of the edges from the first corner
      if constexpr (dim == 2)
        {
          const Vec<2> e = x[1] - x[0], f = x[2] - x[0];
          determinant = e[0] * f[1] - e[1] * f[0];
          product     = dot(e, e) * dot(f, f);
          square_of_n = product * dot(f - e, f - e);
        }
      else
        {
          const Vec<3> e = x[1] - x[0], f = x[2] - x[0], g = x[3] - x[0], fg = cross(f, g);
          const Vec<3> n = fg * dot(e, e) + cross(g, e) * dot(f, f) + cross(e, f) * dot(g, g);
          determinant    = dot(e, fg);
          product        = dot(e, e) * dot(f, f) * dot(g, g);
          square_of_n    = dot(n, n);
        }
      const double square = determinant * determinant;
      return square > 1e-10 * product && square_of_n < (1 - 1e-9) * 4 * square * length * length;
    }
  } // namespace


  template <int dim>
  SimplexMesh<dim> alpha_shape(
    const DelaunayMesh<dim> &triangulation, const double largest_circumradius,
    const std::function<bool(const typename SimplexMesh<dim>::Cell &)>         &keep,
    const std::function<bool(const typename SimplexMesh<dim>::Cell &, double)> &is_small_anyway,
    std::vector<typename SimplexMesh<dim>::Cell>                               *gaps)
  {
    const auto                     &linked   = triangulation.cells();
    const std::vector<Vec<dim>>    &position = triangulation.position();
    SimplexMesh<dim>                mesh;
    std::vector<char>               is_fluid(linked.size(), 0);
    typename SimplexMesh<dim>::Cell cell;
    mesh.cells.reserve(linked.size());
    for (std::size_t c = 0; c < linked.size(); ++c)
      {
        // The circumradius is computed on the sorted tuple, so that it does not depend on how the cell was found.
        cell               = linked[c].node;
        const bool is_even = sort_evenly(cell);
        if (cell[dim] >= triangulation.n_nodes())
          continue;
        const Simplex<dim> x        = corners<dim>(position, cell);
        bool               is_small = has_surely_smaller_circumradius<dim>(x, largest_circumradius);
        if (!is_even)
          std::swap(cell[dim - 1], cell[dim]);
        if (!is_small)
          {
            const double radius = circumradius(x);
            is_small            = radius <= largest_circumradius || (is_small_anyway && is_small_anyway(cell, radius));
          }
        if (is_small && keep(cell))
          {
            is_fluid[c] = 1;
            mesh.cells.push_back(cell);
          }
      }

    const auto is_outside = [&](const unsigned int c) {
      return c == no_cell || !is_fluid[c];
    };
    for (std::size_t c = 0; c < linked.size(); ++c)
      {
        for (int a = 0; a <= dim && is_fluid[c]; ++a)
          if (is_outside(linked[c].neighbor[a]))
            {
              auto facet = outward_facet<dim>(linked[c].node, a);
              if (!sort_evenly(facet))
                std::swap(facet[dim - 2], facet[dim - 1]);
              mesh.boundary.push_back(facet);
            }
        if (gaps && !is_fluid[c] && linked[c].node[0] != linked[c].node[1]) // not an unused one
          gaps->push_back(linked[c].node);
      }
    std::sort(mesh.boundary.begin(), mesh.boundary.end());
    sort_by_highest_node<dim>(mesh.cells, triangulation.n_nodes());
    return mesh;
  }

  template <int dim>
  void order_cells(std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::size_t n_nodes)
  {
    for (auto &cell : cells)
      if (!sort_evenly(cell))
        std::swap(cell[dim - 1], cell[dim]);
    sort_by_highest_node<dim>(cells, n_nodes);
  }

  template SimplexMesh<2> alpha_shape<2>(const DelaunayMesh<2> &, double,
                                         const std::function<bool(const SimplexMesh<2>::Cell &)> &,
                                         const std::function<bool(const SimplexMesh<2>::Cell &, double)> &,
                                         std::vector<SimplexMesh<2>::Cell> *);
  template SimplexMesh<3> alpha_shape<3>(const DelaunayMesh<3> &, double,
                                         const std::function<bool(const SimplexMesh<3>::Cell &)> &,
                                         const std::function<bool(const SimplexMesh<3>::Cell &, double)> &,
                                         std::vector<SimplexMesh<3>::Cell> *);
  template void           order_cells<2>(std::vector<SimplexMesh<2>::Cell> &, std::size_t);
  template void           order_cells<3>(std::vector<SimplexMesh<3>::Cell> &, std::size_t);
} // namespace Breakwater
