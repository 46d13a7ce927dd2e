#pragma once

#include "node_pairs.h"

#include <breakwater/mesh/simplex_mesh.h>

namespace Breakwater
{
  /// How far and how exactly the mass exchange goes.
  struct ExchangeControl
  {
    unsigned int n_iterations = 40;    ///< of conjugate gradients at most; 0: no exchange
    double       reach        = 8.;    ///< T, see exchange_mass() [-]
    double       far_reach    = 1000.; ///< T of calm flow [-]
    double       tolerance    = 1e-4;  ///< rms of what may be left, relative to the rms mass [-]
  };

  /// What an exchange did.
  struct ExchangeReport
  {
    unsigned int n_iterations = 0; ///< of conjugate gradients
    double       far_part     = 1; ///< of the difference between far and near that was carried out [-]
  };

  /// Exchanges mass, with its momentum, between neighbours on a new mesh so that m = rho V, but for what is smooth over
  /// some sqrt(T) nodes. The fluxes between the corners of a cell, |V_c| / (2 (dim + 1)) (psi_a - mean psi), come from
  ///   (L + V / T) psi = m - rho V,
  /// L the sum of these fluxes: an implicit step of T units of a diffusion in which one unit reaches about one node.
  /// Each flux is carried out once, with the mean velocity of donor and receiver, and a little more of the donor's: as
  /// much as makes sure that the kinetic energy can only fall. Mass and momentum are exact. A donor gives at most half
  /// of what it has above 5 % of the mass of a regular node. Driven nodes take no part.
  ///
  /// How far should it go? In calm flow, what remains of m - rho V acts as a false buoyancy and stirs the fluid: far.
  /// In splashes it is mass that surfaces have packed into the fluid, and carrying that far away would let the water
  /// fall: near, and the position correction makes room for it. So psi is that of the near reach and as much of the
  /// difference to the far one as changes the potential energy by `allowed_work` at most.
  /// @param pairs of the nodes and cells
  /// @param potential of the nodes [J/kg]
  /// @param allowed_work [J]
  template <int dim>
  ExchangeReport exchange_mass(FluidNodes<dim> &nodes, const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                               const NodePairs<dim> &pairs, const std::vector<double> &potential, double allowed_work,
                               double reference_density, double spacing, const ExchangeControl &control);
} // namespace Breakwater
