#include "gaps.h"

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// How two nodes have moved against each other, and may do so [m^2].
    struct SquaredMotion
    {
      double square, allowed;
    };

    template <int dim>
    SquaredMotion squared_motion(const unsigned int i, const unsigned int j, const std::vector<Quad> &position,
                                 const std::vector<Quad> &position_before, const double square_of_spacing)
    {
      double motion = 0, distance = 0;
      for (int d = 0; d < dim; ++d)
        {
          const double before = position_before[i][d] - position_before[j][d];
          const double change = position[i][d] - position[j][d] - before;
          distance += before * before;
          motion += change * change;
        }
      return {motion, std::max(square_of_spacing, 0.25 * distance)};
    }
  } // namespace


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
    SquaredMotion largest = {0, 1};
    for (const Cell &cell : cells)
      for (int a = 1; a <= dim; ++a)
        for (int b = 0; b < a; ++b)
          {
            const auto motion = squared_motion<dim>(cell[a], cell[b], position, position_before, spacing * spacing);
            if (motion.square * largest.allowed > largest.square * motion.allowed)
              largest = motion;
          }
    return std::sqrt(largest.square / largest.allowed);
  }


  template <int dim>
  std::size_t Gaps<dim>::n_closing(const std::vector<Quad> &position, const std::vector<Quad> &position_before,
                                   const double spacing) const
  {
    return std::count_if(cells.begin(), cells.end(), [&](const Cell &cell) {
      for (int a = 1; a <= dim; ++a)
        for (int b = 0; b < a; ++b)
          {
            const auto motion = squared_motion<dim>(cell[a], cell[b], position, position_before, spacing * spacing);
            if (motion.square > motion.allowed)
              return true;
          }
      return false;
    });
  }

  template class Gaps<2>;
  template class Gaps<3>;
} // namespace Breakwater
