#include "spectral.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <random>

namespace Breakwater
{
  namespace
  {
    /// Row-sum bound on the largest eigenvalue [1/s] of M^-1 C, where C is the matrix of the viscous forces: a cell's
    /// block is bounded by 2 mu |A_a| |A_b| / V.
    template <int dim>
    double largest_damping(const LinearizedFluid<dim> &fluid)
    {
      std::vector<double> row_sums(fluid.position.size(), 0.);
      for (const auto &cell : fluid.mesh.cells)
        {
          const Simplex<dim> x    = corners(fluid.position, cell);
          const Simplex<dim> area = area_vectors(x);
          double             length[dim + 1], sum = 0;
          for (int a = 0; a <= dim; ++a)
            sum += length[a] = norm(area[a]);
          const double factor = 2 * fluid.viscosity / std::max(std::abs(signed_volume(x)), fluid.least_viscous_volume);
          for (int a = 0; a <= dim; ++a)
            row_sums[cell[a]] += factor * length[a] * sum;
        }
      double largest = 0;
      for (std::size_t i = 0; i < row_sums.size(); ++i)
        if (fluid.mass[i] > 0)
          largest = std::max(largest, row_sums[i] / fluid.mass[i]);
      return largest;
    }

    /// y = M^-1 D^T W D x, by the two passes of the fluid itself.
    template <int dim>
    void apply(const LinearizedFluid<dim> &fluid, const std::vector<Simplex<dim>> &area, const std::vector<Vec<dim>> &x,
               std::vector<double> &pressure, std::vector<Vec<dim>> &y)
    {
      std::fill(pressure.begin(), pressure.end(), 0.);
      std::fill(y.begin(), y.end(), Vec<dim>());
      const auto &cells = fluid.mesh.cells;
      for (std::size_t c = 0; c < cells.size(); ++c)
        {
          double change = 0;
          for (int a = 0; a <= dim; ++a)
            change += dot(area[c][a], x[cells[c][a]]);
          for (int a = 0; a <= dim; ++a)
            pressure[cells[c][a]] += change / (dim + 1);
        }
      for (std::size_t i = 0; i < pressure.size(); ++i)
        pressure[i] *= fluid.stiffness[i];
      for (std::size_t c = 0; c < cells.size(); ++c)
        {
          double mean = 0;
          for (int a = 0; a <= dim; ++a)
            mean += pressure[cells[c][a]];
          mean /= dim + 1;
          for (int a = 0; a <= dim; ++a)
            y[cells[c][a]] += mean * area[c][a];
        }
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] *= fluid.mass[i] > 0 ? 1. / fluid.mass[i] : 0.;
    }
  } // namespace


  template <int dim>
  void SpectralBound<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Method", method_,
               "`gershgorin`: a safe upper bound on the largest frequency from row sums; `power iteration`: the "
               "largest frequency itself, approached from below.",
               {"gershgorin", "power iteration"});
    reader.add("Iterations", n_iterations_, "Power iterations per call.", 1, 10000);
  }


  template <int dim>
  double SpectralBound<dim>::largest_frequency_squared(const LinearizedFluid<dim> &fluid)
  {
    double largest = 0;
    if (method_ == "gershgorin")
      {
        for (std::size_t i = 0; i < fluid.row_sums.size(); ++i)
          largest = std::max(largest, fluid.stiffness[i] * fluid.row_sums[i]);
        return largest;
      }

    const std::size_t n = fluid.position.size();
    if (vector_.size() != n)
      {
        std::mt19937 random(1);
        vector_.resize(n);
        for (Vec<dim> &x : vector_)
          for (int d = 0; d < dim; ++d)
            x[d] = 2. * random() / std::mt19937::max() - 1.;
      }
    std::vector<Simplex<dim>> area;
    area.reserve(fluid.mesh.cells.size());
    for (const auto &cell : fluid.mesh.cells)
      area.push_back(area_vectors(corners(fluid.position, cell)));
    std::vector<double>   pressure(n);
    std::vector<Vec<dim>> next(n);
    for (unsigned int k = 0; k < n_iterations_; ++k)
      {
        apply(fluid, area, vector_, pressure, next);
        double numerator = 0, denominator = 0, square = 0; // Rayleigh quotient in the norm of M
        for (std::size_t i = 0; i < n; ++i)
          if (fluid.mass[i] > 0)
            {
              numerator += fluid.mass[i] * dot(vector_[i], next[i]);
              denominator += fluid.mass[i] * dot(vector_[i], vector_[i]);
              square += fluid.mass[i] * dot(next[i], next[i]);
            }
        if (!(square > 0))
          break;
        largest = numerator / denominator;
        for (std::size_t i = 0; i < n; ++i)
          vector_[i] = next[i] * (1. / std::sqrt(square));
      }
    return largest;
  }


  template <int dim>
  double SpectralBound<dim>::bound(const LinearizedFluid<dim> &fluid)
  {
    const double omega2 = largest_frequency_squared(fluid);
    const double lambda = fluid.viscosity > 0 ? largest_damping(fluid) : 0.;
    if (omega2 > 0)
      return 4. / (lambda + std::sqrt(lambda * lambda + 4 * omega2));
    return lambda > 0 ? 2. / lambda : std::numeric_limits<double>::infinity();
  }

  template class SpectralBound<2>;
  template class SpectralBound<3>;
} // namespace Breakwater
