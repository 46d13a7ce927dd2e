#pragma once

#include "wall_surface.h"

#include <breakwater/base/parameter_reader.h>

namespace Breakwater
{
  /// The shape of a wall: planes of infinite extent with the fluid on one side, or a surface of flat pieces.
  template <int dim>
  struct WallShape
  {
    struct Plane
    {
      Vec<dim> place;  ///< a point of it [m]
      Vec<dim> normal; ///< into the fluid, unit length
    };
    std::vector<Plane>    planes;
    std::vector<Vec<dim>> corners; ///< the wall lies in the box around them; none if it has no end
    std::vector<typename WallSurface<dim>::Piece> pieces;
  };

  /// What the entry "Shape" of a wall may hold, for its documentation.
  template <int dim>
  std::string wall_shape_documentation();

  /// Reads the entry "Shape" of a wall; what is wrong with it is reported through ParameterReader::fail().
  /// Boxes with the fluid inside are planes, as `plane` is; all else is a surface.
  template <int dim>
  WallShape<dim> parse_wall_shape(const std::string &text, FluidSide side, const ParameterReader &reader);
} // namespace Breakwater
