#include "four_cells.h"

// The velocity filter, compiled once per instruction set (see element_passes.cc).

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    namespace
    {
      /// The mean of the recovered velocity gradients at the corners of four cells.
      template <int dim>
      inline void mean_gradient(const FourCells<dim> &four, const Quad *gradient, V4 (*mean)[4])
      {
        for (int d = 0; d < dim; ++d)
          {
            for (int k = 0; k < 4; ++k)
              {
                mean[d][k] = load(gradient[four.node(k, 0) * dim + d]);
                for (int a = 1; a <= dim; ++a)
                  mean[d][k] += load(gradient[four.node(k, a) * dim + d]);
                mean[d][k] *= all(1. / (dim + 1));
              }
            transpose(mean[d][0], mean[d][1], mean[d][2], mean[d][3]);
          }
      }

      /// Pressure impulse against what the cell's rate of volume differs from the mean divergence around it.
      template <int dim>
      inline V4 push_of(const FourCells<dim> &four, const FilterWeights &weights, const V4 (*u)[4],
                        const V4 (*gradient)[4], const Geometry<dim> &geometry, const double *inverse_mass)
      {
        constexpr double n_neighbors = dim == 2 ? 13. : 60.; // cells that share a node with one, itself included
        V4               rate = all(0.), compliance = all(0.), divergence = gradient[0][0] + gradient[1][1];
        if constexpr (dim == 3)
          divergence += gradient[2][2];
        for (int a = 0; a <= dim; ++a)
          {
            V4 square = all(0.);
            for (int d = 0; d < dim; ++d)
              {
                rate += u[a][d] * geometry.area[a][d];
                square += geometry.area[a][d] * geometry.area[a][d];
              }
            compliance += square * four.gather(inverse_mass, a);
          }
        return all(-weights.divergence / n_neighbors) * (rate - geometry.volume * divergence) / compliance;
      }

      template <int dim>
      void filter_impulses(const unsigned int *cells, const std::size_t n_cells, const FilterWeights &weights,
                           const Quad *xp, const Quad *v, const Quad *gradient, const double *node_density,
                           const double *inverse_mass, Quad *impulse)
      {
        constexpr int       n           = dim + 1;
        const FilterWeights own_weights = weights; // which no store to the impulses can change
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 density = four.gather(node_density, 0);
            for (int a = 1; a < n; ++a)
              density = smaller(density, four.gather(node_density, a));
            V4 x[n][4], u[n][4], mean[dim][4];
            for (int a = 0; a < n; ++a)
              four.gather(xp, a, x[a]);
            const Geometry<dim> geometry(x);
            mean_gradient<dim>(four, gradient, mean);
            for (int a = 0; a < n; ++a)
              four.gather(v, a, u[a]);
            const V4 push =
              density > all(0.) ? push_of<dim>(four, own_weights, u, mean, geometry, inverse_mass) : all(0.);
            const V4 mass = larger(density, all(0.)) * absolute(geometry.volume) * all(-own_weights.deviation / n);

            V4 f[n][4]; // velocities against the first corner, less the linear field, less their mean
            for (int d = 0; d < dim; ++d)
              {
                V4 sum = all(0.);
                for (int a = 1; a < n; ++a)
                  {
                    f[a][d] = u[a][d] - u[0][d];
                    for (int e = 0; e < dim; ++e)
                      f[a][d] -= mean[d][e] * (x[a][e] - x[0][e]);
                    sum += f[a][d];
                  }
                sum *= all(1. / n);
                f[0][d] = -sum;
                for (int a = 1; a < n; ++a)
                  f[a][d] -= sum;
                for (int a = 0; a < n; ++a)
                  f[a][d] = mass * f[a][d] + push * geometry.area[a][d];
              }
            for (int a = 0; a < n; ++a)
              four.add(impulse, a, f[a][0], f[a][1], dim == 3 ? f[a][dim - 1] : all(0.), all(0.));
          });
      }
    } // namespace


    template <int dim>
    void set_filter_pass(ElementPasses &passes)
    {
      passes.filter_impulses = filter_impulses<dim>;
    }

    template void set_filter_pass<2>(ElementPasses &);
    template void set_filter_pass<3>(ElementPasses &);
  } // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
