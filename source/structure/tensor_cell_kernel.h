#pragma once

#include "cell_kernel.h"

#include <cmath>
#include <vector>

// Packs are passed between functions of this library alone: the note on their calling convention is void.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace Breakwater
{
  constexpr int n_lanes = 4; ///< cells of a batch

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
} // namespace Breakwater
