#include "remesh_record.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>
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
    const double volume = std::accumulate(nodes_.volume.begin(), nodes_.volume.end(), 0.) - record.mesh_volume_before;
    (volume > 0 ? volume_made_ : volume_lost_) += std::abs(volume);

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
      check("changed the angular momentum", norm(nodes_.angular_momentum() - record.angular_momentum_before),
            " kg m^2/s", std::sqrt(2 * kinetic * inertia), parameters_.largest_angular_change,
            "Largest angular momentum change at a remesh");
  }

  template double PfemFluid<2>::mesh_volume() const;
  template double PfemFluid<3>::mesh_volume() const;
  template void   PfemFluid<2>::check_remesh(const RemeshRecord &, const DomainBalance<2> &, const DomainBalance<2> &);
  template void   PfemFluid<3>::check_remesh(const RemeshRecord &, const DomainBalance<3> &, const DomainBalance<3> &);
} // namespace Breakwater
