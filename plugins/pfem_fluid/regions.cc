#include "regions.h"

#include "surface_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Breakwater
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /// Distance of a body that is bounded by a in some directions and b in the others, from the distances to both.
    double distance_to_both(const double a, const double b)
    {
      return std::hypot(std::max(a, 0.), std::max(b, 0.)) + std::min(std::max(a, b), 0.);
    }

    void append(std::vector<Vec<2>> &to, const std::vector<Vec<2>> &from)
    {
      to.insert(to.end(), from.begin(), from.end());
    }
    void append(std::vector<Vec<3>> &to, const std::vector<Vec<3>> &from)
    {
      to.insert(to.end(), from.begin(), from.end());
    }

    /// The polygon's edges and corners.
    void sample_outline(const Polygon &polygon, const SizeField<2> &size, NodeCandidates<2> &nodes)
    {
      append(nodes.sharp, polygon.vertices);
      for (std::size_t i = 0; i < polygon.vertices.size(); ++i)
        append(
          nodes.smooth,
          sample_open_curve(segment(polygon.vertices[i], polygon.vertices[(i + 1) % polygon.vertices.size()]), size));
    }

    /// How far nodes stand outside of a curved surface so that the chords between them enclose its volume.
    double outset(const double radius, const double spacing, const double factor)
    {
      const double side = surface_spacing * spacing;
      return std::min(factor * side * side / radius, 0.1 * spacing);
    }

    /// The corners of the faces of a box.
    std::vector<std::vector<Vec<3>>> faces_of(const BoxShape<3> &box)
    {
      std::vector<std::vector<Vec<3>>> faces;
      for (int d = 0; d < 3; ++d)
        for (const bool is_upper : {false, true})
          {
            std::vector<Vec<3>> face(4, is_upper ? box.upper : box.lower);
            const int           e = (d + 1) % 3, f = (d + 2) % 3;
            for (int corner = 0; corner < 4; ++corner)
              {
                face[corner][e] = corner == 1 || corner == 2 ? box.upper[e] : box.lower[e];
                face[corner][f] = corner >= 2 ? box.upper[f] : box.lower[f];
              }
            faces.push_back(face);
          }
      return faces;
    }
  } // namespace


  template <int dim>
  void SurfaceRegion<dim>::add_nodes(const SizeField<dim> &size, const Lattice &lattice,
                                     NodeCandidates<dim> &nodes) const
  {
    add_surface(size, nodes);
    if (size.is_uniform())
      append(nodes.interior, fill_box(this->extent(), lattice, size.smallest()));
  }


  template <int dim>
  double BoxRegion<dim>::distance(const Vec<dim> &x) const
  {
    Vec<dim> outside;
    double   largest = -std::numeric_limits<double>::infinity();
    for (int d = 0; d < dim; ++d)
      {
        const double beyond = std::max(box_.lower[d] - x[d], x[d] - box_.upper[d]);
        outside[d]          = std::max(beyond, 0.);
        largest             = std::max(largest, beyond);
      }
    return norm(outside) + std::min(largest, 0.);
  }


  template <int dim>
  void BoxRegion<dim>::add_nodes(const SizeField<dim> &size, const Lattice &lattice, NodeCandidates<dim> &nodes) const
  {
    if (!size.is_uniform())
      {
        add_surface(size, nodes);
        return;
      }
    for (const Vec<dim> &x : fill_box(box_, lattice, size.smallest()))
      {
        int n_faces = 0;
        for (int d = 0; d < dim; ++d)
          n_faces += x[d] == box_.lower[d] || x[d] == box_.upper[d];
        (n_faces == 0 ? nodes.interior : n_faces == 1 ? nodes.smooth : nodes.sharp).push_back(x);
      }
  }


  template <int dim>
  void BoxRegion<dim>::add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const
  {
    if constexpr (dim == 2)
      {
        const Vec<2> &a = box_.lower, &b = box_.upper;
        sample_outline({{a, {{b[0], a[1]}}, b, {{a[0], b[1]}}}}, size, nodes);
      }
    else
      for (const auto &face : faces_of(box_))
        sample_polygon(face, size, nodes.sharp, nodes.smooth);
  }


  template <int dim>
  Ellipsoid<dim>::Ellipsoid(const Vec<dim> &center, const Vec<dim> &half_axes)
    : center_(center)
    , half_axes_(half_axes)
  {
  }


  template <int dim>
  double Ellipsoid<dim>::distance(const Vec<dim> &x) const
  {
    // With q = |x / r| and the gradient of q^2 / 2, the distance is (q - 1) q / |gradient| to first order close to the
    // surface, and exactly that of a sphere.
    Vec<dim> scaled, gradient;
    for (int d = 0; d < dim; ++d)
      {
        scaled[d]   = (x[d] - center_[d]) / half_axes_[d];
        gradient[d] = scaled[d] / half_axes_[d];
      }
    const double q = norm(scaled);
    return q > 0 ? (q - 1) * q / norm(gradient) : -*std::min_element(half_axes_.c, half_axes_.c + dim);
  }


  template <int dim>
  BoxShape<dim> Ellipsoid<dim>::extent() const
  {
    return {"box", center_ - half_axes_, center_ + half_axes_};
  }


  template <int dim>
  void Ellipsoid<dim>::add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const
  {
    double mean_radius = 1;
    for (int d = 0; d < dim; ++d)
      mean_radius *= std::pow(half_axes_[d], 1. / dim);
    const double scale = 1 + outset(mean_radius, size(center_), dim == 2 ? 1. / 12 : 1. / 8) / mean_radius;
    const auto   place = [&](const Vec<dim> &direction) {
      Vec<dim> x = center_;
      for (int d = 0; d < dim; ++d)
        x[d] += scale * half_axes_[d] * direction[d];
      return x;
    };
    if constexpr (dim == 2)
      append(nodes.smooth, sample_closed_curve<2>(
                             [&](const double t) {
                               return place({{std::cos(2 * pi * t), std::sin(2 * pi * t)}});
                             },
                             size));
    else
      {
        // Rings around the z axis, half a distance from the poles, equally spaced along the longer meridian.
        const bool     x_is_longer = half_axes_[0] > half_axes_[1];
        const Curve<3> meridian    = [&](const double t) {
          const double s = std::sin(pi * t);
          return place({{x_is_longer ? s : 0., x_is_longer ? 0. : s, std::cos(pi * t)}});
        };
        const auto rings = sample_rows(meridian, size, 0.5);
        for (std::size_t k = 0; k < rings.size(); ++k)
          append(nodes.smooth,
                 sample_closed_curve<3>(
                   [&](const double t) {
                     const double s = std::sin(pi * rings[k]);
                     return place({{s * std::cos(2 * pi * t), s * std::sin(2 * pi * t), std::cos(pi * rings[k])}});
                   },
                   size, 0.5 * (k % 2)));
      }
  }


  template <int dim>
  double Prism<dim>::distance(const Vec<dim> &x) const
  {
    const double in_plane = polygon_.distance({{x[0], x[1]}});
    if constexpr (dim == 2)
      return in_plane;
    else
      return distance_to_both(in_plane, std::max(z_[0] - x[2], x[2] - z_[1]));
  }


  template <int dim>
  BoxShape<dim> Prism<dim>::extent() const
  {
    BoxShape<dim> box;
    box.kind = "box";
    for (int d = 0; d < 2; ++d)
      {
        const auto less = [d](const Vec<2> &a, const Vec<2> &b) {
          return a[d] < b[d];
        };
        const auto [lowest, highest] = std::minmax_element(polygon_.vertices.begin(), polygon_.vertices.end(), less);
        box.lower[d]                 = (*lowest)[d];
        box.upper[d]                 = (*highest)[d];
      }
    if constexpr (dim == 3)
      {
        box.lower[2] = z_[0];
        box.upper[2] = z_[1];
      }
    return box;
  }


  template <int dim>
  void Prism<dim>::add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const
  {
    if constexpr (dim == 2)
      sample_outline(polygon_, size, nodes);
    else
      {
        std::vector<Vec<3>> ends[2];
        for (const int end : {0, 1})
          {
            for (const Vec<2> &vertex : polygon_.vertices)
              ends[end].push_back({{vertex[0], vertex[1], z_[end]}});
            sample_polygon(ends[end], size, nodes.sharp, nodes.smooth);
          }
        const std::size_t n = polygon_.vertices.size();
        for (std::size_t i = 0; i < n; ++i)
          sample_polygon({ends[0][i], ends[0][(i + 1) % n], ends[1][(i + 1) % n], ends[1][i]}, size, nodes.sharp,
                         nodes.smooth);
      }
  }


  Cylinder::Cylinder(const Vec<3> &start, const Vec<3> &end, const double radius)
    : start_(start)
    , axis_((end - start) * (1 / norm(end - start)))
    , length_(norm(end - start))
    , radius_(radius)
  {
    make_frame(axis_, e1_, e2_);
  }


  double Cylinder::distance(const Vec<3> &x) const
  {
    const double along = dot(x - start_, axis_);
    return distance_to_both(norm(x - start_ - axis_ * along) - radius_, std::max(-along, along - length_));
  }


  BoxShape<3> Cylinder::extent() const
  {
    BoxShape<3>  box;
    const Vec<3> end = start_ + axis_ * length_;
    box.kind         = "box";
    for (int d = 0; d < 3; ++d)
      {
        const double beyond = radius_ * std::sqrt(std::max(0., 1 - axis_[d] * axis_[d]));
        box.lower[d]        = std::min(start_[d], end[d]) - beyond;
        box.upper[d]        = std::max(start_[d], end[d]) + beyond;
      }
    return box;
  }


  void Cylinder::add_surface(const SizeField<3> &size, NodeCandidates<3> &nodes) const
  {
    const double outer = radius_ + outset(radius_, size(start_ + axis_ * (0.5 * length_)), 1. / 16);
    for (const double along : {0., length_})
      {
        std::vector<Vec<3>> on_rim, inside;
        sample_disc(start_ + axis_ * along, e1_, e2_, outer, size, on_rim, inside);
        append(nodes.sharp, on_rim);
        append(nodes.smooth, inside);
      }
    const auto rows = sample_rows(segment(start_, start_ + axis_ * length_), size, 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      append(nodes.smooth, sample_closed_curve(circle(start_ + axis_ * (length_ * rows[k]), e1_, e2_, outer), size,
                                               0.5 * ((k + 1) % 2)));
  }


  template <int dim>
  std::vector<Vec<dim>> cut(const std::vector<Vec<dim>> &polygon, const Vec<dim> &point, const Vec<dim> &normal)
  {
    std::vector<Vec<dim>> left;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Vec<dim> &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double    beyond_a = dot(a - point, normal), beyond_b = dot(b - point, normal);
        if (beyond_a <= 0)
          left.push_back(a);
        if ((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0))
          left.push_back(a + (b - a) * (beyond_a / (beyond_a - beyond_b)));
      }
    return left.size() >= 3 ? left : std::vector<Vec<dim>>();
  }


  CutBox::CutBox(const BoxShape<3> &box, const Vec<3> &point, const Vec<3> &normal)
  {
    const Vec<3>        n = normal * (1 / norm(normal));
    std::vector<Vec<3>> lid;
    for (int d = 0; d < 3; ++d)
      for (const double sign : {-1., 1.})
        {
          points_.push_back(sign < 0 ? box.lower : box.upper);
          normals_.emplace_back();
          normals_.back()[d] = sign;
        }
    points_.push_back(point);
    normals_.push_back(n);
    const double tolerance = 1e-9 * norm(box.upper - box.lower);
    for (const auto &face : faces_of(box))
      {
        const auto left = cut(face, point, n);
        if (left.empty())
          continue;
        faces_.push_back(left);
        for (const Vec<3> &corner : left)
          if (std::abs(dot(corner - point, n)) < tolerance &&
              std::none_of(lid.begin(), lid.end(), [&](const Vec<3> &x) {
                return norm(x - corner) < tolerance;
              }))
            lid.push_back(corner);
      }
    if (lid.size() < 3)
      return;
    // The lid is convex: its corners in the order of their angles around its center.
    Vec<3> center;
    for (const Vec<3> &x : lid)
      center += x * (1. / lid.size());
    const Vec<3> e1 = (lid[0] - center) * (1 / norm(lid[0] - center)), e2 = cross(n, e1);
    const auto   angle = [&](const Vec<3> &x) {
      return std::atan2(dot(x - center, e2), dot(x - center, e1));
    };
    std::sort(lid.begin(), lid.end(), [&](const Vec<3> &a, const Vec<3> &b) {
      return angle(a) < angle(b);
    });
    faces_.push_back(lid);
  }


  double CutBox::distance(const Vec<3> &x) const
  {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_.size(); ++i)
      largest = std::max(largest, dot(x - points_[i], normals_[i]));
    return largest;
  }


  BoxShape<3> CutBox::extent() const
  {
    BoxShape<3> box;
    box.kind  = "box";
    box.lower = box.upper = faces_.front().front();
    for (const auto &face : faces_)
      for (const Vec<3> &x : face)
        for (int d = 0; d < 3; ++d)
          {
            box.lower[d] = std::min(box.lower[d], x[d]);
            box.upper[d] = std::max(box.upper[d], x[d]);
          }
    return box;
  }


  void CutBox::add_surface(const SizeField<3> &size, NodeCandidates<3> &nodes) const
  {
    for (const auto &face : faces_)
      sample_polygon(face, size, nodes.sharp, nodes.smooth);
  }


  template class SurfaceRegion<2>;
  template class SurfaceRegion<3>;
  template class BoxRegion<2>;
  template class BoxRegion<3>;
  template class Ellipsoid<2>;
  template class Ellipsoid<3>;
  template class Prism<2>;
  template class Prism<3>;
  template std::vector<Vec<2>> cut<2>(const std::vector<Vec<2>> &, const Vec<2> &, const Vec<2> &);
  template std::vector<Vec<3>> cut<3>(const std::vector<Vec<3>> &, const Vec<3> &, const Vec<3> &);
} // namespace Breakwater
