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
      for (std::size_t i = 0; i < n_nodes; ++i)
        for (unsigned int begin = i == 0 ? 0 : start[i - 1], c = begin; c < start[i]; ++c)
          for (unsigned int k = c; k > begin && sorted[k] < sorted[k - 1]; --k)
            std::swap(sorted[k], sorted[k - 1]);
      cells.swap(sorted);
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
        const double radius = circumradius(corners<dim>(position, cell));
        if (!is_even)
          std::swap(cell[dim - 1], cell[dim]);
        if ((radius <= largest_circumradius || (is_small_anyway && is_small_anyway(cell, radius))) && keep(cell))
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
