#pragma once

#include <cmath>
#include <cstddef>

namespace Breakwater
{
  /// A vector of dim components in space: position, velocity, force, ... in SI units.
  template <int dim>
  struct Vec
  {
    double c[dim] = {};

    double       &operator[](const std::size_t d) { return c[d]; }
    const double &operator[](const std::size_t d) const { return c[d]; }

    Vec &operator+=(const Vec &other)
    {
      for (int d = 0; d < dim; ++d)
        c[d] += other.c[d];
      return *this;
    }
    Vec &operator-=(const Vec &other)
    {
      for (int d = 0; d < dim; ++d)
        c[d] -= other.c[d];
      return *this;
    }
    Vec &operator*=(const double factor)
    {
      for (int d = 0; d < dim; ++d)
        c[d] *= factor;
      return *this;
    }

    friend Vec operator+(Vec a, const Vec &b) { return a += b; }
    friend Vec operator-(Vec a, const Vec &b) { return a -= b; }
    friend Vec operator*(Vec a, const double factor) { return a *= factor; }
    friend Vec operator*(const double factor, Vec a) { return a *= factor; }
  };

  template <int dim>
  double dot(const Vec<dim> &a, const Vec<dim> &b)
  {
    double sum = 0;
    for (int d = 0; d < dim; ++d)
      sum += a[d] * b[d];
    return sum;
  }

  template <int dim>
  double norm(const Vec<dim> &a)
  {
    return std::sqrt(dot(a, a));
  }

  inline Vec<3> cross(const Vec<3> &a, const Vec<3> &b)
  {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
} // namespace Breakwater
