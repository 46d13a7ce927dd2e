#include "node_cloud.h"
#include "walls.h"

#include <algorithm>
#include <cmath>

// The nodes of the initial state next to walls that its shape does not follow.

namespace Breakwater
{
  namespace
  {
    // Distances in units of the spacing.
    constexpr double depth_of_kept    = 0.45; ///< of nodes that keep their place off a wall
    constexpr double distance_of_feet = 0.8;  ///< least one of a new node on a wall to others there
    constexpr double distance_at_edge = 0.4;  ///< the same for places on the edges of walls
  }                                           // namespace


  template <int dim>
  bool Walls<dim>::is_in_solid(const Vec<dim> &x) const
  {
    for (unsigned int f = 0; f < n_planes_; ++f)
      if (plane_distance(faces_[f], walls_[faces_[f].wall].state.now.to_body(x)) < -1e-9 * spacing_)
        return true;
    return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const Surface &surface) {
      return surface.shape.is_in_solid(walls_[surface.wall].state.now.to_body(x));
    });
  }


  template <int dim>
  bool Walls<dim>::nearest_place(const Vec<dim> &x, const double reach, Vec<dim> &place) const
  {
    double best = reach;
    for (unsigned int f = n_aligned_; f < n_planes_; ++f)
      {
        const Pose<dim> &pose     = walls_[faces_[f].wall].state.now;
        const Vec<dim>   x0       = pose.to_body(x);
        const double     distance = plane_distance(faces_[f], x0);
        if (std::abs(distance) <= best)
          {
            best  = std::abs(distance);
            place = pose.to_world(x0 - distance * faces_[f].normal);
          }
      }
    for (const Surface &surface : surfaces_)
      {
        const Pose<dim>                &pose = walls_[surface.wall].state.now;
        typename WallSurface<dim>::Foot foot;
        if (surface.shape.nearest(pose.to_body(x), best, surface.shape.n_patches(), foot))
          {
            best  = foot.distance;
            place = pose.to_world(foot.place);
          }
      }
    return best < reach;
  }


  template <int dim>
  Vec<dim> Walls<dim>::off_surfaces(const Vec<dim> &x, const double side, const double distance) const
  {
    Vec<dim> result = x;
    for (const Surface &surface : surfaces_)
      {
        const Pose<dim>                &pose = walls_[surface.wall].state.now;
        const double                    sign = surface.shape.side() == FluidSide::both ? side : 1.;
        Vec<dim>                        x0   = pose.to_body(result);
        typename WallSurface<dim>::Foot foot;
        for (const unsigned int patch : surface.shape.patches_near(x0, clearance()))
          if (surface.shape.nearest(x0, 3 * distance, patch, foot))
            x0 += (distance - sign * dot(foot.normal, x0 - foot.place)) * sign * foot.normal;
        result = pose.to_world(x0);
      }
    return result;
  }


  template <int dim>
  std::vector<Vec<dim>> Walls<dim>::fit(const std::vector<Vec<dim>> &nodes, const SizeField<dim> &size,
                                        const std::function<bool(const Vec<dim> &)> &is_fluid) const
  {
    if (n_aligned_ == faces_.size())
      return nodes;
    std::vector<Vec<dim>> result, touching, feet, edges;
    for (const Vec<dim> &x : nodes)
      {
        const double h = size(x);
        Vec<dim>     foot;
        const bool   is_near  = nearest_place(x, h, foot);
        const double distance = is_near ? norm(x - foot) : h;
        if (distance <= clearance())
          touching.push_back(x);
        else if (distance >= depth_of_kept * h && !is_in_solid(x))
          result.push_back(x);
        else if (is_near)
          feet.push_back(foot);
      }
    for (const Surface &surface : surfaces_)
      {
        const Pose<dim>  &pose = walls_[surface.wall].state.now;
        std::vector<char> is_followed(surface.shape.n_patches(), false); // by the shape of the fluid
        for (const Vec<dim> &x : touching)
          for (const unsigned int patch : surface.shape.patches_near(pose.to_body(x), clearance()))
            is_followed[patch] = true;
        for (unsigned int patch = 0; patch < surface.shape.n_patches(); ++patch)
          if (!is_followed[patch])
            for (const Vec<dim> &x0 : surface.shape.places_on_patch(patch, 0.25 * size.smallest()))
              feet.push_back(pose.to_world(x0));
        for (const Vec<dim> &x0 : surface.shape.places_on_edges(size.smallest()))
          edges.push_back(pose.to_world(x0));
      }

    // A wall with fluid on both sides gets nodes on each of them.
    for (const double side : {1., -1.})
      {
        NodeCloud<dim> on_walls(distance_at_edge * size.smallest(), size.largest());
        const auto     add = [&](const std::vector<Vec<dim>> &places, const double distance) {
          for (const Vec<dim> &place : places)
            {
              const Vec<dim> x      = off_surfaces(place, side, clearance());
              const Vec<dim> inside = off_surfaces(place, side, 0.01 * spacing_);
              const bool     is_new = side > 0 || norm(x - off_surfaces(place, 1., clearance())) > 0;
              if (is_new && is_fluid(inside) && !is_in_solid(x) && on_walls.is_free(x, distance * size(x)))
                on_walls.add(x);
            }
        };
        add(touching, clearance());
        add(edges, distance_at_edge);
        add(feet, distance_of_feet);
        result.insert(result.end(), on_walls.places().begin(), on_walls.places().end());
      }
    return result;
  }

#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template bool                  Walls<dim>::is_in_solid(const Vec<dim> &) const;                                      \
  template bool                  Walls<dim>::nearest_place(const Vec<dim> &, double, Vec<dim> &) const;                \
  template Vec<dim>              Walls<dim>::off_surfaces(const Vec<dim> &, double, double) const;                     \
  template std::vector<Vec<dim>> Walls<dim>::fit(const std::vector<Vec<dim>> &, const SizeField<dim> &,                \
                                                 const std::function<bool(const Vec<dim> &)> &) const;
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
