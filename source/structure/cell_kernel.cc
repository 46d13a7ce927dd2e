#include "tensor_cell_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Breakwater
{
  namespace
  {
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
  } // namespace


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
  void TensorCellKernel<dim, n>::gather(const Batch &batch, const std::vector<Vec<dim>> &values,
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
  void TensorCellKernel<dim, n>::gradients(const Batch &batch, const NodeValues &u, PointTensors &gradient) const
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
  void TensorCellKernel<dim, n>::to_material(const PointTensors &tensors, MaterialTensors &values)
  {
    for (int q = 0; q < n_nodes; ++q)
      for (int c = 0; c < dim; ++c)
        for (int j = 0; j < dim; ++j)
          for (int lane = 0; lane < n_lanes; ++lane)
            values[((q * n_lanes + lane) * dim + c) * dim + j] = tensors[q][c][j][lane];
  }


  template <int dim, int n>
  void TensorCellKernel<dim, n>::stresses(const PointTensors &gradient, PointTensors &stress) const
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
  void TensorCellKernel<dim, n>::divergence(const Batch &batch, const PointTensors &stress, NodeValues &force) const
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


  template <int dim>
  std::unique_ptr<CellKernel<dim>> make_cell_kernel(const SolidMesh<dim> &mesh, const Material<dim> &material)
  {
    if (mesh.degree == 1)
      return std::make_unique<TensorCellKernel<dim, 2>>(mesh, material);
    return std::make_unique<TensorCellKernel<dim, 3>>(mesh, material);
  }

  template class TensorCellKernel<2, 2>;
  template class TensorCellKernel<2, 3>;
  template class TensorCellKernel<3, 2>;
  template class TensorCellKernel<3, 3>;
  template std::unique_ptr<CellKernel<2>> make_cell_kernel(const SolidMesh<2> &, const Material<2> &);
  template std::unique_ptr<CellKernel<3>> make_cell_kernel(const SolidMesh<3> &, const Material<3> &);
} // namespace Breakwater
