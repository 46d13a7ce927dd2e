#include "mooney_rivlin.h"

#include "finite_strain.h"

#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// C = F^T F.
    void right_cauchy_green(const double (&f)[3][3], double (&c)[3][3])
    {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          c[i][j] = f[0][i] * f[0][j] + f[1][i] * f[1][j] + f[2][i] * f[2][j];
    }
  } // namespace


  template <int dim>
  void MooneyRivlin<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Density", density_, "Density of the undeformed solid [kg/m^3].", Range::positive());
    reader.add("C1", c1_, "Constant of the first invariant [Pa].");
    reader.add("C2", c2_, "Constant of the second invariant [Pa]; 2 (C1 + C2) is the shear modulus at small strain.");
    reader.add("Bulk modulus", bulk_modulus_,
               "Resistance to changes of volume, K [Pa]. Far above the shear modulus, the nearly incompressible solid "
               "needs a small time step, and cells of degree 1 become too stiff.",
               Range::positive());
  }

  template <int dim>
  void MooneyRivlin<dim>::check_parameters(ParameterReader &reader)
  {
    if (!(c1_ + c2_ > 0))
      reader.fail("C2", "C1 + C2, half of the shear modulus, must be above 0 Pa; it is " + std::to_string(c1_ + c2_));
  }

  template <int dim>
  double MooneyRivlin<dim>::wave_speed() const
  {
    return std::sqrt((bulk_modulus_ + 8. / 3 * (c1_ + c2_)) / density_);
  }

  template <int dim>
  void MooneyRivlin<dim>::first_piola_stress(const double *displacement_gradient, double *stress,
                                             const std::size_t n) const
  {
    for (std::size_t point = 0; point < n; ++point)
      {
        const auto strain = FiniteStrain::from<dim>(displacement_gradient + point * dim * dim);
        double     c[3][3];
        right_cauchy_green(strain.f, c);
        const double i1 = square(strain.f), i2 = 0.5 * (i1 * i1 - square(c)), volume = strain.volume_ratio;
        const double first = 2 * c1_ * std::pow(volume, -2. / 3), second = 2 * c2_ * std::pow(volume, -4. / 3);
        const double across = bulk_modulus_ * (volume - 1) * volume - first * i1 / 3 - second * i2 * 2 / 3;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              double fc = 0;
              for (int k = 0; k < dim; ++k)
                fc += strain.f[i][k] * c[k][j];
              stress[(point * dim + i) * dim + j] =
                (first + second * i1) * strain.f[i][j] - second * fc + across * strain.inverse_transposed[i][j];
            }
      }
  }

  template <int dim>
  double MooneyRivlin<dim>::strain_energy(const double *displacement_gradient) const
  {
    const auto strain = FiniteStrain::from<dim>(displacement_gradient);
    double     c[3][3];
    right_cauchy_green(strain.f, c);
    const double i1 = square(strain.f), i2 = 0.5 * (i1 * i1 - square(c)), volume = strain.volume_ratio;
    return c1_ * (std::pow(volume, -2. / 3) * i1 - 3) + c2_ * (std::pow(volume, -4. / 3) * i2 - 3) +
           0.5 * bulk_modulus_ * (volume - 1) * (volume - 1);
  }

  template class MooneyRivlin<2>;
  template class MooneyRivlin<3>;
} // namespace Breakwater
