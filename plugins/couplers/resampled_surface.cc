#include "resampled_surface.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/area_vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>

namespace Breakwater
{
  namespace
  {
    using Edge = std::pair<unsigned int, unsigned int>; ///< the smaller number first

    Edge edge_of(const unsigned int a, const unsigned int b)
    {
      return {std::min(a, b), std::max(a, b)};
    }

    /// A grid of facets: corner (i, j) is node[j * (n[0] + 1) + i]. In 2D a row, without the second direction.
    struct Grid
    {
      std::array<unsigned int, 2> n;     ///< facets in each direction
      unsigned int                first; ///< one of the facets
      std::vector<unsigned int>   node;
    };

    /// Cuts a surface into grids.
    template <int dim>
    class Patches
    {
    public:
      explicit Patches(const WetSurface<dim> &surface)
        : surface_(surface)
        , is_done_(surface.facets.size())
      {
        for (unsigned int f = 0; f < surface.facets.size(); ++f)
          for (unsigned int k = 0; k < n_sides; ++k)
            sides_[side(f, k)].push_back({f, k});
      }

      std::vector<Grid> grids()
      {
        std::vector<Grid> result;
        for (unsigned int f = 0; f < surface_.facets.size(); ++f)
          if (!is_done_[f])
            result.push_back(grid_around(f));
        return result;
      }

    private:
      static constexpr unsigned int n_sides = dim == 2 ? 2 : 4;

      struct Side
      {
        unsigned int facet, number;
      };
      /// A facet at (i, j) whose local node `first` is the corner (i, j).
      struct Place
      {
        unsigned int facet, first;
        int          i, j;
      };

      /// In 2D a side is a node.
      Edge side(const unsigned int f, const unsigned int k) const
      {
        const auto &facet = surface_.facets[f];
        return dim == 2 ? Edge{facet[k], facet[k]} : edge_of(facet[k], facet[(k + 1) % 4]);
      }

      /// The facet beyond a side, if the surface goes on smoothly there.
      const Side *beyond(const unsigned int f, const unsigned int k) const
      {
        const std::vector<Side> &meeting = sides_.at(side(f, k));
        if (meeting.size() != 2)
          return nullptr;
        const Side &other = meeting[meeting[0].facet == f ? 1 : 0];
        const auto &body  = surface_.body_of_facet;
        if (!body.empty() && body[f] != body[other.facet])
          return nullptr;
        const Vec<dim> a = area_vector<dim>(surface_.position, surface_.facets[f]),
                       b = area_vector<dim>(surface_.position, surface_.facets[other.facet]);
        return dot(a, b) < std::cos(M_PI / 6) * norm(a) * norm(b) ? nullptr : &other;
      }

      Grid grid_around(const unsigned int start)
      {
        // Sides of a facet by direction: the one towards larger i, j, smaller i, j. In 2D node 1 is ahead, 0 behind.
        constexpr int                     step[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
        std::vector<Place>                places     = {{start, 0, 0, 0}};
        std::array<std::array<int, 2>, 2> range{};
        is_done_[start] = 1;
        for (std::size_t p = 0; p < places.size(); ++p)
          for (unsigned int k = 0; k < n_sides; ++k)
            {
              const Place here  = places[p];
              const Side *other = beyond(here.facet, (here.first + k) % n_sides);
              if (other == nullptr || is_done_[other->facet])
                continue;
              is_done_[other->facet]  = 1;
              const unsigned int move = dim == 2 ? (k == 1 ? 1 : 3) : k;
              // Its side that meets ours lies opposite: local side `number` is the one in direction k + 2.
              const unsigned int first = dim == 2 ? 0 : (other->number + 4 - (k + 2) % 4) % 4;
              places.push_back({other->facet, first, here.i + step[move][0], here.j + step[move][1]});
              for (int d = 0; d < 2; ++d)
                {
                  const int at = d == 0 ? places.back().i : places.back().j;
                  range[d][0]  = std::min(range[d][0], at);
                  range[d][1]  = std::max(range[d][1], at);
                }
            }
        return fill_grid(places, range);
      }

      Grid fill_grid(const std::vector<Place> &places, const std::array<std::array<int, 2>, 2> &range) const
      {
        Grid grid;
        grid.first = places.front().facet;
        for (int d = 0; d < 2; ++d)
          grid.n[d] = range[d][1] - range[d][0] + 1;
        constexpr unsigned int none = -1;
        bool                   fits = places.size() == std::size_t(grid.n[0]) * grid.n[1];
        grid.node.assign((grid.n[0] + 1) * (grid.n[1] + 1), none);
        for (const Place &place : places)
          for (unsigned int k = 0; k < (dim == 2 ? 2u : 4u); ++k)
            {
              constexpr unsigned int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
              const unsigned int     i = place.i - range[0][0] + corner[k][0], j = place.j - range[1][0] + corner[k][1];
              const unsigned int     node    = surface_.facets[place.facet][(place.first + k) % n_sides];
              unsigned int          &in_grid = grid.node[j * (grid.n[0] + 1) + i];
              fits                           = fits && (in_grid == none || in_grid == node);
              in_grid                        = node;
            }
        if (!fits)
          throw InputError("Coupling: a smooth part of the wet surface with " + std::to_string(places.size()) +
                           " facets is not a grid of facets, so it can't be given another spacing. Use "
                           "Interface = matching.");
        return grid;
      }

      const WetSurface<dim>            &surface_;
      std::vector<char>                 is_done_;
      std::map<Edge, std::vector<Side>> sides_;
    };

    /// How many facets each direction of each grid gets: the same on both sides of an edge that two grids share.
    template <int dim>
    std::vector<std::array<unsigned int, 2>> numbers_of_facets(const WetSurface<dim>   &surface,
                                                               const std::vector<Grid> &grids, const double spacing)
    {
      std::vector<unsigned int> parent(2 * grids.size());
      std::iota(parent.begin(), parent.end(), 0u);
      const auto root = [&](unsigned int k) {
        while (parent[k] != k)
          k = parent[k];
        return k;
      };
      std::vector<double>          length(parent.size(), 0.);
      std::map<Edge, unsigned int> direction_of;
      for (unsigned int g = 0; g < grids.size(); ++g)
        for (unsigned int d = 0; d < dim - 1; ++d)
          for (unsigned int line = 0; line <= (dim == 2 ? 0 : grids[g].n[1 - d]); ++line)
            {
              double sum = 0;
              for (unsigned int k = 0; k < grids[g].n[d]; ++k)
                {
                  const unsigned int width = grids[g].n[0] + 1, stride = d == 0 ? 1 : width;
                  const unsigned int at = line * (d == 0 ? width : 1) + k * stride;
                  const unsigned int a = grids[g].node[at], b = grids[g].node[at + stride];
                  sum += norm(surface.position[a] - surface.position[b]);
                  const auto known        = direction_of.emplace(edge_of(a, b), 2 * g + d);
                  parent[root(2 * g + d)] = root(known.first->second);
                }
              length[2 * g + d] = std::max(length[2 * g + d], sum);
            }
      std::vector<double> longest(parent.size(), 0.);
      for (unsigned int k = 0; k < parent.size(); ++k)
        longest[root(k)] = std::max(longest[root(k)], length[k]);
      std::vector<std::array<unsigned int, 2>> result(grids.size(), {1, 1});
      for (unsigned int g = 0; g < grids.size(); ++g)
        for (unsigned int d = 0; d < dim - 1; ++d)
          result[g][d] = std::max(1., std::round(longest[root(2 * g + d)] / spacing));
      return result;
    }

    /// The nodes of resampled grids, each one once.
    template <int dim>
    class NewNodes
    {
    public:
      using Weight = typename ResampledSurface<dim>::Weight;

      explicit NewNodes(const WetSurface<dim> &owner)
        : owner_(owner)
      {
      }

      /// The node at (u, v) in units of the grid's facets.
      unsigned int at(const Grid &grid, const double u, const double v)
      {
        const Shape         along = shape_at(grid, 0, u), across = dim == 2 ? Shape{0, {1.}} : shape_at(grid, 1, v);
        std::vector<Weight> weights;
        for (unsigned int b = 0; b < across.values.size(); ++b)
          for (unsigned int a = 0; a < along.values.size(); ++a)
            {
              const double weight = along.values[a] * across.values[b];
              if (std::abs(weight) > 1e-9)
                weights.push_back({grid.node[(across.first + b) * (grid.n[0] + 1) + along.first + a], weight});
            }
        std::sort(weights.begin(), weights.end(), [](const Weight &a, const Weight &b) {
          return a.node < b.node;
        });
        std::vector<long> key;
        for (const Weight &w : weights)
          {
            key.push_back(w.node);
            key.push_back(std::lround(1e6 * w.weight));
          }
        const auto [known, is_new] = number_of_.emplace(key, result.weights.size());
        if (is_new)
          add(weights);
        return known->second;
      }

      ResampledSurface<dim> result;

    private:
      /// Shape functions along one direction of a grid: values of those of the nodes first, first + 1, ...
      struct Shape
      {
        unsigned int        first;
        std::vector<double> values;
      };

      /// True if a line of a grid, with this number in a direction, runs through the middle of elements.
      bool is_middle_line(const Grid &grid, const unsigned int direction, const unsigned int line) const
      {
        if (owner_.is_middle.empty())
          return false;
        const unsigned int width = grid.n[0] + 1, n = dim == 2 ? 1 : grid.n[1 - direction] + 1;
        for (unsigned int k = 0; k < n; ++k)
          if (!owner_.is_middle[grid.node[direction == 0 ? k * width + line : line * width + k]])
            return false;
        return true;
      }

      /// Linear between two nodes, quadratic over three.
      Shape shape_at(const Grid &grid, const unsigned int direction, const double u) const
      {
        const unsigned int i = std::min<unsigned int>(u, grid.n[direction] - 1);
        for (const unsigned int middle : {i, i + 1})
          if (middle > 0 && middle < grid.n[direction] && is_middle_line(grid, direction, middle) &&
              !is_middle_line(grid, direction, middle - 1) && !is_middle_line(grid, direction, middle + 1))
            {
              const double s = (u - (middle - 1)) / 2;
              return {middle - 1, {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)}};
            }
        return {i, {1 - (u - i), u - i}};
      }

      void add(const std::vector<Weight> &weights)
      {
        Vec<dim> x, v, a, inverse_mass;
        for (const Weight &w : weights)
          {
            x += w.weight * owner_.position[w.node];
            v += w.weight * owner_.velocity[w.node];
            a += w.weight * owner_.acceleration[w.node];
            inverse_mass += w.weight * owner_.inverse_mass[w.node];
          }
        result.weights.push_back(weights);
        result.surface.position.push_back(x);
        result.surface.velocity.push_back(v);
        result.surface.acceleration.push_back(a);
        result.surface.inverse_mass.push_back(inverse_mass);
      }

      const WetSurface<dim>                    &owner_;
      std::map<std::vector<long>, unsigned int> number_of_;
    };
  } // namespace


  template <int dim>
  ResampledSurface<dim> copy_of_surface(const WetSurface<dim> &owner)
  {
    ResampledSurface<dim> result{owner, {}};
    for (unsigned int i = 0; i < owner.position.size(); ++i)
      result.weights.push_back({{i, 1.}});
    return result;
  }


  template <int dim>
  ResampledSurface<dim> resample_surface(const WetSurface<dim> &owner, const double spacing)
  {
    const std::vector<Grid> grids   = Patches<dim>(owner).grids();
    const auto              numbers = numbers_of_facets(owner, grids, spacing);
    NewNodes<dim>           nodes(owner);
    WetSurface<dim>        &surface = nodes.result.surface;
    surface.bodies                  = owner.bodies;
    for (std::size_t g = 0; g < grids.size(); ++g)
      {
        const Grid &grid = grids[g];
        const auto  node = [&](const unsigned int i, const unsigned int j) {
          return nodes.at(grid, static_cast<double>(i) * grid.n[0] / numbers[g][0],
                           static_cast<double>(j) * grid.n[1] / numbers[g][1]);
        };
        for (unsigned int j = 0; j < numbers[g][1]; ++j)
          for (unsigned int i = 0; i < numbers[g][0]; ++i)
            if constexpr (dim == 2)
              surface.facets.push_back({node(i, 0), node(i + 1, 0)});
            else
              surface.facets.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        if (!owner.body_of_facet.empty())
          surface.body_of_facet.resize(surface.facets.size(), owner.body_of_facet[grid.first]);
      }
    return nodes.result;
  }


  template <int dim>
  void share_mass(const WetSurface<dim> &owner, const ResampledSurface<dim> &resampled, const double share,
                  std::vector<double> &carried, std::vector<double> &lent)
  {
    const auto         &weights = resampled.weights;
    std::vector<double> area(weights.size(), 0.), area_of_owner(owner.position.size(), 0.), all(area_of_owner);
    if (resampled.surface.facets.empty())
      area.assign(area.size(), 1.); // points of no extent: they are copies
    for (const auto &facet : resampled.surface.facets)
      for (const unsigned int i : facet)
        area[i] += norm(area_vector<dim>(resampled.surface.position, facet)) / facet.size();
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (const auto &w : weights[i])
        area_of_owner[w.node] += std::abs(w.weight) * area[i];

    // All of the mass by the areas, then as much of it that no node of the owner gives more than it may.
    carried.assign(weights.size(), 0.);
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (const auto &w : weights[i])
        carried[i] += owner.mass[w.node] * std::abs(w.weight) * area[i] / area_of_owner[w.node];
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (const auto &w : weights[i])
        all[w.node] += std::max(0., w.weight) * carried[i];
    lent.assign(owner.position.size(), 0.);
    for (std::size_t i = 0; i < weights.size(); ++i)
      {
        double part = 1;
        for (const auto &w : weights[i])
          if (w.weight > 0)
            part = std::min(part, owner.mass[w.node] / all[w.node]);
        carried[i] *= share * part;
        for (const auto &w : weights[i])
          lent[w.node] += w.weight * carried[i];
      }
  }


  template <int dim>
  double part_that_moves_apart(const WetSurface<dim> &owner, const ResampledSurface<dim> &resampled,
                               const std::vector<double> &carried, const std::vector<double> &lent)
  {
    std::vector<double> diagonal(lent), beside(lent.size(), 0.);
    for (std::size_t i = 0; i < carried.size(); ++i)
      {
        double sum = 0;
        for (const auto &w : resampled.weights[i])
          sum += std::abs(w.weight);
        for (const auto &w : resampled.weights[i])
          if (norm(owner.inverse_mass[w.node]) > 0) // nodes that are held do not move
            {
              diagonal[w.node] -= w.weight * w.weight * carried[i];
              beside[w.node] += std::abs(w.weight) * (sum - std::abs(w.weight)) * carried[i];
            }
      }
    double largest_lent = 0, largest_row = 0;
    for (std::size_t k = 0; k < lent.size(); ++k)
      if (norm(owner.inverse_mass[k]) > 0)
        {
          largest_lent = std::max(largest_lent, lent[k] / owner.mass[k]);
          largest_row  = std::max(largest_row, (std::abs(diagonal[k]) + beside[k]) / owner.mass[k]);
        }
    return std::min(largest_lent, largest_row);
  }


  template <int dim>
  double extent(const std::vector<Vec<dim>> &position)
  {
    Vec<dim> lower = position.front(), upper = position.front();
    for (const Vec<dim> &x : position)
      for (int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
    return norm(upper - lower);
  }


#define BREAKWATER_INSTANTIATE(dim)                                                                                      \
  template ResampledSurface<dim> copy_of_surface<dim>(const WetSurface<dim> &);                                          \
  template ResampledSurface<dim> resample_surface<dim>(const WetSurface<dim> &, double);                                 \
  template void   share_mass<dim>(const WetSurface<dim> &, const ResampledSurface<dim> &, double, std::vector<double> &, \
                                std::vector<double> &);                                                                \
  template double part_that_moves_apart<dim>(const WetSurface<dim> &, const ResampledSurface<dim> &,                     \
                                             const std::vector<double> &, const std::vector<double> &);                  \
  template double extent<dim>(const std::vector<Vec<dim>> &);
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
