#include "neo_hookean.h"

#include "finite_strain.h"

#include <cmath>

namespace Breakwater
{
  template <int dim>
  void NeoHookean<dim>::declare_parameters(ParameterReader &reader)
  {
    constants_.declare_parameters(reader);
  }

  template <int dim>
  void NeoHookean<dim>::check_parameters(ParameterReader &)
  {
    lambda_ = constants_.lambda();
    mu_     = constants_.mu();
  }

  template <int dim>
  void NeoHookean<dim>::first_piola_stress(const double *displacement_gradient, double *stress,
                                           const std::size_t n) const
  {
    for (std::size_t point = 0; point < n; ++point)
      {
        const auto   strain = FiniteStrain::from<dim>(displacement_gradient + point * dim * dim);
        const double across = lambda_ * std::log(strain.volume_ratio) - mu_;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            stress[(point * dim + i) * dim + j] = mu_ * strain.f[i][j] + across * strain.inverse_transposed[i][j];
      }
  }

  template <int dim>
  double NeoHookean<dim>::strain_energy(const double *displacement_gradient) const
  {
    const auto   strain    = FiniteStrain::from<dim>(displacement_gradient);
    const double logarithm = std::log(strain.volume_ratio);
    return 0.5 * mu_ * (square(strain.f) - 3) - mu_ * logarithm + 0.5 * lambda_ * logarithm * logarithm;
  }

  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace Breakwater
