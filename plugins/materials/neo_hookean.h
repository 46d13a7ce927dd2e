#pragma once

#include "elastic_constants.h"

#include <breakwater/interfaces/material.h>

namespace Breakwater
{
  /// A rubber-like solid for any strain: it resists being pressed to nothing.
  ///
  /// W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2,  P = mu (F - F^-T) + lambda ln J F^-T,  I1 = tr(F^T F), J = det F
  /// (Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., section 6.4.3).
  template <int dim>
  class NeoHookean : public Material<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    double density() const override { return constants_.density(); }
    void   first_piola_stress(const double *displacement_gradient, double *stress, std::size_t n) const override;
    double strain_energy(const double *displacement_gradient) const override;
    double wave_speed() const override { return constants_.wave_speed(); }

  private:
    ElasticConstants constants_;
    double           lambda_ = 0; ///< [Pa]
    double           mu_     = 0; ///< [Pa]
  };
} // namespace Breakwater
