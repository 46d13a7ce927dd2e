#include "cell_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

// Packs are passed between inlined functions of this file alone: the note on their calling convention is void.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace Breakwater
{
  namespace
  {
    constexpr int n_lanes = 4;
    /// One number for each lane; the compiler maps it to the registers of the instruction set.
    typedef double Pack __attribute__((vector_size(n_lanes * sizeof(double))));

    constexpr int power(const int base, const int exponent)
    {
      return exponent == 0 ? 1 : base * power(base, exponent - 1);
    }

    /// Lagrange polynomials in one direction on [0, 1], n of them.
    template <int n>
    struct Shape1D
    {
      double value[n][n];      ///< [point][node]: of the polynomials of the nodes at the Gauss points
      double derivative[n][n]; ///< [point][point]: of the polynomials of the Gauss points at the Gauss points

      Shape1D()
      {
        double node[n], point[n];
        for (int i = 0; i < n; ++i)
          node[i] = double(i) / (n - 1);
        const double offset = n == 2 ? 0.5 / std::sqrt(3.) : 0.5 * std::sqrt(0.6);
        point[0]            = 0.5 - offset;
        point[n - 1]        = 0.5 + offset;
        if (n == 3)
          point[1] = 0.5;
        for (int q = 0; q < n; ++q)
          for (int i = 0; i < n; ++i)
            {
              value[q][i]      = 1;
              derivative[q][i] = 0;
              for (int j = 0; j < n; ++j)
                if (j != i)
                  {
                    value[q][i] *= (point[q] - node[j]) / (node[i] - node[j]);
                    double product = 1 / (point[i] - point[j]);
                    for (int k = 0; k < n; ++k)
                      if (k != i && k != j)
                        product *= (point[q] - point[k]) / (point[i] - point[k]);
                    derivative[q][i] += product;
                  }
            }
      }
    };

    /// out = (matrix or its transpose, applied in one direction) in, or added to out.
    template <int dim, int n, int direction, bool transpose, bool add>
    inline void sweep(const double (&matrix)[n][n], const Pack *in, Pack *out)
    {
      constexpr int stride = power(n, direction);
      for (int outer = 0; outer < power(n, dim - 1 - direction); ++outer)
        for (int inner = 0; inner < stride; ++inner)
          {
            const int first = outer * stride * n + inner;
            Pack      line[n];
            for (int i = 0; i < n; ++i)
              line[i] = in[first + i * stride];
            for (int q = 0; q < n; ++q)
              {
                Pack sum = (transpose ? matrix[0][q] : matrix[q][0]) * line[0];
                for (int i = 1; i < n; ++i)
                  sum += (transpose ? matrix[i][q] : matrix[q][i]) * line[i];
                if (add)
                  out[first + q * stride] += sum;
                else
                  out[first + q * stride] = sum;
              }
          }
    }

    inline Pack determinant(const Pack (&h)[2][2])
    {
      return (1. + h[0][0]) * (1. + h[1][1]) - h[0][1] * h[1][0];
    }

    inline Pack determinant(const Pack (&h)[3][3])
    {
      const Pack a = 1. + h[0][0], b = 1. + h[1][1], c = 1. + h[2][2];
      return a * (b * c - h[1][2] * h[2][1]) - h[0][1] * (h[1][0] * c - h[1][2] * h[2][0]) +
             h[0][2] * (h[1][0] * h[2][1] - b * h[2][0]);
    }

    /// Von Mises stress of a symmetric tensor; in 2D of plane stress.
    inline double von_mises(const double (&s)[2][2])
    {
      return std::sqrt(s[0][0] * s[0][0] - s[0][0] * s[1][1] + s[1][1] * s[1][1] + 3 * s[0][1] * s[1][0]);
    }

    inline double von_mises(const double (&s)[3][3])
    {
      const double a = s[0][0] - s[1][1], b = s[1][1] - s[2][2], c = s[2][2] - s[0][0];
      return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[0][1] * s[1][0] + s[1][2] * s[2][1] + s[2][0] * s[0][2]));
    }


    /// n nodes in each direction.
    template <int dim, int n>
    class TensorCellKernel : public CellKernel<dim>
    {
    public:
      TensorCellKernel(const SolidMesh<dim> &mesh, const Material<dim> &material);

      typename CellKernel<dim>::Deformation add_internal_force(const std::vector<Vec<dim>> &displacement,
                                                               std::vector<Vec<dim>>       &force) const override;
      double                                strain_energy(const std::vector<Vec<dim>> &displacement) const override;
      std::vector<double>                   von_mises_stress(const std::vector<Vec<dim>> &displacement) const override;
      CellEigenvalues                       start_eigenvalues() const override;
      double              bound_eigenvalue(const std::vector<Vec<dim>> &displacement, CellEigenvalues &eigenvalues,
                                           double tolerance) const override;
      std::vector<double> lumped_mass() const override;

    private:
      static constexpr int n_nodes = power(n, dim); ///< of a cell, and its Gauss points

      using NodeValues   = Pack[dim][n_nodes];
      using PointTensors = Pack[n_nodes][dim][dim];
      /// Products of the edges that meet at a corner, for the first and the last corner of each subcell.
      static constexpr int n_products = dim * (dim + 1) / 2;
      using CellMetrics               = Pack[2 * power(n - 1, dim) * n_products];
      /// At points times lanes, as a Material takes them.
      using MaterialTensors = double[n_nodes * n_lanes * dim * dim];

      /// Geometry of the cells of a batch; lanes beyond the last cell repeat it, and nothing of them is used.
      struct Batch
      {
        unsigned int n_cells;
        unsigned int node[n_nodes][n_lanes];
        Pack         inverse_jacobian[n_nodes][dim][dim]; ///< [point]
        Pack         point_volume[n_nodes];
        Pack         node_volume[n_nodes];
        Pack         size;                   ///< volume to the power 1/dim [m]
        Pack         position[dim][n_nodes]; ///< undeformed [m]
        Pack         inverse_spacing[dim];   ///< of neighbouring nodes in each direction of the cell [1/m]
      };

      void gather(const Batch &batch, const std::vector<Vec<dim>> &values, NodeValues &local) const;
      void gradients(const Batch &batch, const NodeValues &u, PointTensors &gradient) const;
      void stresses(const PointTensors &gradient, PointTensors &stress) const;
      void divergence(const Batch &batch, const PointTensors &stress, NodeValues &force) const;

      void metrics(const Batch &batch, const NodeValues &u, CellMetrics &metric) const;
      void apply_tangent(const Batch &batch, const NodeValues &u, const NodeValues &x, NodeValues &result) const;
      Pack improve_eigenvector(const Batch &batch, const NodeValues &u, NodeValues &x, bool &is_settled) const;
      Pack product(const Batch &batch, const NodeValues &x, const NodeValues &y) const;

      static void to_material(const PointTensors &tensors, MaterialTensors &values);

      unsigned int         n_nodes_total_;
      std::vector<Batch>   batches_;
      const Material<dim> &material_;
      const Shape1D<n>     shape_;
    };


    template <int dim, int n>
    TensorCellKernel<dim, n>::TensorCellKernel(const SolidMesh<dim> &mesh, const Material<dim> &material)
      : n_nodes_total_(mesh.nodes.size())
      , batches_((mesh.n_cells() + n_lanes - 1) / n_lanes)
      , material_(material)
    {
      for (std::size_t b = 0; b < batches_.size(); ++b)
        {
          Batch &batch  = batches_[b];
          batch.n_cells = std::min<unsigned int>(n_lanes, mesh.n_cells() - b * n_lanes);
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            {
              const std::size_t cell = b * n_lanes + std::min(lane, batch.n_cells - 1);
              for (int i = 0; i < n_nodes; ++i)
                {
                  const std::size_t index = cell * n_nodes + i;
                  batch.node[i][lane]     = mesh.cell_nodes[index];
                  for (int d = 0; d < dim; ++d)
                    batch.position[d][i][lane] = mesh.nodes[mesh.cell_nodes[index]][d];
                  batch.point_volume[i][lane] = mesh.point_volume[index];
                  batch.node_volume[i][lane]  = mesh.node_volume[index];
                  for (int k = 0; k < dim; ++k)
                    for (int j = 0; j < dim; ++j)
                      batch.inverse_jacobian[i][k][j][lane] = mesh.inverse_jacobian[(index * dim + k) * dim + j];
                }
              double volume = 0;
              for (int i = 0; i < n_nodes; ++i)
                volume += batch.node_volume[i][lane];
              batch.size[lane] = std::pow(volume, 1. / dim);
              for (int k = 0; k < dim; ++k)
                {
                  double square = 0;
                  for (int j = 0; j < dim; ++j)
                    square += std::pow(batch.inverse_jacobian[n_nodes / 2][k][j][lane], 2);
                  batch.inverse_spacing[k][lane] = (n - 1) * std::sqrt(square);
                }
            }
        }
    }


    template <int dim, int n>
    inline void TensorCellKernel<dim, n>::gather(const Batch &batch, const std::vector<Vec<dim>> &values,
                                                 NodeValues &local) const
    {
      for (int i = 0; i < n_nodes; ++i)
        for (int lane = 0; lane < n_lanes; ++lane)
          {
            const Vec<dim> &value = values[batch.node[i][lane]];
            for (int d = 0; d < dim; ++d)
              local[d][i][lane] = value[d];
          }
    }


    /// H = du/dX at the Gauss points: interpolation to them, derivatives there, chain rule.
    template <int dim, int n>
    inline void TensorCellKernel<dim, n>::gradients(const Batch &batch, const NodeValues &u,
                                                    PointTensors &gradient) const
    {
      for (int c = 0; c < dim; ++c)
        {
          Pack first[n_nodes], second[n_nodes], derivative[dim][n_nodes];
          sweep<dim, n, 0, false, false>(shape_.value, u[c], first);
          sweep<dim, n, 1, false, false>(shape_.value, first, second);
          if constexpr (dim == 3)
            sweep<dim, n, 2, false, false>(shape_.value, second, first);
          const Pack *at_points = dim == 3 ? first : second;
          sweep<dim, n, 0, false, false>(shape_.derivative, at_points, derivative[0]);
          sweep<dim, n, 1, false, false>(shape_.derivative, at_points, derivative[1]);
          if constexpr (dim == 3)
            sweep<dim, n, 2, false, false>(shape_.derivative, at_points, derivative[2]);
          for (int q = 0; q < n_nodes; ++q)
            for (int j = 0; j < dim; ++j)
              {
                Pack sum = derivative[0][q] * batch.inverse_jacobian[q][0][j];
                for (int k = 1; k < dim; ++k)
                  sum += derivative[k][q] * batch.inverse_jacobian[q][k][j];
                gradient[q][c][j] = sum;
              }
        }
    }


    template <int dim, int n>
    inline void TensorCellKernel<dim, n>::to_material(const PointTensors &tensors, MaterialTensors &values)
    {
      for (int q = 0; q < n_nodes; ++q)
        for (int c = 0; c < dim; ++c)
          for (int j = 0; j < dim; ++j)
            for (int lane = 0; lane < n_lanes; ++lane)
              values[((q * n_lanes + lane) * dim + c) * dim + j] = tensors[q][c][j][lane];
    }


    template <int dim, int n>
    inline void TensorCellKernel<dim, n>::stresses(const PointTensors &gradient, PointTensors &stress) const
    {
      MaterialTensors h, p;
      to_material(gradient, h);
      material_.first_piola_stress(h, p, n_nodes * n_lanes);
      for (int q = 0; q < n_nodes; ++q)
        for (int c = 0; c < dim; ++c)
          for (int j = 0; j < dim; ++j)
            for (int lane = 0; lane < n_lanes; ++lane)
              stress[q][c][j][lane] = p[((q * n_lanes + lane) * dim + c) * dim + j];
    }


    /// integral of P grad N_i dV: the transpose of gradients().
    template <int dim, int n>
    inline void TensorCellKernel<dim, n>::divergence(const Batch &batch, const PointTensors &stress,
                                                     NodeValues &force) const
    {
      for (int c = 0; c < dim; ++c)
        {
          Pack flux[dim][n_nodes];
          for (int q = 0; q < n_nodes; ++q)
            for (int k = 0; k < dim; ++k)
              {
                Pack sum = stress[q][c][0] * batch.inverse_jacobian[q][k][0];
                for (int j = 1; j < dim; ++j)
                  sum += stress[q][c][j] * batch.inverse_jacobian[q][k][j];
                flux[k][q] = sum * batch.point_volume[q];
              }
          Pack first[n_nodes], second[n_nodes];
          sweep<dim, n, 0, true, false>(shape_.derivative, flux[0], first);
          sweep<dim, n, 1, true, true>(shape_.derivative, flux[1], first);
          if constexpr (dim == 3)
            {
              sweep<dim, n, 2, true, true>(shape_.derivative, flux[2], first);
              sweep<dim, n, 2, true, false>(shape_.value, first, second);
              sweep<dim, n, 1, true, false>(shape_.value, second, first);
            }
          else
            {
              sweep<dim, n, 1, true, false>(shape_.value, first, second);
              std::copy_n(second, n_nodes, first);
            }
          sweep<dim, n, 0, true, false>(shape_.value, first, force[c]);
        }
    }


    template <int dim, int n>
    typename CellKernel<dim>::Deformation TensorCellKernel<dim, n>::add_internal_force(
      const std::vector<Vec<dim>> &displacement, std::vector<Vec<dim>> &force) const
    {
      typename CellKernel<dim>::Deformation worst{std::numeric_limits<double>::infinity(), 0};
      for (std::size_t b = 0; b < batches_.size(); ++b)
        {
          const Batch &batch = batches_[b];
          NodeValues   u, f;
          PointTensors gradient, stress;
          gather(batch, displacement, u);
          gradients(batch, u, gradient);
          stresses(gradient, stress);
          divergence(batch, stress, f);

          Pack volume = {}, undeformed_volume = {};
          for (int q = 0; q < n_nodes; ++q)
            {
              volume += determinant(gradient[q]) * batch.point_volume[q];
              undeformed_volume += batch.point_volume[q];
            }
          for (unsigned int lane = 0; lane < batch.n_cells; ++lane)
            {
              if (volume[lane] / undeformed_volume[lane] < worst.smallest_volume_ratio)
                worst = {volume[lane] / undeformed_volume[lane], static_cast<unsigned int>(b * n_lanes + lane)};
              for (int i = 0; i < n_nodes; ++i)
                {
                  Vec<dim> &value = force[batch.node[i][lane]];
                  for (int d = 0; d < dim; ++d)
                    value[d] -= f[d][i][lane];
                }
            }
        }
      return worst;
    }


    template <int dim, int n>
    double TensorCellKernel<dim, n>::strain_energy(const std::vector<Vec<dim>> &displacement) const
    {
      double energy = 0;
      for (const Batch &batch : batches_)
        {
          NodeValues      u;
          PointTensors    gradient;
          MaterialTensors h;
          gather(batch, displacement, u);
          gradients(batch, u, gradient);
          to_material(gradient, h);
          for (int q = 0; q < n_nodes; ++q)
            for (unsigned int lane = 0; lane < batch.n_cells; ++lane)
              energy += batch.point_volume[q][lane] * material_.strain_energy(h + (q * n_lanes + lane) * dim * dim);
        }
      return energy;
    }


    /// Cauchy stress P F^T / det F.
    template <int dim, int n>
    std::vector<double> TensorCellKernel<dim, n>::von_mises_stress(const std::vector<Vec<dim>> &displacement) const
    {
      std::vector<double>       sum(n_nodes_total_);
      std::vector<unsigned int> n_cells(n_nodes_total_);
      for (const Batch &batch : batches_)
        {
          NodeValues   u;
          PointTensors gradient, stress;
          gather(batch, displacement, u);
          gradients(batch, u, gradient);
          stresses(gradient, stress);
          for (int q = 0; q < n_nodes; ++q)
            {
              const Pack det = determinant(gradient[q]);
              for (unsigned int lane = 0; lane < batch.n_cells; ++lane)
                {
                  double cauchy[dim][dim];
                  for (int i = 0; i < dim; ++i)
                    for (int j = 0; j < dim; ++j)
                      {
                        cauchy[i][j] = stress[q][i][j][lane];
                        for (int k = 0; k < dim; ++k)
                          cauchy[i][j] += stress[q][i][k][lane] * gradient[q][j][k][lane];
                        cauchy[i][j] /= det[lane];
                      }
                  sum[batch.node[q][lane]] += von_mises(cauchy);
                  ++n_cells[batch.node[q][lane]];
                }
            }
        }
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] /= n_cells[i];
      return sum;
    }


    /// Tangents of the lattice of nodes, dx/dX along its lines, and their products: 2 E + 1 by finite differences, which
    /// a rotation leaves as it is.
    template <int dim, int n>
    void TensorCellKernel<dim, n>::metrics(const Batch &batch, const NodeValues &u, CellMetrics &metric) const
    {
      Pack *next = metric;
      for (int subcell = 0; subcell < power(n - 1, dim); ++subcell)
        {
          const int first = subcell % (n - 1) + n * (subcell / (n - 1) % (n - 1)) +
                            (dim == 3 ? n * n * (subcell / ((n - 1) * (n - 1))) : 0);
          for (const int side : {1, -1})
            {
              const int node = side == 1 ? first : first + 1 + n + (dim == 3 ? n * n : 0);
              Pack      tangent[dim][dim];
              for (int k = 0; k < dim; ++k)
                for (int c = 0; c < dim; ++c)
                  {
                    const int other = node + side * power(n, k);
                    tangent[k][c]   = batch.inverse_spacing[k] *
                                    ((batch.position[c][other] - batch.position[c][node]) + (u[c][other] - u[c][node]));
                  }
              for (int k = 0; k < dim; ++k)
                for (int l = 0; l <= k; ++l)
                  {
                    *next = tangent[k][0] * tangent[l][0];
                    for (int c = 1; c < dim; ++c)
                      *next += tangent[k][c] * tangent[l][c];
                    ++next;
                  }
            }
        }
    }


    /// Scalar product with the lumped mass.
    template <int dim, int n>
    inline Pack TensorCellKernel<dim, n>::product(const Batch &batch, const NodeValues &x, const NodeValues &y) const
    {
      Pack sum = {};
      for (int i = 0; i < n_nodes; ++i)
        {
          Pack dot = x[0][i] * y[0][i];
          for (int c = 1; c < dim; ++c)
            dot += x[c][i] * y[c][i];
          sum += batch.node_volume[i] * dot;
        }
      return material_.density() * sum;
    }


    /// result = M^-1 K(u) x, by central differences over a 1e-6 of the cell's size: their error is the square of that.
    template <int dim, int n>
    void TensorCellKernel<dim, n>::apply_tangent(const Batch &batch, const NodeValues &u, const NodeValues &x,
                                                 NodeValues &result) const
    {
      Pack largest = {};
      for (int c = 0; c < dim; ++c)
        for (int i = 0; i < n_nodes; ++i)
          {
            largest = x[c][i] > largest ? x[c][i] : largest;
            largest = -x[c][i] > largest ? -x[c][i] : largest;
          }
      const Pack step = 1e-6 * batch.size / (largest > 0. ? largest : largest + 1.);

      NodeValues   moved, minus;
      PointTensors gradient, stress;
      for (const double sign : {-1., 1.})
        {
          for (int c = 0; c < dim; ++c)
            for (int i = 0; i < n_nodes; ++i)
              moved[c][i] = u[c][i] + sign * step * x[c][i];
          gradients(batch, moved, gradient);
          stresses(gradient, stress);
          divergence(batch, stress, sign < 0 ? minus : result);
        }
      for (int c = 0; c < dim; ++c)
        for (int i = 0; i < n_nodes; ++i)
          result[c][i] = (result[c][i] - minus[c][i]) * (0.5 / material_.density()) / (step * batch.node_volume[i]);
    }


    /// Largest eigenvalue of a symmetric tridiagonal matrix by bisection, and its eigenvector.
    template <int size>
    double largest_eigenvalue(const double (&diagonal)[size], const double (&beside)[size], double (&vector)[size])
    {
      double lower = diagonal[0], upper = 0;
      for (int i = 0; i < size; ++i)
        upper = std::max(upper, diagonal[i] + beside[i] + (i > 0 ? beside[i - 1] : 0.));
      for (int iteration = 0; iteration < 50; ++iteration)
        {
          // No eigenvalue is above the middle if all pivots of T - middle are negative.
          const double middle   = 0.5 * (lower + upper);
          double       pivot    = diagonal[0] - middle;
          bool         is_above = pivot < 0;
          for (int i = 1; i < size && is_above; ++i)
            {
              pivot    = diagonal[i] - middle - beside[i - 1] * beside[i - 1] / pivot;
              is_above = pivot < 0;
            }
          (is_above ? upper : lower) = middle;
        }
      vector[0] = 1;
      for (int i = 0; i + 1 < size; ++i)
        {
          const double next = (upper - diagonal[i]) * vector[i] - (i > 0 ? beside[i - 1] * vector[i - 1] : 0.);
          vector[i + 1]     = beside[i] > 0 ? next / beside[i] : 0.;
        }
      return upper;
    }


    /// A few steps of Lanczos' method: x becomes the best eigenvector of the largest eigenvalue, which is returned.
    /// It has settled if the last step has raised it by less than a thousandth in all lanes.
    template <int dim, int n>
    Pack TensorCellKernel<dim, n>::improve_eigenvector(const Batch &batch, const NodeValues &u, NodeValues &x,
                                                       bool &is_settled) const
    {
      constexpr int n_steps = 6;
      NodeValues    basis[n_steps], w;
      Pack          diagonal[n_steps], beside[n_steps];
      const auto    assign_scaled = [](const NodeValues &from, const Pack &factor, NodeValues &to) {
        for (int c = 0; c < dim; ++c)
          for (int i = 0; i < n_nodes; ++i)
            to[c][i] = factor * from[c][i];
      };
      const auto square_root = [](Pack value) {
        for (int lane = 0; lane < n_lanes; ++lane)
          value[lane] = std::sqrt(value[lane]);
        return value;
      };

      assign_scaled(x, 1. / square_root(product(batch, x, x)), basis[0]);
      for (int step = 0; step < n_steps; ++step)
        {
          apply_tangent(batch, u, basis[step], w);
          diagonal[step] = product(batch, w, basis[step]);
          for (int other = 0; other <= step; ++other)
            {
              const Pack share = product(batch, w, basis[other]);
              for (int c = 0; c < dim; ++c)
                for (int i = 0; i < n_nodes; ++i)
                  w[c][i] -= share * basis[other][c][i];
            }
          // The space is exhausted where what is left is noise.
          const Pack length = square_root(product(batch, w, w));
          beside[step]      = length > 1e-8 * diagonal[0] ? length : 0. * length;
          if (step + 1 < n_steps)
            assign_scaled(w, beside[step] > 0. ? 1. / length : 0. * length, basis[step + 1]);
        }

      is_settled = true;
      Pack eigenvalue, share[n_steps];
      for (int lane = 0; lane < n_lanes; ++lane)
        {
          double a[n_steps], b[n_steps], vector[n_steps];
          for (int step = 0; step < n_steps; ++step)
            {
              a[step] = diagonal[step][lane];
              b[step] = step + 1 < n_steps ? beside[step][lane] : 0.;
            }
          b[n_steps - 2]      = 0;
          const double before = largest_eigenvalue(a, b, vector);
          b[n_steps - 2]      = beside[n_steps - 2][lane];
          eigenvalue[lane]    = largest_eigenvalue(a, b, vector);
          is_settled          = is_settled && eigenvalue[lane] < 1.001 * before;
          for (int step = 0; step < n_steps; ++step)
            share[step][lane] = vector[step];
        }
      assign_scaled(basis[0], share[0], x);
      for (int step = 1; step < n_steps; ++step)
        for (int c = 0; c < dim; ++c)
          for (int i = 0; i < n_nodes; ++i)
            x[c][i] += share[step] * basis[step][c][i];
      return eigenvalue;
    }


    template <int dim, int n>
    CellEigenvalues TensorCellKernel<dim, n>::start_eigenvalues() const
    {
      const std::size_t n_values = batches_.size() * sizeof(NodeValues) / sizeof(double);
      CellEigenvalues   eigenvalues;
      eigenvalues.eigenvalue.assign(batches_.size() * n_lanes, 0.);
      eigenvalues.direction.assign(n_values, 0.);
      eigenvalues.metric.assign(batches_.size() * sizeof(CellMetrics) / sizeof(double), 0.);
      return eigenvalues;
    }


    template <int dim, int n>
    double TensorCellKernel<dim, n>::bound_eigenvalue(const std::vector<Vec<dim>> &displacement,
                                                      CellEigenvalues &eigenvalues, const double tolerance) const
    {
      double largest = 0;
      for (std::size_t b = 0; b < batches_.size(); ++b)
        {
          const Batch      &batch = batches_[b];
          const std::size_t first = b * sizeof(NodeValues) / sizeof(double);
          NodeValues        u;
          CellMetrics       metric, reference;
          gather(batch, displacement, u);
          metrics(batch, u, metric);
          std::memcpy(reference, &eigenvalues.metric[b * sizeof(CellMetrics) / sizeof(double)], sizeof(CellMetrics));
          Pack change = {};
          for (std::size_t i = 0; i < sizeof(CellMetrics) / sizeof(Pack); ++i)
            {
              const Pack difference = 0.5 * (metric[i] - reference[i]);
              change                = difference > change ? difference : change;
              change                = -difference > change ? -difference : change;
            }
          bool has_changed = false;
          for (int lane = 0; lane < n_lanes; ++lane)
            has_changed =
              has_changed || !(change[lane] <= tolerance) || eigenvalues.eigenvalue[b * n_lanes + lane] == 0;
          if (has_changed)
            {
              // A part of every mode is mixed in, so that another one that has become the largest is found.
              NodeValues x;
              std::memcpy(x, &eigenvalues.direction[first], sizeof(NodeValues));
              const Pack length     = product(batch, x, x);
              Pack       batch_mass = {};
              for (int i = 0; i < n_nodes; ++i)
                batch_mass += material_.density() * batch.node_volume[i];
              for (int c = 0; c < dim; ++c)
                for (int i = 0; i < n_nodes; ++i)
                  {
                    const double k = c * n_nodes + i + 1;
                    for (int lane = 0; lane < n_lanes; ++lane)
                      x[c][i][lane] =
                        (length[lane] > 0 ? x[c][i][lane] * std::sqrt(batch_mass[lane] / length[lane]) : 0.) +
                        0.1 * std::sin(1. + 12.9898 * k * k);
                  }
              Pack eigenvalue;
              bool is_settled = false;
              for (unsigned int round = 0; round < 50 && !is_settled; ++round)
                eigenvalue = improve_eigenvector(batch, u, x, is_settled);
              std::memcpy(&eigenvalues.direction[first], x, sizeof(NodeValues));
              std::memcpy(&eigenvalues.metric[b * sizeof(CellMetrics) / sizeof(double)], metric, sizeof(CellMetrics));
              std::memcpy(&eigenvalues.eigenvalue[b * n_lanes], &eigenvalue, sizeof(Pack));
            }
          for (int lane = 0; lane < n_lanes; ++lane)
            largest = std::max(largest, eigenvalues.eigenvalue[b * n_lanes + lane]);
        }
      return largest;
    }


    template <int dim, int n>
    std::vector<double> TensorCellKernel<dim, n>::lumped_mass() const
    {
      std::vector<double> mass(n_nodes_total_);
      for (const Batch &batch : batches_)
        for (int i = 0; i < n_nodes; ++i)
          for (unsigned int lane = 0; lane < batch.n_cells; ++lane)
            mass[batch.node[i][lane]] += material_.density() * batch.node_volume[i][lane];
      return mass;
    }
  } // namespace


  template <int dim>
  std::unique_ptr<CellKernel<dim>> make_cell_kernel(const SolidMesh<dim> &mesh, const Material<dim> &material)
  {
    if (mesh.degree == 1)
      return std::make_unique<TensorCellKernel<dim, 2>>(mesh, material);
    return std::make_unique<TensorCellKernel<dim, 3>>(mesh, material);
  }

  template std::unique_ptr<CellKernel<2>> make_cell_kernel(const SolidMesh<2> &, const Material<2> &);
  template std::unique_ptr<CellKernel<3>> make_cell_kernel(const SolidMesh<3> &, const Material<3> &);
} // namespace Breakwater
