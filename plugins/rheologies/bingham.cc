#include "bingham.h"

#include <breakwater/base/parameter_reader.h>

#include "yield_viscosity.h"

namespace Breakwater
{
  void Bingham::declare_parameters(ParameterReader &reader)
  {
    reader.add("Plastic viscosity", plastic_viscosity_, "Viscosity mu_p above the yield stress [Pa s]",
               Range::not_negative());
    reader.add("Yield stress", yield_stress_, "Shear stress tau_y below which nothing flows [Pa]",
               Range::not_negative());
    reader.add("Regularization", regularization_,
               "m [s]: the yield stress is there for shear rates well above 1 / m; below, the viscosity is at most "
               "mu_p + tau_y m. A larger m is closer to the ideal law and makes the stable step smaller.",
               Range::positive());
  }


  void Bingham::check_parameters(ParameterReader &reader)
  {
    if (!(plastic_viscosity_ > 0) && !(yield_stress_ > 0))
      reader.fail("Plastic viscosity", "the law is empty: give \"Plastic viscosity\" [Pa s], \"Yield stress\" [Pa] or "
                                       "both, or choose the rheology `inviscid`");
  }


  // eta(g) = mu_p + tau_y [1 - exp(-m g)] / g
  void Bingham::viscosity(const double *shear_rate, double *viscosity, const std::size_t n) const
  {
    for (std::size_t i = 0; i < n; ++i)
      viscosity[i] = plastic_viscosity_ + yield_viscosity(yield_stress_, regularization_, shear_rate[i]);
  }
} // namespace Breakwater
