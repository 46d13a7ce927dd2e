#include "kernels.h"

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    /// The passes for the best instruction set that this machine has.
    template <int dim>
    const ElementPasses &passes()
    {
      static const ElementPasses chosen = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ?
                                            Avx2::element_passes<dim>() :
                                            Baseline::element_passes<dim>();
      return chosen;
    }
  } // namespace


  template <int dim>
  void compute_volumes(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::vector<Quad> &xp,
                       std::vector<double> &volume)
  {
    std::fill(volume.begin(), volume.end(), 0.);
    if (!cells.empty())
      passes<dim>().volumes(cells.front().data(), cells.size(), xp.data(), volume.data());
  }


  template <int dim>
  void compute_forces(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const ForceEffects &effects,
                      const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<Quad> &density_slope,
                      std::vector<Quad> &force)
  {
    std::fill(force.begin(), force.end(), Quad());
    if (!cells.empty())
      passes<dim>().forces[effects.viscous][effects.density_diffusion](
        cells.front().data(), cells.size(), effects, xp.data(), v.data(), density_slope.data(), force.data());
  }


  template <int dim>
  double largest_relative_displacement(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                       const std::vector<Quad> &x, const std::vector<Quad> &x0)
  {
    return cells.empty() ? 0. :
                           passes<dim>().largest_relative_displacement(cells.front().data(), cells.size(), x.data(),
                                                                       x0.data());
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
