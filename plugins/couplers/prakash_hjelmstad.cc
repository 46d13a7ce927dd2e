#include "prakash_hjelmstad.h"

#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    constexpr unsigned int most_passes   = 45;
    constexpr std::size_t  most_memories = 60;

    /// Velocity gap that is allowed after so many passes, relative to the largest tied velocity: what round-off leaves of
    /// a fluid's pressure may stand above the first bound.
    double tolerance(const unsigned int n_passes)
    {
      return n_passes < 20 ? 1e-12 : n_passes < 40 ? 1e-9 : 1e-6;
    }

    double dot(const std::vector<double> &a, const std::vector<double> &b)
    {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }

    void add(std::vector<double> &a, const double factor, const std::vector<double> &b)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] += factor * b[i];
    }

    template <int dim>
    std::vector<double> flat(const std::vector<Vec<dim>> &vectors)
    {
      std::vector<double> values;
      for (const Vec<dim> &v : vectors)
        values.insert(values.end(), v.c, v.c + dim);
      return values;
    }

    template <int dim>
    std::vector<Vec<dim>> vectors(const std::vector<double> &values)
    {
      std::vector<Vec<dim>> result(values.size() / dim);
      for (std::size_t k = 0; k < values.size(); ++k)
        result[k / dim][k % dim] = values[k];
      return result;
    }
  } // namespace


  template <int dim>
  double PrakashHjelmstad<dim>::advance(const double max_time_step)
  {
    const PhaseTimer timer(*this->context_, Phase::coupling);
    if (!this->is_started_)
      {
        this->start_with_equal_accelerations();
        last_change_.assign(this->problem_.places().size(), {});
      }
    this->choose_coarse_domains();
    this->problem_.reset_iterations();
    Schedule   schedule = this->plan_steps(max_time_step);
    const auto shorten  = [&schedule](const unsigned int n_substeps) {
      schedule.coarse_step *= static_cast<double>(n_substeps) / schedule.n_substeps;
      schedule.n_substeps = n_substeps;
    };
    if (schedule.n_substeps > allowed_substeps_)
      shorten(allowed_substeps_);
    while (!make_step(schedule))
      {
        if (schedule.n_substeps == 1)
          throw BreakdownError("Coupling: after " + std::to_string(most_passes) +
                               " repetitions of a single step the velocities still differ by more than 1e-6 of the "
                               "largest one. Use the Gravouil-Combescure coupler.");
        allowed_substeps_ = schedule.n_substeps / 2;
        shorten(allowed_substeps_);
        residual_changes_.clear();
        target_changes_.clear();
        this->context_->set_summary("coarse_steps_made_shorter", ++n_shortened_);
      }
    if (allowed_substeps_ < schedule.n_substeps + 1)
      allowed_substeps_ = schedule.n_substeps + 1;
    return schedule.coarse_step;
  }


  template <int dim>
  bool PrakashHjelmstad<dim>::make_step(const Schedule &schedule)
  {
    const Snapshot       snapshot    = take_snapshot();
    const double         coarse_step = schedule.coarse_step;
    std::vector<Vectors> free_velocity(this->sides_.size());
    std::vector<Start>   start(this->sides_.size());
    for (const Side &side : this->sides_)
      if (side.is_coarse)
        {
          start[side.number] = this->start_of_step(side, coarse_step);
          side.domain->advance_free(coarse_step);
          free_velocity[side.number] = side.surface().velocity;
        }

    const Vectors start_multiplier = this->sides_.front().multiplier;
    Numbers       guess            = flat(start_multiplier);
    add(guess, 1., flat(last_change_));
    last_residual_.clear();
    this->n_done_ = schedule.n_substeps;
    for (unsigned int pass = 1;; ++pass)
      {
        make_fine_steps(start_multiplier, vectors<dim>(guess), coarse_step, schedule.n_substeps);
        const Vectors gap   = residual(free_velocity, vectors<dim>(guess), coarse_step);
        double        speed = 0, largest = 0;
        bool          is_finite = true;
        for (const Side &side : this->sides_)
          for (const Vec<dim> &v : side.surface().velocity)
            speed = std::max(speed, norm(v));
        for (const Vec<dim> &g : gap)
          {
            largest   = std::max(largest, norm(g));
            is_finite = is_finite && std::isfinite(norm(g));
          }
        this->n_passes_ = pass;
        if (is_finite && largest <= tolerance(pass) * speed)
          break;
        if (pass == most_passes || !is_finite)
          {
            go_back_to(snapshot, true);
            return false;
          }
        const std::vector<double> half_step(this->sides_.size(), 0.5 * coarse_step);
        guess = next_guess(guess, flat(this->solve_with(half_step, gap)));
        go_back_to(snapshot, false);
      }

    for (Side &side : this->sides_)
      if (side.is_coarse)
        {
          this->add_multiplier(side, vectors<dim>(guess), coarse_step);
          this->add_link_work(side, start[side.number], coarse_step);
        }
    for (std::size_t r = 0; r < last_change_.size(); ++r)
      last_change_[r] = this->sides_.front().multiplier[r] - start_multiplier[r];
    this->measure_gap();
    this->take_back_drift();
    this->end_steps(true);
    return true;
  }


  template <int dim>
  typename PrakashHjelmstad<dim>::Snapshot PrakashHjelmstad<dim>::take_snapshot() const
  {
    Snapshot snapshot{{}, {}, this->balances_, this->pseudo_energy_};
    for (const Side &side : this->sides_)
      {
        std::ostringstream stream;
        side.domain->save(stream);
        snapshot.domains.push_back(stream.str());
        snapshot.multipliers.push_back(side.multiplier);
      }
    return snapshot;
  }


  template <int dim>
  void PrakashHjelmstad<dim>::go_back_to(const Snapshot &snapshot, const bool of_coarse)
  {
    for (Side &side : this->sides_)
      {
        side.multiplier = snapshot.multipliers[side.number];
        if (side.is_coarse && !of_coarse)
          continue;
        std::istringstream stream(snapshot.domains[side.number]);
        side.domain->load(stream);
      }
    this->balances_      = snapshot.balances;
    this->pseudo_energy_ = snapshot.pseudo_energy;
  }


  // lambda_j = (1 - t/Dt) lambda_0 + t/Dt lambda_m
  template <int dim>
  void PrakashHjelmstad<dim>::make_fine_steps(const Vectors &start, const Vectors &end, const double coarse_step,
                                              const unsigned int n_steps)
  {
    const double fine_step = coarse_step / n_steps;
    for (unsigned int j = 1; j <= n_steps; ++j)
      for (Side &side : this->sides_)
        if (!side.is_coarse)
          {
            const Start before = this->start_of_step(side, fine_step);
            side.domain->advance_free(fine_step);
            Vectors multiplier = start;
            for (std::size_t r = 0; r < start.size(); ++r)
              multiplier[r] += (static_cast<double>(j) / n_steps) * (end[r] - start[r]);
            this->add_multiplier(side, multiplier, fine_step);
            this->add_link_work(side, before, coarse_step);
          }
  }


  // Velocity gap [m/s] that the coarse domains with this multiplier leave to the fine ones, which have it already.
  template <int dim>
  typename PrakashHjelmstad<dim>::Vectors PrakashHjelmstad<dim>::residual(const std::vector<Vectors> &free_velocity,
                                                                          const Vectors              &multiplier,
                                                                          const double                coarse_step)
  {
    std::vector<Vectors>         velocity(this->sides_.size());
    std::vector<const Vectors *> all;
    for (const Side &side : this->sides_)
      {
        velocity[side.number] = side.is_coarse ? free_velocity[side.number] : side.surface().velocity;
        if (side.is_coarse)
          {
            const Vectors force = this->link_force(side, multiplier);
            for (std::size_t i = 0; i < force.size(); ++i)
              for (int d = 0; d < dim; ++d)
                velocity[side.number][i][d] += 0.5 * coarse_step * side.surface().inverse_mass[i][d] * force[i][d];
          }
        all.push_back(&velocity[side.number]);
      }
    return this->mismatch(all);
  }


  // The guess for which the remembered passes, combined linearly, predict no residual: the residual's part outside of
  // their span is taken as it is. Orthogonalized from the newest one back; what adds nothing is forgotten.
  template <int dim>
  typename PrakashHjelmstad<dim>::Numbers PrakashHjelmstad<dim>::next_guess(const Numbers &guess,
                                                                            const Numbers &residual)
  {
    remember(guess, residual);
    Numbers              rest = residual, next = guess;
    std::vector<Numbers> directions, images;
    add(next, 1., residual);
    for (std::size_t k = residual_changes_.size(); k-- > 0;)
      {
        Numbers      direction = residual_changes_[k], image = target_changes_[k];
        const double length = std::sqrt(dot(direction, direction));
        for (unsigned int twice = 0; twice < 2; ++twice)
          for (std::size_t l = 0; l < directions.size(); ++l)
            {
              const double part = dot(directions[l], direction);
              add(direction, -part, directions[l]);
              add(image, -part, images[l]);
            }
        const double left = std::sqrt(dot(direction, direction));
        if (!(left > 1e-9 * length))
          {
            residual_changes_.erase(residual_changes_.begin() + k);
            target_changes_.erase(target_changes_.begin() + k);
            continue;
          }
        for (std::size_t i = 0; i < direction.size(); ++i)
          {
            direction[i] /= left;
            image[i] /= left;
          }
        const double part = dot(direction, rest);
        add(rest, -part, direction);
        add(next, -part, image);
        directions.push_back(direction);
        images.push_back(image);
      }
    return next;
  }


  template <int dim>
  void PrakashHjelmstad<dim>::remember(const Numbers &guess, const Numbers &residual)
  {
    Numbers target = guess;
    add(target, 1., residual);
    if (!last_residual_.empty())
      {
        residual_changes_.push_back(residual);
        add(residual_changes_.back(), -1., last_residual_);
        target_changes_.push_back(target);
        add(target_changes_.back(), -1., last_target_);
        if (residual_changes_.size() > most_memories)
          {
            residual_changes_.erase(residual_changes_.begin());
            target_changes_.erase(target_changes_.begin());
          }
      }
    last_residual_ = residual;
    last_target_   = target;
  }


  template <int dim>
  void PrakashHjelmstad<dim>::save(std::ostream &stream) const
  {
    Base::save(stream);
    write_binary(stream, last_change_);
    write_binary(stream, allowed_substeps_);
    write_binary(stream, n_shortened_);
    write_binary(stream, residual_changes_.size());
    for (std::size_t k = 0; k < residual_changes_.size(); ++k)
      {
        write_binary(stream, residual_changes_[k]);
        write_binary(stream, target_changes_[k]);
      }
  }


  template <int dim>
  void PrakashHjelmstad<dim>::load(std::istream &stream)
  {
    Base::load(stream);
    std::size_t n = 0;
    read_binary(stream, last_change_);
    read_binary(stream, allowed_substeps_);
    read_binary(stream, n_shortened_);
    read_binary(stream, n);
    residual_changes_.resize(n);
    target_changes_.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        read_binary(stream, residual_changes_[k]);
        read_binary(stream, target_changes_[k]);
      }
  }


  template class PrakashHjelmstad<2>;
  template class PrakashHjelmstad<3>;
} // namespace Breakwater
