#pragma once

#include <breakwater/mesh/output_mesh.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// The text of a VTU file (VTK's XML format for unstructured grids, version 0.1): single precision, each array
  /// compressed by zlib and in base64. Only nodes that cells have are in it, each once.
  /// @param cells of nodes of the mesh [cell][vertex], instead of its own
  /// @param vertices_per_cell as in OutputMesh
  /// @param time [s]
  template <int dim>
  std::string vtu_text(const OutputMesh<dim> &mesh, const std::vector<unsigned int> &cells,
                       unsigned int vertices_per_cell, double time);
} // namespace Breakwater
