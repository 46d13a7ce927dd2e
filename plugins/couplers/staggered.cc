#include "staggered.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    /// a + factor b
    template <int dim>
    std::vector<Vec<dim>> sum(std::vector<Vec<dim>> a, const double factor, const std::vector<Vec<dim>> &b)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] += factor * b[i];
      return a;
    }
  } // namespace


  template <int dim>
  void Staggered<dim>::adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains, const std::vector<Tie> &ties)
  {
    if (domains.size() != 2 || ties.size() != 1)
      throw InputError("Coupling: the staggered coupler ties two domains; use Gravouil Combescure for more.");
    Base::adopt_surfaces(domains, ties);
    const unsigned int second = ties[0].second;
    follower_                 = this->has_adopted(second) ? second : ties[0].first;
    choose_coarse_domains();
  }


  template <int dim>
  void Staggered<dim>::choose_coarse_domains()
  {
    leader().is_coarse   = true;
    follower().is_coarse = false;
  }


  template <int dim>
  double Staggered<dim>::advance(const double max_time_step)
  {
    const PhaseTimer timer(*this->context_, Phase::coupling);
    if (!this->is_started_)
      {
        this->add_multiplier(leader(), reaction(leaders_value(leader().surface().acceleration)), 0.);
        set_acceleration(leaders_value(leader().surface().acceleration));
        this->is_started_ = true;
      }
    const auto    schedule     = this->plan_steps(max_time_step);
    const double  coarse_step  = schedule.coarse_step;
    const Start   start        = this->start_of_step(leader(), coarse_step);
    const Vectors velocity     = leaders_value(start.velocity),
                  acceleration = leaders_value(leader().surface().acceleration);
    leader().domain->advance_free(coarse_step);
    this->n_done_ = 0;
    for (double remaining = coarse_step; remaining > 0;)
      {
        const unsigned int n_left     = this->n_remaining_substeps(schedule, remaining);
        const double       fine_step  = remaining / n_left;
        const Start        fine_start = this->start_of_step(follower(), fine_step);
        remaining                     = n_left == 1 ? 0. : remaining - fine_step;
        follower().domain->advance_free(fine_step);
        ++this->n_done_;
        if (n_left == 1)
          {
            this->add_multiplier(leader(), reaction(acceleration), coarse_step);
            this->add_link_work(leader(), start, coarse_step);
            set_velocity(leaders_value(leader().surface().velocity), fine_step);
            this->measure_gap();
          }
        else
          set_velocity(sum(velocity, coarse_step - remaining, acceleration), fine_step);
        this->add_link_work(follower(), fine_start, coarse_step);
        if (n_left == 1)
          put_follower_on_leader();
        follower().domain->end_step();
        set_acceleration(n_left == 1 ? leaders_value(leader().surface().acceleration) : acceleration);
      }
    leader().domain->end_step();
    return coarse_step;
  }


  // What the follower's node at each place has of the leader's field.
  template <int dim>
  typename Staggered<dim>::Vectors Staggered<dim>::leaders_value(const Vectors &field) const
  {
    Vectors value(this->problem_.places().size());
    for (std::size_t r = 0; r < value.size(); ++r)
      {
        const std::vector<TiedPlace::Entry> &entries = this->problem_.places()[r].entries;
        for (std::size_t k = 1; k < entries.size(); ++k)
          value[r] -= (entries[k].weight / entries[0].weight) * field[entries[k].node];
      }
    return value;
  }


  // The multiplier by which the leader takes the follower's own force less the inertia of its own mass, M a_free - m a.
  template <int dim>
  typename Staggered<dim>::Vectors Staggered<dim>::reaction(const Vectors &acceleration) const
  {
    const WetSurface<dim> &surface = this->sides_[follower_].surface();
    Vectors                multiplier(acceleration.size());
    for (std::size_t r = 0; r < multiplier.size(); ++r)
      {
        const TiedPlace::Entry &own     = this->problem_.places()[r].entries[0];
        const double            carried = this->carried_mass(r);
        for (int d = 0; d < dim; ++d)
          if (surface.inverse_mass[own.node][d] > 0)
            multiplier[r][d] = own.weight * (surface.acceleration[own.node][d] / surface.inverse_mass[own.node][d] -
                                             (surface.mass[own.node] - carried) * acceleration[r][d]);
      }
    return multiplier;
  }


  // Adds a force at the follower's tied nodes; the multiplier is what of it does not go into carried mass.
  template <int dim>
  void Staggered<dim>::push_follower(const Vectors &change_of_acceleration, const double time_step)
  {
    const WetSurface<dim> &surface = follower().surface();
    Vectors                force(surface.position.size());
    for (std::size_t r = 0; r < change_of_acceleration.size(); ++r)
      {
        const TiedPlace::Entry &own = this->problem_.places()[r].entries[0];
        for (int d = 0; d < dim; ++d)
          if (surface.inverse_mass[own.node][d] > 0)
            {
              force[own.node][d] = change_of_acceleration[r][d] / surface.inverse_mass[own.node][d];
              follower().multiplier[r][d] -=
                own.weight * (force[own.node][d] - this->carried_mass(r) * change_of_acceleration[r][d]);
            }
      }
    follower().domain->add_link_force(force, time_step);
  }


  // A force in the second half of the step that ends, the first one of this step.
  template <int dim>
  void Staggered<dim>::set_velocity(const Vectors &velocity, const double time_step)
  {
    const WetSurface<dim> &surface = follower().surface();
    Vectors                change  = velocity;
    for (std::size_t r = 0; r < change.size(); ++r)
      {
        const TiedPlace::Entry &own = this->problem_.places()[r].entries[0];
        change[r]                   = (2 / time_step) * (velocity[r] - surface.velocity[own.node]);
        follower().multiplier[r]    = (own.weight * this->carried_mass(r)) * surface.acceleration[own.node];
      }
    push_follower(change, time_step);
  }


  // A force in the first half of the next step: the follower goes on as the leader does.
  template <int dim>
  void Staggered<dim>::set_acceleration(const Vectors &acceleration)
  {
    Vectors change = acceleration;
    for (std::size_t r = 0; r < change.size(); ++r)
      change[r] -= follower().surface().acceleration[this->problem_.places()[r].entries[0].node];
    push_follower(change, 0.);
  }


  template <int dim>
  void Staggered<dim>::put_follower_on_leader()
  {
    const Vectors place    = leaders_value(leader().surface().position);
    Vectors       position = follower().surface().position;
    double        largest  = 0;
    for (std::size_t r = 0; r < place.size(); ++r)
      {
        Vec<dim> &own = position[this->problem_.places()[r].entries[0].node];
        largest       = std::max(largest, norm(place[r] - own));
        own           = place[r];
      }
    follower().domain->correct_surface(position);
    this->balances_[0].taken_back         = largest;
    this->balances_[0].largest_taken_back = std::max(this->balances_[0].largest_taken_back, largest);
  }


  template class Staggered<2>;
  template class Staggered<3>;
} // namespace Breakwater
