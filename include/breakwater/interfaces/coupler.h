#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/interfaces/explicit_domain.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// Two domains that are tied to each other, by their numbers in the list of all domains.
  struct Tie
  {
    std::string  name; ///< in messages and output
    unsigned int first, second;
  };

  /// What a coupler measures at one tie: the proof that the interface makes no energy.
  struct InterfaceBalance
  {
    double       energy             = 0; ///< kinetic energy from the link forces on both domains since the start [J]
    double       velocity_gap       = 0; ///< largest difference of the tied velocities at the last fine step [m/s]
    double       largest_gap        = 0; ///< largest velocity gap of the run [m/s]
    double       displacement_drift = 0; ///< largest difference of the tied positions after the last coarse step [m]
    double       largest_drift      = 0; ///< largest displacement drift of the run [m]
    double       taken_back         = 0; ///< largest way by which a node was put back after the last coarse step [m]
    double       largest_taken_back = 0; ///< of the run [m]
    Vec<3>       momentum;               ///< that the link forces on all domains have not in balance [kg m/s]
    unsigned int n_substeps   = 1;       ///< fine steps in the last coarse step, m
    unsigned int n_unknowns   = 0;       ///< multipliers that depend on each other; 0: each on its own
    unsigned int n_iterations = 0;       ///< of the solver in the last coarse step; 0: direct or nothing to solve
  };

  /// Advances explicit domains together in time, tied in pairs at their wet surfaces.
  template <int dim>
  class Coupler : public Plugin
  {
  public:
    static constexpr const char *interface_name = "coupler";
    static constexpr int         dimension      = dim;

    /// Domains that can take the wet surfaces of their partners for their own do so. The domains outlive the coupler.
    /// @pre these domains are not set up yet, all the others are
    /// @throws InputError if surfaces can't be tied in the way that the parameters ask for
    virtual void adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains, const std::vector<Tie> &ties) = 0;

    /// @pre adopt_surfaces() was called; all domains are set up
    /// @throws InputError if surfaces can't be tied in the way that the parameters ask for
    virtual void setup(RunContext &context) = 0;

    /// The coarse step [s] that is stable now: what advance() takes if nothing cuts it short.
    virtual double stable_time_step() = 0;

    /// One coarse step of all domains, not longer than max_time_step [s]. @return its length [s]
    virtual double advance(double max_time_step) = 0;

    virtual const InterfaceBalance &balance(unsigned int tie) const = 0;

    /// Total force of the tie's first domain on its second one at the last step [N].
    virtual Vec<dim> interface_force(unsigned int tie) const = 0;

    virtual void save(std::ostream &stream) const = 0;
    virtual void load(std::istream &stream)       = 0;
  };
} // namespace Breakwater
