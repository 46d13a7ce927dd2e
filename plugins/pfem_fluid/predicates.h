#pragma once

#include "delaunay.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  /// The predicates of a Delaunay triangulation for one cell: exact, and fast where double precision is enough.
  ///
  /// With b, c, d the edges from the first corner, e = q - x_0, D = det(b, c, d) and
  /// n = |b|^2 c x d + |c|^2 d x b + |d|^2 b x c, a point q lies in the circumsphere of a positive cell when
  ///   D |e|^2 - n . e < 0.
  /// Every term is a product of differences of coordinates. With M_k the largest difference in coordinate k and S the
  /// largest square of a length, all terms together are at most 24 prod_k M_k S (2D: 6), each with at most 18 rounding
  /// errors (2D: 14) of 2^-53: below 4.8e-14 (2D: 1e-14) times the product. Doubled, that is the first filter. The
  /// second takes the sum of the terms' absolute values, for cells with one far corner. What passes neither is computed
  /// exactly.
  template <int dim>
  class Circumsphere
  {
  public:
    explicit Circumsphere(const Simplex<dim> &x)
      : x_(x)
    {
      Vec<dim> e[dim];
      for (int a = 0; a < dim; ++a)
        e[a] = x[a + 1] - x[0];
      double s[dim];
      for (int a = 0; a < dim; ++a)
        {
          s[a]    = dot(e[a], e[a]);
          square_ = std::max(square_, s[a]);
          for (int d = 0; d < dim; ++d)
            largest_[d] = std::max(largest_[d], std::abs(e[a][d]));
        }
      if constexpr (dim == 2)
        {
          determinant_ = e[0][0] * e[1][1] - e[0][1] * e[1][0];
          normal_      = {{s[0] * e[1][1] - s[1] * e[0][1], s[1] * e[0][0] - s[0] * e[1][0]}};
        }
      else
        {
          const Vec<3> area = cross(e[1], e[2]);
          determinant_      = dot(e[0], area);
          normal_           = s[0] * area + s[1] * cross(e[2], e[0]) + s[2] * cross(e[0], e[1]);
        }
    }

    /// Whether the cell is positively oriented. False can also mean that the filter can't tell.
    bool is_surely_positive() const
    {
      double bound = dim == 2 ? 1e-15 : 6e-15;
      for (int d = 0; d < dim; ++d)
        bound *= largest_[d];
      return determinant_ > bound;
    }

    /// Whether a point is outside of the circumsphere, if the cell is positive. False can also mean that the filter
    /// can't tell.
    bool is_surely_outside(const Vec<dim> &q) const
    {
      double bound;
      return side(q, bound) > bound;
    }

    /// Sign of the orientation, exact.
    int orientation() const
    {
      if (is_surely_positive())
        return 1;
      const double bound = (dim == 2 ? 1e-15 : 2e-15) * permanent();
      if (std::abs(determinant_) > bound)
        return determinant_ > 0 ? 1 : -1;
      return exact_orientation<dim>(x_);
    }

    /// Whether a point lies in the circumsphere of a positive cell, exact; see exact_in_sphere().
    bool contains(const Vec<dim> &q) const
    {
      double       bound;
      const double value = side(q, bound);
      if (std::abs(value) > bound)
        return value < 0;
      if (std::abs(value) > 1e-14 * permanent(q))
        return value < 0;
      return exact_in_sphere<dim>(x_, q);
    }

  private:
    double side(const Vec<dim> &q, double &bound) const
    {
      const Vec<dim> e      = q - x_[0];
      const double   square = dot(e, e);
      bound                 = (dim == 2 ? 2e-14 : 1e-13) * std::max(square_, square);
      for (int d = 0; d < dim; ++d)
        bound *= std::max(largest_[d], std::abs(e[d]));
      return determinant_ * square - dot(normal_, e);
    }

    static double sum_of_products(const Vec<dim> &a, const Vec<dim> &b, const int k)
    {
      if constexpr (dim == 2)
        return std::abs(a[1 - k]); // of the minor without column k; b takes no part
      else
        return std::abs(a[(k + 1) % 3] * b[(k + 2) % 3]) + std::abs(a[(k + 2) % 3] * b[(k + 1) % 3]);
    }

    /// Sum of the absolute values of the determinant's terms.
    double permanent() const
    {
      double         sum = 0;
      const Vec<dim> b = x_[1] - x_[0], c = x_[2] - x_[0], d = x_[dim] - x_[0];
      for (int k = 0; k < dim; ++k)
        sum += std::abs(b[k]) * sum_of_products(c, d, k);
      return sum;
    }

    /// Sum of the absolute values of the terms of D |e|^2 - n . e.
    double permanent(const Vec<dim> &q) const
    {
      const Vec<dim> e = q - x_[0], b = x_[1] - x_[0], c = x_[2] - x_[0], d = x_[dim] - x_[0];
      double         sum = dot(e, e) * permanent();
      for (int k = 0; k < dim; ++k)
        {
          double minors = dot(b, b) * sum_of_products(c, d, k);
          if constexpr (dim == 2)
            minors += dot(c, c) * sum_of_products(b, d, k);
          else
            minors += dot(c, c) * sum_of_products(d, b, k) + dot(d, d) * sum_of_products(b, c, k);
          sum += std::abs(e[k]) * minors;
        }
      return sum;
    }

    Simplex<dim> x_;
    Vec<dim>     normal_;
    double       determinant_ = 0;
    Vec<dim>     largest_;    ///< of the differences to the first corner, by coordinate
    double       square_ = 0; ///< largest, of an edge from the first corner
  };
} // namespace Breakwater
