// The largest eigenvalues of cells, for the stable step.
#include "tensor_cell_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace Breakwater
{
  namespace
  {
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
  } // namespace


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
  Pack TensorCellKernel<dim, n>::product(const Batch &batch, const NodeValues &x, const NodeValues &y) const
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
          has_changed = has_changed || !(change[lane] <= tolerance) || eigenvalues.eigenvalue[b * n_lanes + lane] == 0;
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


  template class TensorCellKernel<2, 2>;
  template class TensorCellKernel<2, 3>;
  template class TensorCellKernel<3, 2>;
  template class TensorCellKernel<3, 3>;
} // namespace Breakwater
