#pragma once

#include "fluid_nodes.h"
#include "walls.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  // How the nodal volumes are kept at mass / density although nodes carry their mass through every remesh. Causes,
  // scheme and measurements: doc/volume_conservation.md.

  /// Displacements [m] that bring nodal volumes closer to mass / density: a few conjugate gradient iterations on
  ///   D W D^T phi = r,   u = W D^T phi,   D = dV/dx,
  /// with r_i the missing volume of interior nodes, phi = 0 on the free surface, and W the mobility of the nodes.
  /// Walls let no normal component pass; interface nodes stay.
  ///
  /// @return one displacement per node, empty if nothing is worth correcting
  template <int dim>
  std::vector<Quad> volume_correction(const FluidNodes<dim>                              &nodes,
                                      const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                      const Walls<dim> &walls, double reference_density, double spacing, double weight,
                                      unsigned int n_iterations);

  /// Interior deficit 1 - sum V_i / sum (m_i / rho_i) [-] over the nodes with cells that are on neither the free
  /// surface nor the interface: how much too tightly the interior is packed.
  template <int dim>
  double interior_volume_deficit(const FluidNodes<dim> &nodes);
} // namespace Breakwater
