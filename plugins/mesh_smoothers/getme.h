#pragma once

#include <breakwater/interfaces/mesh_smoother.h>

namespace Breakwater
{
  /// The sequential geometric element transformation method: takes the cell with the smallest insphere, moves its nodes
  /// along the normals of their opposite faces, which makes it more regular, and goes on with the next worst cell.
  ///
  /// After D. Vartziotis, J. Wipper, B. Schwald, The geometric element transformation method for tetrahedral mesh
  /// smoothing, Comput. Methods Appl. Mech. Engng 199 (2009) 169-182, with the insphere radius as the quality, as it
  /// bounds the time step. The cells stay as they are, only nodes move. No cell that a move touches gets worse than the
  /// cell that it is made for was: the smallest insphere never falls, and no cell is inverted.
  template <int dim>
  class Getme : public MeshSmoother<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;

  protected:
    void improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask &task,
                 SmoothingReport &report) override;

  private:
    double       step_             = 0.1;
    unsigned int n_trials_         = 10;
    unsigned int n_steps_per_cell_ = 20;
  };
} // namespace Breakwater
