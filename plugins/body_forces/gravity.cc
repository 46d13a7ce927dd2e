#include "gravity.h"

#include <breakwater/base/parameter_reader.h>

namespace Breakwater
{
  template <int dim>
  void Gravity<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Acceleration", acceleration_, "g [m/s^2], one component per dimension");
  }


  template <int dim>
  void Gravity<dim>::add_acceleration(const double, const std::vector<Vec<dim>> &,
                                      std::vector<Vec<dim>> &acceleration) const
  {
    for (Vec<dim> &a : acceleration)
      a += acceleration_;
  }


  template class Gravity<2>;
  template class Gravity<3>;
} // namespace Breakwater
