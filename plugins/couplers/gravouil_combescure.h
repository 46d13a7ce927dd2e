#pragma once

#include <breakwater/interfaces/coupler.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// Ties the velocities of two domains at matching nodes by Lagrange multipliers; each has its own time step.
  ///
  /// The scheme of Gravouil and Combescure, Multi-time-step explicit-implicit method for non-linear structural
  /// dynamics, Int. J. Numer. Meth. Engng 50 (2001) 199-225, for two explicit domains; doc/coupling.md has the formulas
  /// and what was measured. The domain with the larger stable step is the coarse one, A; the fine one, B, makes m steps
  /// in one of A. The nodes of the two wet surfaces correspond by their numbers, so that the interface operator is
  /// diagonal and nothing has to be solved.
  ///
  /// The proof that no energy is made asks that either domain be stable on its own. A domain that took its surface from
  /// the other (adopt_surface(), a fluid) is not: its tied nodes are almost massless copies. The two then make equal
  /// steps, for which the scheme is that of shared nodes, and the copies follow their owners to the bit.
  template <int dim>
  class GravouilCombescure : public Coupler<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;

    void   adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains, const std::vector<Tie> &ties) override;
    void   setup(RunContext &context) override;
    double advance(double max_time_step) override;
    const InterfaceBalance &balance(unsigned int) const override { return balance_; }
    Vec<dim>                interface_force(unsigned int tie) const override;
    void                    save(std::ostream &stream) const override;
    void                    load(std::istream &stream) override;

    /// What the link forces f gave to the energy of the increments of both domains [J]: the sum over all steps of
    /// (Dt^2 / dt) [f] . [v], with [x] the change in a step. Without copied nodes it never grows: the proof of
    /// stability. InterfaceBalance::energy is the work itself.
    double pseudo_energy() const { return pseudo_energy_; }

  private:
    using Vectors = std::vector<Vec<dim>>;

    /// One of the two domains and the forces that the other one exerts on it.
    struct Side
    {
      ExplicitDomain<dim> *domain = nullptr;
      double               sign   = 0;          ///< of the multiplier as a force on this domain: -1 first, +1 second
      Vectors              link_force;          ///< in the present accelerations of the domain [N]
      bool                 has_adopted = false; ///< its tied nodes are copies of the other domain's

      const WetSurface<dim> &surface() const { return domain->wet_surface(); }
    };

    /// The lengths of steps, as planned at the start of a coarse step.
    struct Schedule
    {
      double       coarse_step; ///< Dt [s]
      unsigned int n_substeps;  ///< m
    };

    /// What the tied nodes of a domain have at the start of a step.
    struct Start
    {
      double  time_step;                          ///< [s]
      Vectors velocity, acceleration, link_force; ///< [m/s], [m/s^2], [N]
    };

    void          check_surfaces() const;
    void          balance_initial_accelerations();
    static double stable_step(const Side &side, const Side &partner);
    bool          first_is_coarse() const;
    Schedule      plan_steps(const Side &coarse, const Side &fine, double max_time_step) const;
    unsigned int  n_remaining_substeps(const Schedule &schedule, double fine_bound, double remaining) const;
    Start         start_of_step(const Side &side, double time_step) const;
    Vectors       free_velocity_at_start(const Side &coarse, double coarse_step) const;

    void    link_at_end(Side &coarse, Side &fine, const Start &coarse_start, const Start &fine_start);
    Vectors multiplier_for_common_velocity(const Vectors &coarse_free, const Side &coarse, const Side &fine,
                                           double coarse_step, double fine_step) const;
    Vectors multiplier_for_common_acceleration() const;
    void    add_multiplier(Side &side, const Vectors &multiplier, double time_step);

    Vectors force_for(const Side &side, const Vectors &change_of_acceleration) const;
    void    add_force(Side &side, const Vectors &force, double time_step);
    void    set_acceleration(Side &side, const Vectors &acceleration);
    void    set_velocity(Side &side, const Vectors &velocity, double time_step);
    void    start_on_straight_path(Side &copy, const Start &owner, double time_step);
    void    stay_on_straight_path(Side &copy, double time_step);

    void add_link_work(const Side &side, const Start &start, double coarse_step);
    void measure_gap();
    void measure_drift();

    std::string  interface_     = "matching";
    std::string  coarse_domain_ = "automatic";
    unsigned int n_substeps_    = 0; ///< 0: automatic

    Side             first_, second_;
    RunContext      *context_    = nullptr;
    bool             is_started_ = false; ///< the accelerations of the two domains are balanced
    InterfaceBalance balance_;
    double           pseudo_energy_ = 0;
  };
} // namespace Breakwater
