#pragma once

#include "star_mesh.h"

namespace Breakwater
{
  /// Entries of GETMe.
  struct GetmeControl
  {
    double       step             = 0.1;
    unsigned int n_trials         = 10;
    unsigned int n_moves_per_cell = 20;

    void declare(ParameterReader &reader);
  };

  /// The sequential geometric element transformation method: takes the cell with the smallest insphere, moves its nodes
  /// along the normals of their opposite faces, which makes it more regular, and goes on with the next worst cell.
  ///
  /// After D. Vartziotis, J. Wipper, B. Schwald, The geometric element transformation method for tetrahedral mesh
  /// smoothing, Comput. Methods Appl. Mech. Engng 199 (2009) 169-182, with the insphere radius as the quality, as it
  /// bounds the time step, and each node's move accepted on its own: with the longest of the steps s, 0.75 s, ... that
  /// no cell around stands below what it was or what the worst cell is to become. The cells stay as they are, only nodes
  /// move; those on the boundary slide. The smallest insphere never falls, and no cell is inverted.
  template <int dim>
  void smooth_by_transformations(StarMesh<dim> &mesh, const GetmeControl &control);

  /// The method as a smoother of its own.
  template <int dim>
  class Getme : public MeshSmoother<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override { control_.declare(reader); }

  protected:
    void improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task,
                 SmoothingReport &report) override
    {
      StarMesh<dim> work(mesh, position, task);
      smooth_by_transformations(work, control_);
      work.finish(report);
    }

  private:
    GetmeControl control_;
  };
} // namespace Breakwater
