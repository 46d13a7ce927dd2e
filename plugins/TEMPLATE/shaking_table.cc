#include "shaking_table.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/plugin_export.h>

#include <cmath>

namespace Breakwater
{
  template <int dim>
  void ShakingTable<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Amplitude", amplitude_, "Largest acceleration A, as a vector [m/s^2].");
    reader.add("Frequency", frequency_, "Frequency f [1/s].", Range::positive());
  }

  // a(t) = A sin(2 pi f t)
  template <int dim>
  void ShakingTable<dim>::add_acceleration(const double time, const std::vector<Vec<dim>> &,
                                           std::vector<Vec<dim>> &acceleration) const
  {
    const Vec<dim> now = std::sin(2 * M_PI * frequency_ * time) * amplitude_;
    for (Vec<dim> &a : acceleration)
      a += now;
  }

  template class ShakingTable<2>;
  template class ShakingTable<3>;
} // namespace Breakwater

// What breakwater calls when it loads this library: each plugin by its interface, its name and one line about it.
BREAKWATER_PLUGIN_LIBRARY(registry)
{
  using namespace Breakwater;
  registry.add<BodyForce<2>, ShakingTable<2>>("Shaking table", "a sinusoidal acceleration along one line");
  registry.add<BodyForce<3>, ShakingTable<3>>("Shaking table", "a sinusoidal acceleration along one line");
}
