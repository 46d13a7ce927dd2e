#pragma once

#include "shapes.h"

#include <vector>

namespace Breakwater
{
  /// The lattice that nodes of uniform spacing are put on at time 0.
  struct Lattice
  {
    bool         body_centred = true; ///< or cubic
    double       jitter       = 0.15; ///< largest random displacement in each coordinate, in units of the spacing
    unsigned int seed         = 1;    ///< of the random numbers
  };

  /// Places of the nodes that fill a box: a lattice whose corner nodes lie on the box, so that the mesh fills it
  /// exactly, jittered (along the faces only where a node lies on them) because a perfect lattice makes slivers.
  /// @param spacing h [m]: two nodes per cube of side 2^(1/dim) h, or one per cube of side h
  template <int dim>
  std::vector<Vec<dim>> fill_box(const BoxShape<dim> &box, const Lattice &lattice, double spacing);
} // namespace Breakwater
