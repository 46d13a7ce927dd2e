#pragma once

#include "element_passes.h"
#include "fluid_nodes.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// The loops over cells for the best instruction set that this machine has; for the compiler's baseline if the
  /// environment says BREAKWATER_INSTRUCTION_SET=baseline, for the same digits on every machine and to compare speeds.
  template <int dim>
  const ElementPasses &element_passes();

  /// Nodal volumes V_i = sum over cells of V_c / (dim + 1), signed [m^dim].
  template <int dim>
  void compute_volumes(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::vector<Quad> &xp,
                       std::vector<double> &volume);

  /// Nodal forces of the fluid's stresses [N] in the first three components of `force`:
  ///   F_a = sum_c  p_c A_a - tau_c A_a,   A_a = dV_c/dx_a,   p_c the mean nodal pressure,
  ///   tau = mu (L + L^T - 2/3 tr L),   L = sum_a v_a (x) A_a / max(|V_c|, least_viscous_volume).
  /// With p_i = -dE/dV_i the pressure part is exactly -dE/dx: no energy is made between two remeshes.
  ///
  /// With density diffusion the fourth component is, of density_slope = (rho; s) with s the hydrostatic gradient of
  /// the density,  sum_c |V_c| [rho_a - rho_c - s_c . (x_a - x_c)],  the means over the cell written rho_c, s_c, x_c.
  template <int dim>
  void compute_forces(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const ForceEffects &effects,
                      const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<Quad> &density_slope,
                      std::vector<Quad> &force);

  /// Shear rates sqrt(2 D:D) of the cells [1/s]; cells smaller than least_volume count as this big.
  template <int dim>
  void compute_shear_rates(const std::vector<typename SimplexMesh<dim>::Cell> &cells, double least_volume,
                           const std::vector<Quad> &xp, const std::vector<Quad> &v, std::vector<double> &shear_rate);

  /// Impulses [kg m/s] of the velocity filter, which takes away what the nodal pressure does not see.
  ///
  /// A part `weights.deviation` of the velocity's deviation from a locally linear field:
  ///   -weight sum_c m_c [v_a - v_c - G_c (x_a - x_c)],   m_c = |V_c| / (dim + 1) times the cell's least node_density,
  /// with the means over the cell written v_c and x_c, and G_c that of the recovered nodal velocity gradients.
  ///
  /// A part `weights.divergence` of the deviation of the cell's rate of volume from the mean around it:
  ///   -weight / n sum_c [w_c - V_c tr G_c] A_a / sum_b (|A_b|^2 / m_b),   w_c = sum_a v_a . A_a,
  /// n the number of cells that share nodes with one, 13 in 2D and 60 in 3D. Fields whose divergence has no nodal mean
  /// cost no energy of compression, and under gravity they even gain some: water at rest would slowly stir itself.
  ///
  /// In every cell the impulses add up to zero, so momentum is exact; linear fields are untouched; nothing is divided
  /// by the volume of a cell. A node density of zero leaves all cells of that node out.
  /// @param gradient a buffer
  template <int dim>
  void filter_impulses(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const FilterWeights &weights,
                       const std::vector<Quad> &xp, const std::vector<Quad> &v, const std::vector<double> &volume,
                       double least_volume, const std::vector<double> &node_density,
                       const std::vector<double> &inverse_mass, std::vector<Quad> &gradient,
                       std::vector<Quad> &impulse);

  /// Largest displacement [m] of a node against the mean of one of its cells, of displacements x - x0.
  template <int dim>
  double largest_relative_displacement(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                       const std::vector<Quad> &x, const std::vector<Quad> &x0);
} // namespace Breakwater
