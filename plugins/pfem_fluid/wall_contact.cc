#include "walls.h"

#include <algorithm>
#include <cmath>

// What walls do to nodes.

namespace Breakwater
{
  namespace
  {
    /// A node in contact that is farther than this from the wall, in spacings, is no longer in contact.
    constexpr double reach = 0.1;
    /// A node in contact that is farther beside a surface than this, in spacings, has left it.
    constexpr double overhang = 0.01;
    template <int dim>
    Vec<dim> vec(const double *values)
    {
      Vec<dim> result;
      std::copy_n(values, dim, result.c);
      return result;
    }

    /// Directions at right angles to each other.
    template <int dim>
    class Directions
    {
    public:
      unsigned int    size() const { return n_; }
      const Vec<dim> &back() const { return direction_[n_ - 1]; }
      void            clear() { n_ = 0; }

      /// Adds what of a unit vector is at right angles to all so far. @return false if that is almost nothing
      bool add(Vec<dim> e)
      {
        for (unsigned int k = 0; k < n_; ++k)
          e -= dot(e, direction_[k]) * direction_[k];
        const double length = norm(e);
        if (n_ == dim || length < 0.1)
          return false;
        direction_[n_++] = length == 1 ? e : e * (1 / length);
        return true;
      }

    private:
      Vec<dim>     direction_[dim];
      unsigned int n_ = 0;
    };
  } // namespace


  template <int dim>
  double Walls<dim>::plane_distance(const Face &face, const Vec<dim> &body_place) const
  {
    return dot(face.normal, body_place - face.point);
  }


  template <int dim>
  Vec<dim> Walls<dim>::velocity_at(const Wall &wall, const Vec<dim> &x) const
  {
    if (!wall.is_moving || step_ == 0)
      return {};
    const Vec<dim> x0 = wall.state.now.to_body(x), before = wall.state.before.to_world(x0);
    return in_step_ ? (x - before) * (1 / step_) : (wall.state.after.to_world(x0) - before) * (0.5 / step_);
  }


  template <int dim>
  Vec<dim> Walls<dim>::acceleration_at(const Wall &wall, const Vec<dim> &x) const
  {
    if (!wall.is_moving || step_ == 0)
      return {};
    const Vec<dim> x0 = wall.state.now.to_body(x);
    return (wall.state.before.to_world(x0) + wall.state.after.to_world(x0) - 2. * x) * (1 / (step_ * step_));
  }


  template <int dim>
  bool Walls<dim>::normal_at(const Face &face, const Vec<dim> &x, Vec<dim> &normal) const
  {
    if (face.direction >= 0)
      {
        normal                 = Vec<dim>();
        normal[face.direction] = face.sign;
        return true;
      }
    const Pose<dim> &pose = walls_[face.wall].state.now;
    if (face.surface < 0)
      {
        normal = pose.rotated(face.normal);
        return true;
      }
    const WallSurface<dim> &shape = surfaces_[face.surface].shape;
    const Vec<dim>          x0    = pose.to_body(x);
    if (shape.is_flat(face.patch))
      {
        normal = pose.rotated(shape.flat_normal(face.patch, x0));
        return true;
      }
    typename WallSurface<dim>::Foot foot;
    if (!shape.nearest(x0, reach * spacing_, face.patch, foot))
      return false;
    const bool is_behind = shape.side() == FluidSide::both && dot(foot.normal, x0 - foot.place) < 0;
    normal               = pose.rotated(is_behind ? -1. * foot.normal : foot.normal);
    return true;
  }


  template <int dim>
  typename Walls<dim>::Load Walls<dim>::load_of(const Wall &wall, const Vec<dim> &x, const Vec<dim> &force) const
  {
    Load           load;
    const Vec<dim> arm = x - wall.reference_point;
    load.force         = force;
    if constexpr (dim == 2)
      load.moment[2] = arm[0] * force[1] - arm[1] * force[0];
    else
      load.moment = cross(arm, force);
    if (wall.is_moving)
      load.power = -dot(force, velocity_at(wall, x));
    return load;
  }


  template <int dim>
  double Walls<dim>::distance_now(const Face &plane, const Vec<dim> &x) const
  {
    return plane.direction >= 0 ? plane.sign * (x[plane.direction] - plane.place) :
                                  plane_distance(plane, walls_[plane.wall].state.now.to_body(x));
  }


  template <int dim>
  bool Walls<dim>::stop_at_faces(const Vec<dim> &x_old, double *x, double *v, const double mass, Contacts &contacts)
  {
    bool       has_new      = false;
    const auto stop_aligned = [&]() {
      for (unsigned int f = 0; f < n_aligned_; ++f)
        {
          const Face &face = faces_[f];
          const int   d    = face.direction;
          if (face.sign * (x[d] - face.place) >= 0)
            continue;
          x[d] = face.place;
          Vec<dim> normal;
          normal[d] = face.sign;
          take_velocity(face, normal, vec<dim>(x), v, mass);
          has_new = has_new || !contacts.has(f);
          contacts.add(f);
        }
    };
    stop_aligned();
    if (n_aligned_ == faces_.size())
      return has_new;

    const Contacts before = contacts;
    for (unsigned int f = n_aligned_; f < n_planes_; ++f)
      stop_at_plane(f, x, v, mass, contacts);
    for (const Surface &surface : surfaces_)
      stop_at_surface(surface, x_old, x, v, mass, contacts);
    stop_aligned();
    return has_new || std::any_of(contacts.begin(), contacts.end(), [&](const Contacts::Face face) {
             return !before.has(face);
           });
  }


  template <int dim>
  void Walls<dim>::take_velocity(const Face &face, const Vec<dim> &normal, const Vec<dim> &x, double *v,
                                 const double mass)
  {
    Wall        &wall     = walls_[face.wall];
    Vec<dim>     taken    = vec<dim>(v) - velocity_at(wall, x);
    const double approach = dot(normal, taken);
    if (wall.law != Law::no_slip)
      taken = std::min(0., approach) * normal;
    for (int d = 0; d < dim; ++d)
      v[d] -= taken[d];
    if (mass > 0)
      wall.state.total.add(load_of(wall, x, taken), mass);
  }


  template <int dim>
  void Walls<dim>::stop_at_plane(const unsigned int f, double *x, double *v, const double mass, Contacts &contacts)
  {
    const Face      &face     = faces_[f];
    const Pose<dim> &pose     = walls_[face.wall].state.now;
    Vec<dim>         x0       = pose.to_body(vec<dim>(x));
    const double     distance = plane_distance(face, x0);
    if (distance > reach * spacing_)
      contacts.remove(f);
    if (distance >= 0 && !contacts.has(f))
      return;
    x0 -= distance * face.normal;
    const Vec<dim> place = pose.to_world(x0);
    std::copy_n(place.c, dim, x);
    if (distance < 0)
      take_velocity(face, pose.rotated(face.normal), place, v, mass);
    contacts.add(f);
  }


  template <int dim>
  void Walls<dim>::stop_at_surface(const Surface &surface, const Vec<dim> &x_old, double *x, double *v,
                                   const double mass, Contacts &contacts)
  {
    const WallSurface<dim> &shape         = surface.shape;
    const State            &state         = walls_[surface.wall].state;
    const Vec<dim>          from          = (in_step_ ? state.before : state.now).to_body(x_old);
    Vec<dim>                to            = state.now.to_body(vec<dim>(x));
    const Contacts          held          = contacts;
    const auto              is_of_surface = [&](const Contacts::Face f) {
      return f >= surface.first_face && f < surface.first_face + shape.n_patches();
    };
    if (std::none_of(held.begin(), held.end(), is_of_surface) && !shape.may_reach(from, to, 0.))
      return;

    // Puts `to` in front of one more plane, without leaving those before.
    Directions<dim> directions;
    const auto      put_in_front = [&](const Vec<dim> &place, const Vec<dim> &normal) {
      if (!directions.add(normal))
        {
          directions.clear();
          directions.add(normal);
        }
      const Vec<dim> &e = directions.back();
      to += ((clearance() - dot(normal, to - place)) / dot(normal, e)) * e;
    };

    for (const Contacts::Face f : held)
      if (is_of_surface(f))
        {
          typename WallSurface<dim>::Foot foot;
          const bool                      found  = shape.nearest(to, reach * spacing_, f - surface.first_face, foot);
          const Vec<dim>                  away   = to - foot.place;
          const Vec<dim>                  beside = away - dot(away, foot.normal) * foot.normal;
          if (!found || norm(beside) > overhang * spacing_)
            contacts.remove(f);
          else
            put_in_front(foot.place, shape.side() == FluidSide::both && dot(foot.normal, from - foot.place) < 0 ?
                                       -1. * foot.normal :
                                       foot.normal);
        }
    typename WallSurface<dim>::Crossing crossing;
    for (int n = 0; shape.first_crossing(from, to, crossing); ++n)
      {
        const Face &face = faces_[surface.first_face + crossing.patch];
        contacts.add(surface.first_face + crossing.patch);
        take_velocity(face, state.now.rotated(crossing.normal), state.now.to_world(to), v, mass);
        if (n < 2 * dim)
          put_in_front(crossing.place, crossing.normal);
        else
          to = from; // wedged in: it stays where it was on the wall
      }
    const Vec<dim> place = state.now.to_world(to);
    std::copy_n(place.c, dim, x);
  }


  template <int dim>
  void Walls<dim>::constrain(const double *x, double *a, double *v, const double mass, const double slip_rate,
                             const bool may_release, Contacts &contacts)
  {
    if (contacts.empty())
      return;
    if (contacts.are_below(n_aligned_))
      constrain_along_axes(x, a, v, mass, may_release, contacts);
    else
      constrain_generally(x, a, v, mass, may_release, contacts);
    if (slip_rate > 0)
      rub(x, a, v, mass, slip_rate, contacts);
  }


  template <int dim>
  void Walls<dim>::constrain_along_axes(const double *x, double *a, double *v, const double mass,
                                        const bool may_release, Contacts &contacts)
  {
    Wall          *sticking = nullptr;
    const Contacts held     = contacts;
    const Vec<dim> place    = vec<dim>(x);
    for (const Contacts::Face f : held)
      {
        const Face &face = faces_[f];
        Wall       &wall = walls_[face.wall];
        const int   d    = face.direction;
        if (may_release && face.sign * a[d] > 0)
          {
            contacts.remove(f);
            continue;
          }
        Vec<dim> force, impulse;
        force[d]   = mass * a[d];
        impulse[d] = mass * v[d];
        wall.state.load.add(load_of(wall, place, force), 1.);
        wall.state.total.add(load_of(wall, place, impulse), 1.);
        a[d] = 0;
        v[d] = 0;
        if (wall.law == Law::no_slip)
          sticking = &wall;
      }
    if (sticking != nullptr)
      {
        sticking->state.load.add(load_of(*sticking, place, vec<dim>(a)), mass);
        sticking->state.total.add(load_of(*sticking, place, vec<dim>(v)), mass);
        std::fill_n(a, dim, 0.);
        std::fill_n(v, dim, 0.);
      }
  }


  template <int dim>
  void Walls<dim>::constrain_generally(const double *x, double *a, double *v, const double mass, const bool may_release,
                                       Contacts &contacts)
  {
    Wall           *sticking = nullptr;
    const Contacts  held     = contacts;
    const Vec<dim>  place    = vec<dim>(x);
    Directions<dim> directions;
    const auto      take = [&](Wall &wall, const Vec<dim> &acceleration, const Vec<dim> &velocity) {
      wall.state.load.add(load_of(wall, place, acceleration), mass);
      wall.state.total.add(load_of(wall, place, velocity), mass);
      for (int d = 0; d < dim; ++d)
        {
          a[d] -= acceleration[d];
          v[d] -= velocity[d];
        }
    };
    for (const Contacts::Face f : held)
      {
        const Face    &face = faces_[f];
        Wall          &wall = walls_[face.wall];
        Vec<dim>       normal;
        const Vec<dim> acceleration = vec<dim>(a) - acceleration_at(wall, place);
        if (!normal_at(face, place, normal) || (may_release && dot(normal, acceleration) > 0))
          {
            contacts.remove(f);
            continue;
          }
        if (!directions.add(normal))
          continue;
        const Vec<dim> &e = directions.back();
        take(wall, dot(e, acceleration) * e, dot(e, vec<dim>(v) - velocity_at(wall, place)) * e);
        if (wall.law == Law::no_slip)
          sticking = &wall;
      }
    if (sticking != nullptr)
      take(*sticking, vec<dim>(a) - acceleration_at(*sticking, place), vec<dim>(v) - velocity_at(*sticking, place));
  }


  // a = F/m - k (u + dt/2 a), u the velocity in the middle of the step: second order, stable for every dt k, and what
  // is steady is exact.
  template <int dim>
  void Walls<dim>::rub(const double *x, double *a, const double *v, const double mass, const double slip_rate,
                       const Contacts &contacts)
  {
    const auto slips = [&](const Contacts::Face f) {
      return walls_[faces_[f].wall].law == Law::navier_slip;
    };
    const auto found = std::find_if(contacts.begin(), contacts.end(), slips);
    if (found == contacts.end())
      return;
    Wall          &wall         = walls_[faces_[*found].wall];
    const Vec<dim> place        = vec<dim>(x);
    Vec<dim>       velocity     = vec<dim>(v) - velocity_at(wall, place);
    Vec<dim>       acceleration = vec<dim>(a) - acceleration_at(wall, place);
    mask(x, velocity.c, contacts);
    mask(x, acceleration.c, contacts);
    const Vec<dim> slowed = (acceleration - slip_rate * velocity) * (1 / (1 + 0.5 * step_ * slip_rate));
    wall.state.load.add(load_of(wall, place, acceleration - slowed), mass);
    for (int d = 0; d < dim; ++d)
      a[d] += slowed[d] - acceleration[d];
  }


  template <int dim>
  template <class Take>
  void Walls<dim>::project(const double *x, double *vector, const Contacts &contacts, const Take &take) const
  {
    const Vec<dim>  place = vec<dim>(x);
    Directions<dim> directions;
    int             sticking = -1;
    for (const Contacts::Face f : contacts)
      {
        const Face &face = faces_[f];
        Vec<dim>    normal;
        if (!normal_at(face, place, normal))
          continue;
        if (walls_[face.wall].law == Law::no_slip)
          sticking = face.wall;
        if (!directions.add(normal))
          continue;
        const Vec<dim> part = dot(directions.back(), vec<dim>(vector)) * directions.back();
        take(face.wall, part);
        for (int d = 0; d < dim; ++d)
          vector[d] -= part[d];
      }
    if (sticking >= 0)
      {
        take(sticking, vec<dim>(vector));
        std::fill_n(vector, dim, 0.);
      }
  }


  template <int dim>
  void Walls<dim>::mask(const double *x, double *vector, const Contacts &contacts) const
  {
    project(x, vector, contacts, [](const unsigned int, const Vec<dim> &) {});
  }


  template <int dim>
  void Walls<dim>::mask_impulse(const double *x, double *impulse, const Contacts &contacts)
  {
    project(x, impulse, contacts, [&](const unsigned int w, const Vec<dim> &part) {
      walls_[w].state.total.add(load_of(walls_[w], vec<dim>(x), part), 1.);
    });
  }


  template <int dim>
  void Walls<dim>::push(const Contacts &faces, const Vec<dim> &x, const Vec<dim> &force)
  {
    Wall &wall = walls_[faces_[*faces.begin()].wall];
    wall.state.load.add(load_of(wall, x, force), 1.);
  }


  template class Walls<2>;
  template class Walls<3>;
} // namespace Breakwater
