#include "fluid_shape.h"
#include "node_cloud.h"

#include <algorithm>
#include <cmath>
#include <random>

// Where the nodes of the fluid stand at time 0.

namespace Breakwater
{
  namespace
  {
    // Distances in units of the spacing h.
    constexpr double surface_distance  = 0.6;  ///< least one of two nodes on surfaces
    constexpr double interior_distance = 0.5;  ///< least one of a node inside to any other
    constexpr double interior_depth    = 0.4;  ///< of nodes inside below the surface
    constexpr double seam              = 0.3;  ///< of nodes of one part's lattice to the parts before it
    constexpr double tolerance         = 0.15; ///< for being on the surface: curved ones are sampled a little outside

    // Where the spacing varies, nodes are thrown until no more find a place (maximal Poisson-disk sampling). Thrown
    // this far apart there is one node per h^dim: saturated disks of diameter d fill 0.547 of a plane, spheres 0.384
    // of space (Zhang and Torquato, Physical Review E 88, 053312, 2013).
    template <int dim>
    constexpr double thrown_distance = dim == 2 ? 0.835 : 0.902;

    /// Size of the cells in each of which one place is tried.
    template <int dim>
    constexpr double cell_of_trials = dim == 2 ? 0.2 : 0.35;
  } // namespace


  template <int dim>
  bool FluidShape<dim>::may_stand_on_surface(const Vec<dim> &x, const double spacing) const
  {
    return std::abs(distance(x)) <= tolerance * spacing;
  }


  template <int dim>
  bool FluidShape<dim>::may_stand_inside(const Vec<dim> &x, const double spacing, const std::size_t part) const
  {
    for (std::size_t p = 0; p < part; ++p)
      if (!parts_[p].is_taken_away && parts_[p].region->distance(x) < seam * spacing)
        return false;
    return distance(x) <= -interior_depth * spacing;
  }


  template <int dim>
  std::vector<Vec<dim>> FluidShape<dim>::place_nodes(const SizeField<dim> &size, const Lattice &lattice) const
  {
    if (parts_.size() == 1 && size.is_uniform() && parts_.front().region->is_box())
      return fill_box(extent(), lattice, size.smallest());

    std::vector<NodeCandidates<dim>> candidates(parts_.size());
    for (std::size_t p = 0; p < parts_.size(); ++p)
      parts_[p].region->add_nodes(size, lattice, candidates[p]);

    NodeCloud<dim> nodes(interior_distance * size.smallest(), size.largest());
    const auto     add_surface = [&](const std::vector<Vec<dim>> &places) {
      for (const Vec<dim> &x : places)
        if (may_stand_on_surface(x, size(x)) && nodes.is_free(x, surface_distance * size(x)))
          nodes.add(x);
    };
    for (const auto &part : candidates)
      for (const Vec<dim> &x : part.given)
        nodes.add(x);
    for (const auto &part : candidates)
      add_surface(part.sharp);
    for (const auto &part : candidates)
      add_surface(part.smooth);

    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (!parts_[p].is_taken_away)
        for (const Vec<dim> &x : candidates[p].interior)
          if (may_stand_inside(x, size(x), p) && nodes.is_free(x, interior_distance * size(x)))
            nodes.add(x);
    if (!size.is_uniform())
      for (const Vec<dim> &x : graded_darts(size, lattice.seed))
        if (may_stand_inside(x, size(x), 0) && nodes.is_free(x, thrown_distance<dim> * size(x)))
          nodes.add(x);
    return nodes.places();
  }


  template <int dim>
  std::vector<Vec<dim>> FluidShape<dim>::graded_darts(const SizeField<dim> &size, const unsigned int seed) const
  {
    std::mt19937 random(seed);
    const auto   noise = [&]() {
      return 2. * random() / std::mt19937::max() - 1.;
    };

    // One place in each cell: the box around the shape, halved again and again.
    struct Cell
    {
      Vec<dim> center, half;
    };
    const BoxShape<dim>   box   = extent();
    std::vector<Cell>     cells = {{(box.lower + box.upper) * 0.5, (box.upper - box.lower) * 0.5}};
    std::vector<Vec<dim>> darts;
    while (!cells.empty())
      {
        Cell cell = cells.back();
        cells.pop_back();
        const int    longest = std::max_element(cell.half.c, cell.half.c + dim) - cell.half.c;
        const double radius  = norm(cell.half);
        if (distance(cell.center) > radius)
          continue;
        if (2 * cell.half[longest] >
              cell_of_trials<dim> * (size(cell.center) - SizeField<dim>::largest_gradient * radius) &&
            2 * cell.half[longest] > cell_of_trials<dim> * size.smallest())
          {
            cell.half[longest] *= 0.5;
            for (const double side : {-1., 1.})
              {
                cells.push_back(cell);
                cells.back().center[longest] += side * cell.half[longest];
              }
            continue;
          }
        for (int d = 0; d < dim; ++d)
          cell.center[d] += noise() * cell.half[d];
        darts.push_back(cell.center);
      }
    // The shuffle of the standard library is not the same everywhere.
    for (std::size_t i = darts.size(); i > 1; --i)
      std::swap(darts[i - 1], darts[random() % i]);
    return darts;
  }

  template std::vector<Vec<2>> FluidShape<2>::place_nodes(const SizeField<2> &, const Lattice &) const;
  template std::vector<Vec<3>> FluidShape<3>::place_nodes(const SizeField<3> &, const Lattice &) const;
} // namespace Breakwater
