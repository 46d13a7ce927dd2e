#include "alpha_shape.h"
#include "moved_nodes.h"
#include "pfem_fluid.h"
#include "remesh_record.h"
#include "wall_surface.h"

#include <breakwater/mesh/volume_operator.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

// A new mesh is smoothed: what may move, and what the nodes carry along.

namespace Breakwater
{
  template <int dim>
  void PfemFluid<dim>::smooth_mesh(RemeshRecord &record)
  {
    std::vector<Vec<dim>> position = nodes_.positions();
    record.quality_before = record.quality_after = mesh_quality<dim>(mesh_, position, parameters_.spacing);
    if (parameters_.mesh_smoothers.empty())
      return;

    record.spectral_bound_before = spectral_bound_of_unsmoothed();
    PhaseTimer timer(*context_, Phase::smoothing);
    unsmoothed_mesh_                      = mesh_;
    const std::vector<Vec<dim>>    before = position;
    std::vector<Vec<dim>>          wall_normal;
    const std::vector<NodeFreedom> freedom = freedom_of_nodes(wall_normal);
    SmoothingReport               &report  = record.smoothing;
    for (std::size_t s = 0; s < parameters_.mesh_smoothers.size(); ++s)
      {
        const SmoothingReport one = parameters_.mesh_smoothers[s].smooth(
          mesh_, position, {freedom, wall_normal, parameters_.spacing, parameters_.smoothing_target});
        report.n_flips += one.n_flips;
        report.n_peeled_cells += one.n_peeled_cells;
        report.peeled_volume += one.peeled_volume;
        report.volume_change += one.volume_change;
      }
    measure_moves(before, position, report);
    order_cells<dim>(mesh_.cells, nodes_.n);
    move_to_smoothed(position);
    report.seconds       = timer.seconds();
    record.quality_after = mesh_quality<dim>(mesh_, nodes_.positions(), parameters_.spacing);
  }


  template <int dim>
  std::vector<NodeFreedom> PfemFluid<dim>::freedom_of_nodes(std::vector<Vec<dim>> &wall_normal)
  {
    classify_nodes();
    find_wall_normals(wall_normal);
    std::vector<NodeFreedom> freedom(nodes_.n, NodeFreedom::fixed);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const Contacts &walls = nodes_.walls[i];
        if (nodes_.is_driven(i) || !nodes_.has_cells[i] || parameters_.walls.is_curved(walls))
          continue;
        const bool is_surface = nodes_.is_surface[i];
        const auto n_walls    = std::distance(walls.begin(), walls.end());
        if (n_walls == 0)
          freedom[i] = is_surface ? NodeFreedom::slides_on_surface : NodeFreedom::free;
        else if (n_walls == 1 && !is_surface)
          freedom[i] = NodeFreedom::slides_on_wall;
        else if (n_walls + is_surface == 2 && norm(wall_normal[i]) > 0)
          freedom[i] = NodeFreedom::slides_on_line;
      }
    return freedom;
  }


  // From the facets that the first of a node's walls closes.
  template <int dim>
  void PfemFluid<dim>::find_wall_normals(std::vector<Vec<dim>> &normal) const
  {
    normal.assign(nodes_.n, {});
    for (const auto &facet : mesh_.boundary)
      {
        Contacts                  shared = nodes_.walls[facet[0]];
        std::array<Vec<dim>, dim> x;
        for (int a = 0; a < dim; ++a)
          {
            shared = common(shared, nodes_.walls[facet[a]]);
            x[a]   = nodes_.position(facet[a]);
          }
        for (const unsigned int i : facet)
          if (!shared.empty() && shared.has(*nodes_.walls[i].begin()))
            normal[i] += area_vector<dim>(x);
      }
    for (Vec<dim> &n : normal)
      if (const double length = norm(n); length > 0)
        n *= 1. / length;
  }


  template <int dim>
  void PfemFluid<dim>::move_to_smoothed(const std::vector<Vec<dim>> &position)
  {
    Walls<dim> &walls = parameters_.walls;
    nodes_.density    = transfer_to_moved_nodes<dim>(nodes_, unsmoothed_mesh_.cells, position, walls,
                                                  parameters_.equation_of_state.front().reference_density());
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const Vec<dim> before = nodes_.position(i);
        if (norm(position[i] - before) > 0)
          {
            for (int d = 0; d < dim; ++d)
              nodes_.xp[i][d] = position[i][d];
            Quad unused;
            walls.stop(before, nodes_.xp[i].c, unused.c, 0., nodes_.contacts[i]);
          }
      }
    nodes_.position_at_remesh = nodes_.xp;
    collect_curved_facets();
  }


  // As set_references() will find it after smoothing.
  template <int dim>
  double PfemFluid<dim>::spectral_bound_of_unsmoothed()
  {
    update_volumes();
    std::vector<double> inertia(nodes_.n);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      inertia[i] = nodes_.inertia(i);
    const std::vector<double> row_sums = volume_operator_row_sums(mesh_, nodes_.positions(), inertia);
    double                    largest  = 0;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const double c = parameters_.equation_of_state.front().sound_speed(nodes_.density[i]);
        largest        = std::max(largest, nodes_.density[i] * c * c / softened_volume(i, row_sums[i]) * row_sums[i]);
      }
    return largest > 0 ? 2. / std::sqrt(largest) : std::numeric_limits<double>::infinity();
  }

  template void PfemFluid<2>::smooth_mesh(RemeshRecord &);
  template void PfemFluid<3>::smooth_mesh(RemeshRecord &);
} // namespace Breakwater
