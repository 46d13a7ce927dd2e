#include "gaps.h"

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  template <int dim>
  Gaps<dim>::Gaps(const std::vector<Cell> &cells_around, const std::size_t n_nodes, const std::size_t n_interface)
  {
    for (Cell cell : cells_around)
      {
        const unsigned int lowest = *std::min_element(cell.begin(), cell.end());
        for (unsigned int &i : cell)
          if (i >= n_nodes)
            i = lowest;
        if (*std::max_element(cell.begin(), cell.end()) >= std::max<std::size_t>(n_interface, lowest + 1))
          cells.push_back(cell);
      }
  }


  template <int dim>
  double Gaps<dim>::closure(const std::vector<Quad> &position, const std::vector<Quad> &position_before,
                            const double spacing) const
  {
    const double square_of_spacing = spacing * spacing;
    double       largest = 0, over = 1; // squares
    for (const Cell &cell : cells)
      for (int a = 1; a <= dim; ++a)
        for (int b = 0; b < a; ++b)
          {
            double motion = 0, distance = 0; // squares
            for (int d = 0; d < dim; ++d)
              {
                const double before = position_before[cell[a]][d] - position_before[cell[b]][d];
                const double change = position[cell[a]][d] - position[cell[b]][d] - before;
                distance += before * before;
                motion += change * change;
              }
            const double allowed = std::max(square_of_spacing, 0.25 * distance);
            if (motion * over > largest * allowed)
              {
                largest = motion;
                over    = allowed;
              }
          }
    return std::sqrt(largest / over);
  }

  template class Gaps<2>;
  template class Gaps<3>;
} // namespace Breakwater
