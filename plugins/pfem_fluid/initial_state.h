#pragma once

#include "pfem_parameters.h"

#include <vector>

namespace Breakwater
{
  /// Places of the nodes that fill a box: a body-centred lattice whose corner nodes lie on the box, so that the mesh
  /// fills it exactly, jittered (along the faces only where a node lies on them) because a perfect lattice makes
  /// slivers. @param spacing h [m]: two nodes per cube of side 2^(1/dim) h
  template <int dim>
  std::vector<Vec<dim>> fill_box(const InitialState<dim> &state, double spacing);
} // namespace Breakwater
