#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// What a smoother did.
  struct SmoothingReport
  {
    unsigned int n_moved_nodes = 0;
    unsigned int n_iterations  = 0;
    double       mean_move     = 0; ///< of the moved nodes [m]
    double       largest_move  = 0; ///< [m]
  };

  /// Improves a simplex mesh by moving nodes or changing cells.
  template <int dim>
  class MeshSmoother : public Plugin
  {
  public:
    static constexpr const char *interface_name = "mesh smoother";
    static constexpr int         dimension      = dim;

    /// Improves the mesh in place.
    /// @param mesh valid on entry and exit: no inverted cell
    /// @param position of the nodes [m]
    /// @param is_fixed nodes that must not move: walls, interface, free surface
    /// @param spacing the wanted distance of nodes, h [m]
    virtual SmoothingReport smooth(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position,
                                   const std::vector<char> &is_fixed, double spacing) = 0;
  };
} // namespace Breakwater
