#pragma once

#include <breakwater/interfaces/time_step_bound.h>

namespace Breakwater
{
  /// dt = min over cells of r_in / c, the insphere radius over the sound speed: Meduri, Cremonesi and Perego, eq. (8).

  template <int dim>
  class InsphereBound : public TimeStepBound<dim>
  {
  public:
    double bound(const LinearizedFluid<dim> &fluid) override;
  };
} // namespace Breakwater
