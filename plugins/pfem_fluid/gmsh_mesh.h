#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <string>
#include <vector>

namespace Breakwater
{
  /// What a gmsh file holds, as far as simplices go; other elements are left out.
  struct GmshMesh
  {
    std::vector<Vec<3>>                      position; ///< of the nodes, in the order of the file [m]
    std::vector<std::array<unsigned int, 2>> lines;
    std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<std::array<unsigned int, 4>> tetrahedra;
  };

  /// Reads a gmsh file of format 2.2 or 4.1 in ASCII (gmsh.info/doc/texinfo, section "MSH file format").
  /// @throws InputError with the line of the file and what is wrong there
  GmshMesh read_gmsh(const std::string &file);
} // namespace Breakwater
