#pragma once

#include "isotropic_material.h"

namespace Breakwater
{
  /// Hooke's law for small strains and small rotations; a large rotation makes false stresses, so that this law is for
  /// verification and for stiff bodies.
  ///
  /// e = (H + H^T) / 2,  P = lambda tr(e) 1 + 2 mu e,  energy lambda/2 tr(e)^2 + mu e:e.
  template <int dim>
  class LinearElastic : public IsotropicMaterial<dim>
  {
  public:
    void   first_piola_stress(const double *displacement_gradient, double *stress, std::size_t n) const override;
    double strain_energy(const double *displacement_gradient) const override;
  };
} // namespace Breakwater
