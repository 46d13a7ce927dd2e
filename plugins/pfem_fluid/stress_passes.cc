#include "four_cells.h"

// Forces of the fluid's stresses and rates of deformation, compiled once per instruction set (see element_passes.cc).

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    namespace
    {
      /// V times the velocity gradient, of which row d is sum_a v_a[d] A_a. As the A_a add up to zero, velocities
      /// against the first corner do.
      template <int dim>
      inline void velocity_gradient(const FourCells<dim> &four, const Quad *v, const Geometry<dim> &geometry,
                                    V4 (*gradient)[dim])
      {
        V4 u0[4], u[4];
        four.gather(v, 0, u0);
        for (int a = 1; a <= dim; ++a)
          {
            four.gather(v, a, u);
            for (int d = 0; d < dim; ++d)
              for (int e = 0; e < dim; ++e)
                {
                  const V4 part  = (u[d] - u0[d]) * geometry.area[a][e];
                  gradient[d][e] = a == 1 ? part : gradient[d][e] + part;
                }
          }
      }

      /// Pressure of four cells: the mean of their nodes', and their own.
      template <int dim>
      inline V4 pressure_of(const FourCells<dim> &four, const ForceEffects &effects, const V4 (*x)[4], const V4 &volume)
      {
        V4 pressure = x[0][3];
        for (int a = 1; a <= dim; ++a)
          pressure += x[a][3];
        pressure *= all(1. / (dim + 1));
        if (effects.cell_stiffness > 0)
          {
            const V4 at_rest = four.of_cells(effects.cell_volume_at_rest);
            pressure -=
              all(effects.cell_stiffness) * (volume - at_rest) / larger(at_rest, all(effects.least_cell_volume));
          }
        return pressure;
      }

      /// p - tau, tau = mu / V (S - 2/3 tr(L) V), S = V (L + L^T).
      template <int dim>
      inline void pressure_less_viscous_stress(const FourCells<dim> &four, const ForceEffects &effects, const Quad *v,
                                               const Geometry<dim> &geometry, const V4 &pressure, V4 (*stress)[dim])
      {
        const V4 mu =
          effects.cell_viscosity != nullptr ? four.of_cells(effects.cell_viscosity) : all(effects.viscosity);
        const V4 factor = mu / larger(absolute(geometry.volume), all(effects.least_viscous_volume));
        V4       gradient[dim][dim];
        velocity_gradient<dim>(four, v, geometry, gradient);
        V4 trace = gradient[0][0] + gradient[1][1];
        if constexpr (dim == 3)
          trace += gradient[2][2];
        for (int d = 0; d < dim; ++d)
          {
            stress[d][d] = pressure - factor * (gradient[d][d] + gradient[d][d] - all(2. / 3.) * trace);
            for (int e = 0; e < d; ++e)
              stress[d][e] = stress[e][d] = -factor * (gradient[d][e] + gradient[e][d]);
          }
      }

      /// |V| [rho_a - rho_c - s_c . (x_a - x_c)] at each corner: exactly zero in a hydrostatic column.
      template <int dim>
      inline void density_fluxes(const FourCells<dim> &four, const Quad *density_slope, const V4 (*x)[4],
                                 const V4 &volume, V4 *flux)
      {
        constexpr int n = dim + 1;
        V4            q[n][4];
        for (int a = 0; a < n; ++a)
          four.gather(density_slope, a, q[a]);
        flux[0] = all(0.); // those against the first corner at first
        V4 mean = all(0.);
        for (int a = 1; a < n; ++a)
          flux[a] = q[a][3] - q[0][3];
        for (int d = 0; d < dim; ++d)
          {
            V4 slope = q[0][d];
            for (int a = 1; a < n; ++a)
              slope += q[a][d];
            slope *= all(1. / n);
            for (int a = 1; a < n; ++a)
              flux[a] -= slope * (x[a][d] - x[0][d]);
          }
        for (int a = 1; a < n; ++a)
          mean += flux[a];
        mean *= all(1. / n);
        for (int a = 0; a < n; ++a)
          flux[a] = absolute(volume) * (flux[a] - mean);
      }

      template <int dim, bool viscous, bool diffusion>
      void forces(const unsigned int *cells, const std::size_t n_cells, const ForceEffects &effects, const Quad *xp,
                  const Quad *v, const Quad *density_slope, Quad *force)
      {
        constexpr int      n           = dim + 1;
        const ForceEffects own_effects = effects; // which no store to the forces can change
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 x[n][4];
            for (int a = 0; a < n; ++a)
              four.gather(xp, a, x[a]);
            const Geometry<dim> geometry(x);
            const V4            pressure = pressure_of<dim>(four, own_effects, x, geometry.volume);

            V4 f[n][4];
            if constexpr (viscous)
              {
                V4 stress[dim][dim];
                pressure_less_viscous_stress<dim>(four, own_effects, v, geometry, pressure, stress);
                for (int a = 1; a < n; ++a)
                  for (int d = 0; d < dim; ++d)
                    {
                      f[a][d] = stress[d][0] * geometry.area[a][0] + stress[d][1] * geometry.area[a][1];
                      if constexpr (dim == 3)
                        f[a][d] += stress[d][2] * geometry.area[a][2];
                    }
              }
            else
              for (int a = 1; a < n; ++a)
                for (int d = 0; d < dim; ++d)
                  f[a][d] = pressure * geometry.area[a][d];
            for (int d = 0; d < dim; ++d)
              {
                V4 sum = f[1][d] + f[2][d];
                if constexpr (dim == 3)
                  sum += f[3][d];
                f[0][d] = -sum;
              }

            V4 flux[n] = {};
            if constexpr (diffusion)
              density_fluxes<dim>(four, density_slope, x, geometry.volume, flux);
            for (int a = 0; a < n; ++a)
              four.add(force, a, f[a][0], f[a][1], dim == 3 ? f[a][dim - 1] : all(0.), flux[a]);
          });
      }

      template <int dim>
      void shear_rates(const unsigned int *cells, const std::size_t n_cells, const double least_volume, const Quad *xp,
                       const Quad *v, double *shear_rate)
      {
        for_four_cells<dim>(
          cells, n_cells, [=](const FourCells<dim> &four) __attribute__((always_inline)) {
            V4 x[dim + 1][4], gradient[dim][dim];
            for (int a = 0; a <= dim; ++a)
              four.gather(xp, a, x[a]);
            const Geometry<dim> geometry(x);
            velocity_gradient<dim>(four, v, geometry, gradient);
            V4 square = all(0.); // of S = V (L + L^T); D = S / (2 V), so sqrt(2 D:D) = sqrt(S:S / 2) / V
            for (int d = 0; d < dim; ++d)
              for (int e = 0; e < dim; ++e)
                {
                  const V4 s = gradient[d][e] + gradient[e][d];
                  square += s * s;
                }
            const V4 size = larger(absolute(geometry.volume), all(least_volume));
            for (std::size_t k = 0; k < four.n; ++k)
              shear_rate[four.first + k] = __builtin_sqrt(0.5 * square[k]) / size[k];
          });
      }
    } // namespace


    template <int dim>
    void set_stress_passes(ElementPasses &passes)
    {
      passes.forces[0][0] = forces<dim, false, false>;
      passes.forces[0][1] = forces<dim, false, true>;
      passes.forces[1][0] = forces<dim, true, false>;
      passes.forces[1][1] = forces<dim, true, true>;
      passes.shear_rates  = shear_rates<dim>;
    }

    template void set_stress_passes<2>(ElementPasses &);
    template void set_stress_passes<3>(ElementPasses &);
  } // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
