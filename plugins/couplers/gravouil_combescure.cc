#include "gravouil_combescure.h"

namespace Breakwater
{
  namespace
  {
    /// (1 - fraction) a + fraction b
    template <int dim>
    std::vector<Vec<dim>> interpolate(const std::vector<Vec<dim>> &a, const std::vector<Vec<dim>> &b,
                                      const double fraction)
    {
      std::vector<Vec<dim>> result = a;
      for (std::size_t i = 0; i < a.size(); ++i)
        result[i] = (1 - fraction) * a[i] + fraction * b[i];
      return result;
    }
  } // namespace


  template <int dim>
  double GravouilCombescure<dim>::advance(const double max_time_step)
  {
    const PhaseTimer timer(*this->context_, Phase::coupling);
    if (!this->is_started_)
      this->start_with_equal_accelerations();
    this->choose_coarse_domains();
    this->problem_.reset_iterations();
    this->n_done_ = 0;

    const auto           schedule    = this->plan_steps(max_time_step);
    const double         coarse_step = schedule.coarse_step;
    const std::size_t    n           = this->sides_.size();
    std::vector<Start>   start(n);
    std::vector<Vectors> free_start(n), free_end(n), free_now(n);
    for (const Side &side : this->sides_)
      if (side.is_coarse)
        {
          start[side.number]      = this->start_of_step(side, coarse_step);
          free_start[side.number] = free_velocity_at_start(side, coarse_step);
          side.domain->advance_free(coarse_step);
          free_end[side.number] = side.surface().velocity;
        }

    std::vector<const Vectors *> velocity(n);
    for (double remaining = coarse_step; remaining > 0;)
      {
        const unsigned int n_left    = this->n_remaining_substeps(schedule, remaining);
        const double       fine_step = remaining / n_left;
        remaining                    = n_left == 1 ? 0. : remaining - fine_step;
        const bool is_last           = n_left == 1;
        for (const Side &side : this->sides_)
          {
            if (side.is_coarse)
              free_now[side.number] =
                interpolate(free_end[side.number], free_start[side.number], remaining / coarse_step);
            else
              {
                start[side.number] = this->start_of_step(side, fine_step);
                side.domain->advance_free(fine_step);
              }
            velocity[side.number] = side.is_coarse ? &free_now[side.number] : &side.surface().velocity;
          }
        ++this->n_done_;

        const Vectors multiplier = this->multiplier_for_common_velocity(velocity, coarse_step, fine_step);
        for (Side &side : this->sides_)
          if (is_last || !side.is_coarse)
            {
              this->add_multiplier(side, multiplier, side.is_coarse ? coarse_step : fine_step);
              this->add_link_work(side, start[side.number], coarse_step);
            }
        if (is_last)
          {
            this->measure_gap();
            this->take_back_drift();
          }
        this->end_steps(is_last);
      }
    return coarse_step;
  }


  // v_A,free(0) = v_A(0) - Dt/2 M_A^-1 f(0): with it, the velocity of A is exact at the start of the coarse step, and
  // lambda is continuous there. Interpolating from v_A(0) itself looks right and destroys energy.
  template <int dim>
  typename GravouilCombescure<dim>::Vectors GravouilCombescure<dim>::free_velocity_at_start(
    const Side &coarse, const double coarse_step) const
  {
    const WetSurface<dim> &surface = coarse.surface();
    const Vectors          force   = this->link_force(coarse, coarse.multiplier);
    Vectors                free    = surface.velocity;
    for (std::size_t i = 0; i < free.size(); ++i)
      for (int d = 0; d < dim; ++d)
        free[i][d] -= coarse_step / 2 * surface.inverse_mass[i][d] * force[i][d];
    return free;
  }


  template class GravouilCombescure<2>;
  template class GravouilCombescure<3>;
} // namespace Breakwater
