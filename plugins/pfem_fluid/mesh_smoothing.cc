#include "alpha_shape.h"
#include "moved_nodes.h"
#include "pfem_fluid.h"
#include "remesh_record.h"

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
    unsmoothed_mesh_                       = mesh_;
    const std::vector<Vec<dim>>    before  = position;
    const std::vector<NodeFreedom> freedom = freedom_of_nodes();
    SmoothingReport               &report  = record.smoothing;
    for (std::size_t s = 0; s < parameters_.mesh_smoothers.size(); ++s)
      {
        const SmoothingReport one = parameters_.mesh_smoothers[s].smooth(
          mesh_, position, {freedom, parameters_.spacing, parameters_.smoothing_target});
        report.n_flips += one.n_flips;
        report.n_peeled_cells += one.n_peeled_cells;
        report.peeled_volume += one.peeled_volume;
        report.volume_change += one.volume_change;
      }
    measure_moves(before, position, report);
    order_cells<dim>(mesh_.cells, nodes_.n);
    move_to_smoothed(position);
    report.seconds       = timer.seconds();
    record.quality_after = mesh_quality<dim>(mesh_, position, parameters_.spacing);
  }


  template <int dim>
  std::vector<NodeFreedom> PfemFluid<dim>::freedom_of_nodes()
  {
    classify_nodes();
    std::vector<NodeFreedom> freedom(nodes_.n, NodeFreedom::fixed);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        if (nodes_.is_driven(i) || !nodes_.has_cells[i])
          continue;
        const Contacts &walls = nodes_.walls[i];
        // The area vector of a node on one flat wall, away from the surface, is the wall's normal.
        const bool is_on_one_plane =
          std::distance(walls.begin(), walls.end()) == 1 && !parameters_.walls.is_curved(walls);
        if (walls.empty())
          freedom[i] = nodes_.is_surface[i] ? NodeFreedom::slides_on_surface : NodeFreedom::free;
        else if (is_on_one_plane && !nodes_.is_surface[i])
          freedom[i] = NodeFreedom::slides_on_wall;
      }
    return freedom;
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
