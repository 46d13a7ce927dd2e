#include "four_doubles.h"

// The element passes, compiled once per instruction set with BREAKWATER_INSTRUCTION_SET as the namespace.
//
// Here a node is one vector of four doubles, so that a cell costs dim + 1 vector loads and stores and the arithmetic
// runs along x, y, z: the faster way for loops with little arithmetic. The others stand in stress_passes.cc,
// filter_pass.cc and mesh_passes.cc. No header with inline functions of general use may stand in these files: the linker could pick a copy
// of them that was compiled for an instruction set which the machine does not have.

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    namespace
    {
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
      unsigned int pairs_around(const unsigned int *cells, const unsigned int *corners, const std::size_t n_corners,
                                const Quad *x, const char *active, const unsigned int first, unsigned int *place_of,
                                unsigned int *around, Quad *sum, Quad *own)
      {
        constexpr std::size_t ahead = 24; // corners, about those of one node
        constexpr double      half = 0.5 / (dim + 1), share[] = {half, half, half / 2, half / 3, half / 4};
        constexpr double      sign[]   = {-1., 1., -1., 1.};
        unsigned int          n_around = 0;
        V4                    total    = all(0.);
        for (std::size_t k = 0; k < n_corners; ++k)
          {
            __builtin_prefetch(cells + corners[k + ahead] / (dim + 1) * (dim + 1));
            const unsigned int *cell = cells + corners[k] / (dim + 1) * (dim + 1), a = corners[k] % (dim + 1);
            unsigned int        facet[dim];
            for (unsigned int b = 0; b < dim; ++b)
              facet[b] = cell[(a + 1 + b) % (dim + 1)];
            const V4 x0 = load(x[facet[0]]), e1 = load(x[facet[1]]) - x0;
            V4       A;
            if constexpr (dim == 2)
              A = V4{-0.5 * e1[1], 0.5 * e1[0], 0., 0.};
            else // inwards, if the order of the facet's corners is made that of the cell
              A = cross(e1, load(x[facet[2]]) - x0) * all(sign[a] / 6.);
            int n_active = active[cell[a]];
            for (const unsigned int i : facet)
              n_active += active[i];
            const double volume = dot3(A, load(x[cell[a]]) - x0);
            A[3]                = (volume < 0 ? -volume : volume) * share[n_active];
            for (const unsigned int i : facet)
              {
                // Without branches, which would be guessed wrongly.
                const bool         is_new = place_of[i] <= first;
                const unsigned int place  = is_new ? n_around : place_of[i] - first - 1;
                const long         known  = is_new ? 0 : -1;
                const I4           so_far = reinterpret_cast<I4>(load(sum[place])) & I4{known, known, known, known};
                around[place]             = i;
                store(sum[place], reinterpret_cast<V4>(so_far) + A);
                place_of[i] = first + 1 + place;
                n_around += is_new;
              }
            total += A;
          }
        store(*own, total);
        return n_around;
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
      ElementPasses passes;
      set_stress_passes<dim>(passes);
      set_filter_pass<dim>(passes);
      set_mesh_passes<dim>(passes);
      passes.volumes                       = volumes<dim>;
      passes.velocity_gradients            = velocity_gradients<dim>;
      passes.exchange_requests             = exchange_requests<dim>;
      passes.exchange_transfers            = exchange_transfers<dim>;
      passes.pairs_around                  = pairs_around<dim>;
      passes.largest_relative_displacement = largest_relative_displacement<dim>;
      return passes;
    }

    template ElementPasses element_passes<2>();
    template ElementPasses element_passes<3>();
  } // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
