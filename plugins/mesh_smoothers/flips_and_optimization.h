#pragma once

#include <breakwater/interfaces/mesh_smoother.h>

namespace Breakwater
{
  /// Repairs the few bad cells of a Delaunay mesh: flips first, then moves of single nodes, last slender cells of the
  /// free surface are taken away. The fluid needs a valid mesh, not a Delaunay one.
  ///
  /// A first pass makes flips only. The following ones take the bad cells, the worst first: flip, else move the cell's
  /// nodes (NodeStep), else, where few cells are bad, the nodes of its hardly better neighbours, and at the end of the
  /// pass peel what is left (Peel). It ends when no cell is below the target, or nothing has changed. Nodes go at most
  /// 0.5 h from where they were, on the free surface 0.3 h.
  template <int dim>
  class FlipsAndOptimization : public MeshSmoother<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;

  protected:
    void improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task,
                 SmoothingReport &report) override;

  private:
    unsigned int n_passes_     = 30;
    double       largest_peel_ = 1e-3;
  };
} // namespace Breakwater
