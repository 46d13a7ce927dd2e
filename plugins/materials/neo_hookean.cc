#include "neo_hookean.h"

#include "finite_strain.h"

#include <cmath>

namespace Breakwater
{
  template <int dim>
  void NeoHookean<dim>::first_piola_stress(const double *displacement_gradient, double *stress,
                                           const std::size_t n) const
  {
    const double lambda = this->lambda_, mu = this->mu_;
    for (std::size_t point = 0; point < n; ++point)
      {
        const auto   strain = FiniteStrain::from<dim>(displacement_gradient + point * dim * dim);
        const double across = lambda * std::log(strain.volume_ratio) - mu;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            stress[(point * dim + i) * dim + j] = mu * strain.f[i][j] + across * strain.inverse_transposed[i][j];
      }
  }

  template <int dim>
  double NeoHookean<dim>::strain_energy(const double *displacement_gradient) const
  {
    const double lambda = this->lambda_, mu = this->mu_;
    const auto   strain    = FiniteStrain::from<dim>(displacement_gradient);
    const double logarithm = std::log(strain.volume_ratio);
    return 0.5 * mu * (square(strain.f) - 3) - mu * logarithm + 0.5 * lambda * logarithm * logarithm;
  }

  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace Breakwater
