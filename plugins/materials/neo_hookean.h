#pragma once

#include "isotropic_material.h"

namespace Breakwater
{
  /// A rubber-like solid for any strain: it resists being pressed to nothing.
  ///
  /// W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2,  P = mu (F - F^-T) + lambda ln J F^-T,  I1 = tr(F^T F), J = det F
  /// (Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., section 6.4.3).
  template <int dim>
  class NeoHookean : public IsotropicMaterial<dim>
  {
  public:
    void   first_piola_stress(const double *displacement_gradient, double *stress, std::size_t n) const override;
    double strain_energy(const double *displacement_gradient) const override;
  };
} // namespace Breakwater
