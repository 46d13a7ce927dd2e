#include "moved_nodes.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace Breakwater
{
  namespace
  {
    /// Places of a mesh, found by walking from cell to cell.
    template <int dim>
    class PlaceFinder
    {
    public:
      using Cells = std::vector<typename SimplexMesh<dim>::Cell>;

      struct Place
      {
        unsigned int                cell;
        std::array<double, dim + 1> weights; ///< of its corners; they are not negative and add up to 1
      };

      PlaceFinder(const FluidNodes<dim> &nodes, const Cells &cells)
        : nodes_(nodes)
        , cells_(cells)
        , begin_(nodes.n + 1, 0)
        , cell_at_(cells.size() * (dim + 1))
      {
        for (const auto &cell : cells)
          for (const unsigned int i : cell)
            ++begin_[i];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        for (unsigned int c = cells.size(); c-- > 0;)
          for (const unsigned int i : cells[c])
            cell_at_[--begin_[i]] = c;
      }

      /// @param node that is not far from x, and has cells
      Place find(const unsigned int node, const Vec<dim> &x) const
      {
        constexpr unsigned int most_steps = 20;
        Place                  best{cell_at_[begin_[node]], {}};
        double                 least = -std::numeric_limits<double>::infinity();
        for (unsigned int k = begin_[node]; k < begin_[node + 1]; ++k)
          {
            const auto   weights = weights_in(cell_at_[k], x);
            const double smaller = *std::min_element(weights.begin(), weights.end());
            if (smaller > least)
              {
                best  = {cell_at_[k], weights};
                least = smaller;
              }
          }
        for (unsigned int step = 0; step < most_steps && least < 0; ++step)
          {
            const int    across = std::min_element(best.weights.begin(), best.weights.end()) - best.weights.begin();
            unsigned int next   = 0;
            if (!neighbor(best.cell, across, next))
              break;
            best  = {next, weights_in(next, x)};
            least = *std::min_element(best.weights.begin(), best.weights.end());
          }
        double sum = 0;
        for (double &weight : best.weights)
          sum += weight = std::max(weight, 0.);
        for (double &weight : best.weights)
          weight /= sum;
        return best;
      }

    private:
      /// Barycentric coordinates of x, some negative if it is outside; of a flat cell those of its centre.
      std::array<double, dim + 1> weights_in(const unsigned int c, const Vec<dim> &x) const
      {
        std::array<double, dim + 1> weights;
        const Simplex<dim>          corners = nodes_.corners(cells_[c]);
        const Simplex<dim>          area    = area_vectors(corners);
        const double                volume  = signed_volume(corners);
        if (!(volume > 1e-14 * std::pow(norm(area[0]), dim / (dim - 1.))))
          weights.fill(1. / (dim + 1));
        else
          for (int a = 0; a <= dim; ++a)
            weights[a] = dot(area[a], x - corners[a == 0 ? 1 : 0]) / volume;
        return weights;
      }

      bool neighbor(const unsigned int c, const int opposite, unsigned int &found) const
      {
        const auto         facet = outward_facet<dim>(cells_[c], opposite);
        const unsigned int i     = facet[0];
        for (unsigned int k = begin_[i]; k < begin_[i + 1]; ++k)
          {
            const auto &other = cells_[cell_at_[k]];
            const bool  has   = std::all_of(facet.begin(), facet.end(), [&](const unsigned int node) {
              return std::find(other.begin(), other.end(), node) != other.end();
            });
            if (has && cell_at_[k] != c)
              {
                found = cell_at_[k];
                return true;
              }
          }
        return false;
      }

      const FluidNodes<dim>    &nodes_;
      const Cells              &cells_;
      std::vector<unsigned int> begin_, cell_at_;
    };

    /// Two nodes exchange fluid of a mass [kg].
    struct Swap
    {
      unsigned int a, b;
      double       mass;
    };

    template <int dim>
    void carry_out(const std::vector<Swap> &swaps, FluidNodes<dim> &nodes, Walls<dim> &walls)
    {
      std::vector<double> part(nodes.n, 0.);
      for (const Swap &swap : swaps)
        {
          part[swap.a] += swap.mass;
          part[swap.b] += swap.mass;
        }
      for (std::size_t i = 0; i < nodes.n; ++i)
        part[i] = part[i] > nodes.mass[i] ? nodes.mass[i] / part[i] : 1.;
      std::vector<Quad> impulse(nodes.n);
      std::vector<char> is_concerned(nodes.n, 0);
      for (const Swap &swap : swaps)
        {
          const double mass    = swap.mass * std::min(part[swap.a], part[swap.b]);
          is_concerned[swap.a] = is_concerned[swap.b] = 1;
          for (int d = 0; d < dim; ++d)
            {
              const double change = mass * (nodes.v[swap.b][d] - nodes.v[swap.a][d]);
              impulse[swap.a][d] += change;
              impulse[swap.b][d] -= change;
            }
        }
      for (std::size_t i = 0; i < nodes.n; ++i)
        if (is_concerned[i])
          {
            if (!nodes.contacts[i].empty())
              walls.mask_impulse(nodes.xp[i].c, impulse[i].c, nodes.contacts[i]);
            for (int d = 0; d < dim; ++d)
              nodes.v[i][d] += impulse[i][d] / nodes.mass[i];
          }
    }
  } // namespace


  template <int dim>
  std::vector<double> transfer_to_moved_nodes(FluidNodes<dim>                                    &nodes,
                                              const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                              const std::vector<Vec<dim>> &position, Walls<dim> &walls,
                                              const double reference_density)
  {
    std::vector<double>    density = nodes.density;
    const PlaceFinder<dim> finder(nodes, cells);
    std::vector<Swap>      swaps;
    for (std::size_t i = 0; i < nodes.n; ++i)
      if (norm(position[i] - nodes.position(i)) > 0)
        {
          const auto place = finder.find(i, position[i]);
          density[i]       = 0;
          for (int a = 0; a <= dim; ++a)
            {
              // A stretched surface must not drag density into the interior.
              const unsigned int j = cells[place.cell][a];
              density[i] += place.weights[a] *
                            (nodes.is_surface[j] ? std::max(nodes.density[j], reference_density) : nodes.density[j]);
              if (j != i && !nodes.is_driven(j) && nodes.mass[i] > 0)
                swaps.push_back({static_cast<unsigned int>(i), j, place.weights[a] * nodes.mass[i]});
            }
        }
    carry_out(swaps, nodes, walls);
    return density;
  }

  template std::vector<double> transfer_to_moved_nodes<2>(FluidNodes<2> &, const std::vector<SimplexMesh<2>::Cell> &,
                                                          const std::vector<Vec<2>> &, Walls<2> &, double);
  template std::vector<double> transfer_to_moved_nodes<3>(FluidNodes<3> &, const std::vector<SimplexMesh<3>::Cell> &,
                                                          const std::vector<Vec<3>> &, Walls<3> &, double);
} // namespace Breakwater
