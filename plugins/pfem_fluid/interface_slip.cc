#include "interface_slip.h"

#include <breakwater/mesh/area_vector.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Breakwater
{
  namespace
  {
    /// Adds what of a vector is at right angles to the directions so far, unless that is almost nothing.
    template <int dim>
    void add_direction(std::array<Vec<dim>, dim> &direction, unsigned int &n, Vec<dim> e)
    {
      constexpr double least = 0.1;
      const double     whole = norm(e);
      for (unsigned int k = 0; k < n; ++k)
        e -= dot(e, direction[k]) * direction[k];
      if (n < dim && norm(e) > least * whole)
        direction[n++] = e * (1 / norm(e));
    }
  } // namespace


  template <int dim>
  void InterfaceSlip<dim>::set_up(const WetSurface<dim> &surface, const std::vector<char> &slips)
  {
    const double smooth = std::cos(40 * M_PI / 180);
    pieces_.assign(surface.position.size(), {});
    sticks_.assign(pieces_.size(), 0);
    std::vector<std::vector<Vec<dim>>> normal(pieces_.size());
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
      for (const unsigned int i : surface.facets[f])
        {
          const Facet   &facet = surface.facets[f];
          const Vec<dim> area  = area_vector<dim>(surface.position, facet);
          std::size_t    piece = 0;
          sticks_[i]           = sticks_[i] || !slips[f];
          while (piece < normal[i].size() && dot(normal[i][piece], area) < smooth * norm(area) * norm(normal[i][piece]))
            ++piece;
          if (piece == normal[i].size())
            {
              normal[i].emplace_back();
              pieces_[i].emplace_back();
            }
          normal[i][piece] += area;
          pieces_[i][piece].push_back(facet);
        }
    begin_.assign(pieces_.size() + 1, 0);
    taken_.assign(pieces_.size(), {});
    direction_.assign(pieces_.size(), {});
    n_directions_.assign(pieces_.size(), dim);
  }


  template <int dim>
  void InterfaceSlip<dim>::find_neighbours(const FluidNodes<dim> &nodes, const Cells &cells)
  {
    std::vector<std::map<unsigned int, double>> share(pieces_.size());
    cells_.clear();
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (*std::min_element(cells[c].begin(), cells[c].end()) < nodes.n_interface)
        {
          const auto &cell = cells[c];
          cells_.push_back(c);
          std::vector<unsigned int> takers;
          for (const unsigned int j : cell)
            if (!nodes.is_driven(j))
              takers.push_back(j);
          const double volume = signed_volume(nodes.corners(cell));
          for (const unsigned int i : cell)
            if (i < nodes.n_interface && volume > 0)
              for (const unsigned int j : takers)
                share[i][j] += volume / takers.size();
        }
    begin_.assign(1, 0);
    neighbour_.clear();
    weight_.clear();
    for (const auto &shares : share)
      {
        double sum = 0;
        for (const auto &[j, volume] : shares)
          sum += volume;
        for (const auto &[j, volume] : shares)
          {
            neighbour_.push_back(j);
            weight_.push_back(volume / sum);
          }
        begin_.push_back(neighbour_.size());
      }
  }


  template <int dim>
  void InterfaceSlip<dim>::update_directions(const FluidNodes<dim> &nodes, const Walls<dim> &walls)
  {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      {
        n_directions_[i] = sticks_[i] ? dim : 0;
        if (sticks_[i])
          continue;
        for (const auto &piece : pieces_[i])
          {
            Vec<dim> normal;
            for (const Facet &facet : piece)
              {
                std::array<Vec<dim>, WetSurface<dim>::nodes_per_facet> corner;
                for (std::size_t k = 0; k < corner.size(); ++k)
                  corner[k] = nodes.position(facet[k]);
                normal += area_vector<dim>(corner);
              }
            add_direction<dim>(direction_[i], n_directions_[i], normal);
          }
        if (nodes.walls[i].empty())
          continue;
        for (int d = 0; d < dim; ++d)
          {
            Vec<dim> e, left;
            e[d] = left[d] = 1;
            walls.mask(nodes.xp[i].c, left.c, nodes.walls[i]);
            if (norm(e - left) > 0.3) // of the three, one points into the wall by more than half
              add_direction<dim>(direction_[i], n_directions_[i], e - left);
          }
      }
  }


  template <int dim>
  Vec<dim> InterfaceSlip<dim>::along(const std::size_t i, const Vec<dim> &vector) const
  {
    Vec<dim> result = vector;
    for (unsigned int k = 0; k < n_directions_[i]; ++k)
      result -= dot(vector, direction_[i][k]) * direction_[i][k];
    return n_directions_[i] == dim ? Vec<dim>() : result;
  }


  template <int dim>
  void InterfaceSlip<dim>::add_slip(FluidNodes<dim> &nodes)
  {
    own_velocity_.resize(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      {
        own_velocity_[i] = nodes.velocity(i);
        if (begin_[i] == begin_[i + 1])
          continue;
        Vec<dim> slip = -1. * own_velocity_[i];
        for (unsigned int k = begin_[i]; k < begin_[i + 1]; ++k)
          slip += weight_[k] * nodes.velocity(neighbour_[k]);
        slip = along(i, slip);
        for (int d = 0; d < dim; ++d)
          nodes.v[i][d] += slip[d];
      }
  }


  template <int dim>
  void InterfaceSlip<dim>::take_slip_back(FluidNodes<dim> &nodes) const
  {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (int d = 0; d < dim; ++d)
        nodes.v[i][d] = own_velocity_[i][d];
  }


  // The viscous part is what the pressure leaves, see compute_forces().
  template <int dim>
  void InterfaceSlip<dim>::pass_viscous_forces_on(FluidNodes<dim> &nodes, const Cells &cells,
                                                  const ForceEffects &effects) const
  {
    std::vector<Vec<dim>> viscous(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      viscous[i] = FluidNodes<dim>::vec(nodes.force[i]);
    for (const unsigned int c : cells_)
      {
        const Simplex<dim> x        = nodes.corners(cells[c]);
        const Simplex<dim> area     = area_vectors(x);
        double             pressure = 0;
        for (const unsigned int i : cells[c])
          pressure += nodes.xp[i][3] / (dim + 1);
        if (effects.cell_stiffness > 0)
          pressure -= effects.cell_stiffness * (signed_volume(x) - effects.cell_volume_at_rest[c]) /
                      std::max(effects.cell_volume_at_rest[c], effects.least_cell_volume);
        for (int a = 0; a <= dim; ++a)
          if (cells[c][a] < viscous.size())
            viscous[cells[c][a]] -= pressure * area[a];
      }
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (begin_[i] < begin_[i + 1])
        {
          const Vec<dim> force = along(i, viscous[i]);
          for (int d = 0; d < dim; ++d)
            {
              nodes.force[i][d] -= force[d];
              for (unsigned int k = begin_[i]; k < begin_[i + 1]; ++k)
                nodes.force[neighbour_[k]][d] += weight_[k] * force[d];
            }
        }
  }


  template <int dim>
  void InterfaceSlip<dim>::take_forces_along(FluidNodes<dim> &nodes, const std::vector<Vec<dim>> &gravity)
  {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      {
        const Vec<dim> weight = nodes.mass[i] * gravity[gravity.size() == 1 ? 0 : i];
        taken_[i]             = along(i, FluidNodes<dim>::vec(nodes.force[i]) + weight);
        for (int d = 0; d < dim; ++d)
          nodes.force[i][d] -= taken_[i][d];
      }
  }


  template class InterfaceSlip<2>;
  template class InterfaceSlip<3>;
} // namespace Breakwater
