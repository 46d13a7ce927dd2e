#include "saint_venant_kirchhoff.h"

namespace Breakwater
{
  namespace
  {
    /// E = (H + H^T + H^T H) / 2.
    template <int dim>
    inline void green_lagrange_strain(const double *h, double (&strain)[dim][dim])
    {
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          {
            double sum = h[i * dim + j] + h[j * dim + i];
            for (int k = 0; k < dim; ++k)
              sum += h[k * dim + i] * h[k * dim + j];
            strain[i][j] = strain[j][i] = 0.5 * sum;
          }
    }
  } // namespace


  template <int dim>
  void SaintVenantKirchhoff<dim>::first_piola_stress(const double *displacement_gradient, double *stress,
                                                     const std::size_t n) const
  {
    const double lambda = this->lambda_, two_mu = 2 * this->mu_;
    for (std::size_t point = 0; point < n; ++point)
      {
        const double *h = displacement_gradient + point * dim * dim;
        double       *p = stress + point * dim * dim;
        double        s[dim][dim]; // first the strain E, then the stress S
        green_lagrange_strain<dim>(h, s);
        double trace = 0;
        for (int i = 0; i < dim; ++i)
          trace += s[i][i];
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            s[i][j] = two_mu * s[i][j] + (i == j ? lambda * trace : 0.);
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              double sum = s[i][j];
              for (int k = 0; k < dim; ++k)
                sum += h[i * dim + k] * s[k][j];
              p[i * dim + j] = sum;
            }
      }
  }

  template <int dim>
  double SaintVenantKirchhoff<dim>::strain_energy(const double *displacement_gradient) const
  {
    double strain[dim][dim];
    green_lagrange_strain<dim>(displacement_gradient, strain);
    double trace = 0, square = 0;
    for (int i = 0; i < dim; ++i)
      {
        trace += strain[i][i];
        for (int j = 0; j < dim; ++j)
          square += strain[i][j] * strain[i][j];
      }
    return 0.5 * this->lambda_ * trace * trace + this->mu_ * square;
  }

  template class SaintVenantKirchhoff<2>;
  template class SaintVenantKirchhoff<3>;
} // namespace Breakwater
