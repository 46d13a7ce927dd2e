#include "alpha_shape.h"
#include "moved_nodes.h"
#include "pfem_fluid.h"
#include "remesh_record.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

// A new mesh is smoothed: what may move, and what the nodes carry along.

namespace Breakwater
{
  namespace
  {
    /// Makes the normal of a wall the direction of its edge with another. @return false if they are parallel
    bool make_direction(Vec<2> &, const Vec<2> &)
    {
      return true;
    }
    bool make_direction(Vec<3> &normal, const Vec<3> &other)
    {
      normal              = cross(normal, other);
      const double length = norm(normal);
      normal *= length > 0 ? 1. / length : 0.;
      return length > 0.1;
    }

    template <int dim>
    std::vector<char> are_on_boundary(const SimplexMesh<dim> &mesh, const std::size_t n_nodes)
    {
      std::vector<char> result(n_nodes, 0);
      for (const auto &facet : mesh.boundary)
        for (const unsigned int i : facet)
          result[i] = 1;
      return result;
    }
  } // namespace


  template <int dim>
  void PfemFluid<dim>::smooth_mesh(RemeshRecord &record)
  {
    std::vector<Vec<dim>> position = nodes_.positions();
    record.quality_before = record.quality_after = quality();
    if (parameters_.mesh_smoothers.empty())
      return;

    // It costs as much as the smoothing of calm flow and hardly changes: it is measured now and then.
    constexpr unsigned int n_between = 10;
    if (n_remeshes_ % n_between == 0)
      unsmoothed_bound_ = spectral_bound_of_unsmoothed();
    PhaseTimer timer(*context_, Phase::smoothing);
    unsmoothed_mesh_                      = mesh_;
    const std::vector<Vec<dim>>    before = position;
    std::vector<Vec<dim>>          wall_normal;
    const std::vector<NodeFreedom> freedom      = freedom_of_nodes(wall_normal);
    SmoothingReport               &report       = record.smoothing;
    const auto                     is_reachable = [&](const unsigned int i, const Vec<dim> &x) {
      Vec<dim> place   = x;
      Contacts unnoted = nodes_.contacts[i];
      Quad     unused;
      parameters_.walls.stop(before[i], place.c, unused.c, 0., unnoted);
      return norm(place - x) <= 1e-5 * parameters_.spacing;
    };
    for (std::size_t s = 0; s < parameters_.mesh_smoothers.size(); ++s)
      {
        const SmoothingReport one = parameters_.mesh_smoothers[s].smooth(
          mesh_, position, {freedom, wall_normal, parameters_.spacing, parameters_.smoothing_target, is_reachable});
        report.add(one);
      }
    measure_moves(before, position, report);
    order_cells<dim>(mesh_.cells, nodes_.n);
    move_to_smoothed(position);
    report.seconds       = timer.seconds();
    record.quality_after = quality();
  }


  template <int dim>
  QualityReport PfemFluid<dim>::quality() const
  {
    std::vector<double> radii(mesh_.cells.size());
    if (!radii.empty())
      element_passes<dim>().insphere_radii(mesh_.cells.front().data(), radii.size(), nodes_.xp.data(), radii.data());
    return quality_report<dim>(radii, parameters_.spacing);
  }


  template <int dim>
  std::vector<NodeFreedom> PfemFluid<dim>::freedom_of_nodes(std::vector<Vec<dim>> &wall_normal)
  {
    classify_nodes();
    wall_normal.assign(nodes_.n, {});
    const auto normal_of = [this](const unsigned int n, const std::size_t i) { // of a flat wall
      Vec<dim> normal;
      parameters_.walls.normal_at(*(nodes_.walls[i].begin() + n), nodes_.position(i), normal);
      return normal;
    };
    const std::vector<char>  is_on_boundary = are_on_boundary(mesh_, nodes_.n);
    std::vector<NodeFreedom> freedom(nodes_.n, NodeFreedom::fixed);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const Contacts &walls = nodes_.walls[i];
        if (nodes_.is_driven(i) || !nodes_.has_cells[i] || parameters_.walls.is_curved(walls))
          continue;
        const bool is_surface = nodes_.is_surface[i];
        const auto n_walls    = std::distance(walls.begin(), walls.end());
        if (n_walls == 0 || !is_on_boundary[i]) // close to a wall that others cover
          freedom[i] = is_surface ? NodeFreedom::slides_on_surface : NodeFreedom::free;
        else if (n_walls <= 2)
          {
            wall_normal[i] = normal_of(0, i);
            if (n_walls == 1)
              freedom[i] = is_surface ? NodeFreedom::slides_on_line : NodeFreedom::slides_on_wall;
            else if (make_direction(wall_normal[i], normal_of(1, i)))
              freedom[i] = is_surface ? NodeFreedom::ends_on_edge : NodeFreedom::slides_on_edge;
          }
      }
    return freedom;
  }


  template <int dim>
  void PfemFluid<dim>::move_to_smoothed(const std::vector<Vec<dim>> &position)
  {
    Walls<dim> &walls = parameters_.walls;
    nodes_.density    = transfer_to_moved_nodes<dim>(nodes_, unsmoothed_mesh_.cells, position, walls,
                                                  parameters_.equation_of_state.front().reference_density());
    const std::vector<char> was_on_boundary = are_on_boundary(unsmoothed_mesh_, nodes_.n);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const Vec<dim> before = nodes_.position(i);
        if (norm(position[i] - before) > 0)
          {
            if (!was_on_boundary[i]) // it was close to a wall at most
              nodes_.contacts[i] = nodes_.walls[i] = {};
            for (int d = 0; d < dim; ++d)
              nodes_.xp[i][d] = position[i][d];
            Quad unused;
            walls.stop(before, nodes_.xp[i].c, unused.c, 0., nodes_.contacts[i]);
          }
      }
    nodes_.position_at_remesh = nodes_.xp;
    collect_curved_facets();
    collect_interface_cells();
    collect_rim_facets();
  }


  // As set_references() will find it after smoothing.
  template <int dim>
  double PfemFluid<dim>::spectral_bound_of_unsmoothed()
  {
    update_volumes();
    const NodePairs<dim>      pairs(nodes_, mesh_.cells);
    const std::vector<double> row_sums = pairs.row_sums(inertias());
    const std::vector<double> volume   = softened_volumes(pairs, row_sums);
    double                    largest  = 0;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const double c = parameters_.equation_of_state.front().sound_speed(nodes_.density[i]);
        largest        = std::max(largest, nodes_.density[i] * c * c / volume[i] * row_sums[i]);
      }
    return largest > 0 ? 2. / std::sqrt(largest) : std::numeric_limits<double>::infinity();
  }

  template void PfemFluid<2>::smooth_mesh(RemeshRecord &);
  template void PfemFluid<3>::smooth_mesh(RemeshRecord &);
} // namespace Breakwater
