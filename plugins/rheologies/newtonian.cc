#include "newtonian.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>

namespace Breakwater
{
  void Newtonian::declare_parameters(ParameterReader &reader)
  {
    reader.add("Viscosity", viscosity_, "Dynamic viscosity mu [Pa s]; water 0.001", Range::not_negative());
  }


  void Newtonian::viscosity(const double *, double *viscosity, const std::size_t n) const
  {
    std::fill_n(viscosity, n, viscosity_);
  }
} // namespace Breakwater
