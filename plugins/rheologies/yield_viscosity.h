#pragma once

#include <cmath>

namespace Breakwater
{
  /// Part of the viscosity [Pa s] that a yield stress makes, regularised: tau_y [1 - exp(-m g)] / g, which falls from
  /// tau_y m at rest to tau_y / g at shear rates far above 1 / m.
  /// Source: T. C. Papanastasiou, Flows of materials with yield, Journal of Rheology 31 (1987) 385.
  /// @param yield_stress tau_y [Pa]
  /// @param regularization m [s]
  /// @param shear_rate g [1/s], not negative
  inline double yield_viscosity(const double yield_stress, const double regularization, const double shear_rate)
  {
    // tau_y m (1 - exp(-x)) / x, x = m g; expm1 keeps all digits for small x.
    const double x = regularization * shear_rate;
    return yield_stress * regularization * (x > 0 ? -std::expm1(-x) / x : 1.);
  }
} // namespace Breakwater
