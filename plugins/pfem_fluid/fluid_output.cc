#include "pfem_fluid.h"
#include "volume_conservation.h"

#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <numeric>

// What the fluid tells of itself: balances, columns of history.csv, the mesh for output, checkpoints.

namespace Breakwater
{
  template <int dim>
  DomainBalance<dim> PfemFluid<dim>::node_balance(const std::size_t i) const
  {
    const EquationOfState &state = parameters_.equation_of_state.front();
    const Vec<dim>         x     = nodes_.position(i);
    DomainBalance<dim>     result;
    result.mass           = nodes_.mass[i];
    result.momentum       = nodes_.velocity(i) * nodes_.mass[i];
    result.kinetic_energy = 0.5 * nodes_.mass[i] * dot(nodes_.velocity(i), nodes_.velocity(i));
    for (const auto &force : *body_forces_)
      result.potential_energy += nodes_.mass[i] * force->potential(x);
    // The pressure is minus the derivative of this by the volume.
    if (nodes_.has_cells[i] && (nodes_.density[i] > state.reference_density() || parameters_.tension == "allowed"))
      result.internal_energy =
        nodes_.stiffness_volume[i] * nodes_.base_density[i] * state.specific_energy(nodes_.density[i]);
    return result;
  }


  template <int dim>
  DomainBalance<dim> PfemFluid<dim>::balance() const
  {
    DomainBalance<dim> result;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      result += node_balance(i);
    for (std::size_t c = 0; c < cell_volume_at_rest_.size(); ++c)
      {
        const double change = signed_volume(nodes_.corners(mesh_.cells[c])) - cell_volume_at_rest_[c];
        result.internal_energy += 0.5 * effects_.cell_stiffness * change * change /
                                  std::max(cell_volume_at_rest_[c], effects_.least_cell_volume);
      }
    result.received_mass     = received_.mass;
    result.received_momentum = received_.momentum + parameters_.openings.driving_impulse();
    result.received_energy   = received_.energy() + parameters_.openings.driving_work() + parameters_.walls.work();
    return result;
  }


  template <int dim>
  double PfemFluid<dim>::own_energy(const DomainBalance<dim> &balance) const
  {
    return balance.energy() - balance.received_energy - interface_work_;
  }


  template <int dim>
  void PfemFluid<dim>::add_history(Row &row)
  {
    const DomainBalance<dim> now = balance();
    row.emplace_back("fluid mass [kg]", now.mass);
    for (int d = 0; d < dim; ++d)
      row.emplace_back(std::string("fluid momentum ") + "xyz"[d] + " [kg m/s]", now.momentum[d]);
    const Vec<3> angular = nodes_.angular_momentum();
    for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
      row.emplace_back(std::string("fluid angular momentum ") + "xyz"[d] + " [kg m^2/s]", angular[d]);
    const double deficit = interior_volume_deficit(nodes_);
    row.emplace_back("interior volume deficit [-]", deficit);
    double       volume = 0, largest_pressure = 0, largest_speed = 0;
    unsigned int n_isolated = 0;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        volume += nodes_.volume[i];
        if (nodes_.has_cells[i])
          largest_pressure = std::max(largest_pressure, nodes_.xp[i][3]);
        largest_speed = std::max(largest_speed, norm(nodes_.velocity(i)));
        n_isolated += i >= nodes_.n_interface && !nodes_.has_cells[i];
      }
    row.emplace_back("fluid mesh volume [m^" + std::to_string(dim) + "]", volume);
    row.emplace_back("volume of closed gaps [m^" + std::to_string(dim) + "]", volume_made_);
    row.emplace_back("volume of torn fluid [m^" + std::to_string(dim) + "]", volume_lost_);
    row.emplace_back("isolated nodes [-]", n_isolated);
    row.emplace_back("nodes put back at walls [-]", n_wall_stops_);
    parameters_.walls.add_history(time_, row);
    if (slip_.is_on())
      for (int d = 0; d < dim; ++d)
        row.emplace_back(std::string("impulse left out along structures ") + "xyz"[d] + " [kg m/s]", slip_impulse_[d]);
    row.emplace_back("largest pressure [Pa]", largest_pressure);
    row.emplace_back("largest fluid speed [m/s]", largest_speed);
    if (!parameters_.openings.empty())
      {
        parameters_.openings.add_history(row);
        for (int d = 0; d < dim; ++d)
          row.emplace_back(std::string("momentum received through openings ") + "xyz"[d] + " [kg m/s]",
                           now.received_momentum[d]);
        row.emplace_back("energy received through openings [J]", now.received_energy);
      }
    context_->set_summary_max("largest_interior_volume_deficit", std::abs(deficit));
    const EquationOfState &state = parameters_.equation_of_state.front();
    context_->set_summary_max("largest_mach_number", largest_speed / state.sound_speed(state.reference_density()));
    context_->set_summary("nodes_put_back_at_walls", n_wall_stops_);
    context_->set_summary("nodes_put_back_out_of_structures", n_pushed_out_);
    context_->set_summary("fluid_nodes", nodes_.n - nodes_.n_interface);
    context_->set_summary("fluid_cells", mesh_.cells.size());
  }


  template <int dim>
  OutputMesh<dim> PfemFluid<dim>::output_mesh() const
  {
    OutputMesh<dim> output;
    output.position          = nodes_.positions();
    output.vertices_per_cell = dim + 1;
    for (const auto &cell : mesh_.cells)
      output.cells.insert(output.cells.end(), cell.begin(), cell.end());

    typename OutputMesh<dim>::Field velocity{"velocity", dim, {}}, pressure{"pressure", 1, {}},
      density{"density", 1, {}}, surface{"surface", 1, {}};
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        velocity.values.insert(velocity.values.end(), nodes_.v[i].c, nodes_.v[i].c + dim);
        pressure.values.push_back(nodes_.xp[i][3]);
        density.values.push_back(nodes_.density[i]);
        surface.values.push_back(nodes_.is_surface[i]);
      }
    output.fields = {velocity, pressure, density, surface};
    return output;
  }


  namespace
  {
    /// Calls `visit` with every number of the state, for saving and loading alike.
    template <class Nodes, class Mesh, class Visitor>
    void visit_nodes(Nodes &nodes, Mesh &mesh, const Visitor &visit)
    {
      visit(nodes.n);
      visit(nodes.n_interface);
      Nodes::visit_arrays(nodes, visit);
      visit(mesh.cells);
      visit(mesh.boundary);
    }
  } // namespace


  template <int dim>
  void PfemFluid<dim>::save(std::ostream &stream) const
  {
    const auto visit = [&](const auto &value) {
      write_binary(stream, value);
    };
    visit_nodes(nodes_, mesh_, visit);
    visit(unsmoothed_mesh_.cells);
    visit(unsmoothed_mesh_.boundary);
    visit(gaps_.cells);
    Openings<dim>::visit_state(parameters_.openings, visit);
    visit(received_);
    visit(contact_impulse_);
    InterfaceSlip<dim>::visit_state(slip_, visit);
    visit(slip_impulse_);
    visit(cell_volume_at_rest_);
    visit(effects_.cell_stiffness);
    visit(adopted_.surface().revision);
    for (const double value : {time_, bound_, sound_speed_at_bound_, largest_density_, interface_work_,
                               energy_after_remesh_, spectral_bound_, volume_made_, volume_lost_, far_part_,
                               diffusion_time_, unsmoothed_bound_, steps_since_filter_})
      visit(value);
    for (const unsigned int value : {n_steps_to_check_, n_remeshes_})
      visit(value);
    visit(strain_watch_);
    visit(gap_watch_);
    visit(n_wall_stops_);
    visit(n_pushed_out_);
    parameters_.walls.save(stream);
  }


  template <int dim>
  void PfemFluid<dim>::load(std::istream &stream)
  {
    const auto visit = [&](auto &value) {
      read_binary(stream, value);
    };
    visit_nodes(nodes_, mesh_, visit);
    visit(unsmoothed_mesh_.cells);
    visit(unsmoothed_mesh_.boundary);
    nodes_.number_in_triangulation.resize(nodes_.n);
    std::iota(nodes_.number_in_triangulation.begin(), nodes_.number_in_triangulation.end(), 0u);
    triangulation_ = {}; // it is still that of the initial state: make it anew
    visit(gaps_.cells);
    Openings<dim>::visit_state(parameters_.openings, visit);
    parameters_.openings.find_driven(nodes_);
    visit(received_);
    visit(contact_impulse_);
    const std::vector<char> sticks = slip_.sticking_nodes();
    InterfaceSlip<dim>::visit_state(slip_, visit);
    if (slip_.sticking_nodes() != sticks)
      throw InputError(name_ + ": the checkpoint was written with another \"Law at structures\". Resume with the scene "
                               "that wrote it.");
    visit(slip_impulse_);
    visit(cell_volume_at_rest_);
    visit(effects_.cell_stiffness);
    effects_.cell_volume_at_rest = cell_volume_at_rest_.data();
    visit(adopted_.surface().revision);
    for (double *value : {&time_, &bound_, &sound_speed_at_bound_, &largest_density_, &interface_work_,
                          &energy_after_remesh_, &spectral_bound_, &volume_made_, &volume_lost_, &far_part_,
                          &diffusion_time_, &unsmoothed_bound_, &steps_since_filter_})
      visit(*value);
    for (unsigned int *value : {&n_steps_to_check_, &n_remeshes_})
      visit(*value);
    visit(strain_watch_);
    visit(gap_watch_);
    visit(n_wall_stops_);
    visit(n_pushed_out_);
    parameters_.walls.load(stream);
    collect_curved_facets();
    collect_interface_cells();
    collect_rim_facets();
    if (!body_force_is_uniform_)
      update_body_acceleration();
    refresh_surface();
    adopted_.update_normals();
  }

  template class PfemFluid<2>;
  template class PfemFluid<3>;
} // namespace Breakwater
