#pragma once

#include <breakwater/base/parameter_reader.h>

namespace Breakwater
{
  /// Density and the two constants of an isotropic elastic solid.
  class ElasticConstants
  {
  public:
    void declare_parameters(ParameterReader &reader);

    double density() const { return density_; } ///< undeformed [kg/m^3]
    double lambda() const;                      ///< first constant of Lame, E nu / ((1 + nu) (1 - 2 nu)) [Pa]
    double mu() const;                          ///< shear modulus, E / (2 (1 + nu)) [Pa]
    double wave_speed() const;                  ///< of dilational waves, sqrt((lambda + 2 mu) / density) [m/s]

  private:
    double density_        = 1000; ///< [kg/m^3]
    double youngs_modulus_ = 1e6;  ///< [Pa]
    double poissons_ratio_ = 0.3;
  };
} // namespace Breakwater
