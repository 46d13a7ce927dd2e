#include "remesh_record.h"
#include "volume_conservation.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

// What a remesh may change, and what it has changed.

namespace Breakwater
{
  template <int dim>
  double PfemFluid<dim>::mesh_volume() const
  {
    double volume = 0;
    for (const auto &cell : mesh_.cells)
      volume += signed_volume(nodes_.corners(cell));
    return volume;
  }


  template <int dim>
  void PfemFluid<dim>::check_remesh(const RemeshRecord &record, const DomainBalance<dim> &before,
                                    const DomainBalance<dim> &after)
  {
    (record.volume_made > 0 ? volume_made_ : volume_lost_) += std::abs(record.volume_made);

    Vec<dim> center;
    double   square = 0; // sum of m x^2
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        center += nodes_.position(i) * (nodes_.mass[i] / after.mass);
        square += nodes_.mass[i] * dot(nodes_.position(i), nodes_.position(i));
      }
    const EquationOfState &state   = parameters_.equation_of_state.front();
    const double           slow    = 1e-3 * state.sound_speed(state.reference_density());
    const double           kinetic = std::max(before.kinetic_energy, 0.5 * after.mass * slow * slow);
    const double           inertia = square - after.mass * dot(center, center);

    const auto check = [&](const std::string &what, const double change, const std::string &unit, const double scale,
                           const double limit, const std::string &entry) {
      if (change <= limit * scale)
        return;
      std::ostringstream message;
      message << name_ << " broke down at t = " << time_ << " s: a remesh of " << mesh_.cells.size()
              << " cells around (" << center[0];
      for (int d = 1; d < dim; ++d)
        message << ", " << center[d];
      message << ") m " << what << " by " << change << unit << ", allowed are " << limit * scale << unit << " ('Limits/"
              << entry << "' is " << limit << "). A finer spacing or a smaller 'Remeshing/Largest strain' helps.";
      throw BreakdownError(message.str());
    };
    check("raised the energy", own_energy(after) - own_energy(before), " J", kinetic, parameters_.largest_energy_gain,
          "Largest energy gain at a remesh");
    if (parameters_.openings.empty()) // what leaves takes its angular momentum along
      check("changed the angular momentum", norm(record.angular_momentum_change), " kg m^2/s",
            std::sqrt(2 * kinetic * inertia), parameters_.largest_angular_change,
            "Largest angular momentum change at a remesh");
  }

  template <int dim>
  void PfemFluid<dim>::add_remeshing_row(const RemeshRecord &record, const DomainBalance<dim> &before,
                                         const DomainBalance<dim> &after)
  {
    const double c          = sound_speed_at_bound_;
    double       volume     = 0;
    unsigned int n_isolated = 0;
    for (std::size_t i = 0; i < nodes_.n; ++i)
      {
        volume += nodes_.volume[i];
        n_isolated += i >= nodes_.n_interface && !nodes_.has_cells[i];
      }
    Row row = {{"time [s]", time_},
               {"nodes [-]", static_cast<double>(nodes_.n)},
               {"cells [-]", static_cast<double>(mesh_.cells.size())},
               {"largest strain [-]", strain_watch_.value() / parameters_.spacing},
               {"gap closure [-]", gap_watch_.value()},
               {"asked by gaps [-]", static_cast<double>(gaps_asked_)},
               {"isolated nodes [-]", static_cast<double>(n_isolated)},
               {"removed nodes [-]", static_cast<double>(record.node_changes.n_removed)},
               {"inserted nodes [-]", static_cast<double>(record.node_changes.n_inserted)},
               {"softened nodes [-]", static_cast<double>(n_softened_)},
               {"insphere bound before smoothing [s]", record.quality_before.smallest_radius / c},
               {"spectral bound before smoothing [s]",
                parameters_.mesh_smoothers.empty() ? spectral_bound_ : unsmoothed_bound_},
               {"insphere bound [s]", record.quality_after.smallest_radius / c},
               {"spectral bound [s]", spectral_bound_},
               {"bound in use [s]", bound_},
               {"smallest r before smoothing [-]", record.quality_before.smallest},
               {"r of 0.1 % before smoothing [-]", record.quality_before.thousandth},
               {"r of 1 % before smoothing [-]", record.quality_before.hundredth},
               {"median r before smoothing [-]", record.quality_before.median},
               {"smallest r [-]", record.quality_after.smallest},
               {"r of 0.1 % [-]", record.quality_after.thousandth},
               {"r of 1 % [-]", record.quality_after.hundredth},
               {"median r [-]", record.quality_after.median},
               {"smoothed nodes [-]", static_cast<double>(record.smoothing.n_moved_nodes)},
               {"mean smoothing move [m]", record.smoothing.mean_move},
               {"largest smoothing move [m]", record.smoothing.largest_move},
               {"smoothing flips [-]", static_cast<double>(record.smoothing.n_flips)},
               {"peeled cells [-]", static_cast<double>(record.smoothing.n_peeled_cells)},
               {"nodes freed by peeling [-]", static_cast<double>(record.smoothing.n_freed_nodes)},
               {"lifts of surface nodes [-]", static_cast<double>(record.smoothing.n_lifts)},
               {"smoothing volume change [m^" + std::to_string(dim) + "]", record.smoothing.volume_change},
               {"smoothing over triangulation [-]", record.smoothing.seconds / record.triangulation_seconds},
               {"new triangulation [-]", static_cast<double>(record.triangulation.is_full)},
               {"flips [-]", static_cast<double>(record.triangulation.n_flips)},
               {"reinserted nodes [-]", static_cast<double>(record.triangulation.n_reinserted)},
               {"triangulation [CPU s]", record.triangulation_seconds},
               {"smoothing [CPU s]", record.smoothing.seconds},
               {"transfer [CPU s]", record.transfer_seconds},
               {"exchange iterations [-]", static_cast<double>(record.exchange.n_iterations)},
               {"far part of the exchange [-]", far_part_},
               {"volume correction scale [-]", record.correction_scale},
               {"nodes put back out of structures [-]", static_cast<double>(record.n_pushed_out)},
               {"mass change [kg]", after.mass - before.mass},
               {"mesh volume [m^" + std::to_string(dim) + "]", volume}};
    for (int d = 0; d < dim; ++d)
      row.emplace_back(std::string("momentum change ") + "xyz"[d] + " [kg m/s]",
                       after.momentum[d] - before.momentum[d]);
    row.emplace_back("kinetic energy change [J]", after.kinetic_energy - before.kinetic_energy);
    row.emplace_back("potential energy change [J]", after.potential_energy - before.potential_energy);
    row.emplace_back("internal energy change [J]", after.internal_energy - before.internal_energy);
    for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
      row.emplace_back(std::string("angular momentum change ") + "xyz"[d] + " [kg m^2/s]",
                       record.angular_momentum_change[d]);
    row.emplace_back("volume made by the mesh [m^" + std::to_string(dim) + "]", record.volume_made);
    row.emplace_back("interior volume deficit [-]", interior_volume_deficit(nodes_));
    context_->table("remeshing").add_row(row);
  }

  template double PfemFluid<2>::mesh_volume() const;
  template double PfemFluid<3>::mesh_volume() const;
  template void   PfemFluid<2>::check_remesh(const RemeshRecord &, const DomainBalance<2> &, const DomainBalance<2> &);
  template void   PfemFluid<3>::check_remesh(const RemeshRecord &, const DomainBalance<3> &, const DomainBalance<3> &);
  template void   PfemFluid<2>::add_remeshing_row(const RemeshRecord &, const DomainBalance<2> &,
                                                  const DomainBalance<2> &);
  template void   PfemFluid<3>::add_remeshing_row(const RemeshRecord &, const DomainBalance<3> &,
                                                  const DomainBalance<3> &);
} // namespace Breakwater
