#pragma once

#include "star_mesh.h"

namespace Breakwater
{
  /// Entries of the elastic analogy.
  struct ElasticControl
  {
    unsigned int n_rounds     = 4;
    unsigned int n_iterations = 40;
    double       tolerance    = 1e-3;

    void declare(ParameterReader &reader);
  };

  /// The elastic analogy: bad cells blow themselves up in an elastic solid, and push their neighbours aside.
  ///
  /// After section 5 of S. Meduri, M. Cremonesi and U. Perego, An explicit Lagrangian approach for 3D simulation of
  /// fluid-structure-interaction problems, and their An efficient runtime mesh smoothing technique for 3D explicit
  /// Lagrangian free-surface fluid flow simulations, Int. J. Numer. Meth. Engng 117 (2019). The solid is made of the
  /// cells with r below the target and all that share a node with them. Cells resist by their deviatoric stiffness
  /// (G = 1), each bad one has the pressure p_c = h / (sqrt(24) r_in), which is 1 in a regular cell:
  ///   K u = D^T p,   (K u)_a = sum_c s_c A_a,   s_c = 2 G dev sym(sum_b u_b (x) A_b / V_c),   D^T p = sum_c p_c A_a,
  /// A_a = dV_c/dx_a. Only nodes of bad cells move, on the boundary orthogonally to their area vector. The equilibrium
  /// is found by adaptive dynamic relaxation (P. Underwood, Dynamic relaxation, in: Computational Methods for Transient
  /// Analysis, 1983): central differences with a step of 1, masses that make it stable, M_a = 1/4 sum_b |K_ab|, and the
  /// damping of the lowest mode that moves, c = 2 sqrt(u K u / u M u).
  ///
  /// Each node then takes all, a half or a quarter of its displacement, whichever leaves no cell around it below what it
  /// was or the smallest r of its star, the worst first; several rounds, each with the solid of the cells that are bad
  /// then. (In one go, a few displacements would turn cells over.)
  template <int dim>
  void relax_elastically(StarMesh<dim> &mesh, const ElasticControl &control);

  /// The analogy as a smoother of its own.
  template <int dim>
  class ElasticAnalogy : public MeshSmoother<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override { control_.declare(reader); }

  protected:
    void improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task,
                 SmoothingReport &report) override
    {
      StarMesh<dim> work(mesh, position, task);
      relax_elastically(work, control_);
      work.finish(report);
    }

  private:
    ElasticControl control_;
  };
} // namespace Breakwater
