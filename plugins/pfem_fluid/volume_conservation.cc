#include "volume_conservation.h"

#include "kernels.h"

#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// Sweeps of a diffusion of the extensive quantity q over the cells: each corner gives
    /// |V_c| / (2 (dim + 1)) times the difference of q / V to the cell's mean. The sum of q is kept.
    template <int dim>
    void smooth_extensive(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                          const std::vector<double> &cell_volume, const std::vector<double> &node_volume,
                          const unsigned int n_sweeps, std::vector<double> &q)
    {
      std::vector<double> change(q.size()), density(q.size());
      for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
        {
          std::fill(change.begin(), change.end(), 0.);
          for (std::size_t i = 0; i < q.size(); ++i)
            density[i] = q[i] / node_volume[i];
          for (std::size_t c = 0; c < cells.size(); ++c)
            {
              double mean = 0;
              for (const unsigned int i : cells[c])
                mean += density[i];
              mean /= dim + 1;
              const double factor = cell_volume[c] / (2 * (dim + 1));
              for (const unsigned int i : cells[c])
                change[i] -= factor * (density[i] - mean);
            }
          for (std::size_t i = 0; i < q.size(); ++i)
            q[i] += change[i];
        }
    }

    /// The operator of the correction, with what it needs in between.
    template <int dim>
    class CorrectionOperator
    {
    public:
      CorrectionOperator(const FluidNodes<dim> &nodes, const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                         const Walls<dim> &walls, const double reference_density, const double spacing)
        : nodes_(nodes)
        , cells_(cells)
        , walls_(walls)
        , is_free_(nodes.n)
        , mobility_(nodes.n)
        , place_(nodes.xp)
      {
        const double regular_mass = reference_density * regular_volume<dim>(spacing);
        for (std::size_t i = 0; i < nodes.n; ++i)
          {
            is_free_[i]  = nodes.has_cells[i] && !nodes.is_surface[i];
            mobility_[i] = nodes.is_driven(i) ? 0. : regular_mass / std::max(nodes.mass[i], 0.3 * regular_mass);
          }
      }

      /// phi counts only where this is true: nodes inside and on the wetted interface.
      bool is_free(const std::size_t i) const { return is_free_[i]; }

      /// u = W D^T phi: the forces of the pressure phi.
      void displacement(const std::vector<double> &phi, std::vector<Quad> &u)
      {
        for (std::size_t i = 0; i < phi.size(); ++i)
          place_[i][3] = phi[i];
        compute_forces<dim>(cells_, ForceEffects(), place_, nodes_.v, nodes_.density_slope, u);
        for (std::size_t i = 0; i < u.size(); ++i)
          {
            for (int d = 0; d < dim; ++d)
              u[i][d] *= mobility_[i];
            if (!nodes_.contacts[i].empty())
              walls_.mask(nodes_.xp[i].c, u[i].c, nodes_.contacts[i]);
          }
      }

      /// D u, at the free nodes
      void volume_change(const std::vector<Quad> &u, std::vector<double> &result) const
      {
        std::fill(result.begin(), result.end(), 0.);
        element_passes<dim>().volume_changes(cells_.front().data(), cells_.size(), nodes_.xp.data(), u.data(),
                                             result.data());
        for (std::size_t i = 0; i < result.size(); ++i)
          if (!is_free_[i])
            result[i] = 0;
      }

    private:
      const FluidNodes<dim>                              &nodes_;
      const std::vector<typename SimplexMesh<dim>::Cell> &cells_;
      const Walls<dim>                                   &walls_;
      std::vector<char>                                   is_free_;
      std::vector<double>                                 mobility_;
      std::vector<Quad>                                   place_; ///< of the nodes, and phi
    };

    double dot(const std::vector<double> &a, const std::vector<double> &b)
    {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }
  } // namespace


  template <int dim>
  std::vector<Quad> volume_correction(const FluidNodes<dim>                              &nodes,
                                      const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                      const Walls<dim> &walls, const double reference_density, const double spacing,
                                      const double weight, const unsigned int n_iterations)
  {
    const double        regular = regular_volume<dim>(spacing);
    std::vector<double> missing(nodes.n, 0.);
    double              square_missing = 0, square_volume = 0;
    for (std::size_t i = nodes.n_interface; i < nodes.n; ++i)
      if (nodes.has_cells[i] && !nodes.is_surface[i] && !nodes.is_driven(i))
        {
          const double wanted = nodes.mass[i] / std::max(nodes.density[i], reference_density);
          missing[i]          = std::clamp(wanted - nodes.volume[i], -0.3 * regular, 0.3 * regular);
          square_missing += missing[i] * missing[i];
          square_volume += nodes.volume[i] * nodes.volume[i];
        }
    if (n_iterations == 0 || !(square_missing > 1e-4 * square_volume))
      return {};

    {
      // Over the interior cells only, so that the surface takes nothing.
      std::vector<typename SimplexMesh<dim>::Cell> interior;
      std::vector<double>                          cell_volume;
      for (const auto &cell : cells)
        if (std::all_of(cell.begin(), cell.end(), [&](const unsigned int i) {
              return !nodes.is_driven(i) && !nodes.is_surface[i];
            }))
          {
            interior.push_back(cell);
            cell_volume.push_back(std::abs(signed_volume(nodes.corners(cell))));
          }
      std::vector<double> node_volume(nodes.n);
      for (std::size_t i = 0; i < nodes.n; ++i)
        node_volume[i] = std::max(nodes.volume[i], 0.1 * regular);
      smooth_extensive<dim>(interior, cell_volume, node_volume, 3, missing);
    }

    CorrectionOperator<dim> correction(nodes, cells, walls, reference_density, spacing);
    std::vector<double>     residual(nodes.n), direction, image(nodes.n);
    std::vector<Quad>       u(nodes.n), sum(nodes.n); // of directions, and of the solution
    for (std::size_t i = 0; i < nodes.n; ++i)
      residual[i] = correction.is_free(i) ? weight * missing[i] : 0.;
    direction   = residual;
    double norm = dot(residual, residual);
    for (unsigned int k = 0; k < n_iterations && norm > 0; ++k)
      {
        correction.displacement(direction, u);
        correction.volume_change(u, image);
        const double curvature = dot(direction, image);
        if (!(curvature > 0))
          break;
        const double step = norm / curvature;
        for (std::size_t i = 0; i < nodes.n; ++i)
          {
            for (int d = 0; d < dim; ++d)
              sum[i][d] += step * u[i][d];
            residual[i] -= step * image[i];
          }
        const double new_norm = dot(residual, residual);
        for (std::size_t i = 0; i < nodes.n; ++i)
          direction[i] = residual[i] + new_norm / norm * direction[i];
        norm = new_norm;
      }
    const double largest = 0.1 * spacing;
    for (Quad &shift : sum)
      {
        double length = 0;
        for (int d = 0; d < dim; ++d)
          length += shift[d] * shift[d];
        length = std::sqrt(length);
        if (length > largest)
          for (int d = 0; d < dim; ++d)
            shift[d] *= largest / length;
      }
    return sum;
  }


  template <int dim>
  double interior_volume_deficit(const FluidNodes<dim> &nodes)
  {
    double volume = 0, wanted = 0;
    for (std::size_t i = nodes.n_interface; i < nodes.n; ++i)
      if (nodes.has_cells[i] && !nodes.is_surface[i] && !nodes.is_driven(i))
        {
          volume += nodes.volume[i];
          wanted += nodes.mass[i] / nodes.density[i];
        }
    return wanted > 0 ? 1. - volume / wanted : 0.;
  }


#define BREAKWATER_INSTANTIATE(dim)                                                                                    \
  template std::vector<Quad> volume_correction<dim>(const FluidNodes<dim> &,                                           \
                                                    const std::vector<SimplexMesh<dim>::Cell> &, const Walls<dim> &,   \
                                                    double, double, double, unsigned int);                             \
  template double            interior_volume_deficit<dim>(const FluidNodes<dim> &);
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
