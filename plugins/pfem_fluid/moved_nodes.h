#pragma once

#include "fluid_nodes.h"
#include "walls.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// Gives the nodes that a smoother moves the velocity and density of their new places.
  ///
  /// Values come from the mesh before the move, by linear interpolation: w_j at the corners j of the cell that the new
  /// place lies in (outside of the mesh, weights that are not negative of the cell next to it). The density takes the
  /// interpolated value: it is the pressure, not the mass. Masses stay with the nodes; what the move changes of m -
  /// rho V is left to the mass exchange. Momentum is exact: a moved node i exchanges fluid of the mass w_j m_i with
  /// each corner j, which gives i the interpolated velocity and takes the difference from those who had it. What a
  /// node exchanges in all is at most its mass, so that the kinetic energy can only fall. Driven nodes give no
  /// velocity.
  /// @param cells of the mesh before the move
  /// @param position of the nodes after it [m]; `nodes` still has those before
  /// @return the densities [kg/m^3]; the velocities are changed in `nodes`
  template <int dim>
  std::vector<double> transfer_to_moved_nodes(FluidNodes<dim>                                    &nodes,
                                              const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                              const std::vector<Vec<dim>> &position, Walls<dim> &walls,
                                              double reference_density);
} // namespace Breakwater
