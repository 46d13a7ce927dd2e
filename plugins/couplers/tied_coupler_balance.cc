// What a tied coupler measures of its interfaces, and the way back of what has drifted.
#include "tied_coupler.h"

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  // Change of kinetic energy by the link forces f in one step: dt/2 (f_n + f_n+1) . (v_n + v_n+1) / 2, as each acts in
  // the second half of the step that ends and in the first half of the next one. Likewise that of momentum.
  template <int dim>
  void TiedCoupler<dim>::add_link_work(const Side &side, const Start &start, const double coarse_step)
  {
    const double   time_step = start.time_step;
    const Vectors &velocity  = side.surface().velocity;
    for (const Action &action : actions_[side.number])
      {
        InterfaceBalance &balance = balances_[problem_.places()[action.place].tie];
        const Vec<dim>   &before = start.multiplier[action.place], &after = side.multiplier[action.place];
        const Vec<dim>   &v_before = start.velocity[action.node], &v_after = velocity[action.node];
        balance.energy -= action.weight * time_step / 4 * dot(before + after, v_before + v_after);
        for (int d = 0; d < dim; ++d)
          balance.momentum[d] -= action.weight * time_step / 2 * (before[d] + after[d]);
        pseudo_energy_ -=
          action.weight * coarse_step * coarse_step / time_step * dot(after - before, v_after - v_before);
      }
  }


  template <int dim>
  void TiedCoupler<dim>::measure_gap()
  {
    const Vectors gap = mismatch(&WetSurface<dim>::velocity);
    for (InterfaceBalance &balance : balances_)
      {
        balance.velocity_gap = 0;
        balance.n_substeps   = n_done_;
        balance.n_iterations = problem_.n_iterations() + n_passes_;
      }
    for (std::size_t r = 0; r < gap.size(); ++r)
      {
        const TiedPlace  &place   = problem_.places()[r];
        InterfaceBalance &balance = balances_[place.tie];
        for (int d = 0; d < dim; ++d)
          if (std::any_of(place.entries.begin(), place.entries.end(), [&](const TiedPlace::Entry &e) {
                return sides_[e.domain].surface().inverse_mass[e.node][d] > 0;
              }))
            balance.velocity_gap = std::max(balance.velocity_gap, std::abs(gap[r][d]));
      }
    for (InterfaceBalance &balance : balances_)
      balance.largest_gap = std::max(balance.largest_gap, balance.velocity_gap);
  }


  // Velocities are tied, places are not: they drift apart by what the steps of the two sides integrate differently. Nodes
  // that belong to an owner go back to it, which no force feels.
  template <int dim>
  void TiedCoupler<dim>::take_back_drift()
  {
    const Vectors drift = mismatch(&WetSurface<dim>::position);
    for (const Side &side : sides_)
      if (has_adopted(side.number))
        move_copies(side, drift);
    const Vectors left = mismatch(&WetSurface<dim>::position);
    for (InterfaceBalance &balance : balances_)
      balance.displacement_drift = balance.taken_back = 0;
    for (std::size_t r = 0; r < drift.size(); ++r)
      {
        InterfaceBalance &balance  = balances_[problem_.places()[r].tie];
        balance.displacement_drift = std::max(balance.displacement_drift, norm(left[r]));
        if (r < places_of_adopted_.size())
          balance.taken_back = std::max(balance.taken_back, norm(drift[r]));
      }
    for (InterfaceBalance &balance : balances_)
      {
        balance.largest_drift      = std::max(balance.largest_drift, balance.displacement_drift);
        balance.largest_taken_back = std::max(balance.largest_taken_back, balance.taken_back);
      }
  }


  template <int dim>
  void TiedCoupler<dim>::move_copies(const Side &side, const Vectors &drift) const
  {
    Vectors place = side.surface().position;
    for (std::size_t r = 0; r < places_of_adopted_.size(); ++r)
      {
        const TiedPlace::Entry &own = problem_.places()[r].entries[0];
        if (own.domain == side.number)
          place[own.node] -= own.weight * drift[r]; // the weight is 1 or -1
      }
    side.domain->correct_surface(place);
  }


  template <int dim>
  Vec<dim> TiedCoupler<dim>::interface_force(const unsigned int tie) const
  {
    const Side &first = sides_[ties_[tie].first], &second = sides_[ties_[tie].second];
    Vec<dim>    sum;
    for (const Action &action : actions_[second.number])
      if (problem_.places()[action.place].tie == tie)
        sum -= action.weight * second.multiplier[action.place];
    // The multiplier moves the mass that is carried for the owner, too.
    for (std::size_t r = 0; r < (shares_mass() ? carried_mass_.size() : 0); ++r)
      {
        const TiedPlace        &place = problem_.places()[r];
        const TiedPlace::Entry &copy  = place.entries[0];
        if (place.tie == tie && copy.domain == first.number)
          sum += carried_mass_[r] * first.surface().acceleration[copy.node];
        else if (place.tie == tie)
          sum -= carried_mass_[r] * second.surface().acceleration[copy.node];
      }
    return sum;
  }


  template class TiedCoupler<2>;
  template class TiedCoupler<3>;
} // namespace Breakwater
