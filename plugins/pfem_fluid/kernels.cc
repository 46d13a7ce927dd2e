#include "kernels.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace Breakwater
{
  namespace
  {
    bool uses_avx2()
    {
      const char *wanted = std::getenv("BREAKWATER_INSTRUCTION_SET");
      return (wanted == nullptr || std::string(wanted) != "baseline") && __builtin_cpu_supports("avx2") &&
             __builtin_cpu_supports("fma");
    }
  } // namespace


  template <int dim>
  const ElementPasses &element_passes()
  {
    static const ElementPasses chosen = uses_avx2() ? Avx2::element_passes<dim>() : Baseline::element_passes<dim>();
    return chosen;
  }


  template <int dim>
  void compute_volumes(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::vector<Quad> &xp,
                       std::vector<double> &volume)
  {
    std::fill(volume.begin(), volume.end(), 0.);
    if (!cells.empty())
      element_passes<dim>().volumes(cells.front().data(), cells.size(), xp.data(), volume.data());
  }


  template <int dim>
  void compute_forces(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const ForceEffects &effects,
                      const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<Quad> &density_slope,
                      std::vector<Quad> &force)
  {
    std::fill(force.begin(), force.end(), Quad());
    if (!cells.empty())
      element_passes<dim>().forces[effects.viscous][effects.density_diffusion](
        cells.front().data(), cells.size(), effects, xp.data(), v.data(), density_slope.data(), force.data());
  }


  template <int dim>
  void compute_shear_rates(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const double least_volume,
                           const std::vector<Quad> &xp, const std::vector<Quad> &v, std::vector<double> &shear_rate)
  {
    shear_rate.resize(cells.size());
    if (!cells.empty())
      element_passes<dim>().shear_rates(cells.front().data(), cells.size(), least_volume, xp.data(), v.data(),
                                        shear_rate.data());
  }


  template <int dim>
  void filter_impulses(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const FilterWeights &weights,
                       const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<double> &volume,
                       const double least_volume, const std::vector<double> &node_density,
                       const std::vector<double> &inverse_mass, std::vector<Quad> &gradient, std::vector<Quad> &impulse)
  {
    impulse.assign(xp.size(), Quad());
    if (cells.empty())
      return;
    gradient.assign(xp.size() * dim, Quad());
    element_passes<dim>().velocity_gradients(cells.front().data(), cells.size(), xp.data(), v.data(), gradient.data());
    for (std::size_t i = 0; i < xp.size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double scale = 1. / std::max(volume[i], least_volume);
          for (int e = 0; e < dim; ++e)
            gradient[i * dim + d][e] *= scale;
          gradient[i * dim + d][3] = 0;
        }
    element_passes<dim>().filter_impulses(cells.front().data(), cells.size(), weights, xp.data(), v.data(),
                                          gradient.data(), node_density.data(), inverse_mass.data(), impulse.data());
  }


  template <int dim>
  double largest_relative_displacement(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                       const std::vector<Quad> &x, const std::vector<Quad> &x0)
  {
    return cells.empty() ? 0. :
                           element_passes<dim>().largest_relative_displacement(cells.front().data(), cells.size(),
                                                                               x.data(), x0.data());
  }


#define BREAKWATER_INSTANTIATE(dim)                                                                                      \
  template const ElementPasses &element_passes<dim>();                                                                   \
  template void   compute_volumes<dim>(const std::vector<SimplexMesh<dim>::Cell> &, const std::vector<Quad> &,           \
                                     std::vector<double> &);                                                           \
  template void   compute_forces<dim>(const std::vector<SimplexMesh<dim>::Cell> &, const ForceEffects &,                 \
                                    const std::vector<Quad> &, const std::vector<Quad> &, const std::vector<Quad> &,   \
                                    std::vector<Quad> &);                                                              \
  template void   compute_shear_rates<dim>(const std::vector<SimplexMesh<dim>::Cell> &, double,                          \
                                         const std::vector<Quad> &, const std::vector<Quad> &, std::vector<double> &); \
  template void   filter_impulses<dim>(const std::vector<SimplexMesh<dim>::Cell> &, const FilterWeights &,               \
                                     const std::vector<Quad> &, const std::vector<Quad> &,                             \
                                     const std::vector<double> &, double, const std::vector<double> &,                 \
                                     const std::vector<double> &, std::vector<Quad> &, std::vector<Quad> &);           \
  template double largest_relative_displacement<dim>(const std::vector<SimplexMesh<dim>::Cell> &,                        \
                                                     const std::vector<Quad> &, const std::vector<Quad> &);
  BREAKWATER_INSTANTIATE(2)
  BREAKWATER_INSTANTIATE(3)
} // namespace Breakwater
