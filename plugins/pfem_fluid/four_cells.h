#pragma once

#include "four_doubles.h"

// Loops over cells by four, a lane of each vector a cell: the faster way where there is much arithmetic. Formulas are
// written as for one cell.

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    namespace
    {
      inline V4 absolute(const V4 &a)
      {
        constexpr long no_sign = 0x7fffffffffffffff;
        return reinterpret_cast<V4>(reinterpret_cast<I4>(a) & I4{no_sign, no_sign, no_sign, no_sign});
      }
      inline V4 larger(const V4 &a, const V4 &b)
      {
        return a > b ? a : b;
      }

      inline V4 smaller(const V4 &a, const V4 &b)
      {
        return a < b ? a : b;
      }

      /// Turns four rows into four columns.
      inline void transpose(V4 &a, V4 &b, V4 &c, V4 &d)
      {
        const V4 ab_even = __builtin_shuffle(a, b, I4{0, 4, 2, 6}), ab_odd = __builtin_shuffle(a, b, I4{1, 5, 3, 7});
        const V4 cd_even = __builtin_shuffle(c, d, I4{0, 4, 2, 6}), cd_odd = __builtin_shuffle(c, d, I4{1, 5, 3, 7});
        a = __builtin_shuffle(ab_even, cd_even, I4{0, 1, 4, 5});
        b = __builtin_shuffle(ab_odd, cd_odd, I4{0, 1, 4, 5});
        c = __builtin_shuffle(ab_even, cd_even, I4{2, 3, 6, 7});
        d = __builtin_shuffle(ab_odd, cd_odd, I4{2, 3, 6, 7});
      }

      /// Four cells of a mesh that follow each other; at its end fewer, and the last one repeated.
      template <int dim>
      struct FourCells
      {
        static constexpr int n_corners = dim + 1;

        const unsigned int *corners; ///< [cell][corner]
        std::size_t         first;   ///< number of the first cell
        std::size_t         n;       ///< of them, 4 but at the end

        unsigned int node(const int cell, const int corner) const { return corners[cell * n_corners + corner]; }

        /// The components of a node's values at one corner: [component] of the cells.
        void gather(const Quad *values, const int corner, V4 *component) const
        {
          for (int k = 0; k < 4; ++k)
            component[k] = load(values[node(k, corner)]);
          transpose(component[0], component[1], component[2], component[3]);
        }

        V4 gather(const double *values, const int corner) const
        {
          return V4{values[node(0, corner)], values[node(1, corner)], values[node(2, corner)], values[node(3, corner)]};
        }

        /// Adds [component] of the cells to the nodes at one corner.
        void add(Quad *values, const int corner, V4 a, V4 b, V4 c, V4 d) const
        {
          transpose(a, b, c, d);
          const V4 rows[4] = {a, b, c, d};
          for (std::size_t k = 0; k < n; ++k)
            {
              Quad &sum = values[node(k, corner)];
              store(sum, load(sum) + rows[k]);
            }
        }

        /// Values of the cells themselves.
        V4 of_cells(const double *values) const
        {
          V4 result = all(values[first]);
          if (n == 4)
            __builtin_memcpy(&result, values + first, sizeof(result));
          else
            for (std::size_t k = 0; k < n; ++k)
              result[k] = values[first + k];
          return result;
        }
      };

      /// Calls work(four) for all cells.
      template <int dim, class Work>
      inline void for_four_cells(const unsigned int *cells, const std::size_t n_cells, const Work &work)
      {
        constexpr std::size_t n_corners = dim + 1;
        std::size_t           c         = 0;
        for (; c + 4 <= n_cells; c += 4)
          work(FourCells<dim>{cells + c * n_corners, c, 4});
        if (c == n_cells)
          return;
        unsigned int last[4 * n_corners];
        for (std::size_t k = 0; k < 4; ++k)
          for (std::size_t a = 0; a < n_corners; ++a)
            last[k * n_corners + a] = cells[(c + k < n_cells ? c + k : n_cells - 1) * n_corners + a];
        work(FourCells<dim>{last, c, n_cells - c});
      }

      /// Area vectors A_a = dV/dx_a of four cells, and their volumes.
      template <int dim>
      struct Geometry
      {
        V4 area[dim + 1][dim];
        V4 volume;

        /// @param x places [corner][component]
        explicit Geometry(const V4 (*x)[4])
        {
          V4 e[dim][dim]; // edges from the first corner
          for (int a = 0; a < dim; ++a)
            for (int d = 0; d < dim; ++d)
              e[a][d] = x[a + 1][d] - x[0][d];
          if constexpr (dim == 2)
            {
              area[1][0] = all(0.5) * e[1][1];
              area[1][1] = all(-0.5) * e[1][0];
              area[2][0] = all(-0.5) * e[0][1];
              area[2][1] = all(0.5) * e[0][0];
              volume     = e[0][0] * area[1][0] + e[0][1] * area[1][1];
            }
          else
            {
              for (int d = 0; d < 3; ++d)
                e[2][d] *= all(1. / 6.);
              set_cross(e[1], e[2], area[1]);
              set_cross(e[2], e[0], area[2]);
              volume = e[0][0] * area[1][0] + e[0][1] * area[1][1] + e[0][2] * area[1][2];
              for (int d = 0; d < 3; ++d)
                e[0][d] *= all(1. / 6.);
              set_cross(e[0], e[1], area[3]);
            }
          for (int d = 0; d < dim; ++d)
            {
              V4 sum = area[1][d] + area[2][d];
              if constexpr (dim == 3)
                sum += area[3][d];
              area[0][d] = -sum;
            }
        }

      private:
        static void set_cross(const V4 *a, const V4 *b, V4 *result)
        {
          for (int d = 0; d < 3; ++d)
            {
              const int e = (d + 1) % 3, f = (d + 2) % 3;
              result[d] = a[e] * b[f] - a[f] * b[e];
            }
        }
      };
    } // namespace
  }   // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
