#pragma once

#include "isotropic_material.h"

namespace Breakwater
{
  /// The linear law between the Green-Lagrange strain and the second Piola-Kirchhoff stress: exact for any rotation,
  /// meant for small to moderate strains. It softens under compression: a bar has no strength left when it is pressed
  /// to 1/sqrt(3) = 0.577 of its length.
  ///
  /// E = (H + H^T + H^T H) / 2,  S = lambda tr(E) 1 + 2 mu E,  P = (1 + H) S,  energy lambda/2 tr(E)^2 + mu E:E
  /// (Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.5).
  template <int dim>
  class SaintVenantKirchhoff : public IsotropicMaterial<dim>
  {
  public:
    void   first_piola_stress(const double *displacement_gradient, double *stress, std::size_t n) const override;
    double strain_energy(const double *displacement_gradient) const override;
  };
} // namespace Breakwater
