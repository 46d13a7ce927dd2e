#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/interfaces/explicit_domain.h>

namespace Breakwater
{
  /// What a coupler measures: the proof that the interface makes no energy.
  struct InterfaceBalance
  {
    double       energy             = 0; ///< kinetic energy from the link forces on both domains since the start [J]
    double       velocity_gap       = 0; ///< largest difference of the tied velocities at the last fine step [m/s]
    double       largest_gap        = 0; ///< largest velocity gap of the run [m/s]
    double       displacement_drift = 0; ///< largest difference of the tied positions since the last correction [m]
    unsigned int n_substeps         = 1; ///< fine steps in the last coarse step, m
  };

  /// Advances two explicit domains together in time, tied at their wet surfaces.
  template <int dim>
  class Coupler : public Plugin
  {
  public:
    static constexpr const char *interface_name = "coupler";
    static constexpr int         dimension      = dim;

    /// Ties the domains. Both references outlive the coupler.
    /// @pre the domains are set up and have wet surfaces
    /// @throws InputError if the surfaces can't be tied in the way that the parameters ask for
    virtual void setup(ExplicitDomain<dim> &first, ExplicitDomain<dim> &second, RunContext &context) = 0;

    /// One coarse step, not longer than max_time_step [s]. @return its length [s]
    virtual double advance(double max_time_step) = 0;

    virtual const InterfaceBalance &balance() const = 0;

    /// Total force of the first domain on the second at the last step [N].
    virtual Vec<dim> interface_force() const = 0;

    virtual void save(std::ostream &stream) const = 0;
    virtual void load(std::istream &stream)       = 0;
  };
} // namespace Breakwater
