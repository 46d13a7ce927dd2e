#include "pfem_fluid.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Breakwater
{
  template <int dim>
  void PfemFluid<dim>::declare_parameters(ParameterReader &reader)
  {
    parameters_.declare(reader);
  }


  template <int dim>
  void PfemFluid<dim>::check_parameters(ParameterReader &reader)
  {
    parameters_.check(reader);
  }


  template <int dim>
  void PfemFluid<dim>::setup(const std::string &name, const BodyForces<dim> &body_forces, RunContext &context)
  {
    name_        = name;
    body_forces_ = &body_forces;
    context_     = &context;

    const FluidRheology &rheology = parameters_.rheology.front();
    effects_.viscous              = rheology.is_viscous();
    effects_.viscosity            = effects_.viscous ? rheology.largest_viscosity() : 0.;
    // A sliver that passes through zero volume would make its viscous force infinite.
    effects_.least_cell_volume    = 0.05 * regular_volume<dim>(parameters_.spacing);
    effects_.least_viscous_volume = 0.01 * regular_volume<dim>(parameters_.spacing);
    context.note_effect("viscosity", effects_.viscous, "the rheology is inviscid");
    context.note_effect("density diffusion", parameters_.density_diffusion > 0, "its coefficient is 0");
    filters_velocity_ = parameters_.filter_weight > 0 || parameters_.divergence_filter_weight > 0;
    context.note_effect("velocity filter", filters_velocity_, "its weights are 0");
    context.note_effect("tension", parameters_.tension == "allowed", "pressure below zero is cut off");
    const bool asks_for_slip = parameters_.law_at_structures.asks_for_slip();
    if (!adopted_.empty() || asks_for_slip)
      context.note_effect("free slip at structures", asks_for_slip && !adopted_.empty(),
                          adopted_.empty() ? "no structure meets the fluid" :
                          effects_.viscous ? "Law at structures is no slip" :
                                             "Law at structures is no slip, although the fluid has no viscosity");
    context.note_effect("moving walls", parameters_.walls.any_moves(), "no wall has a motion");
    context.note_effect("Navier slip", parameters_.walls.any_has_navier_slip(), "no wall has that law");
    context.note_effect("spacing that varies", !parameters_.size.is_uniform(), "the spacing is one number");
    if (parameters_.size.was_graded())
      context.note_effect("spacing made smaller where it was steeper than " +
                            std::to_string(SizeField<dim>::largest_gradient).substr(0, 3),
                          true);
    context.note_effect("inflow and outflow", !parameters_.openings.empty(), "the scene names no opening");
    const bool needs_smoothing = parameters_.time_step_bound.names().front() == "Insphere";
    context.note_effect("mesh smoothing", !parameters_.mesh_smoothers.empty(),
                        needs_smoothing ?
                          "no smoother is named, although the insphere bound vanishes with the worst cell" :
                          "no smoother is named; the spectral bound does not need one");

    body_force_is_uniform_ = true;
    for (const auto &force : body_forces)
      body_force_is_uniform_ = body_force_is_uniform_ && force->is_uniform();

    parameters_.openings.set_up(parameters_.size, parameters_.equation_of_state.front().reference_density());
    make_initial_state();
    energy_after_remesh_ = own_energy(balance());
  }


  template <int dim>
  double PfemFluid<dim>::stable_time_step() const
  {
    // Since the last remesh the fluid may have stiffened.
    const double now = parameters_.equation_of_state.front().sound_speed(largest_density_);
    return parameters_.fraction_of_bound * bound_ * std::min(1., sound_speed_at_bound_ / now);
  }


  template <int dim>
  void PfemFluid<dim>::advance_free(const double time_step)
  {
    PhaseTimer timer(*context_, Phase::solver);

    auto &walls = parameters_.walls;
    walls.act(0.5 * time_step);
    walls.move(time_ + time_step, time_step);
    parameters_.openings.start_step(nodes_, time_, time_step);
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        Quad          &x = nodes_.xp[i], &v = nodes_.v[i];
        const Vec<dim> x_old = nodes_.position(i);
        for (int d = 0; d < dim; ++d)
          {
            v[d] += 0.5 * time_step * nodes_.a[i][d];
            x[d] += time_step * v[d];
          }
        if (i >= nodes_.n_interface)
          n_wall_stops_ += walls.stop(x_old, x.c, v.c, nodes_.mass[i], nodes_.contacts[i]);
      }
    time_ += time_step;
    last_time_step_ = time_step;

    if (slip_.is_on())
      slip_.update_directions(nodes_, walls);
    update_volumes();
    update_pressure();
    diffusion_time_ += time_step;
    effects_.density_diffusion = is_diffusion_due(time_step);
    update_forces();
    accelerate(time_step);
    if (effects_.density_diffusion)
      diffuse_density();
    walls.act(0.5 * time_step);
    walls.finish_step();
    parameters_.openings.finish_step(nodes_, time_);

    context_->cell_steps += mesh_.cells.size();
    refresh_surface();
  }


  template <int dim>
  void PfemFluid<dim>::update_pressure()
  {
    constexpr std::size_t  block_size = 1024; // what one loop leaves is in the cache for the next
    const EquationOfState &state      = parameters_.equation_of_state.front();
    const double           least = parameters_.tension == "allowed" ? -std::numeric_limits<double>::infinity() : 0.;
    double                 pressure[block_size];
    largest_density_ = 0;
    for (std::size_t begin = 0; begin < nodes_.n; begin += block_size)
      {
        const std::size_t end = std::min(begin + block_size, nodes_.n);
        for (std::size_t i = begin; i < end; ++i)
          {
            const double J =
              std::clamp(1. + (nodes_.volume[i] - nodes_.reference_volume[i]) / nodes_.stiffness_volume[i], 0.7, 1.4);
            nodes_.density[i] = nodes_.base_density[i] / J;
            largest_density_  = std::max(largest_density_, nodes_.density[i]);
          }
        state.pressure(nodes_.density.data() + begin, pressure, end - begin);
        for (std::size_t i = begin; i < end; ++i)
          nodes_.xp[i][3] = std::max(least, pressure[i - begin]);
      }
  }


  template <int dim>
  void PfemFluid<dim>::update_body_acceleration()
  {
    if (body_force_is_uniform_ && !body_acceleration_.empty())
      return;
    std::vector<Vec<dim>> places = body_force_is_uniform_ ? std::vector<Vec<dim>>(1) : nodes_.positions();
    body_acceleration_.assign(places.size(), Vec<dim>());
    for (const auto &force : *body_forces_)
      force->add_acceleration(time_, places, body_acceleration_);
  }


  template <int dim>
  void PfemFluid<dim>::update_forces()
  {
    update_body_acceleration();
    const auto body = [&](const std::size_t i) -> const Vec<dim> & {
      return body_acceleration_[body_force_is_uniform_ ? 0 : i];
    };
    if (effects_.density_diffusion)
      {
        // The hydrostatic gradient of the density in a fluid that accelerates by a is rho / c^2 (g - a). The acceleration
        // of interface nodes is the structure's: its fast vibrations are none of the fluid's, and would be driven.
        for (std::size_t i = 0; i < nodes_.n; ++i)
          {
            const double moves = i < nodes_.n_interface ? 0. : 1.;
            for (int d = 0; d < dim; ++d)
              nodes_.density_slope[i][d] = nodes_.hydrostatic_slope[i] * (body(i)[d] - moves * nodes_.a[i][d]);
            nodes_.density_slope[i][3] = nodes_.density[i];
          }
      }

    const bool slips_with_viscosity = slip_.is_on() && effects_.viscous;
    if (slips_with_viscosity)
      slip_.add_slip(nodes_);
    update_viscosity();
    compute_forces<dim>(mesh_.cells, effects_, nodes_.xp, nodes_.v, nodes_.density_slope, nodes_.force);
    if (slips_with_viscosity)
      {
        slip_.take_slip_back(nodes_);
        slip_.pass_viscous_forces_on(nodes_, mesh_.cells, effects_);
      }
    parameters_.walls.begin_forces();
    add_cap_forces();
    add_wedge_forces();
    if (slip_.is_on())
      slip_.take_forces_along(nodes_, body_acceleration_);
  }


  template <int dim>
  void PfemFluid<dim>::accelerate(const double time_step)
  {
    const auto body = [&](const std::size_t i) -> const Vec<dim> & {
      return body_acceleration_[body_force_is_uniform_ ? 0 : i];
    };
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      for (int d = 0; d < dim; ++d) // the weight of what it carries for another body acts there
        nodes_.a[i][d] = (nodes_.force[i][d] + nodes_.mass[i] * body(i)[d]) / nodes_.inertia(i);
    if (time_step > 0)
      spend_contact_impulse(time_step);
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      for (int d = 0; d < dim; ++d)
        nodes_.v[i][d] += 0.5 * time_step * nodes_.a[i][d];

    const bool   allows_tension = parameters_.tension == "allowed";
    const double fastest        = largest_speed();
    bool         is_sound       = true;
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      {
        Quad           &a = nodes_.a[i], &v = nodes_.v[i];
        const double    inverse_mass      = 1. / nodes_.mass[i];
        const Vec<dim> &body_acceleration = body(i);
        for (int d = 0; d < dim; ++d)
          a[d] = nodes_.force[i][d] * inverse_mass + body_acceleration[d];
        if (!nodes_.contacts[i].empty())
          {
            const double slip_rate =
              nodes_.slip_conductance.empty() ? 0. : effects_.viscosity * nodes_.slip_conductance[i] / nodes_.mass[i];
            // A fluid that bears tension hangs on its walls.
            const bool may_release = !allows_tension || !nodes_.has_cells[i];
            parameters_.walls.constrain(nodes_.xp[i].c, a.c, v.c, nodes_.mass[i], slip_rate, may_release,
                                        nodes_.contacts[i]);
          }
        double square = 0;
        for (int d = 0; d < dim; ++d)
          {
            v[d] += 0.5 * time_step * a[d];
            square += v[d] * v[d];
          }
        is_sound = is_sound && square <= fastest * fastest; // false for what is not a number
      }
    is_sound_ = is_sound;
  }


  template <int dim>
  void PfemFluid<dim>::update_viscosity()
  {
    const FluidRheology &rheology = parameters_.rheology.front();
    if (rheology.is_newtonian())
      return;
    compute_shear_rates<dim>(mesh_.cells, effects_.least_viscous_volume, nodes_.xp, nodes_.v, shear_rate_);
    cell_viscosity_.resize(shear_rate_.size());
    rheology.viscosity(shear_rate_.data(), cell_viscosity_.data(), shear_rate_.size());
    effects_.cell_viscosity = cell_viscosity_.data();
  }


  template <int dim>
  bool PfemFluid<dim>::is_diffusion_due(const double time_step) const
  {
    if (!(parameters_.density_diffusion > 0))
      return false;
    const EquationOfState &state = parameters_.equation_of_state.front();
    const double           c     = state.sound_speed(state.reference_density());
    // The operator's eigenvalues are at most 1: up to xi c T / h = 1 no mode changes its sign.
    return c * (diffusion_time_ + time_step) >
           parameters_.spacing * std::min(parameters_.diffusion_period, 1 / parameters_.density_diffusion);
  }


  template <int dim>
  void PfemFluid<dim>::diffuse_density()
  {
    const EquationOfState &state = parameters_.equation_of_state.front();
    const double           c     = state.sound_speed(state.reference_density());
    const double factor = -parameters_.density_diffusion * c * diffusion_time_ / (parameters_.spacing * (dim + 1));
    for (std::size_t i = 0; i < nodes_.n; ++i)
      if (nodes_.has_cells[i])
        nodes_.base_density[i] += factor * nodes_.force[i][3] / nodes_.stiffness_volume[i];
    diffusion_time_            = 0;
    effects_.density_diffusion = false;
  }


  template <int dim>
  void PfemFluid<dim>::end_step()
  {
    PhaseTimer timer(*context_, Phase::solver);
    check_state();
    add_interface_work();
    if (filters_velocity_ && is_filter_due())
      {
        filter_velocity();
        steps_since_filter_ = 0;
      }
    if (n_steps_to_check_ > 0)
      --n_steps_to_check_;
    else if (needs_remeshing())
      {
        remesh();
        strain_watch_ = gap_watch_ = {};
      }
    else
      n_steps_to_check_ = 2;
  }


  // What it takes away grows in the fluid's time: steps that are short for another reason count less.
  template <int dim>
  bool PfemFluid<dim>::is_filter_due()
  {
    const EquationOfState &state = parameters_.equation_of_state.front();
    const double           c     = state.sound_speed(state.reference_density());
    steps_since_filter_ += std::min(1., c * last_time_step_ / (0.4 * parameters_.spacing));
    return steps_since_filter_ >= parameters_.filter_period;
  }


  template <int dim>
  void PfemFluid<dim>::Watch::note(const double value, const double allowed)
  {
    const double growth = 4 * std::max(0., value - value_) / n_looks_;
    const double limit  = value <= allowed ? allowed : 2 * allowed; // twice as much may be allowed in some cells
    unsigned int n_wait = 0;
    while (n_wait < 3 && value + (n_wait + 2) * growth <= limit)
      ++n_wait;
    value_           = value;
    n_looks_         = 0;
    n_looks_to_wait_ = n_wait;
  }


  template <int dim>
  bool PfemFluid<dim>::is_strained()
  {
    if (!strain_watch_.is_due())
      return false;
    const double allowed = parameters_.largest_strain * parameters_.spacing;
    const double largest = largest_relative_displacement<dim>(mesh_.cells, nodes_.xp, nodes_.position_at_remesh);
    strain_watch_.note(largest, allowed);
    return is_too_much(largest / allowed, [&]() {
      return std::count_if(mesh_.cells.begin(), mesh_.cells.end(), [&](const auto &cell) {
        return element_passes<dim>().largest_relative_displacement(cell.data(), 1, nodes_.xp.data(),
                                                                   nodes_.position_at_remesh.data()) > allowed;
      });
    });
  }


  // Bodies of fluid that fly towards each other share no cell of the mesh.
  template <int dim>
  bool PfemFluid<dim>::may_gaps_close()
  {
    if (!gap_watch_.is_due())
      return false;
    const double closure = gaps_.closure(nodes_.xp, nodes_.position_at_remesh, parameters_.spacing);
    gap_watch_.note(closure, 1.);
    return is_too_much(closure, [&]() {
      return gaps_.n_closing(nodes_.xp, nodes_.position_at_remesh, parameters_.spacing);
    });
  }


  template <int dim>
  template <class Count>
  bool PfemFluid<dim>::is_too_much(const double over_limit, const Count &n_cells_over) const
  {
    if (over_limit <= 1 || over_limit > 2 || parameters_.strained_part == 0)
      return over_limit > 1;
    return n_cells_over() > parameters_.strained_part * mesh_.cells.size();
  }


  template <int dim>
  bool PfemFluid<dim>::needs_remeshing()
  {
    gaps_asked_ = false;
    if (parameters_.openings.needs_remeshing() || is_strained())
      return true;
    if (parameters_.walls.has_travelled(0.3 * parameters_.spacing))
      return true;
    gaps_asked_ = may_gaps_close();
    return gaps_asked_;
  }


  template <int dim>
  double PfemFluid<dim>::largest_speed() const
  {
    const EquationOfState &state = parameters_.equation_of_state.front();
    return parameters_.largest_mach_number * state.sound_speed(state.reference_density());
  }


  template <int dim>
  void PfemFluid<dim>::check_state() const
  {
    const double fastest = largest_speed();
    for (std::size_t i = 0; i < (is_sound_ ? nodes_.n_interface : nodes_.n); ++i)
      {
        double sum = nodes_.xp[i][3], square = 0;
        for (int d = 0; d < dim; ++d)
          {
            sum += nodes_.xp[i][d] + nodes_.a[i][d];
            square += nodes_.v[i][d] * nodes_.v[i][d];
          }
        if (!std::isfinite(sum) || !(square <= fastest * fastest))
          fail_at_node(i, fastest);
      }
  }


  template <int dim>
  void PfemFluid<dim>::fail_at_node(const std::size_t i, const double fastest) const
  {
    std::ostringstream message;
    message << name_ << " broke down at t = " << time_ << " s: node " << i << ", which was at (";
    for (int d = 0; d < dim; ++d)
      message << (d == 0 ? "" : ", ") << nodes_.position_at_remesh[i][d];
    const double speed = norm(nodes_.velocity(i));
    message << ") m after the last remesh, ";
    if (std::isfinite(speed))
      message << "moves at " << speed << " m/s; allowed are " << fastest << " m/s, 'Limits/Largest Mach number' times "
              << "the speed of sound.";
    else
      message << "has a state that is not finite (pressure " << nodes_.xp[i][3] << " Pa, volume " << nodes_.volume[i]
              << " m^" << dim << ").";
    message << " Either the step is unstable: lower 'Fraction of the bound' (now " << parameters_.fraction_of_bound
            << "); or the flow is too fast for this fluid: raise its speed of sound.";
    throw BreakdownError(message.str());
  }


  template <int dim>
  void PfemFluid<dim>::filter_velocity()
  {
    // Driven nodes and their cells take no part: their density is left at zero.
    const double         least_volume = 0.1 * regular_volume<dim>(parameters_.spacing);
    std::vector<double> &node_density = filter_buffers_.node_density, &inverse_mass = filter_buffers_.inverse_mass;
    std::vector<Quad>   &impulse = filter_buffers_.impulse;
    node_density.assign(nodes_.n, 0.);
    inverse_mass.assign(nodes_.n, 0.);
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      {
        if (nodes_.is_driven(i))
          continue;
        node_density[i] = nodes_.mass[i] / std::max(nodes_.volume[i], least_volume);
        inverse_mass[i] = 1. / nodes_.mass[i];
      }
    filter_impulses<dim>(mesh_.cells, {parameters_.filter_weight, parameters_.divergence_filter_weight}, nodes_.xp,
                         nodes_.v, nodes_.volume, least_volume, node_density, inverse_mass, filter_buffers_.gradient,
                         impulse);
    // Where the gradients around are poor they may do work. A part s of them changes the energy by power s + square s^2 / 2,
    // in any frame.
    double power = 0, square = 0;
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      for (int d = 0; d < dim; ++d)
        {
          power += impulse[i][d] * nodes_.v[i][d];
          square += impulse[i][d] * impulse[i][d] * inverse_mass[i];
        }
    const double part = square > 0 ? std::clamp(-2 * power / square, 0., 1.) : 0.;
    for (std::size_t i = nodes_.n_interface; i < nodes_.n; ++i)
      if (nodes_.has_cells[i] && !nodes_.is_driven(i))
        {
          for (int d = 0; d < dim; ++d)
            impulse[i][d] *= part;
          if (!nodes_.contacts[i].empty())
            parameters_.walls.mask_impulse(nodes_.xp[i].c, impulse[i].c, nodes_.contacts[i]);
          for (int d = 0; d < dim; ++d)
            nodes_.v[i][d] += impulse[i][d] / nodes_.mass[i];
        }
  }

  template class PfemFluid<2>;
  template class PfemFluid<3>;
} // namespace Breakwater
