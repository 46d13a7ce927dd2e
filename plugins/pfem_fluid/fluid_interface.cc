#include "pfem_fluid.h"

#include <algorithm>
#include <stdexcept>

// The nodes that the fluid shares with structures: what the coupler sees of them and does to them.

namespace Breakwater
{
  template <int dim>
  unsigned int PfemFluid<dim>::adopt_surface(const WetSurface<dim> &partner)
  {
    return adopted_.append(partner);
  }


  template <int dim>
  void PfemFluid<dim>::lend_mass(const std::vector<double> &)
  {
    throw std::logic_error("a fluid has no mass to lend at the surfaces that it adopted");
  }


  template <int dim>
  void PfemFluid<dim>::spend_contact_impulse(const double time_step)
  {
    // The impulse acts through the kicks of this step and the next. A step that was cut short must not make it a blow
    // in the next one.
    const double duration = std::max(time_step, 0.5 * stable_time_step());
    for (std::size_t i = 0; i < contact_impulse_.size(); ++i)
      for (int d = 0; d < dim; ++d)
        nodes_.a[i][d] += contact_impulse_[i][d] / (duration * nodes_.inertia(i));
    contact_impulse_.clear();
  }


  template <int dim>
  void PfemFluid<dim>::add_interface_work()
  {
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double weight = nodes_.mass[i] * body_acceleration_[body_force_is_uniform_ ? 0 : i][d];
          interface_work_ +=
            last_time_step_ * (nodes_.mass[i] * nodes_.a[i][d] - nodes_.force[i][d] - weight) * nodes_.v[i][d];
        }
    for (std::size_t i = 0; i < slip_.taken_forces().size(); ++i)
      {
        interface_work_ -= last_time_step_ * dot(slip_.taken_forces()[i], nodes_.velocity(i));
        slip_impulse_ += last_time_step_ * slip_.taken_forces()[i];
      }
  }


  template <int dim>
  void PfemFluid<dim>::add_link_force(const std::vector<Vec<dim>> &force, const double time_step)
  {
    const auto &inverse_mass = adopted_.surface().inverse_mass;
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double change = inverse_mass[i][d] * force[i][d];
          nodes_.a[i][d] += change;
          nodes_.v[i][d] += 0.5 * time_step * change;
        }
    refresh_surface();
  }


  // The volumes that pressures are measured from change with the cells.
  template <int dim>
  void PfemFluid<dim>::correct_surface(const std::vector<Vec<dim>> &position)
  {
    constexpr double    round_off = 1e-10; // in spacings: without effect on the pressure
    double              largest   = 0;
    std::vector<double> change(interface_cells_.size());
    for (std::size_t k = 0; k < change.size(); ++k)
      change[k] = -signed_volume(nodes_.corners(mesh_.cells[interface_cells_[k]]));
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      {
        largest = std::max(largest, norm(position[i] - nodes_.position(i)));
        for (int d = 0; d < dim; ++d)
          nodes_.xp[i][d] = position[i][d];
      }
    for (std::size_t k = 0; largest > round_off * parameters_.spacing && k < change.size(); ++k)
      {
        const unsigned int c = interface_cells_[k];
        change[k] += signed_volume(nodes_.corners(mesh_.cells[c]));
        if (!cell_volume_at_rest_.empty())
          cell_volume_at_rest_[c] += change[k];
        for (const unsigned int i : mesh_.cells[c])
          {
            nodes_.volume[i] += change[k] / (dim + 1);
            nodes_.reference_volume[i] += change[k] / (dim + 1);
          }
      }
    refresh_surface();
  }


  template <int dim>
  void PfemFluid<dim>::collect_interface_cells()
  {
    interface_cells_.clear();
    for (unsigned int c = 0; c < mesh_.cells.size(); ++c)
      if (std::any_of(mesh_.cells[c].begin(), mesh_.cells[c].end(), [this](const unsigned int i) {
            return i < nodes_.n_interface;
          }))
        interface_cells_.push_back(c);
  }


  template <int dim>
  void PfemFluid<dim>::refresh_surface()
  {
    WetSurface<dim> &surface = adopted_.surface();
    for (std::size_t i = 0; i < nodes_.n_interface; ++i)
      {
        surface.position[i]     = nodes_.position(i);
        surface.velocity[i]     = nodes_.velocity(i);
        surface.acceleration[i] = FluidNodes<dim>::vec(nodes_.a[i]);
        surface.mass[i]         = nodes_.inertia(i);
        for (int d = 0; d < dim; ++d)
          surface.inverse_mass[i][d] = 1. / surface.mass[i];
      }
  }

  template unsigned int PfemFluid<2>::adopt_surface(const WetSurface<2> &);
  template void         PfemFluid<2>::lend_mass(const std::vector<double> &);
  template void         PfemFluid<2>::spend_contact_impulse(double);
  template void         PfemFluid<2>::add_interface_work();
  template void         PfemFluid<2>::add_link_force(const std::vector<Vec<2>> &, double);
  template void         PfemFluid<2>::correct_surface(const std::vector<Vec<2>> &);
  template void         PfemFluid<2>::collect_interface_cells();
  template void         PfemFluid<2>::refresh_surface();
  template unsigned int PfemFluid<3>::adopt_surface(const WetSurface<3> &);
  template void         PfemFluid<3>::lend_mass(const std::vector<double> &);
  template void         PfemFluid<3>::spend_contact_impulse(double);
  template void         PfemFluid<3>::add_interface_work();
  template void         PfemFluid<3>::add_link_force(const std::vector<Vec<3>> &, double);
  template void         PfemFluid<3>::correct_surface(const std::vector<Vec<3>> &);
  template void         PfemFluid<3>::collect_interface_cells();
  template void         PfemFluid<3>::refresh_surface();
} // namespace Breakwater
