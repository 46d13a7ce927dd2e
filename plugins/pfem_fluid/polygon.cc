#include "polygon.h"

#include <algorithm>
#include <limits>

namespace Breakwater
{
  namespace
  {
    /// Twice the area of a triangle, positive if a, b, c run counterclockwise.
    double turn(const Vec<2> &a, const Vec<2> &b, const Vec<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    double distance_to_segment(const Vec<2> &x, const Vec<2> &a, const Vec<2> &b)
    {
      const Vec<2> edge = b - a;
      const double t    = std::clamp(dot(x - a, edge) / dot(edge, edge), 0., 1.);
      return norm(x - a - edge * t);
    }

    bool touch(const Vec<2> &a, const Vec<2> &b, const Vec<2> &c, const Vec<2> &d)
    {
      return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0 &&
             std::max(a[0], b[0]) >= std::min(c[0], d[0]) && std::max(c[0], d[0]) >= std::min(a[0], b[0]) &&
             std::max(a[1], b[1]) >= std::min(c[1], d[1]) && std::max(c[1], d[1]) >= std::min(a[1], b[1]);
    }
  } // namespace


  double Polygon::distance(const Vec<2> &x) const
  {
    double nearest   = std::numeric_limits<double>::infinity();
    bool   is_inside = false;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      {
        const Vec<2> &a = vertices[i], &b = vertices[(i + 1) % vertices.size()];
        nearest = std::min(nearest, distance_to_segment(x, a, b));
        // A ray to the right: it leaves the polygon through an odd number of edges if it starts inside.
        if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]))
          is_inside = !is_inside;
      }
    return is_inside ? -nearest : nearest;
  }


  double Polygon::area() const
  {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
      sum += 0.5 * turn(vertices[0], vertices[i], vertices[i + 1]);
    return sum;
  }


  bool Polygon::crosses_itself() const
  {
    const std::size_t n = vertices.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
        if (!(i == 0 && j == n - 1) && touch(vertices[i], vertices[i + 1], vertices[j], vertices[(j + 1) % n]))
          return true;
    return false;
  }
} // namespace Breakwater
