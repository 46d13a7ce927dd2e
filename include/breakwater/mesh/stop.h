#pragma once

#include <breakwater/base/vec.h>

namespace Breakwater
{
  /// A plane that nodes can't cross: they stay on the side to which the normal points.
  template <int dim>
  struct Stop
  {
    Vec<dim> place;  ///< a point of the plane [m]
    Vec<dim> normal; ///< unit length
  };
} // namespace Breakwater
