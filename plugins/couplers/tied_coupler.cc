#include "tied_coupler.h"

#include "resampled_surface.h"

#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/mesh/common_nodes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace Breakwater
{
  namespace
  {
    /// Copies of nodes that are held carry this many times their owners' mass, which nobody lends: they do not move.
    constexpr double mass_of_held_copies = 1e3;

    template <int dim>
    bool is_held(const WetSurface<dim> &surface, const unsigned int node)
    {
      return *std::max_element(surface.inverse_mass[node].c, surface.inverse_mass[node].c + dim) == 0;
    }
  } // namespace


  template <int dim>
  void TiedCoupler<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Interface", interface_,
               "How a fluid meets a structure: with the nodes of the structure's surface (matching), or with nodes of "
               "its own spacing on the structure's facets (non-matching)",
               {"matching", "non-matching"});
    reader.add("Spacing", spacing_, "Spacing of the fluid's nodes on a surface that does not match [m].",
               Range::not_negative());
    reader.add("Mass share", mass_share_,
               "Part of the mass of a structure's tied nodes that the fluid's nodes there carry for it [-]: either "
               "domain must be stable with its part.",
               Range{0.01, 0.99});
    reader.add("Direct solver up to", direct_up_to_,
               "Number of equations of an interface that does not match (its places, or the structure's nodes there if "
               "these are fewer) up to which they are solved directly; beyond it by conjugate gradients.");
    reader.add("Coarse domain", coarse_domain_,
               "The domain with the larger step: chosen at every step by the stable steps (automatic), always the "
               "first one of a tie (the fluid) or always the second one (the structure)",
               {"automatic", "first", "second"});
    reader.add("Substeps", n_substeps_,
               "Fine steps in one coarse step, m; 0: as many as the stable steps call for (a fixed number is for "
               "tests)");
  }


  template <int dim>
  void TiedCoupler<dim>::check_parameters(ParameterReader &reader)
  {
    if (interface_ == "non-matching" && !(spacing_ > 0))
      reader.fail("Spacing", "an interface that does not match needs a spacing above 0 m, such as the fluid's");
    if (interface_ == "matching" && spacing_ > 0)
      reader.fail("Spacing", "a matching interface has the structure's spacing; set Interface = non-matching, or leave "
                             "this entry out");
  }


  template <int dim>
  void TiedCoupler<dim>::adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains, const std::vector<Tie> &ties)
  {
    sides_.clear();
    for (unsigned int k = 0; k < domains.size(); ++k)
      sides_.push_back({domains[k], k, false, {}});
    ties_ = ties;
    places_of_adopted_.clear();
    carried_mass_.clear();
    has_adopted_.assign(domains.size(), 0);
    part_of_step_.assign(domains.size(), 1.);
    for (unsigned int t = 0; t < ties.size(); ++t)
      {
        const unsigned int first = ties[t].first, second = ties[t].second;
        if (domains[first]->can_adopt_surface() && !domains[second]->can_adopt_surface())
          tie_adopted(t, first, second, places_of_adopted_);
        else if (domains[second]->can_adopt_surface() && !domains[first]->can_adopt_surface())
          tie_adopted(t, second, first, places_of_adopted_);
      }
  }


  template <int dim>
  void TiedCoupler<dim>::tie_adopted(const unsigned int tie, const unsigned int adopter, const unsigned int owner,
                                     std::vector<TiedPlace> &places)
  {
    ExplicitDomain<dim>   &lender  = *sides_[owner].domain;
    const WetSurface<dim> &surface = lender.wet_surface();
    if (surface.position.empty())
      throw InputError("Coupling \"" + ties_[tie].name +
                       "\": a domain has no wet surface, so there is nothing to tie.");
    std::vector<double>         lent;
    const ResampledSurface<dim> resampled =
      interface_ == "matching" ? copy_of_surface(surface) : resample_surface(surface, spacing_);
    WetSurface<dim> adopted = resampled.surface;
    share_mass(surface, resampled, mass_share_, adopted.mass, lent);
    for (std::size_t i = 0; i < adopted.mass.size(); ++i)
      if (resampled.weights[i].size() == 1 && is_held(surface, resampled.weights[i][0].node))
        {
          const unsigned int k = resampled.weights[i][0].node;
          lent[k] -= adopted.mass[i];
          adopted.mass[i] = mass_of_held_copies * surface.mass[k];
        }
    if (shares_mass())
      {
        part_of_step_[owner] =
          std::min(part_of_step_[owner], std::sqrt(1 - part_that_moves_apart(surface, resampled, adopted.mass, lent)));
        lender.lend_mass(lent);
      }

    const unsigned int offset = sides_[adopter].domain->adopt_surface(adopted);
    const double       sign   = adopter == ties_[tie].first ? 1 : -1;
    has_adopted_[adopter]     = 1;
    for (unsigned int i = 0; i < adopted.position.size(); ++i)
      {
        places.push_back({{{adopter, offset + i, sign}}, tie});
        carried_mass_.push_back(adopted.mass[i]);
        for (const auto &weight : resampled.weights[i])
          places.back().entries.push_back({owner, weight.node, -sign * weight.weight});
      }
  }


  // Two domains that keep their own nodes are tied where these lie at the same places.
  template <int dim>
  void TiedCoupler<dim>::tie_matching(const unsigned int tie, std::vector<TiedPlace> &places) const
  {
    const Tie             &domains = ties_[tie];
    const WetSurface<dim> &first = sides_[domains.first].surface(), &second = sides_[domains.second].surface();
    const std::string      who = "Coupling \"" + domains.name + "\": ";
    if (second.position.empty() || first.position.empty())
      throw InputError(who + "a domain has no wet surface, so there is nothing to tie.");
    const double tolerance =
      1e-9 * std::max({extent(first.position), extent(second.position), norm(first.position.front())});
    const auto pairs = common_nodes(first.position, second.position, tolerance);
    if (pairs.empty())
      throw InputError(who +
                       "no node of one wet surface lies on a node of the other. Domains that keep their own nodes "
                       "are tied where these are at the same places.");
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (k == 0 || pairs[k].first != pairs[k - 1].first) // each node of the first domain once
        places.push_back({{{domains.first, pairs[k].first, 1.}, {domains.second, pairs[k].second, -1.}}, tie});
  }


  template <int dim>
  void TiedCoupler<dim>::setup(RunContext &context)
  {
    context_       = &context;
    is_started_    = false;
    pseudo_energy_ = 0;
    balances_.assign(ties_.size(), {});
    std::vector<TiedPlace> places = places_of_adopted_;
    for (unsigned int t = 0; t < ties_.size(); ++t)
      if (!has_adopted_[ties_[t].first] && !has_adopted_[ties_[t].second])
        tie_matching(t, places);
    problem_ = InterfaceProblem<dim>(places, direct_up_to_);
    check_places();
    actions_.assign(sides_.size(), {});
    for (unsigned int r = 0; r < places.size(); ++r)
      for (const TiedPlace::Entry &entry : places[r].entries)
        actions_[entry.domain].push_back({r, entry.node, entry.weight});
    for (Side &side : sides_)
      side.multiplier.assign(places.size(), {});
    if (!problem_.is_diagonal())
      for (InterfaceBalance &balance : balances_)
        balance.n_unknowns = dim * places.size();
    context.note_effect("coupling (" + description() + ", " +
                          (problem_.is_diagonal() ? "nothing to solve" : "equations to solve") + ")",
                        true);
  }


  template <int dim>
  void TiedCoupler<dim>::check_places()
  {
    for (const Side &side : sides_)
      {
        const WetSurface<dim> &surface = side.surface();
        for (const std::vector<Vec<dim>> *field : {&surface.velocity, &surface.acceleration, &surface.inverse_mass})
          if (field->size() != surface.position.size())
            throw std::logic_error("a wet surface lacks velocities, accelerations or masses");
      }
    const Vectors gap = mismatch(&WetSurface<dim>::position);
    for (std::size_t r = 0; r < gap.size(); ++r)
      {
        const TiedPlace::Entry &first    = problem_.places()[r].entries[0];
        const Vectors          &position = sides_[first.domain].surface().position;
        if (norm(gap[r]) > 1e-9 * std::max(extent(position), norm(position[first.node])))
          throw std::logic_error("nodes that are tied lie apart");
      }
  }


  template <int dim>
  std::vector<const WetSurface<dim> *> TiedCoupler<dim>::surfaces() const
  {
    std::vector<const WetSurface<dim> *> result;
    for (const Side &side : sides_)
      result.push_back(&side.surface());
    return result;
  }


  // The tied nodes start with the same acceleration. Otherwise the multiplier would alternate around its right value
  // for ever.
  template <int dim>
  void TiedCoupler<dim>::start_with_equal_accelerations()
  {
    const Vectors multiplier =
      problem_.solve(surfaces(), std::vector<double>(sides_.size(), 1.), mismatch(&WetSurface<dim>::acceleration));
    for (Side &side : sides_)
      add_multiplier(side, multiplier, 0.);
    is_started_ = true;
  }


  template <int dim>
  double TiedCoupler<dim>::smallest_bound(const bool of_coarse) const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Side &side : sides_)
      if (side.is_coarse == of_coarse)
        {
          const double bound = part_of_step_[side.number] * side.domain->stable_time_step();
          if (!(bound > 0))
            throw BreakdownError("Coupling: the stable step of a domain is " + std::to_string(bound) + " s.");
          smallest = std::min(smallest, bound);
        }
    return smallest;
  }


  // Automatic: fine is the domain with the smallest step, and with it those whose step is less than twice as large.
  // Where that would be all, the one with the largest step is coarse.
  template <int dim>
  void TiedCoupler<dim>::choose_coarse_domains()
  {
    if (coarse_domain_ != "automatic")
      {
        for (const Tie &tie : ties_)
          sides_[coarse_domain_ == "first" ? tie.first : tie.second].is_coarse = true;
        return;
      }
    std::vector<double> bound;
    for (const Side &side : sides_)
      bound.push_back(side.domain->stable_time_step());
    const double smallest = *std::min_element(bound.begin(), bound.end());
    const auto   largest  = std::max_element(bound.begin(), bound.end()) - bound.begin();
    for (Side &side : sides_)
      side.is_coarse = side.number == static_cast<unsigned int>(largest) || bound[side.number] >= 2 * smallest;
  }


  template <int dim>
  double TiedCoupler<dim>::stable_time_step()
  {
    choose_coarse_domains();
    return plan_steps(std::numeric_limits<double>::infinity()).coarse_step;
  }


  // m = max(1, floor(Dt_A / dt_B)),  Dt = min(Dt_A, m dt_B, largest step)
  template <int dim>
  typename TiedCoupler<dim>::Schedule TiedCoupler<dim>::plan_steps(const double max_time_step) const
  {
    const double coarse_bound = smallest_bound(true), fine_bound = smallest_bound(false);
    // a ratio that should be an integer may come out a little less
    const double       ratio = std::isfinite(fine_bound) ? std::floor(coarse_bound / fine_bound * (1 + 1e-12)) : 1.;
    const unsigned int n_substeps =
      n_substeps_ > 0 ? n_substeps_ : static_cast<unsigned int>(std::clamp(ratio, 1., 1e6));
    return {std::min({coarse_bound, n_substeps * fine_bound, max_time_step}), n_substeps};
  }


  // The fine domains' bound may change within the coarse step: the time that is left is split evenly anew.
  template <int dim>
  unsigned int TiedCoupler<dim>::n_remaining_substeps(const Schedule &schedule, const double remaining) const
  {
    const double fine_bound = smallest_bound(false);
    if (!(fine_bound > 1e-9 * remaining))
      throw BreakdownError("Coupling: a fine domain's stable step fell to " + std::to_string(fine_bound) +
                           " s within a coarse step of " + std::to_string(schedule.coarse_step) + " s.");
    const double       needed = std::max(1., std::ceil(remaining / fine_bound * (1 - 1e-12)));
    const unsigned int fixed  = n_substeps_ > n_done_ ? n_substeps_ - n_done_ : 1;
    return std::max(fixed, static_cast<unsigned int>(needed));
  }


  template <int dim>
  typename TiedCoupler<dim>::Vectors TiedCoupler<dim>::mismatch(const std::vector<const Vectors *> &field) const
  {
    Vectors sum(problem_.places().size());
    for (std::size_t r = 0; r < sum.size(); ++r)
      for (const TiedPlace::Entry &entry : problem_.places()[r].entries)
        sum[r] += entry.weight * (*field[entry.domain])[entry.node];
    return sum;
  }


  template <int dim>
  typename TiedCoupler<dim>::Vectors TiedCoupler<dim>::mismatch(Vectors WetSurface<dim>::*field) const
  {
    std::vector<const Vectors *> of_sides;
    for (const Side &side : sides_)
      of_sides.push_back(&(side.surface().*field));
    return mismatch(of_sides);
  }


  template <int dim>
  typename TiedCoupler<dim>::Vectors TiedCoupler<dim>::multiplier_for_common_velocity(
    const std::vector<const Vectors *> &velocity, const double coarse_step, const double fine_step)
  {
    std::vector<double> factor;
    for (const Side &side : sides_)
      factor.push_back(0.5 * (side.is_coarse ? coarse_step : fine_step));
    return problem_.solve(surfaces(), factor, mismatch(velocity));
  }


  template <int dim>
  typename TiedCoupler<dim>::Vectors TiedCoupler<dim>::link_force(const Side &side, const Vectors &multiplier) const
  {
    Vectors force(side.surface().position.size());
    for (const Action &action : actions_[side.number])
      force[action.node] -= action.weight * multiplier[action.place];
    return force;
  }


  template <int dim>
  void TiedCoupler<dim>::add_multiplier(Side &side, const Vectors &multiplier, const double time_step)
  {
    side.domain->add_link_force(link_force(side, multiplier), time_step);
    side.multiplier = multiplier;
  }


  // A remesh changes a domain's own forces. With equal steps the multiplier changes such that tied nodes keep a common
  // acceleration, on both sides alike, so that no momentum is lost. Otherwise the domain's wet nodes keep theirs: a fine
  // domain answers a jump of the force within the coarse step, a coarse one that started with it would swing about it.
  template <int dim>
  void TiedCoupler<dim>::end_steps(const bool of_coarse)
  {
    std::vector<Vectors>         change(sides_.size());
    std::vector<const Vectors *> changes;
    bool                         has_changed = false;
    for (const Side &side : sides_)
      {
        Vectors &field = change[side.number];
        field          = side.surface().acceleration;
        if (of_coarse || !side.is_coarse)
          side.domain->end_step();
        for (std::size_t i = 0; i < field.size(); ++i)
          {
            field[i]    = side.surface().acceleration[i] - field[i];
            has_changed = has_changed || norm(field[i]) > 0;
          }
        changes.push_back(&field);
      }
    if (!has_changed)
      return;
    const bool    is_shared = of_coarse && n_done_ == 1;
    const Vectors multiplier =
      is_shared ? problem_.solve(surfaces(), std::vector<double>(sides_.size(), 1.), mismatch(changes)) : Vectors();
    for (Side &side : sides_)
      {
        Vectors &force = change[side.number];
        for (std::size_t i = 0; i < force.size(); ++i)
          force[i] *= -side.surface().mass[i];
        if (is_shared)
          force = link_force(side, multiplier);
        side.domain->add_link_force(force, 0.);
        for (std::size_t r = 0; r < multiplier.size(); ++r)
          side.multiplier[r] += multiplier[r];
      }
  }


  template <int dim>
  typename TiedCoupler<dim>::Start TiedCoupler<dim>::start_of_step(const Side &side, const double time_step) const
  {
    return {time_step, side.surface().velocity, side.multiplier};
  }


  template <int dim>
  void TiedCoupler<dim>::save(std::ostream &stream) const
  {
    for (const Side &side : sides_)
      write_binary(stream, side.multiplier);
    write_binary(stream, is_started_);
    write_binary(stream, balances_);
    write_binary(stream, pseudo_energy_);
  }


  template <int dim>
  void TiedCoupler<dim>::load(std::istream &stream)
  {
    const std::size_t n = problem_.places().size(), n_ties = ties_.size();
    for (Side &side : sides_)
      {
        read_binary(stream, side.multiplier);
        if (side.multiplier.size() != n)
          throw InputError("Coupling: the checkpoint has " + std::to_string(side.multiplier.size()) +
                           " tied nodes, the scene " + std::to_string(n) +
                           ". Resume with the scene that wrote the checkpoint.");
      }
    read_binary(stream, is_started_);
    read_binary(stream, balances_);
    read_binary(stream, pseudo_energy_);
    if (balances_.size() != n_ties)
      throw InputError("Coupling: the checkpoint has another number of ties than the scene. Resume with the scene that "
                       "wrote the checkpoint.");
  }


  template class TiedCoupler<2>;
  template class TiedCoupler<3>;
} // namespace Breakwater
