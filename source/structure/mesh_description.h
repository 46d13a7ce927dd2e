#pragma once

#include <breakwater/mesh/stop.h>

#include <array>
#include <string>
#include <vector>

namespace Breakwater
{
  /// A box of equal cells along the axes.
  template <int dim>
  struct BoxMesh
  {
    Vec<dim>                      lower, upper; ///< opposite corners [m]
    std::array<unsigned int, dim> n_cells;
  };

  /// Reads "box(x0, y0, z0; x1, y1, z1; nx, ny, nz)", in 2D with two numbers in each part.
  /// @throws InputError that says what is wrong with the text and what is expected
  template <int dim>
  BoxMesh<dim> parse_box_mesh(const std::string &text);

  /// Reads planes "x, y, z; nx, ny, nz", in 2D with two numbers in each part, separated by vertical bars.
  /// @throws InputError that says what is wrong with the text and what is expected
  template <int dim>
  std::vector<Stop<dim>> parse_stops(const std::string &text);

  /// Names of the boundaries of a box in the order of their numbers: left, right, bottom, top, front, back are the
  /// sides at the smallest and the largest x, y and z.
  template <int dim>
  std::vector<std::string> boundary_names();

  /// Marks the named boundaries. The order of the result is that of boundary_names().
  /// @throws InputError with the known names if a name is unknown or stands twice
  template <int dim>
  std::array<bool, 2 * dim> parse_boundaries(const std::vector<std::string> &names);
} // namespace Breakwater
