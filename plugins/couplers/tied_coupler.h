#pragma once

#include "interface_problem.h"

#include <breakwater/interfaces/coupler.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// What all couplers share: the places at which domains are tied, the mass that the two sides share there, the plan
  /// of steps, the forces of the multipliers on the domains and what is measured of them.
  ///
  /// A multiplier lambda [N] acts on the nodes of its place by -w lambda, w > 0 in the tie's first domain, w < 0 in its
  /// second one. Domains with large steps are coarse and make one in a call of advance(), the others, fine, several.
  template <int dim>
  class TiedCoupler : public Coupler<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    void   adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains, const std::vector<Tie> &ties) override;
    void   setup(RunContext &context) override;
    double stable_time_step() override;
    const InterfaceBalance &balance(const unsigned int tie) const override { return balances_[tie]; }
    Vec<dim>                interface_force(unsigned int tie) const override;
    void                    save(std::ostream &stream) const override;
    void                    load(std::istream &stream) override;

    /// What the link forces f gave to the energy of the increments of all domains [J]: the sum over all steps of
    /// (Dt^2 / dt) [f] . [v], with [x] the change in a step. InterfaceBalance::energy is the work itself.
    double pseudo_energy() const { return pseudo_energy_; }

  protected:
    using Vectors = std::vector<Vec<dim>>;

    /// A domain and the multipliers that are in its present accelerations.
    struct Side
    {
      ExplicitDomain<dim> *domain;
      unsigned int         number; ///< in the list of domains
      bool                 is_coarse = false;
      Vectors              multiplier; ///< one per place [N]

      const WetSurface<dim> &surface() const { return domain->wet_surface(); }
    };

    /// What a side has at the start of a step.
    struct Start
    {
      double  time_step = 0;        ///< [s]
      Vectors velocity, multiplier; ///< [m/s], [N]
    };

    /// The lengths of steps, as planned at the start of a coarse step.
    struct Schedule
    {
      double       coarse_step; ///< Dt [s]
      unsigned int n_substeps;  ///< m
    };

    /// True if the coupler lets adopted nodes carry a real share of their owners' mass.
    virtual bool shares_mass() const { return true; }

    /// What the run says of the coupler.
    virtual std::string description() const = 0;

    virtual void choose_coarse_domains();
    Schedule     plan_steps(double max_time_step) const;
    unsigned int n_remaining_substeps(const Schedule &schedule, double remaining) const;
    double       smallest_bound(bool of_coarse) const;

    void start_with_equal_accelerations();

    /// lambda of H lambda = g, H with this factor for each domain.
    Vectors solve_with(const std::vector<double> &factor, const Vectors &g)
    {
      return problem_.solve(surfaces(), factor, g);
    }

    /// lambda of H lambda = sum of w v, H with half of its step for each domain.
    /// @param velocity of all nodes of each domain [m/s]
    Vectors multiplier_for_common_velocity(const std::vector<const Vectors *> &velocity, double coarse_step,
                                           double fine_step);

    Vectors link_force(const Side &side, const Vectors &multiplier) const; ///< [N], one per node
    Vectors mismatch(const std::vector<const Vectors *> &field) const;     ///< sum of w times field
    Vectors mismatch(Vectors WetSurface<dim>::*field) const;
    void    add_multiplier(Side &side, const Vectors &multiplier, double time_step); ///< and keeps it
    Start   start_of_step(const Side &side, double time_step) const;
    void    add_link_work(const Side &side, const Start &start, double coarse_step);
    void    end_steps(bool of_coarse);
    void    measure_gap();
    void    take_back_drift();

    RunContext                   *context_    = nullptr;
    bool                          is_started_ = false;
    std::vector<Side>             sides_; ///< one per domain
    InterfaceProblem<dim>         problem_;
    std::vector<InterfaceBalance> balances_; ///< one per tie
    double                        pseudo_energy_ = 0;
    unsigned int                  n_substeps_    = 0; ///< fixed number; 0: automatic
    unsigned int                  n_done_        = 0; ///< fine steps in the present coarse step
    unsigned int                  n_passes_ = 0; ///< repetitions of the fine steps in the present coarse step, if any

    bool   has_adopted(const unsigned int domain) const { return has_adopted_[domain] != 0; }
    double carried_mass(std::size_t place) const { return place < carried_mass_.size() ? carried_mass_[place] : 0.; }

  private:
    /// Where a place acts on a domain.
    struct Action
    {
      unsigned int place, node;
      double       weight;
    };

    void tie_adopted(unsigned int tie, unsigned int adopter, unsigned int owner, std::vector<TiedPlace> &places);
    void tie_matching(unsigned int tie, std::vector<TiedPlace> &places) const;
    void check_places();
    void move_copies(const Side &side, const Vectors &drift) const;
    std::vector<const WetSurface<dim> *> surfaces() const;

    std::string  interface_     = "matching";
    double       spacing_       = 0; ///< of the nodes of a surface that does not match [m]
    double       mass_share_    = 0.5;
    unsigned int direct_up_to_  = 20000;
    std::string  coarse_domain_ = "automatic";

    std::vector<Tie>                 ties_;
    std::vector<double>              part_of_step_;      ///< [domain] of its stable step that it may take
    std::vector<char>                has_adopted_;       ///< [domain]
    std::vector<TiedPlace>           places_of_adopted_; ///< the first of all places
    std::vector<double>              carried_mass_;      ///< by their adopted nodes for the owner [kg]
    std::vector<std::vector<Action>> actions_;           ///< [domain]
  };
} // namespace Breakwater
