#pragma once

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// Row sums that bound the eigenvalues of the nodal-pressure fluid, M u'' = -D^T W D u with D_ik = dV_i/dx_k.
  ///
  /// By Gershgorin's theorem on W D M^-1 D^T (the same non-zero eigenvalues as M^-1 D^T W D),
  ///   omega_max^2 <= max_i W_i b_i,   b_i = sum_k |D_ik| s_k / m_k,   s_k = sum_j |D_jk|,
  /// with D_ik the sum of A_k / (dim + 1) over the cells of both, A_k = dV_c/dx_k. (The vectors cancel to a large part:
  /// inside, D_ii = 0. The sum of their lengths instead would be three times too large.)
  /// @param position of the nodes [m]
  /// @param mass that moves with each node [kg]; infinite or zero entries take no part
  /// @return b_i [m^(2 dim - 2) / kg], 0 for nodes without cells
  template <int dim>
  std::vector<double> volume_operator_row_sums(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position,
                                               const std::vector<double> &mass);
} // namespace Breakwater
