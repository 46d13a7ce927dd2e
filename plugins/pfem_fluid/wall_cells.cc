#include "walls.h"

#include <breakwater/mesh/area_vector.h>

#include <algorithm>
#include <cmath>

// Which cells and facets of the mesh walls allow.

namespace Breakwater
{
  template <int dim>
  Contacts Walls<dim>::faces_at(const Vec<dim> &x, const double tolerance) const
  {
    Contacts contacts;
    for (unsigned int f = 0; f < n_planes_; ++f)
      if (std::abs(distance_now(faces_[f], x)) <= tolerance)
        contacts.add(f);
    for (const Surface &surface : surfaces_)
      for (const unsigned int patch :
           surface.shape.patches_near(walls_[surface.wall].state.now.to_body(x), tolerance + 2 * clearance()))
        contacts.add(surface.first_face + patch);
    return contacts;
  }


  template <int dim>
  bool Walls<dim>::are_far(const Vec<dim> &x, const double distance) const
  {
    return std::none_of(surfaces_.begin(), surfaces_.end(), [&](const Surface &surface) {
      const Vec<dim> x0 = walls_[surface.wall].state.now.to_body(x);
      return surface.shape.may_reach(x0, x0, distance);
    });
  }


  template <int dim>
  bool Walls<dim>::separate(const Simplex<dim> &cell) const
  {
    for (const Surface &surface : surfaces_)
      {
        Simplex<dim> x0;
        for (int a = 0; a <= dim; ++a)
          x0[a] = walls_[surface.wall].state.now.to_body(cell[a]);
        for (int a = 1; a <= dim; ++a)
          for (int b = 0; b < a; ++b)
            if (surface.shape.separates(x0[a], x0[b]))
              return true;
      }
    return false;
  }


  template <int dim>
  bool Walls<dim>::flatten(const Contacts &shared, const Simplex<dim> &cell) const
  {
    for (const Contacts::Face f : shared)
      {
        const Face &face = faces_[f];
        if (face.surface < 0 || surfaces_[face.surface].shape.is_flat(face.patch))
          return true;
        // On a curved face: a cap between chords is no fluid on the outside of the bend, but it is on the inside.
        const WallSurface<dim> &shape = surfaces_[face.surface].shape;
        Vec<dim>                center;
        for (const Vec<dim> &corner : cell)
          center += corner * (1. / (dim + 1));
        center = walls_[face.wall].state.now.to_body(center);
        typename WallSurface<dim>::Foot foot;
        if (shape.side() != FluidSide::both && shape.nearest(center, spacing_, face.patch, foot) &&
            dot(foot.normal, center - foot.place) < 0)
          return true;
      }
    return false;
  }


  template <int dim>
  bool Walls<dim>::close(const Contacts &shared, const std::array<Vec<dim>, dim> &facet) const
  {
    for (const Contacts::Face f : shared)
      {
        const Face &face = faces_[f];
        if (face.surface < 0 || surfaces_[face.surface].shape.is_flat(face.patch))
          return true;
        Vec<dim> center;
        for (const Vec<dim> &corner : facet)
          center += corner * (1. / dim);
        double longest = 0;
        for (const Vec<dim> &corner : facet)
          longest = std::max(longest, norm(corner - facet[0]));
        typename WallSurface<dim>::Foot foot;
        if (surfaces_[face.surface].shape.nearest(walls_[face.wall].state.now.to_body(center), 0.3 * longest,
                                                  face.patch, foot))
          return true;
      }
    return false;
  }


  template <int dim>
  bool Walls<dim>::distance_to(const Contacts::Face f, const Vec<dim> &x, const double reach, double &distance,
                               Vec<dim> &normal) const
  {
    const Face &face = faces_[f];
    if (face.surface < 0)
      {
        distance = distance_now(face, x);
        return normal_at(face, x, normal);
      }
    const Pose<dim>                &pose = walls_[face.wall].state.now;
    const Vec<dim>                  x0   = pose.to_body(x);
    typename WallSurface<dim>::Foot foot;
    if (!surfaces_[face.surface].shape.nearest(x0, reach, face.patch, foot))
      return false;
    distance = dot(foot.normal, x0 - foot.place);
    normal   = pose.rotated(foot.normal);
    return true;
  }


  template <int dim>
  bool Walls<dim>::distance_to_curved(const Contacts &faces, const Vec<dim> &x, const double reach, double &distance,
                                      Vec<dim> &normal) const
  {
    for (const Contacts::Face f : faces)
      {
        const Face &face = faces_[f];
        if (face.surface >= 0 && !surfaces_[face.surface].shape.is_flat(face.patch))
          return distance_to(f, x, reach, distance, normal);
      }
    return false;
  }


  template <int dim>
  bool Walls<dim>::is_curved(const Contacts &faces) const
  {
    return std::any_of(faces.begin(), faces.end(), [&](const Contacts::Face f) {
      return faces_[f].surface >= 0 && !surfaces_[faces_[f].surface].shape.is_flat(faces_[f].patch);
    });
  }


  template <int dim>
  double Walls<dim>::slip_conductance(const Contacts &shared, const std::array<Vec<dim>, dim> &facet) const
  {
    for (const Contacts::Face f : shared)
      if (walls_[faces_[f].wall].law == Law::navier_slip)
        return norm(area_vector<dim>(facet)) / walls_[faces_[f].wall].slip_length;
    return 0;
  }

#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template Contacts Walls<dim>::faces_at(const Vec<dim> &, double) const;                                              \
  template bool     Walls<dim>::are_far(const Vec<dim> &, double) const;                                               \
  template bool     Walls<dim>::separate(const Simplex<dim> &) const;                                                  \
  template bool     Walls<dim>::flatten(const Contacts &, const Simplex<dim> &) const;                                 \
  template bool     Walls<dim>::close(const Contacts &, const std::array<Vec<dim>, dim> &) const;                      \
  template bool     Walls<dim>::distance_to(Contacts::Face, const Vec<dim> &, double, double &, Vec<dim> &) const;     \
  template bool     Walls<dim>::distance_to_curved(const Contacts &, const Vec<dim> &, double, double &, Vec<dim> &)   \
    const;                                                                                                             \
  template bool   Walls<dim>::is_curved(const Contacts &) const;                                                       \
  template double Walls<dim>::slip_conductance(const Contacts &, const std::array<Vec<dim>, dim> &) const;
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
