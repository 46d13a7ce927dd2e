#pragma once

#include <breakwater/base/vec.h>

#include <vector>

namespace Breakwater
{
  /// A closed polygon in the plane, simple but not necessarily convex.
  struct Polygon
  {
    std::vector<Vec<2>> vertices; ///< [m], in either sense of rotation

    /// Distance of a place to the polygon's edges [m], negative inside.
    double distance(const Vec<2> &x) const;

    /// Signed area [m^2], positive if the vertices run counterclockwise.
    double area() const;

    /// True if two edges that are no neighbours touch.
    bool crosses_itself() const;
  };
} // namespace Breakwater
