#include "element_passes.h"

// The element passes, compiled once per instruction set with BREAKWATER_INSTRUCTION_SET as the namespace.
//
// A node is one vector of four doubles, so that a cell costs dim + 1 vector loads and stores and the arithmetic runs
// along x, y, z. No header with inline functions of general use may stand here: the linker could pick a copy of them
// that was compiled for an instruction set which the machine does not have.

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    namespace
    {
      typedef double V4 __attribute__((vector_size(32)));
      typedef long   I4 __attribute__((vector_size(32)));

      inline V4 load(const Quad &q)
      {
        return *reinterpret_cast<const V4 *>(q.c);
      }
      inline void store(Quad &q, const V4 &v)
      {
        *reinterpret_cast<V4 *>(q.c) = v;
      }
      inline V4 all(const double s)
      {
        return V4{s, s, s, s};
      }

      template <int lane>
      inline V4 spread(const V4 &v)
      {
        return __builtin_shuffle(v, I4{lane, lane, lane, lane});
      }

      /// a x b in the first three lanes.
      inline V4 cross(const V4 &a, const V4 &b)
      {
        constexpr I4 yzx = {1, 2, 0, 3};
        return __builtin_shuffle(a * __builtin_shuffle(b, yzx) - __builtin_shuffle(a, yzx) * b, yzx);
      }

      inline double dot3(const V4 &a, const V4 &b)
      {
        const V4 p = a * b;
        return p[0] + p[1] + p[2];
      }

      /// The sums over the lanes of four vectors.
      inline V4 lane_sums(const V4 &a, const V4 &b, const V4 &c, const V4 &d)
      {
        const V4 ab = __builtin_shuffle(a, b, I4{0, 4, 2, 6}) + __builtin_shuffle(a, b, I4{1, 5, 3, 7});
        const V4 cd = __builtin_shuffle(c, d, I4{0, 4, 2, 6}) + __builtin_shuffle(c, d, I4{1, 5, 3, 7});
        return __builtin_shuffle(ab, cd, I4{0, 1, 4, 5}) + __builtin_shuffle(ab, cd, I4{2, 3, 6, 7});
      }

      /// Area vectors A_a of a cell, and its volume. The fourth lanes of x take no part.
      template <int dim>
      inline double geometry(const V4 *x, V4 *area)
      {
        if constexpr (dim == 2)
          {
            const V4 e1 = x[1] - x[0], e2 = x[2] - x[0];
            area[1] = V4{0.5 * e2[1], -0.5 * e2[0], 0., 0.};
            area[2] = V4{-0.5 * e1[1], 0.5 * e1[0], 0., 0.};
            area[0] = -(area[1] + area[2]);
            return e1[0] * area[1][0] + e1[1] * area[1][1];
          }
        else
          {
            const V4 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = (x[3] - x[0]) * all(1. / 6.);
            area[1] = cross(e2, e3);
            area[2] = cross(e3, e1);
            area[3] = cross(e1, e2) * all(1. / 6.);
            area[0] = -(area[1] + area[2] + area[3]);
            return dot3(e1, area[1]);
          }
      }

      template <int dim>
      inline double volume_of(const V4 *x)
      {
        if constexpr (dim == 2)
          {
            const V4 e1 = x[1] - x[0], e2 = x[2] - x[0];
            return 0.5 * (e1[0] * e2[1] - e1[1] * e2[0]);
          }
        else
          return dot3(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])) * (1. / 6.);
      }

      /// S = V (L + L^T), of which row d is sum_a v_a[d] A_a + A_a[d] v_a. As the A_a add up to zero, velocities
      /// against the first corner do.
      template <int dim>
      inline void strain_rate_rows(const V4 *v, const V4 *area, V4 *s)
      {
        s[0] = s[1] = s[2] = all(0.);
        for (int a = 1; a <= dim; ++a)
          {
            const V4 dv = v[a] - v[0];
            s[0] += spread<0>(dv) * area[a] + spread<0>(area[a]) * dv;
            s[1] += spread<1>(dv) * area[a] + spread<1>(area[a]) * dv;
            if constexpr (dim == 3)
              s[2] += spread<2>(dv) * area[a] + spread<2>(area[a]) * dv;
          }
      }

      /// Viscous forces of a cell are subtracted from f: tau A_a with tau = mu / V (S - 2/3 tr(L) V).
      template <int dim>
      inline void subtract_viscous_forces(const V4 *v, const V4 *area, const double factor, V4 *f)
      {
        V4 s[3];
        strain_rate_rows<dim>(v, area, s);
        const V4 pressure_like = all((1. / 3.) * (s[0][0] + s[1][1] + s[2][2]));
        for (int a = 1; a <= dim; ++a)
          {
            V4 t = spread<0>(area[a]) * s[0] + spread<1>(area[a]) * s[1] - pressure_like * area[a];
            if constexpr (dim == 3)
              t += spread<2>(area[a]) * s[2];
            t *= all(factor);
            f[a] -= t;
            f[0] += t;
          }
      }

      template <int dim>
      void volumes(const unsigned int *cells, const std::size_t n_cells, const Quad *xp, double *volume)
      {
        constexpr double share = 1. / (dim + 1);
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * (dim + 1);
            V4                  x[dim + 1];
            for (int a = 0; a <= dim; ++a)
              x[a] = load(xp[cell[a]]);
            const double part = volume_of<dim>(x) * share;
            for (int a = 0; a <= dim; ++a)
              volume[cell[a]] += part;
          }
      }

      template <int dim, bool viscous, bool diffusion>
      void forces(const unsigned int *cells, const std::size_t n_cells, const ForceEffects &effects, const Quad *xp,
                  const Quad *v, const Quad *density_slope, Quad *force)
      {
        constexpr int    n    = dim + 1;
        constexpr double mean = 1. / n;
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * n;
            V4                  x[n], area[n], f[n];
            for (int a = 0; a < n; ++a)
              x[a] = load(xp[cell[a]]);
            V4 sum = x[0];
            for (int a = 1; a < n; ++a)
              sum += x[a];
            const double volume   = geometry<dim>(x, area);
            const double size     = __builtin_fabs(volume);
            V4           pressure = spread<3>(sum) * all(mean);
            if (effects.cell_stiffness > 0)
              {
                const double at_rest = effects.cell_volume_at_rest[c], least_cell = effects.least_cell_volume;
                pressure -=
                  all(effects.cell_stiffness * (volume - at_rest) / (at_rest > least_cell ? at_rest : least_cell));
              }
            for (int a = 0; a < n; ++a)
              f[a] = pressure * area[a];

            if constexpr (viscous)
              {
                V4 velocity[n];
                for (int a = 0; a < n; ++a)
                  velocity[a] = load(v[cell[a]]);
                const double least = effects.least_viscous_volume;
                const double mu    = effects.cell_viscosity != nullptr ? effects.cell_viscosity[c] : effects.viscosity;
                subtract_viscous_forces<dim>(velocity, area, mu / (size > least ? size : least), f);
              }

            if constexpr (diffusion)
              {
                // rho_a - s . x_a, of which the cell's mean is taken away: exactly zero in a hydrostatic column.
                V4 q[n], q_mean;
                for (int a = 0; a < n; ++a)
                  q[a] = load(density_slope[cell[a]]);
                q_mean = q[0];
                for (int a = 1; a < n; ++a)
                  q_mean += q[a];
                q_mean *= all(mean);
                V4 y[4] = {all(0.), all(0.), all(0.), all(0.)};
                for (int a = 0; a < n; ++a)
                  y[a] = __builtin_shuffle(q_mean * (x[0] - x[a]), q[a] - q_mean, I4{0, 1, 2, 7});
                const V4     rest      = lane_sums(y[0], y[1], y[2], y[3]);
                const double rest_mean = (rest[0] + rest[1] + rest[2] + rest[3]) * mean;
                const V4     flux      = all(size) * (rest - all(rest_mean));
                f[0]                   = __builtin_shuffle(f[0], spread<0>(flux), I4{0, 1, 2, 7});
                f[1]                   = __builtin_shuffle(f[1], spread<1>(flux), I4{0, 1, 2, 7});
                f[2]                   = __builtin_shuffle(f[2], spread<2>(flux), I4{0, 1, 2, 7});
                if constexpr (dim == 3)
                  f[3] = __builtin_shuffle(f[3], spread<3>(flux), I4{0, 1, 2, 7});
              }

            for (int a = 0; a < n; ++a)
              store(force[cell[a]], load(force[cell[a]]) + f[a]);
          }
      }

      template <int dim>
      void shear_rates(const unsigned int *cells, const std::size_t n_cells, const double least_volume, const Quad *xp,
                       const Quad *v, double *shear_rate)
      {
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * (dim + 1);
            V4                  x[dim + 1], u[dim + 1], area[dim + 1], s[3];
            for (int a = 0; a <= dim; ++a)
              {
                x[a] = load(xp[cell[a]]);
                u[a] = load(v[cell[a]]);
              }
            const double size = __builtin_fabs(geometry<dim>(x, area));
            strain_rate_rows<dim>(u, area, s);
            // D = S / (2 V), so sqrt(2 D:D) = sqrt(S:S / 2) / V.
            const double square = dot3(s[0], s[0]) + dot3(s[1], s[1]) + dot3(s[2], s[2]);
            shear_rate[c]       = __builtin_sqrt(0.5 * square) / (size > least_volume ? size : least_volume);
          }
      }

      template <int dim>
      void velocity_gradients(const unsigned int *cells, const std::size_t n_cells, const Quad *xp, const Quad *v,
                              Quad *gradient)
      {
        const V4 share = all(1. / (dim + 1));
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * (dim + 1);
            V4                  x[dim + 1], area[dim + 1], row[3] = {all(0.), all(0.), all(0.)};
            for (int a = 0; a <= dim; ++a)
              x[a] = load(xp[cell[a]]);
            geometry<dim>(x, area);
            const V4 v0 = load(v[cell[0]]);
            for (int a = 1; a <= dim; ++a)
              {
                const V4 dv = (load(v[cell[a]]) - v0) * share;
                row[0] += spread<0>(dv) * area[a];
                row[1] += spread<1>(dv) * area[a];
                if constexpr (dim == 3)
                  row[2] += spread<2>(dv) * area[a];
              }
            for (int a = 0; a <= dim; ++a)
              for (int d = 0; d < dim; ++d)
                {
                  Quad &sum = gradient[cell[a] * dim + d];
                  store(sum, load(sum) + row[d]);
                }
          }
      }

      template <int dim>
      void filter_impulses(const unsigned int *cells, const std::size_t n_cells, const FilterWeights &weights,
                           const Quad *xp, const Quad *v, const Quad *gradient, const double *node_density,
                           const double *inverse_mass, Quad *impulse)
      {
        constexpr int    n           = dim + 1;
        constexpr double n_neighbors = dim == 2 ? 13. : 60.; // cells that share a node with one, itself included
        const V4         share       = all(1. / n);
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell    = cells + c * n;
            double              density = node_density[cell[0]];
            for (int a = 1; a < n; ++a)
              density = node_density[cell[a]] < density ? node_density[cell[a]] : density;
            if (!(density > 0))
              continue;
            V4 x[n], u[n], x_mean = all(0.), u_mean = all(0.), row[4] = {all(0.), all(0.), all(0.), all(0.)};
            for (int a = 0; a < n; ++a)
              {
                x[a] = load(xp[cell[a]]);
                u[a] = load(v[cell[a]]);
                x_mean += x[a];
                u_mean += u[a];
                for (int d = 0; d < dim; ++d)
                  row[d] += load(gradient[cell[a] * dim + d]);
              }
            V4           area[n];
            const double volume = geometry<dim>(x, area), size = __builtin_fabs(volume);
            const V4     mass = all(-weights.deviation * density * size / n);
            x_mean *= share;
            u_mean *= share;
            for (int d = 0; d < dim; ++d)
              row[d] *= share;
            V4 flux = all(0.); // sum of v . A, lane by lane
            for (int a = 0; a < n; ++a)
              flux += u[a] * area[a];
            double mean_divergence = row[0][0] + row[1][1], w = flux[0] + flux[1];
            if constexpr (dim == 3)
              {
                mean_divergence += row[2][2];
                w += flux[2];
              }
            double compliance = 0; // of the cell's volume to a pressure impulse: sum of |A|^2 / m
            for (int a = 0; a < n; ++a)
              compliance += dot3(area[a], area[a]) * inverse_mass[cell[a]];
            const V4 push = all(-weights.divergence / n_neighbors * (w - volume * mean_divergence) / compliance);
            for (int a = 0; a < n; ++a)
              {
                const V4 dx     = x[a] - x_mean; // the fourth lane of the rows is zero
                const V4 linear = lane_sums(row[0] * dx, row[1] * dx, row[2] * dx, all(0.));
                Quad    &sum    = impulse[cell[a]];
                store(sum, load(sum) + mass * (u[a] - u_mean - linear) + push * area[a]);
              }
          }
      }

      template <int dim>
      void exchange_operator(const unsigned int *cells, const std::size_t n_cells, const double *cell_weight,
                             const double *psi, const double *active, double *image)
      {
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * (dim + 1);
            double              n = 0, sum = 0;
            for (int a = 0; a <= dim; ++a)
              {
                n += active[cell[a]];
                sum += active[cell[a]] * psi[cell[a]];
              }
            const double mean = n > 0 ? sum / n : 0.;
            for (int a = 0; a <= dim; ++a)
              image[cell[a]] += cell_weight[c] * active[cell[a]] * (psi[cell[a]] - mean);
          }
      }

      template <int dim>
      void exchange_requests(const unsigned int *cells, const std::size_t n_cells, const double *cell_weight,
                             const double *psi, const double *active, Quad *request, double *given, double *taken)
      {
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * (dim + 1);
            V4                  e = all(0.), is_active = all(0.);
            for (int a = 0; a <= dim; ++a)
              {
                e[a]         = psi[cell[a]];
                is_active[a] = active[cell[a]];
              }
            const V4     weighted = e * is_active;
            const double n        = is_active[0] + is_active[1] + is_active[2] + is_active[3];
            const double sum      = weighted[0] + weighted[1] + weighted[2] + weighted[3];
            const V4     z        = all(cell_weight[c]) * is_active * (all(n > 0 ? sum / n : 0.) - e);
            store(request[c], z);
            for (int a = 0; a <= dim; ++a)
              {
                given[cell[a]] += z[a] < 0 ? -z[a] : 0.;
                taken[cell[a]] += z[a] > 0 ? z[a] : 0.;
              }
          }
      }

      template <int dim>
      void exchange_transfers(const unsigned int *cells, const std::size_t n_cells, const Quad *request,
                              const double *part, const double *turnover, const Quad *v, Quad *received)
      {
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell    = cells + c * (dim + 1);
            const V4            z       = load(request[c]);
            const V4            donated = z < all(0.) ? -z : all(0.);
            const V4            taken   = z > all(0.) ? z : all(0.);
            V4                  from = all(0.), to = all(0.); // velocity of donors and receivers times mass, and mass
            V4                  u[dim + 1];
            double              scale = 1, upwind = 0;
            for (int a = 0; a <= dim; ++a)
              {
                u[a] = load(v[cell[a]]);
                from += all(donated[a]) * u[a];
                to += all(taken[a]) * u[a];
                const double p = donated[a] > 0 ? part[cell[a]] : 1., t = turnover[cell[a]];
                scale  = p < scale ? p : scale;
                upwind = t > upwind ? t : upwind;
              }
            if (!(from[3] > 0 && to[3] > 0))
              continue;
            const double own = 0.5 + 0.5 * (upwind < 1 ? upwind : 1.); // the donor's part in the velocity carried over
            const V4     mean_from = all((1 - own) / to[3]) * to, mean_to = all(own / from[3]) * from;
            for (int a = 0; a <= dim; ++a)
              {
                Quad &sum = received[cell[a]];
                store(sum, load(sum) + all(scale * taken[a]) * (mean_to + all(1 - own) * u[a]) -
                             all(scale * donated[a]) * (all(own) * u[a] + mean_from));
              }
          }
      }

      template <int dim>
      double largest_relative_displacement(const unsigned int *cells, const std::size_t n_cells, const Quad *x,
                                           const Quad *x0)
      {
        double largest = 0;
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const unsigned int *cell = cells + c * (dim + 1);
            V4                  u[dim + 1];
            for (int a = 0; a <= dim; ++a)
              u[a] = load(x[cell[a]]) - load(x0[cell[a]]);
            V4 mean = u[0];
            for (int a = 1; a <= dim; ++a)
              mean += u[a];
            mean *= all(1. / (dim + 1));
            for (int a = 0; a <= dim; ++a)
              {
                const V4     d      = u[a] - mean;
                const double square = dot3(d, d);
                largest             = square > largest ? square : largest;
              }
          }
        return __builtin_sqrt(largest);
      }
    } // namespace


    template <int dim>
    ElementPasses element_passes()
    {
      return {
        volumes<dim>,
        {{forces<dim, false, false>, forces<dim, false, true>}, {forces<dim, true, false>, forces<dim, true, true>}},
        shear_rates<dim>,
        velocity_gradients<dim>,
        filter_impulses<dim>,
        exchange_operator<dim>,
        exchange_requests<dim>,
        exchange_transfers<dim>,
        largest_relative_displacement<dim>};
    }

    template ElementPasses element_passes<2>();
    template ElementPasses element_passes<3>();
  } // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
