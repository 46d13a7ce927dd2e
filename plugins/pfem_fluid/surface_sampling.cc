#include "surface_sampling.h"

#include "polygon.h"

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// The length of a curve in units of `unit` times the local spacing, up to each of a number of parameters.
    template <int dim>
    std::vector<double> lengths_along(const Curve<dim> &curve, const SizeField<dim> &size, const double unit)
    {
      double coarse = 0;
      for (int i = 0; i < 16; ++i)
        coarse += norm(curve((i + 1) / 16.) - curve(i / 16.));
      const auto          n = static_cast<unsigned int>(std::min(1e5, 64 + 8 * coarse / size.smallest()));
      std::vector<double> length(n + 1, 0.);
      Vec<dim>            last = curve(0);
      for (unsigned int i = 1; i <= n; ++i)
        {
          const Vec<dim> next = curve(static_cast<double>(i) / n);
          length[i]           = length[i - 1] + norm(next - last) / (unit * size((last + next) * 0.5));
          last                = next;
        }
      return length;
    }

    /// The parameter at which a curve has a given length.
    double parameter_at(const std::vector<double> &length, const double wanted)
    {
      const auto next = std::upper_bound(length.begin(), length.end(), wanted);
      if (next == length.end())
        return 1;
      const auto   i    = next - length.begin() - 1;
      const double part = (wanted - length[i]) / (length[i + 1] - length[i]);
      return (i + part) / (length.size() - 1.);
    }
  } // namespace


  template <int dim>
  std::vector<Vec<dim>> sample_open_curve(const Curve<dim> &curve, const SizeField<dim> &size)
  {
    const std::vector<double> length = lengths_along(curve, size, surface_spacing);
    const long                n      = std::max(1l, std::lround(length.back()));
    std::vector<Vec<dim>>     places = {curve(0)};
    for (long i = 1; i < n; ++i)
      places.push_back(curve(parameter_at(length, i * length.back() / n)));
    places.push_back(curve(1));
    return places;
  }


  template <int dim>
  std::vector<Vec<dim>> sample_closed_curve(const Curve<dim> &curve, const SizeField<dim> &size, const double phase)
  {
    const std::vector<double> length = lengths_along(curve, size, surface_spacing);
    const long                n      = std::max(3l, std::lround(length.back()));
    std::vector<Vec<dim>>     places;
    for (long i = 0; i < n; ++i)
      places.push_back(curve(parameter_at(length, (i + phase) * length.back() / n)));
    return places;
  }


  template <int dim>
  std::vector<double> sample_rows(const Curve<dim> &curve, const SizeField<dim> &size, const double first)
  {
    const std::vector<double> length = lengths_along(curve, size, surface_row_spacing);
    const long                n      = std::max(1l, std::lround(length.back()));
    std::vector<double>       rows;
    for (long k = 0; k + first < n; ++k)
      rows.push_back(parameter_at(length, (k + first) * length.back() / n));
    return rows;
  }


  Curve<3> circle(const Vec<3> &center, const Vec<3> &e1, const Vec<3> &e2, const double radius)
  {
    return [=](const double t) {
      const double angle = 2 * 3.14159265358979323846 * t;
      return center + e1 * (radius * std::cos(angle)) + e2 * (radius * std::sin(angle));
    };
  }


  void sample_disc(const Vec<3> &center, const Vec<3> &e1, const Vec<3> &e2, const double radius,
                   const SizeField<3> &size, std::vector<Vec<3>> &on_rim, std::vector<Vec<3>> &inside)
  {
    on_rim          = sample_closed_curve(circle(center, e1, e2, radius), size);
    const auto rows = sample_rows(segment(center + e1 * radius, center), size, 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        const auto ring =
          sample_closed_curve(circle(center, e1, e2, radius * (1 - rows[k])), size, 0.5 * ((k + 1) % 2));
        inside.insert(inside.end(), ring.begin(), ring.end());
      }
    inside.push_back(center);
  }


  void make_frame(const Vec<3> &normal, Vec<3> &e1, Vec<3> &e2)
  {
    Vec<3> other;
    other[std::abs(normal[2]) < 0.9 ? 2 : 0] = 1;
    e1                                       = cross(other, normal);
    e1 *= 1 / norm(e1);
    e2 = cross(normal, e1);
  }


  void sample_polygon(const std::vector<Vec<3>> &vertices, const SizeField<3> &size, std::vector<Vec<3>> &on_edges,
                      std::vector<Vec<3>> &in_face)
  {
    const std::size_t n = vertices.size();
    Vec<3>            normal, along;
    for (std::size_t i = 0; i < n; ++i)
      {
        const Vec<3> &a = vertices[i], &b = vertices[(i + 1) % n];
        const auto    places = sample_open_curve(segment(a, b), size);
        on_edges.insert(on_edges.end(), places.begin(), places.end());
        normal += cross(a - vertices[0], b - vertices[0]);
        if (norm(b - a) > norm(along))
          along = b - a;
      }
    const Vec<3> e1 = along * (1 / norm(along)), e2 = cross(normal * (1 / norm(normal)), e1);

    Polygon polygon;
    Vec<2>  lower, upper;
    for (const Vec<3> &vertex : vertices)
      {
        polygon.vertices.push_back({{dot(vertex - vertices[0], e1), dot(vertex - vertices[0], e2)}});
        for (int d = 0; d < 2; ++d)
          {
            lower[d] = std::min(lower[d], polygon.vertices.back()[d]);
            upper[d] = std::max(upper[d], polygon.vertices.back()[d]);
          }
      }
    const auto place = [&](const double u, const double v) {
      return vertices[0] + e1 * u + e2 * v;
    };
    // Each row as close to the last as the finest place of that row asks for.
    bool   is_odd = false;
    double v      = lower[1];
    while (true)
      {
        double finest = size.largest();
        for (int i = 0; i <= 32; ++i)
          finest = std::min(finest, size(place(lower[0] + (upper[0] - lower[0]) * i / 32, v)));
        v += surface_row_spacing * finest;
        is_odd = !is_odd;
        if (v >= upper[1])
          break;
        double u = lower[0] + (is_odd ? 0.5 : 1.) * surface_spacing * size(place(lower[0], v));
        while (u < upper[0])
          {
            const double h = size(place(u, v));
            if (polygon.distance({{u, v}}) < -0.55 * surface_spacing * h)
              in_face.push_back(place(u, v));
            u += surface_spacing * h;
          }
      }
  }

  template std::vector<Vec<2>> sample_open_curve<2>(const Curve<2> &, const SizeField<2> &);
  template std::vector<Vec<3>> sample_open_curve<3>(const Curve<3> &, const SizeField<3> &);
  template std::vector<Vec<2>> sample_closed_curve<2>(const Curve<2> &, const SizeField<2> &, double);
  template std::vector<Vec<3>> sample_closed_curve<3>(const Curve<3> &, const SizeField<3> &, double);
  template std::vector<double> sample_rows<3>(const Curve<3> &, const SizeField<3> &, double);
} // namespace Breakwater
