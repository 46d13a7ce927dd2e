#include "fluid_cells.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    template <int dim>
    double longest_edge(const Simplex<dim> &x)
    {
      double longest = 0;
      for (int a = 1; a <= dim; ++a)
        for (int b = 0; b < a; ++b)
          longest = std::max(longest, norm(x[a] - x[b]));
      return longest;
    }

    /// True if the facet between three interface nodes is a needle without being the structure's own, slender as that may
    /// be: they lie in a row on an edge of a bent structure, and no place of the fourth node makes the cell a good one. In
    /// 2D there are none.
    template <int dim>
    bool has_needle(const typename SimplexMesh<dim>::Cell &cell, const Simplex<dim> &x, const std::size_t n_interface,
                    const AdoptedSurface<dim> &adopted)
    {
      if constexpr (dim == 3)
        {
          const auto is_other = [n_interface](const unsigned int node) {
            return node >= n_interface;
          };
          if (std::count_if(cell.begin(), cell.end(), is_other) != 1)
            return false;
          const int    other = std::find_if(cell.begin(), cell.end(), is_other) - cell.begin();
          const Vec<3> a = x[(other + 1) % 4], e = x[(other + 2) % 4] - a, f = x[(other + 3) % 4] - a, g = f - e;
          return norm(cross(e, f)) < 0.1 * std::max({dot(e, e), dot(f, f), dot(g, g)}) &&
                 !adopted.has_facet_of(outward_facet<3>(cell, other));
        }
      return false;
    }

    /// Faces that all nodes of a cell have in common.
    template <class Cell>
    Contacts shared_by(const Cell &cell, const std::vector<Contacts> &faces)
    {
      Contacts shared = faces[cell[0]];
      for (const unsigned int i : cell)
        shared = common(shared, faces[i]);
      return shared;
    }
  } // namespace


  template <int dim>
  FluidCells<dim>::FluidCells(const FluidNodes<dim> &nodes, const PfemParameters<dim> &parameters,
                              const AdoptedSurface<dim> &adopted, const FormerFluid<dim> &former,
                              const std::function<bool(const Cell &)> &is_inside)
    : nodes_(nodes)
    , parameters_(parameters)
    , adopted_(adopted)
    , former_(former)
    , is_inside_(is_inside)
    , kind_(nodes.n)
    , near_surface_(nodes.n, 0)
    , near_walls_(nodes.n)
  {
    const bool any_has_surface = parameters.walls.any_has_surface();
    for (unsigned int i = 0; i < nodes.n; ++i)
      {
        const Vec<dim> x    = nodes.position(i);
        const double   size = parameters.size(x);
        near_walls_[i]      = parameters.walls.faces_at(x, 0.5 * size);
        // An edge of a cell, at most twice this length, passes through surfaces close to one of its ends only.
        const double reach = std::max(parameters.alpha, parameters.alpha_of_fluid) * size;
        near_surface_[i]   = any_has_surface && !parameters.walls.are_far(x, reach);
        if (!nodes.walls[i].empty() || is_interface(i))
          kind_[i] |= held;
        if (!near_surface_[i] && !is_interface(i) && !is_inside)
          kind_[i] |= plain;
      }
  }


  template <int dim>
  bool FluidCells<dim>::keeps(const Cell &cell) const
  {
    unsigned char all = held | plain; // what all nodes are
    for (const unsigned int i : cell)
      all &= kind_[i];
    return all == plain || keeps_at_boundary(cell);
  }


  template <int dim>
  bool FluidCells<dim>::keeps_at_boundary(const Cell &cell) const
  {
    bool are_held = true, is_near_surface = false, has_interface = false, is_all_interface = true;
    for (const unsigned int i : cell)
      {
        are_held         = are_held && (kind_[i] & held);
        is_near_surface  = is_near_surface || near_surface_[i];
        has_interface    = has_interface || is_interface(i);
        is_all_interface = is_all_interface && is_interface(i);
      }
    if (is_all_interface || (is_inside_ && !is_inside_(cell)))
      return false;
    const Walls<dim>  &walls  = parameters_.walls;
    const Simplex<dim> x      = nodes_.corners(cell);
    const Contacts     shared = shared_by(cell, nodes_.walls);
    if (!shared.empty() && walls.flatten(shared, x))
      return false;
    if (is_near_surface && walls.separate(x))
      return false;
    if (are_held && signed_volume(x) < 0.02 * regular_volume<dim>(parameters_.spacing))
      return false;
    if (has_interface && !parameters_.mesh_smoothers.empty() && has_needle<dim>(cell, x, nodes_.n_interface, adopted_))
      return false;
    return !has_interface || adopted_.accepts(cell, nodes_);
  }


  template <int dim>
  bool FluidCells<dim>::is_small(const Cell &cell, const double circumradius) const
  {
    const double size = parameters_.size(nodes_.position(cell[0]));
    if (!parameters_.size.is_uniform() && circumradius <= parameters_.alpha * size)
      return true;
    // Around a node that was within the fluid, all was fluid.
    const auto was_within = [this](const unsigned int i) {
      return nodes_.has_cells[i] && !nodes_.is_surface[i];
    };
    const double largest = parameters_.alpha_of_fluid * size;
    if (circumradius <= largest &&
        (is_inside_ || std::any_of(cell.begin(), cell.end(), was_within) || former_.had(cell)))
      return true;
    const double length = longest_edge<dim>(nodes_.corners(cell));
    if (length <= 2 * largest && former_.had_surface_of(cell))
      return true;
    // A flat cell along a wall has a large circumradius only because its nodes have come close to the wall. Without it
    // there would be a free surface at the wall, deep in the fluid, and the pressure would push into the hole.
    return length <= 1.9 * largest && !shared_by(cell, near_walls_).empty();
  }

  template class FluidCells<2>;
  template class FluidCells<3>;
} // namespace Breakwater
