#include "linear_elastic.h"

namespace Breakwater
{
  template <int dim>
  void LinearElastic<dim>::first_piola_stress(const double *displacement_gradient, double *stress,
                                              const std::size_t n) const
  {
    const double lambda = this->lambda_, mu = this->mu_;
    for (std::size_t point = 0; point < n; ++point)
      {
        const double *h     = displacement_gradient + point * dim * dim;
        double       *p     = stress + point * dim * dim;
        double        trace = 0;
        for (int i = 0; i < dim; ++i)
          trace += h[i * dim + i];
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            p[i * dim + j] = mu * (h[i * dim + j] + h[j * dim + i]) + (i == j ? lambda * trace : 0.);
      }
  }

  template <int dim>
  double LinearElastic<dim>::strain_energy(const double *displacement_gradient) const
  {
    double trace = 0, square = 0;
    for (int i = 0; i < dim; ++i)
      {
        trace += displacement_gradient[i * dim + i];
        for (int j = 0; j < dim; ++j)
          {
            const double strain = 0.5 * (displacement_gradient[i * dim + j] + displacement_gradient[j * dim + i]);
            square += strain * strain;
          }
      }
    return 0.5 * this->lambda_ * trace * trace + this->mu_ * square;
  }

  template class LinearElastic<2>;
  template class LinearElastic<3>;
} // namespace Breakwater
