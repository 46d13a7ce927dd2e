#pragma once

#include "fluid_nodes.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// The pairs of nodes that share cells of a mesh, with what the volume operator D_ik = dV_i/dx_k and the mass
  /// exchange have at each: what would be passes over the cells, made once, becomes products with sparse matrices.
  template <int dim>
  class NodePairs
  {
  public:
    using Cell = typename SimplexMesh<dim>::Cell;

    /// @pre cells are positively oriented; for the mass exchange, nodes.has_cells is that of these cells
    NodePairs(const FluidNodes<dim> &nodes, const std::vector<Cell> &cells);

    /// Row sums that bound the eigenvalues of the nodal-pressure fluid, M u'' = -D^T W D u.
    ///
    /// By Gershgorin's theorem on W D M^-1 D^T (the same non-zero eigenvalues as M^-1 D^T W D),
    ///   omega_max^2 <= max_i W_i b_i,   b_i = sum_k |D_ik| s_k / m_k,   s_k = sum_j |D_jk|,
    /// with D_ik the sum of A_k / (dim + 1) over the cells of both, A_k = dV_c/dx_k. (The vectors cancel to a large
    /// part: inside, D_ii = 0. The sum of their lengths instead would be three times too large.)
    /// @param mass that moves with each node [kg]; infinite or zero entries take no part
    /// @return b_i [m^(2 dim - 2) / kg], 0 for nodes without cells
    std::vector<double> row_sums(const std::vector<double> &mass) const;

    /// Operator of the mass exchange: image_i = d_i psi_i - sum_k g_ik psi_k over the neighbours that take part, g_ik
    /// the sum of |V_c| / (2 (dim + 1) n_c) over the cells of both, n_c the number of the cell's corners that take
    /// part.
    /// @param diagonal d_i: conductance_sums() and more [m^dim]
    /// @return sum of psi_i image_i
    double exchange(const std::vector<double> &diagonal, const std::vector<double> &psi,
                    std::vector<double> &image) const;

    /// sum_k g_ik [m^dim]; zero for nodes that take no part.
    const std::vector<double> &conductance_sums() const { return conductance_sum_; }

  private:
    struct Corners;

    // Of each node k, the nodes i of its cells, itself among them, from start_[k] on.
    std::vector<unsigned int> start_, neighbor_;
    std::vector<double>       length_; ///< |D_ik| [m^(dim - 1)]

    // Of each node that takes part, its neighbours with lower numbers that do.
    std::vector<unsigned int> lower_start_, lower_neighbor_;
    std::vector<double>       conductance_, conductance_sum_; ///< [m^dim]
  };
} // namespace Breakwater
