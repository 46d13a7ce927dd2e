#include "gravouil_combescure.h"

#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace Breakwater
{
  namespace
  {
    /// Length of the diagonal of the box around the nodes [m].
    template <int dim>
    double extent(const std::vector<Vec<dim>> &position)
    {
      Vec<dim> lower = position.front(), upper = position.front();
      for (const Vec<dim> &x : position)
        for (int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
      return norm(upper - lower);
    }

    template <int dim>
    double largest_distance(const std::vector<Vec<dim>> &a, const std::vector<Vec<dim>> &b)
    {
      double largest = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, norm(a[i] - b[i]));
      return largest;
    }

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

    /// factor (a - b)
    template <int dim>
    std::vector<Vec<dim>> difference(std::vector<Vec<dim>> a, const std::vector<Vec<dim>> &b, const double factor)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = factor * (a[i] - b[i]);
      return a;
    }
  } // namespace


  template <int dim>
  void GravouilCombescure<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Interface", interface_, "How the wet surfaces meet: node on node (matching)", {"matching"});
    reader.add(
      "Coarse domain", coarse_domain_,
      "The domain with the larger step: chosen at every step by the stable steps (automatic), always the first "
      "one (the fluid) or always the second one (the structure)",
      {"automatic", "first", "second"});
    reader.add(
      "Substeps", n_substeps_,
      "Fine steps in one coarse step, m; 0: as many as the stable steps call for (a fixed number is for tests)");
  }


  template <int dim>
  void GravouilCombescure<dim>::adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains,
                                               const std::vector<Tie>                   &ties)
  {
    if (ties.size() != 1 || domains.size() != 2)
      throw InputError("Coupling: two domains can be tied so far, not " + std::to_string(domains.size()) + ".");
    ExplicitDomain<dim> &first = *domains[ties[0].first], &second = *domains[ties[0].second];
    first_  = {&first, -1., {}, first.can_adopt_surface()};
    second_ = {&second, +1., {}, second.can_adopt_surface() && !first_.has_adopted};
    if (first_.has_adopted)
      first.adopt_surface(second.wet_surface());
    else if (second_.has_adopted)
      second.adopt_surface(first.wet_surface());
  }


  template <int dim>
  void GravouilCombescure<dim>::setup(RunContext &context)
  {
    first_.link_force.assign(first_.surface().position.size(), {});
    second_.link_force = first_.link_force;
    context_           = &context;
    is_started_        = false;
    balance_           = {};
    pseudo_energy_     = 0;
    check_surfaces();
    context.note_effect("coupling (Gravouil-Combescure, matching nodes)", true);
  }


  template <int dim>
  void GravouilCombescure<dim>::check_surfaces() const
  {
    const WetSurface<dim> &first = first_.surface(), &second = second_.surface();
    const std::string      remedy = " Matching interfaces need the same nodes in the same order: couple a domain that "
                                    "can take the other's surface for its own, as a fluid does.";
    if (second.position.empty() || first.position.empty())
      throw InputError("Coupling: a domain has no wet surface, so there is nothing to tie.");
    if (first.position.size() != second.position.size())
      throw InputError("Coupling: the wet surfaces have " + std::to_string(first.position.size()) + " and " +
                       std::to_string(second.position.size()) + " nodes." + remedy);
    const double distance = largest_distance(first.position, second.position);
    if (distance > 1e-10 * std::max(extent(second.position), norm(second.position.front())))
      throw InputError("Coupling: nodes that should be tied are up to " + std::to_string(distance) + " m apart." +
                       remedy);
    for (const WetSurface<dim> *surface : {&first, &second})
      for (const std::vector<Vec<dim>> *field : {&surface->velocity, &surface->acceleration, &surface->inverse_mass})
        if (field->size() != surface->position.size())
          throw std::logic_error("a wet surface lacks velocities, accelerations or masses");
  }


  // The tied nodes start with the same acceleration. Otherwise the multiplier would alternate around its right value
  // for ever, and almost massless nodes fly off.
  template <int dim>
  void GravouilCombescure<dim>::balance_initial_accelerations()
  {
    const Vectors multiplier = multiplier_for_common_acceleration();
    add_multiplier(first_, multiplier, 0.);
    add_multiplier(second_, multiplier, 0.);
    is_started_ = true;
  }


  template <int dim>
  bool GravouilCombescure<dim>::first_is_coarse() const
  {
    if (coarse_domain_ == "automatic")
      return stable_step(first_, second_) >= stable_step(second_, first_);
    return coarse_domain_ == "first";
  }


  // A copy has almost no mass of its own: it lives on half of its owner's (ExplicitDomain::adopt_surface()). The other
  // half is left to the owner, whose squared frequencies at most double by that. With M = M_1 + M_2 and K = K_1 + K_2,
  // K_i <= 4 / dt^2 M_i for both makes the whole stable; with all of the mass in both it need not be.
  template <int dim>
  double GravouilCombescure<dim>::stable_step(const Side &side, const Side &partner)
  {
    return side.domain->stable_time_step() * (partner.has_adopted ? std::sqrt(0.5) : 1.);
  }


  // m = max(1, floor(Dt_A / dt_B)),  Dt = min(Dt_A, m dt_B, largest step)
  template <int dim>
  typename GravouilCombescure<dim>::Schedule GravouilCombescure<dim>::plan_steps(const Side &coarse, const Side &fine,
                                                                                 const double max_time_step) const
  {
    const double coarse_bound = stable_step(coarse, fine), fine_bound = stable_step(fine, coarse);
    if (!(coarse_bound > 0) || !(fine_bound > 0))
      throw BreakdownError("Coupling: the stable steps of the two domains are " + std::to_string(coarse_bound) +
                           " s and " + std::to_string(fine_bound) + " s.");
    unsigned int n_substeps = 1;
    if (n_substeps_ > 0)
      n_substeps = n_substeps_;
    else if (!coarse.has_adopted && !fine.has_adopted) // a ratio that should be an integer may come out a little less
      n_substeps = static_cast<unsigned int>(std::max(1., std::floor(coarse_bound / fine_bound * (1 + 1e-12))));
    return {std::min({coarse_bound, n_substeps * fine_bound, max_time_step}), n_substeps};
  }


  // The fine domain's bound may change within the coarse step: the time that is left is split evenly anew.
  template <int dim>
  unsigned int GravouilCombescure<dim>::n_remaining_substeps(const Schedule &schedule, const double fine_bound,
                                                             const double remaining) const
  {
    if (!(fine_bound > 1e-9 * remaining))
      throw BreakdownError("Coupling: the fine domain's stable step fell to " + std::to_string(fine_bound) +
                           " s within a coarse step of " + std::to_string(schedule.coarse_step) + " s.");
    const double       needed = std::max(1., std::ceil(remaining / fine_bound * (1 - 1e-12)));
    const unsigned int fixed  = n_substeps_ > balance_.n_substeps ? n_substeps_ - balance_.n_substeps : 1;
    return std::max(fixed, static_cast<unsigned int>(needed));
  }


  template <int dim>
  double GravouilCombescure<dim>::advance(const double max_time_step)
  {
    const PhaseTimer timer(*context_, Phase::coupling);
    if (!is_started_)
      balance_initial_accelerations();

    Side          &coarse = first_is_coarse() ? first_ : second_, &fine = &coarse == &first_ ? second_ : first_;
    const Schedule schedule     = plan_steps(coarse, fine, max_time_step);
    const double   coarse_step  = schedule.coarse_step;
    const Start    coarse_start = start_of_step(coarse, coarse_step);
    const Vectors  free_start   = free_velocity_at_start(coarse, coarse_step);
    coarse.domain->advance_free(coarse_step);
    const Vectors free_end = coarse.surface().velocity;

    Start  fine_start;
    double remaining    = coarse_step;
    balance_.n_substeps = 0;
    while (true)
      {
        const unsigned int n_left    = n_remaining_substeps(schedule, stable_step(fine, coarse), remaining);
        const double       fine_step = remaining / n_left;
        if (fine.has_adopted && n_left > 1 && balance_.n_substeps == 0)
          start_on_straight_path(fine, coarse_start, fine_step);
        fine_start = start_of_step(fine, fine_step);
        fine.domain->advance_free(fine_step);
        ++balance_.n_substeps;
        if (n_left == 1)
          break;

        remaining -= fine_step;
        if (fine.has_adopted)
          stay_on_straight_path(fine, fine_step);
        else
          add_multiplier(fine,
                         multiplier_for_common_velocity(interpolate(free_end, free_start, remaining / coarse_step),
                                                        coarse, fine, coarse_step, fine_step),
                         fine_step);
        add_link_work(fine, fine_start, coarse_step);
        fine.domain->end_step();
      }
    link_at_end(coarse, fine, coarse_start, fine_start);
    fine.domain->end_step();
    coarse.domain->end_step();
    return coarse_step;
  }


  // Both domains are at the end of the coarse step, without links.
  template <int dim>
  void GravouilCombescure<dim>::link_at_end(Side &coarse, Side &fine, const Start &coarse_start,
                                            const Start &fine_start)
  {
    const double  coarse_step = coarse_start.time_step, fine_step = fine_start.time_step;
    const Vectors multiplier = fine.has_adopted ? multiplier_for_common_acceleration() :
                                                  multiplier_for_common_velocity(coarse.surface().velocity, coarse,
                                                                                 fine, coarse_step, fine_step);
    add_multiplier(coarse, multiplier, coarse_step);
    add_multiplier(fine, multiplier, fine_step);
    measure_drift();

    const bool   has_copy = coarse.has_adopted || fine.has_adopted;
    Side        &copy = coarse.has_adopted ? coarse : fine, &owner = coarse.has_adopted ? fine : coarse;
    const Start &copy_start = coarse.has_adopted ? coarse_start : fine_start;
    if (has_copy)
      {
        copy.domain->correct_surface(owner.surface().position);
        set_velocity(copy, owner.surface().velocity, copy_start.time_step);
      }
    measure_gap();
    add_link_work(fine, fine_start, coarse_step);
    add_link_work(coarse, coarse_start, coarse_step);
    if (has_copy)
      set_acceleration(copy, owner.surface().acceleration);
  }


  template <int dim>
  typename GravouilCombescure<dim>::Start GravouilCombescure<dim>::start_of_step(const Side  &side,
                                                                                 const double time_step) const
  {
    return {time_step, side.surface().velocity, side.surface().acceleration, side.link_force};
  }


  // v_A,free(0) = v_A(0) - Dt/2 M_A^-1 f(0): with it, the velocity of A is exact at the start of the coarse step, and
  // lambda is continuous there. Interpolating from v_A(0) itself looks right and destroys energy.
  template <int dim>
  typename GravouilCombescure<dim>::Vectors GravouilCombescure<dim>::free_velocity_at_start(
    const Side &coarse, const double coarse_step) const
  {
    const WetSurface<dim> &surface = coarse.surface();
    Vectors                free    = surface.velocity;
    for (std::size_t i = 0; i < free.size(); ++i)
      for (int d = 0; d < dim; ++d)
        free[i][d] -= coarse_step / 2 * surface.inverse_mass[i][d] * coarse.link_force[i][d];
    return free;
  }


  // H lambda = v_first,free - v_second,free,  H = Dt/2 M_A^-1 + dt/2 M_B^-1, per node and component; directions that
  // are held in both domains have no link.
  template <int dim>
  typename GravouilCombescure<dim>::Vectors GravouilCombescure<dim>::multiplier_for_common_velocity(
    const Vectors &coarse_free, const Side &coarse, const Side &fine, const double coarse_step,
    const double fine_step) const
  {
    const Vectors &coarse_mass = coarse.surface().inverse_mass, &fine_mass = fine.surface().inverse_mass;
    const Vectors &fine_free = fine.surface().velocity;
    Vectors        multiplier(fine_free.size());
    for (std::size_t i = 0; i < multiplier.size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double h   = coarse_step / 2 * coarse_mass[i][d] + fine_step / 2 * fine_mass[i][d];
          multiplier[i][d] = h > 0 ? -(coarse.sign * coarse_free[i][d] + fine.sign * fine_free[i][d]) / h : 0.;
        }
    return multiplier;
  }


  // lambda = (a_first - a_second) / (1 / m_first + 1 / m_second): the two nodes as if they were one
  template <int dim>
  typename GravouilCombescure<dim>::Vectors GravouilCombescure<dim>::multiplier_for_common_acceleration() const
  {
    const WetSurface<dim> &first = first_.surface(), &second = second_.surface();
    Vectors                multiplier(first.acceleration.size());
    for (std::size_t i = 0; i < multiplier.size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double compliance = first.inverse_mass[i][d] + second.inverse_mass[i][d];
          multiplier[i][d] = compliance > 0 ? (first.acceleration[i][d] - second.acceleration[i][d]) / compliance : 0.;
        }
    return multiplier;
  }


  template <int dim>
  void GravouilCombescure<dim>::add_multiplier(Side &side, const Vectors &multiplier, const double time_step)
  {
    side.link_force.assign(multiplier.size(), {});
    Vectors force = multiplier;
    for (Vec<dim> &f : force)
      f *= side.sign;
    add_force(side, force, time_step);
  }


  template <int dim>
  void GravouilCombescure<dim>::add_force(Side &side, const Vectors &force, const double time_step)
  {
    for (std::size_t i = 0; i < force.size(); ++i)
      side.link_force[i] += force[i];
    side.domain->add_link_force(force, time_step);
  }


  // f = m da; none in directions that are held
  template <int dim>
  typename GravouilCombescure<dim>::Vectors GravouilCombescure<dim>::force_for(
    const Side &side, const Vectors &change_of_acceleration) const
  {
    const Vectors &inverse_mass = side.surface().inverse_mass;
    Vectors        force(inverse_mass.size());
    for (std::size_t i = 0; i < force.size(); ++i)
      for (int d = 0; d < dim; ++d)
        if (inverse_mass[i][d] > 0)
          force[i][d] = change_of_acceleration[i][d] / inverse_mass[i][d];
    return force;
  }


  // A force in the first half of the next step.
  template <int dim>
  void GravouilCombescure<dim>::set_acceleration(Side &side, const Vectors &acceleration)
  {
    add_force(side, force_for(side, difference(acceleration, side.surface().acceleration, 1.)), 0.);
  }


  // A force in the second half of the step that ends.
  template <int dim>
  void GravouilCombescure<dim>::set_velocity(Side &side, const Vectors &velocity, const double time_step)
  {
    add_force(side, force_for(side, difference(velocity, side.surface().velocity, 2 / time_step)), time_step);
  }


  // The owners' displacement in the coarse step is known at its start, Dt V with V = v + Dt/2 a. The copies go there
  // on a straight line, v + dt/2 a' = V: any other path (v + t a, or velocities interpolated linearly) lags behind in
  // phase, and energy grows.
  template <int dim>
  void GravouilCombescure<dim>::start_on_straight_path(Side &copy, const Start &owner, const double time_step)
  {
    Vectors acceleration = owner.acceleration;
    for (Vec<dim> &a : acceleration)
      a *= owner.time_step / time_step;
    set_acceleration(copy, acceleration);
  }


  // a = 0, and with it v = V
  template <int dim>
  void GravouilCombescure<dim>::stay_on_straight_path(Side &copy, const double time_step)
  {
    copy.link_force.assign(copy.link_force.size(), {});
    add_force(copy, force_for(copy, difference(Vectors(copy.link_force.size()), copy.surface().acceleration, 1.)),
              time_step);
  }


  // Change of kinetic energy by the link forces f in one step: dt/2 (f_n + f_n+1) . (v_n + v_n+1) / 2, as each acts in
  // the second half of the step that ends and in the first half of the next one.
  template <int dim>
  void GravouilCombescure<dim>::add_link_work(const Side &side, const Start &start, const double coarse_step)
  {
    const double   time_step = start.time_step;
    const Vectors &velocity  = side.surface().velocity;
    for (std::size_t i = 0; i < velocity.size(); ++i)
      {
        balance_.energy +=
          time_step / 4 * dot(start.link_force[i] + side.link_force[i], start.velocity[i] + velocity[i]);
        pseudo_energy_ += coarse_step * coarse_step / time_step *
                          dot(side.link_force[i] - start.link_force[i], velocity[i] - start.velocity[i]);
      }
  }


  template <int dim>
  void GravouilCombescure<dim>::measure_gap()
  {
    const WetSurface<dim> &first = first_.surface(), &second = second_.surface();
    balance_.velocity_gap = 0;
    for (std::size_t i = 0; i < first.velocity.size(); ++i)
      for (int d = 0; d < dim; ++d)
        if (first.inverse_mass[i][d] + second.inverse_mass[i][d] > 0)
          balance_.velocity_gap =
            std::max(balance_.velocity_gap, std::abs(first.velocity[i][d] - second.velocity[i][d]));
    balance_.largest_gap = std::max(balance_.largest_gap, balance_.velocity_gap);
  }


  template <int dim>
  void GravouilCombescure<dim>::measure_drift()
  {
    balance_.displacement_drift = largest_distance(first_.surface().position, second_.surface().position);
  }


  template <int dim>
  Vec<dim> GravouilCombescure<dim>::interface_force(unsigned int) const
  {
    Vec<dim> sum;
    for (const Vec<dim> &force : second_.link_force)
      sum += force;
    return sum;
  }


  template <int dim>
  void GravouilCombescure<dim>::save(std::ostream &stream) const
  {
    write_binary(stream, static_cast<std::uint64_t>(first_.link_force.size()));
    for (const Side *side : {&first_, &second_})
      for (const Vec<dim> &force : side->link_force)
        write_binary(stream, force);
    write_binary(stream, is_started_);
    write_binary(stream, balance_);
    write_binary(stream, pseudo_energy_);
  }


  template <int dim>
  void GravouilCombescure<dim>::load(std::istream &stream)
  {
    std::uint64_t n = 0;
    read_binary(stream, n);
    if (n != first_.link_force.size())
      throw InputError("Coupling: the checkpoint has " + std::to_string(n) + " tied nodes, the scene " +
                       std::to_string(first_.link_force.size()) + ". Resume with the scene that wrote the checkpoint.");
    for (Side *side : {&first_, &second_})
      for (Vec<dim> &force : side->link_force)
        read_binary(stream, force);
    read_binary(stream, is_started_);
    read_binary(stream, balance_);
    read_binary(stream, pseudo_energy_);
  }


  template class GravouilCombescure<2>;
  template class GravouilCombescure<3>;
} // namespace Breakwater
