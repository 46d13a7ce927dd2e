#pragma once

#include <breakwater/base/vec.h>

#include <algorithm>
#include <limits>

namespace Breakwater
{
  /// Weights of the place of a segment or triangle nearest to x.
  template <int dim>
  void nearest_weights(const Vec<dim> *corner, const Vec<dim> &x, double *weights)
  {
    const auto on_segment = [&](const int i, const int j) {
      const Vec<dim> e = corner[j] - corner[i];
      return std::clamp(dot(x - corner[i], e) / dot(e, e), 0., 1.);
    };
    if constexpr (dim == 2)
      {
        weights[1] = on_segment(0, 1);
        weights[0] = 1 - weights[1];
      }
    else
      {
        const Vec<3> e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], r = x - corner[0];
        const double g11 = dot(e1, e1), g12 = dot(e1, e2), g22 = dot(e2, e2), r1 = dot(r, e1), r2 = dot(r, e2);
        const double determinant = g11 * g22 - g12 * g12;
        weights[1]               = (g22 * r1 - g12 * r2) / determinant;
        weights[2]               = (g11 * r2 - g12 * r1) / determinant;
        weights[0]               = 1 - weights[1] - weights[2];
        if (weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0)
          return;
        // Outside the triangle: the nearest of the three sides.
        double best = std::numeric_limits<double>::infinity();
        double result[3];
        for (int i = 0; i < 3; ++i)
          {
            const int    j     = (i + 1) % 3;
            const double t     = on_segment(i, j);
            const Vec<3> delta = x - (corner[i] * (1 - t) + corner[j] * t);
            if (dot(delta, delta) < best)
              {
                best              = dot(delta, delta);
                result[i]         = 1 - t;
                result[j]         = t;
                result[3 - i - j] = 0;
              }
          }
        std::copy_n(result, 3, weights);
      }
  }
} // namespace Breakwater
