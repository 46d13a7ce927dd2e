#pragma once

#include <breakwater/base/parameter_reader.h>
#include <breakwater/interfaces/material.h>

namespace Breakwater
{
  /// Rubber with two constants for changes of shape and one for changes of volume, fitted to tests of the material.
  ///
  /// W = C1 (J^(-2/3) I1 - 3) + C2 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2,
  /// P = 2 C1 J^(-2/3) (F - I1/3 F^-T) + 2 C2 J^(-4/3) (I1 F - F F^T F - 2/3 I2 F^-T) + K (J - 1) J F^-T,
  /// I1 = tr C, I2 = (I1^2 - tr C^2) / 2, C = F^T F, J = det F (Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.5).
  /// At small strain the shear modulus is 2 (C1 + C2), the bulk modulus K.
  template <int dim>
  class MooneyRivlin : public Material<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    double density() const override { return density_; }
    void   first_piola_stress(const double *displacement_gradient, double *stress, std::size_t n) const override;
    double strain_energy(const double *displacement_gradient) const override;
    double wave_speed() const override;

  private:
    double density_      = 1000;  ///< undeformed [kg/m^3]
    double c1_           = 1.5e5; ///< [Pa]
    double c2_           = 0.5e5; ///< [Pa]
    double bulk_modulus_ = 2e6;   ///< K [Pa]
  };
} // namespace Breakwater
