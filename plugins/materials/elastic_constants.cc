#include "elastic_constants.h"

#include <cmath>

namespace Breakwater
{
  void ElasticConstants::declare_parameters(ParameterReader &reader)
  {
    reader.add("Density", density_, "Density of the undeformed solid [kg/m^3].", Range::positive());
    reader.add("Young's modulus", youngs_modulus_, "Young's modulus E at small strain [Pa].", Range::positive());
    reader.add("Poisson's ratio", poissons_ratio_,
               "Poisson's ratio nu [-]. Close to 0.5, the nearly incompressible solid needs a small time step, and "
               "cells of degree 1 become too stiff.",
               Range{-0.99, 0.4999});
  }

  double ElasticConstants::lambda() const
  {
    return youngs_modulus_ * poissons_ratio_ / ((1 + poissons_ratio_) * (1 - 2 * poissons_ratio_));
  }

  double ElasticConstants::mu() const
  {
    return youngs_modulus_ / (2 * (1 + poissons_ratio_));
  }

  double ElasticConstants::wave_speed() const
  {
    return std::sqrt((lambda() + 2 * mu()) / density_);
  }
} // namespace Breakwater
