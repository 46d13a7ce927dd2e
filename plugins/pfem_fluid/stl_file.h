#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <string>
#include <vector>

namespace Breakwater
{
  /// The triangles of an STL file, ASCII or binary, lengths in metres. Its normals are not used: the side of the
  /// fluid says which way they point.
  /// @throws InputError with the file and line if it can't be read, is cut off, or has no triangle
  std::vector<std::array<Vec<3>, 3>> read_stl(const std::string &file);
} // namespace Breakwater
