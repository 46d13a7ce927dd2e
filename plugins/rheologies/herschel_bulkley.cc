#include "herschel_bulkley.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <limits>

#include "yield_viscosity.h"

namespace Breakwater
{
  void HerschelBulkley::declare_parameters(ParameterReader &reader)
  {
    reader.add("Consistency", consistency_, "K in tau = tau_y + K g^n [Pa s^n]", Range::not_negative());
    reader.add("Yield stress", yield_stress_, "Shear stress tau_y below which nothing flows [Pa]",
               Range::not_negative());
    reader.add("Flow index", flow_index_, "Exponent n [-]; below 1 the fluid is shear thinning, above 1 thickening",
               {0.01, 3.});
    reader.add("Regularization", regularization_,
               "m [s]: the law holds for shear rates well above 1 / m; below, a thinning fluid's viscosity is at most "
               "K m^(1-n) + tau_y m. A larger m is closer to the ideal law and makes the stable step smaller.",
               Range::positive());
    reader.add("Largest shear rate", largest_shear_rate_,
               "Shear rate [1/s] above which a thickening fluid's power law thickens no more; 0: none, for n <= 1",
               Range::not_negative());
  }


  void HerschelBulkley::check_parameters(ParameterReader &reader)
  {
    if (!(consistency_ > 0) && !(yield_stress_ > 0))
      reader.fail("Consistency", "the law is empty: give \"Consistency\" [Pa s^n], \"Yield stress\" [Pa] or both, or "
                                 "choose the rheology `inviscid`");
    const bool thickens = flow_index_ > 1;
    if (thickens && !(largest_shear_rate_ > 0))
      reader.fail("Largest shear rate", "a flow index above 1 needs one [1/s]: no step is stable at a viscosity "
                                        "without bound");
    if (!thickens && largest_shear_rate_ > 0)
      reader.fail("Largest shear rate", "only a flow index above 1 has one: the viscosity falls with the shear rate");

    power_law_from_    = flow_index_ < 1 ? 1 / regularization_ : 0.;
    power_law_to_      = thickens ? largest_shear_rate_ : std::numeric_limits<double>::max();
    const double worst = thickens ? power_law_to_ : power_law_from_;
    largest_viscosity_ = consistency_ * std::pow(worst, flow_index_ - 1) + yield_stress_ * regularization_;
  }


  // eta(g) = K G^(n-1) + tau_y [1 - exp(-m g)] / g
  void HerschelBulkley::viscosity(const double *shear_rate, double *viscosity, const std::size_t n) const
  {
    for (std::size_t i = 0; i < n; ++i)
      {
        const double power_law_rate = std::clamp(shear_rate[i], power_law_from_, power_law_to_);
        viscosity[i]                = consistency_ * std::pow(power_law_rate, flow_index_ - 1) +
                       yield_viscosity(yield_stress_, regularization_, shear_rate[i]);
      }
  }
} // namespace Breakwater
