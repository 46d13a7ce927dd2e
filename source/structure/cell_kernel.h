#pragma once

#include "solid_mesh.h"

#include <breakwater/interfaces/material.h>

#include <memory>

namespace Breakwater
{
  /// The largest eigenvalues of the cells with what is needed to follow them, in the layout of a CellKernel.
  struct CellEigenvalues
  {
    std::vector<double> eigenvalue; ///< [1/s^2]
    std::vector<double> direction;  ///< an eigenvector for each cell
    std::vector<double> metric;     ///< a measure of the strain when each cell was last looked at [-]
  };

  /// Forces, energies and stresses of the cells of a total-Lagrangian solid, by Gauss quadrature with sum factorisation.
  ///
  /// Cells are worked on in batches, a lane of the arithmetic for each. Displacements and forces are per node of the
  /// mesh [m], [N]. The kernel keeps no state of the motion.
  template <int dim>
  class CellKernel
  {
  public:
    /// The worst cell of a force evaluation.
    struct Deformation
    {
      double       smallest_volume_ratio; ///< deformed volume of the cell over its undeformed one
      unsigned int cell;
    };

    virtual ~CellKernel() = default;

    /// Adds the internal forces f_i = - integral of P grad N_i dV.
    virtual Deformation add_internal_force(const std::vector<Vec<dim>> &displacement,
                                           std::vector<Vec<dim>>       &force) const = 0;

    /// Integral of the strain energy [J].
    virtual double strain_energy(const std::vector<Vec<dim>> &displacement) const = 0;

    /// Equivalent Cauchy stress [Pa] at the nodes by von Mises, the mean over the cells of a node, each with the value
    /// of its Gauss point nearest to the node. In 2D from the stresses in the plane alone.
    virtual std::vector<double> von_mises_stress(const std::vector<Vec<dim>> &displacement) const = 0;

    /// The eigenvalues of a state that has none yet.
    virtual CellEigenvalues start_eigenvalues() const = 0;

    /// Bound on the largest eigenvalue [1/s^2] of M^-1 K, K the tangent stiffness at this displacement.
    ///
    /// The largest eigenvalue of the assembled pencil is not above the largest one of any single, free cell with its
    /// own share of the lumped mass (Irons and Treharne, 1971). Those are found by a few Lanczos steps for each cell,
    /// on the tangent by central differences of the force, but only for cells whose strain has changed by more than the
    /// tolerance since they were last looked at.
    virtual double bound_eigenvalue(const std::vector<Vec<dim>> &displacement, CellEigenvalues &eigenvalues,
                                    double tolerance) const = 0;

    /// Lumped masses of the nodes [kg], by Gauss-Lobatto quadrature.
    virtual std::vector<double> lumped_mass() const = 0;
  };

  /// The mesh is copied, the material borrowed.
  template <int dim>
  std::unique_ptr<CellKernel<dim>> make_cell_kernel(const SolidMesh<dim> &mesh, const Material<dim> &material);
} // namespace Breakwater
