#include "kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// The element passes. A node is one vector of four doubles, so that a cell costs dim + 1 vector loads and stores; the
// arithmetic runs along x, y, z. No header of a big library may stand here.

namespace Breakwater
{
  namespace
  {
    typedef double V4 __attribute__((vector_size(32)));
    typedef long   I4 __attribute__((vector_size(32)));

    inline V4   load(const Quad &q) { return *reinterpret_cast<const V4 *>(q.c); }
    inline void store(Quad &q, const V4 &v) { *reinterpret_cast<V4 *>(q.c) = v; }
    inline V4   all(const double s) { return V4{s, s, s, s}; }

    /// a x b in the first three lanes; the fourth is a3 b3 - a3 b3 = 0.
    inline V4 cross3(const V4 &a, const V4 &b)
    {
      constexpr I4 yzx = {1, 2, 0, 3};
      // (a x b) = (a * b.yzx - a.yzx * b).yzx
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
          area[1]     = V4{0.5 * e2[1], -0.5 * e2[0], 0., 0.};
          area[2]     = V4{-0.5 * e1[1], 0.5 * e1[0], 0., 0.};
          area[0]     = -(area[1] + area[2]);
          return e1[0] * area[1][0] + e1[1] * area[1][1];
        }
      else
        {
          const V4 sixth = all(1. / 6.);
          const V4 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = (x[3] - x[0]) * sixth;
          area[1] = cross3(e2, e3);
          area[2] = cross3(e3, e1);
          area[3] = cross3(e1, e2) * sixth;
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
        return dot3(x[1] - x[0], cross3(x[2] - x[0], x[3] - x[0])) * (1. / 6.);
    }

    template <int dim, bool viscous, bool diffusion>
    void force_pass(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const ForceEffects &effects,
                    const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<Quad> &density_slope,
                    std::vector<Quad> &force)
    {
      constexpr int    n = dim + 1;
      constexpr double mean = 1. / n;
      for (const auto &cell : cells)
        {
          V4 x[n], area[n];
          for (int a = 0; a < n; ++a)
            x[a] = load(xp[cell[a]]);
          V4 sum = x[0];
          for (int a = 1; a < n; ++a)
            sum += x[a];
          const double volume = geometry<dim>(x, area);
          const V4     center = sum * all(mean);

          const V4 pressure = all(center[3]);
          V4       f[n];
          for (int a = 0; a < n; ++a)
            f[a] = pressure * area[a];

          if constexpr (viscous)
            {
              // Rows of V L: row d is sum_a v_a[d] A_a.
              V4 rows[dim];
              for (int d = 0; d < dim; ++d)
                rows[d] = all(0.);
              for (int a = 0; a < n; ++a)
                {
                  const V4 va = load(v[cell[a]]);
                  for (int d = 0; d < dim; ++d)
                    rows[d] += all(va[d]) * area[a];
                }
              double trace = 0;
              for (int d = 0; d < dim; ++d)
                trace += rows[d][d];
              const double factor = effects.viscosity / std::max(std::abs(volume), effects.least_viscous_volume);
              V4           tau[dim];
              for (int d = 0; d < dim; ++d)
                {
                  tau[d] = rows[d];
                  for (int e = 0; e < dim; ++e)
                    tau[d][e] += rows[e][d];
                  tau[d][d] -= (2. / 3.) * trace;
                }
              // tau is symmetric: tau A = sum_d A[d] row_d.
              for (int a = 0; a < n; ++a)
                {
                  V4 t = all(area[a][0]) * tau[0];
                  for (int d = 1; d < dim; ++d)
                    t += all(area[a][d]) * tau[d];
                  f[a] -= all(factor) * t;
                }
            }

          if constexpr (diffusion)
            {
              V4 q[n];
              for (int a = 0; a < n; ++a)
                q[a] = load(density_slope[cell[a]]);
              V4 q_mean = q[0];
              for (int a = 1; a < n; ++a)
                q_mean += q[a];
              q_mean *= all(mean);
              for (int a = 0; a < n; ++a)
                {
                  const V4 along = q_mean * (x[a] - center);
                  double   slope = along[0] + along[1];
                  if constexpr (dim == 3)
                    slope += along[2];
                  f[a][3] = std::abs(volume) * (q[a][3] - q_mean[3] - slope);
                }
            }

          for (int a = 0; a < n; ++a)
            store(force[cell[a]], load(force[cell[a]]) + f[a]);
        }
    }
  } // namespace


  template <int dim>
  void compute_volumes(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::vector<Quad> &xp,
                       std::vector<double> &volume)
  {
    std::fill(volume.begin(), volume.end(), 0.);
    constexpr double share = 1. / (dim + 1);
    for (const auto &cell : cells)
      {
        V4 x[dim + 1];
        for (int a = 0; a <= dim; ++a)
          x[a] = load(xp[cell[a]]);
        const double part = volume_of<dim>(x) * share;
        for (int a = 0; a <= dim; ++a)
          volume[cell[a]] += part;
      }
  }


  template <int dim>
  void compute_forces(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const ForceEffects &effects,
                      const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<Quad> &density_slope,
                      std::vector<Quad> &force)
  {
    std::fill(force.begin(), force.end(), Quad());
    if (effects.viscous && effects.density_diffusion)
      force_pass<dim, true, true>(cells, effects, xp, v, density_slope, force);
    else if (effects.viscous)
      force_pass<dim, true, false>(cells, effects, xp, v, density_slope, force);
    else if (effects.density_diffusion)
      force_pass<dim, false, true>(cells, effects, xp, v, density_slope, force);
    else
      force_pass<dim, false, false>(cells, effects, xp, v, density_slope, force);
  }


  template <int dim>
  double largest_relative_displacement(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                       const std::vector<Quad> &x, const std::vector<Quad> &x0)
  {
    double largest = 0;
    for (const auto &cell : cells)
      {
        V4 u[dim + 1];
        for (int a = 0; a <= dim; ++a)
          u[a] = load(x[cell[a]]) - load(x0[cell[a]]);
        V4 mean = u[0];
        for (int a = 1; a <= dim; ++a)
          mean += u[a];
        mean *= all(1. / (dim + 1));
        for (int a = 0; a <= dim; ++a)
          {
            const V4 d = u[a] - mean;
            largest    = std::max(largest, dot3(d, d));
          }
      }
    return std::sqrt(largest);
  }


  template void compute_volumes<2>(const std::vector<SimplexMesh<2>::Cell> &, const std::vector<Quad> &,
                                   std::vector<double> &);
  template void compute_volumes<3>(const std::vector<SimplexMesh<3>::Cell> &, const std::vector<Quad> &,
                                   std::vector<double> &);
  template void compute_forces<2>(const std::vector<SimplexMesh<2>::Cell> &, const ForceEffects &,
                                  const std::vector<Quad> &, const std::vector<Quad> &, const std::vector<Quad> &,
                                  std::vector<Quad> &);
  template void compute_forces<3>(const std::vector<SimplexMesh<3>::Cell> &, const ForceEffects &,
                                  const std::vector<Quad> &, const std::vector<Quad> &, const std::vector<Quad> &,
                                  std::vector<Quad> &);
  template double largest_relative_displacement<2>(const std::vector<SimplexMesh<2>::Cell> &,
                                                   const std::vector<Quad> &, const std::vector<Quad> &);
  template double largest_relative_displacement<3>(const std::vector<SimplexMesh<3>::Cell> &,
                                                   const std::vector<Quad> &, const std::vector<Quad> &);
} // namespace Breakwater
