#include "alpha_shape.h"
#include "fluid_cells.h"
#include "mass_exchange.h"
#include "node_pairs.h"
#include "pfem_fluid.h"
#include "remesh_record.h"
#include "volume_conservation.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace Breakwater
{
  template <int dim>
  void PfemFluid<dim>::remesh()
  {
    PhaseTimer         timer(*context_, Phase::remeshing);
    const double       reference_density = parameters_.equation_of_state.front().reference_density();
    const auto         link_force        = interface_link_force();
    const std::size_t  n_entered         = let_in();
    DomainBalance<dim> before            = balance();
    RemeshRecord       record;

    const Vec<3> angular_momentum_before = nodes_.angular_momentum();
    // Volumes and pressures belong to the present positions: advance_free() left them so.
    correct_volumes(own_energy(before), record);
    shift_to_centroids();
    adopted_.update_normals();
    // A node on a facet between two nodes of a body has hardly a volume, and nothing keeps it from passing through.
    constexpr double        clearance = 0.25;
    std::vector<Vec<dim>>   impulse(nodes_.n_interface);
    const std::vector<Quad> before_push = nodes_.xp;
    record.n_pushed_out = adopted_.push_out(nodes_, 2 * parameters_.spacing, clearance * parameters_.spacing, impulse);
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      {
        Vec<dim> x_old;
        std::copy_n(before_push[i].c, dim, x_old.c);
        if (norm(nodes_.position(i) - x_old) > 0) // not through a wall
          n_wall_stops_ +=
            parameters_.walls.stop(x_old, nodes_.xp[i].c, nodes_.v[i].c, nodes_.mass[i], nodes_.contacts[i]);
      }
    n_pushed_out_ += record.n_pushed_out;

    const double volume_before = mesh_volume();
    record.node_changes = manage_nodes<dim>(nodes_, mesh_.cells, parameters_.size, parameters_.walls, reference_density,
                                            parameters_.node_limits);
    const bool has_left = let_out(before);
    if (n_remeshes_ % 20 == 19 || n_entered > 0 || has_left)
      sort_nodes();
    parameters_.openings.find_driven(nodes_);
    {
      PhaseTimer triangulation_timer(*context_, Phase::remeshing);
      record.triangulation         = triangulate();
      record.triangulation_seconds = triangulation_timer.seconds();
    }
    smooth_mesh(record);

    PhaseTimer transfer_timer(*context_, Phase::remeshing);
    update_volumes();
    classify_nodes();
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        // A stretched surface must not drag density into the interior when it closes.
        const bool at_surface  = nodes_.is_surface[i] || !nodes_.has_cells[i];
        nodes_.base_density[i] = at_surface ? std::max(nodes_.density[i], reference_density) : nodes_.density[i];
        nodes_.density[i]      = nodes_.base_density[i];
      }
    const NodePairs<dim> pairs(nodes_, mesh_.cells);
    exchange(pairs, record);
    find_slip_neighbours();
    set_references(pairs);
    update_pressure();

    update_forces();
    accelerate(0);
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      for (int d = 0; d < dim; ++d)
        nodes_.a[i][d] += link_force[i][d] / nodes_.inertia(i);
    if (record.n_pushed_out > 0)
      contact_impulse_ = impulse;
    refresh_surface();

    ++n_remeshes_;
    ++context_->n_remeshes;
    n_steps_to_check_              = 2;
    const auto after               = balance();
    energy_after_remesh_           = own_energy(after);
    record.transfer_seconds        = transfer_timer.seconds();
    record.volume_made             = std::accumulate(nodes_.volume.begin(), nodes_.volume.end(), 0.) - volume_before;
    record.angular_momentum_change = nodes_.angular_momentum() - angular_momentum_before;
    add_remeshing_row(record, before, after);
    check_remesh(record, before, after);
  }


  // M a - F - m g: what other bodies do [N]. A remesh changes F, not this.
  template <int dim>
  std::vector<Vec<dim>> PfemFluid<dim>::interface_link_force() const
  {
    std::vector<Vec<dim>> force(nodes_.n_interface);
    for (std::size_t i = 0; i < force.size(); ++i)
      for (int d = 0; d < dim; ++d)
        force[i][d] = nodes_.inertia(i) * nodes_.a[i][d] - nodes_.force[i][d] -
                      nodes_.mass[i] * body_acceleration_[body_force_is_uniform_ ? 0 : i][d];
    return force;
  }


  template <int dim>
  void PfemFluid<dim>::find_slip_neighbours()
  {
    if (!slip_.is_on())
      return;
    slip_.find_neighbours(nodes_, mesh_.cells);
    slip_.update_directions(nodes_, parameters_.walls);
  }


  template <int dim>
  std::size_t PfemFluid<dim>::let_in()
  {
    const std::size_t n_entered = parameters_.openings.add_layers(nodes_, time_);
    for (std::size_t i = nodes_.n - n_entered; i < nodes_.n; ++i)
      received_ += node_balance(i);
    return n_entered;
  }


  template <int dim>
  bool PfemFluid<dim>::let_out(DomainBalance<dim> &before)
  {
    const std::vector<char> leaves = parameters_.openings.take_leaving(nodes_);
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (leaves[i])
        {
          received_ -= node_balance(i);
          before -= node_balance(i);
        }
    if (!leaves.empty())
      nodes_.remove(leaves);
    return !leaves.empty();
  }


  template <int dim>
  typename DelaunayMesh<dim>::Report PfemFluid<dim>::triangulate(
    const std::function<bool(const typename SimplexMesh<dim>::Cell &)> &is_inside)
  {
    const std::vector<Vec<dim>> position = nodes_.positions();
    // A smoother can't cure what lies between a wall and a node of the surface that stands hardly off it.
    const double at_wall = (parameters_.mesh_smoothers.empty() ? 0.01 : 0.05) * parameters_.spacing;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      nodes_.walls[i] = parameters_.walls.faces_at(position[i], at_wall);

    std::vector<unsigned int> numbers(nodes_.n);
    std::iota(numbers.begin(), numbers.end(), 0u);
    if (triangulation_.n_nodes() > 0 && nodes_.number_in_triangulation != numbers)
      triangulation_.renumber(nodes_.number_in_triangulation);
    const auto report = triangulation_.update(position);

    const FormerFluid<dim> former(parameters_.mesh_smoothers.empty() ? std::move(mesh_) : unsmoothed_mesh_,
                                  nodes_.number_in_triangulation);
    const FluidCells<dim> fluid(nodes_, parameters_, adopted_, former, is_inside);
    const auto            keep = [&](const auto &cell) {
      return fluid.keeps(cell);
    };
    const auto is_small = [&](const auto &cell, const double circumradius) {
      return fluid.is_small(cell, circumradius);
    };
    std::vector<typename SimplexMesh<dim>::Cell> gaps;
    mesh_ = alpha_shape<dim>(triangulation_, parameters_.alpha * parameters_.spacing, keep, is_small, &gaps);
    gaps_ = Gaps<dim>(gaps, nodes_.n, nodes_.n_interface);
    nodes_.number_in_triangulation = numbers;
    nodes_.position_at_remesh      = nodes_.xp;
    parameters_.walls.note_remesh();
    collect_curved_facets();
    collect_interface_cells();
    collect_rim_facets();
    return report;
  }


  template <int dim>
  void PfemFluid<dim>::classify_nodes()
  {
    std::fill(nodes_.has_cells.begin(), nodes_.has_cells.end(), 0);
    std::fill(nodes_.is_surface.begin(), nodes_.is_surface.end(), 0);
    const Walls<dim> &walls    = parameters_.walls;
    const bool        has_slip = walls.any_has_navier_slip();
    if (has_slip)
      nodes_.slip_conductance.assign(nodes_.n, 0.);
    for (const auto &cell : mesh_.cells)
      for (const unsigned int i : cell)
        nodes_.has_cells[i] = 1;
    for (const auto &facet : mesh_.boundary)
      {
        Contacts                  shared       = nodes_.walls[facet[0]];
        bool                      is_interface = true;
        std::array<Vec<dim>, dim> corner;
        for (int a = 0; a < dim; ++a)
          {
            const unsigned int i = facet[a];
            shared               = common(shared, nodes_.walls[i]);
            is_interface         = is_interface && i < nodes_.n_interface;
            corner[a]            = nodes_.position(i);
          }
        const bool is_at_wall = !shared.empty() && walls.close(shared, corner);
        if (!is_at_wall && !is_interface)
          for (const unsigned int i : facet)
            nodes_.is_surface[i] = 1;
        if (is_at_wall && has_slip)
          for (const unsigned int i : facet)
            nodes_.slip_conductance[i] += walls.slip_conductance(shared, corner) / dim;
      }
  }


  template <int dim>
  void PfemFluid<dim>::correct_volumes(const double energy, RemeshRecord &record)
  {
    const std::vector<Quad> shift = volume_correction<dim>(
      nodes_, mesh_.cells, parameters_.walls, parameters_.equation_of_state.front().reference_density(),
      parameters_.spacing, parameters_.correction_weight, parameters_.correction_iterations);
    if (shift.empty())
      return;

    // Lifting fluid costs energy: no more than what has been dissipated since the last remesh.
    double cost = 0;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        const Vec<dim> x = nodes_.position(i), moved = x + FluidNodes<dim>::vec(shift[i]);
        for (const auto &force : *body_forces_)
          cost += nodes_.mass[i] * (force->potential(moved) - force->potential(x));
      }
    const double dissipated = energy_after_remesh_ - energy;
    const double scale      = cost > 0 ? std::clamp(dissipated / cost, 0., 1.) : 1.;
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      {
        if (nodes_.is_driven(i))
          continue;
        const Vec<dim> x = nodes_.position(i);
        for (int d = 0; d < dim; ++d)
          nodes_.xp[i][d] += scale * shift[i][d];
        Quad unused;
        parameters_.walls.stop(x, nodes_.xp[i].c, unused.c, 0., nodes_.contacts[i]);
      }
    record.correction_scale = scale;
  }


  template <int dim>
  void PfemFluid<dim>::exchange(const NodePairs<dim> &pairs, RemeshRecord &record)
  {
    /// Work that the far exchange may do at a remesh: what lifts the fluid by this part of a spacing.
    constexpr double    allowed_lift = 1e-4;
    std::vector<double> potential(nodes_.n, 0.);
    double              mass = 0;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        mass += nodes_.mass[i];
        for (const auto &force : *body_forces_)
          potential[i] += force->potential(nodes_.position(i));
      }
    // In a splash hardly anything goes far: it is tried now and then.
    ExchangeControl control = parameters_.exchange;
    if (far_part_ < 0.3 && n_remeshes_ % 4 != 0)
      control.far_reach = 0;
    record.exchange = exchange_mass<dim>(
      nodes_, mesh_.cells, pairs, potential, allowed_lift * parameters_.spacing * mass * largest_body_acceleration(),
      parameters_.equation_of_state.front().reference_density(), parameters_.spacing, control);
    if (control.far_reach > 0)
      far_part_ = record.exchange.far_part;
  }


  template <int dim>
  void PfemFluid<dim>::shift_to_centroids()
  {
    if (!(parameters_.centroid_shift > 0))
      return;
    std::vector<Quad> moment(nodes_.n); // of the cells around: sum of V x, and of V in the fourth component
    for (const auto &cell : mesh_.cells)
      {
        const Simplex<dim> x      = nodes_.corners(cell);
        const double       volume = std::abs(signed_volume(x));
        Vec<dim>           center;
        for (const Vec<dim> &corner : x)
          center += corner * (1. / (dim + 1));
        for (const unsigned int i : cell)
          {
            for (int d = 0; d < dim; ++d)
              moment[i][d] += volume * center[d];
            moment[i][3] += volume;
          }
      }
    const double largest = 0.1 * parameters_.spacing;
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      if (nodes_.has_cells[i] && !nodes_.is_surface[i] && !nodes_.is_driven(i) && nodes_.contacts[i].empty() &&
          nodes_.walls[i].empty())
        {
          Vec<dim> shift;
          for (int d = 0; d < dim; ++d)
            shift[d] = parameters_.centroid_shift * (moment[i][d] / moment[i][3] - nodes_.xp[i][d]);
          const double length = norm(shift);
          if (length > largest)
            shift *= largest / length;
          const Vec<dim> x = nodes_.position(i);
          for (int d = 0; d < dim; ++d)
            nodes_.xp[i][d] += shift[d];
          if (parameters_.walls.any_has_surface())
            {
              Quad unused;
              parameters_.walls.stop(x, nodes_.xp[i].c, unused.c, 0., nodes_.contacts[i]);
            }
        }
  }


  template <int dim>
  void PfemFluid<dim>::sort_nodes()
  {
    std::vector<Vec<dim>> position = nodes_.positions();
    position.erase(position.begin(), position.begin() + nodes_.n_interface);
    std::vector<unsigned int> order(nodes_.n_interface);
    std::iota(order.begin(), order.end(), 0u);
    for (const unsigned int i : hilbert_order(position))
      order.push_back(nodes_.n_interface + i);

    const auto permute = [&](auto &values) {
      const auto old = values;
      for (std::size_t k = 0; k < order.size(); ++k)
        values[k] = old[order[k]];
    };
    nodes_.visit_carried(permute);
  }


  template <int dim>
  void PfemFluid<dim>::set_references(const NodePairs<dim> &pairs)
  {
    const EquationOfState      &state    = parameters_.equation_of_state.front();
    const std::vector<double>   inertia  = inertias();
    const std::vector<Vec<dim>> position = nodes_.positions();
    const std::vector<double>   row_sums = pairs.row_sums(inertia);
    nodes_.stiffness_volume              = softened_volumes(pairs, row_sums);

    n_softened_    = 0;
    double largest = 0; // of W_i b_i, the squared nodal frequencies
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        nodes_.reference_volume[i] = nodes_.volume[i];
        n_softened_ += nodes_.stiffness_volume[i] > stiffest_volume(i);
        const double c              = state.sound_speed(nodes_.base_density[i]);
        nodes_.hydrostatic_slope[i] = nodes_.base_density[i] / (c * c);
        largest = std::max(largest, nodes_.base_density[i] * c * c / nodes_.stiffness_volume[i] * row_sums[i]);
      }
    spectral_bound_ = largest > 0 ? 2. / std::sqrt(largest) : std::numeric_limits<double>::infinity();
    update_time_step_bound(position, inertia, row_sums);
    set_cell_stiffness();
  }


  template <int dim>
  std::vector<double> PfemFluid<dim>::inertias() const
  {
    std::vector<double> result(nodes_.n);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      result[i] = nodes_.inertia(i);
    return result;
  }


  template <int dim>
  double PfemFluid<dim>::stiffest_volume(const std::size_t i) const
  {
    return std::max(nodes_.volume[i], 0.1 * regular_volume<dim>(parameters_.spacing));
  }


  // Light nodes of the fluid bear no pressure to speak of: the surface is near. Those of a light structure bear all that
  // the fluid presses with. Softened as much they would let it sink into the fluid, and as what the softened nodes store
  // is much of the energy then, each remesh, which chooses anew who is softened, would make some.
  template <int dim>
  std::vector<double> PfemFluid<dim>::softened_volumes(const NodePairs<dim>      &pairs,
                                                       const std::vector<double> &row_sums) const
  {
    const double h      = parameters_.spacing;
    const double factor = parameters_.equation_of_state.front().reference_density() * h * h / parameters_.softening;
    std::vector<double> inertia = inertias();
    std::fill_n(inertia.begin(), nodes_.n_interface, 0.);
    std::vector<double> result = nodes_.n_interface > 0 ? pairs.row_sums(inertia) : row_sums;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      result[i] = std::max(std::max(stiffest_volume(i), factor * result[i]),
                           std::min(parameters_.softening_at_structures * stiffest_volume(i), factor * row_sums[i]));
    return result;
  }


  template <int dim>
  double PfemFluid<dim>::largest_body_acceleration() const
  {
    double largest = 0;
    for (const Vec<dim> &acceleration : body_acceleration_)
      largest = std::max(largest, norm(acceleration));
    return largest;
  }


  template <int dim>
  void PfemFluid<dim>::set_cell_stiffness()
  {
    effects_.cell_stiffness = parameters_.cell_stiffness * parameters_.equation_of_state.front().reference_density() *
                              largest_body_acceleration() * parameters_.spacing;
    cell_volume_at_rest_.clear();
    if (effects_.cell_stiffness > 0)
      for (const auto &cell : mesh_.cells)
        cell_volume_at_rest_.push_back(signed_volume(nodes_.corners(cell)));
    effects_.cell_volume_at_rest = cell_volume_at_rest_.data();
  }


  template <int dim>
  void PfemFluid<dim>::update_time_step_bound(const std::vector<Vec<dim>> &position, const std::vector<double> &inertia,
                                              const std::vector<double> &row_sums)
  {
    const EquationOfState &state = parameters_.equation_of_state.front();
    std::vector<double>    stiffness(nodes_.n), sound_speed(nodes_.n);
    sound_speed_at_bound_ = nodes_.n == 0 ? state.sound_speed(state.reference_density()) : 0.; // no fluid yet
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        sound_speed[i]        = state.sound_speed(nodes_.base_density[i]);
        stiffness[i]          = nodes_.base_density[i] * sound_speed[i] * sound_speed[i] / nodes_.stiffness_volume[i];
        sound_speed_at_bound_ = std::max(sound_speed_at_bound_, sound_speed[i]);
      }
    const double bound = parameters_.time_step_bound.front().bound(
      {mesh_, position, inertia, stiffness, sound_speed, row_sums, effects_.viscous ? effects_.viscosity : 0.,
       effects_.least_viscous_volume});
    // Without cells nothing oscillates; still, look for new neighbours now and then.
    bound_ = std::min(bound, 2 * parameters_.spacing / sound_speed_at_bound_);
    if (!(bound_ > 0))
      throw BreakdownError("The time step bound '" + parameters_.time_step_bound.names().front() + "' of " + name_ +
                           " is " + std::to_string(bound_) + " s at t = " + std::to_string(time_) +
                           " s: the mesh has a flat cell. Use the spectral bound or a mesh smoother.");
    context_->step_limited_by = name_ + " (" + parameters_.time_step_bound.names().front() + ")";
  }


  template class PfemFluid<2>;
  template class PfemFluid<3>;
} // namespace Breakwater
