#pragma once

#include "elastic_constants.h"

#include <breakwater/interfaces/material.h>

namespace Breakwater
{
  /// What laws share that are known by the two constants of a linear isotropic solid.
  template <int dim>
  class IsotropicMaterial : public Material<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override { constants_.declare_parameters(reader); }
    void check_parameters(ParameterReader &) override
    {
      lambda_ = constants_.lambda();
      mu_     = constants_.mu();
    }

    double density() const override { return constants_.density(); }
    double wave_speed() const override { return constants_.wave_speed(); }

  protected:
    double lambda_ = 0; ///< [Pa]
    double mu_     = 0; ///< [Pa]

  private:
    ElasticConstants constants_;
  };
} // namespace Breakwater
