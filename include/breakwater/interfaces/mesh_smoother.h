#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/mesh/simplex_mesh.h>

#include <functional>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Where a smoother may put a node. What slides does so orthogonally to the node's area vector dV/dx, which keeps the
  /// volume.
  enum class NodeFreedom : char
  {
    fixed,             ///< stays: corners of walls, bent walls, interface, inflow
    ends_on_edge,      ///< where the edge of two flat walls meets the free surface: stays, to keep the volume
    slides_on_edge,    ///< on the edge of two flat walls
    slides_on_line,    ///< on the line where a flat wall meets the free surface: along the wall, too
    slides_on_wall,    ///< on one flat wall
    slides_on_surface, ///< on the free surface
    free               ///< anywhere, as long as no cell is inverted: inside
  };

  constexpr bool slides(const NodeFreedom freedom)
  {
    return freedom != NodeFreedom::fixed && freedom != NodeFreedom::ends_on_edge && freedom != NodeFreedom::free;
  }

  /// True on the free surface: if the volume may change, the node can move anywhere, or along its walls.
  constexpr bool is_on_surface(const NodeFreedom freedom)
  {
    return freedom == NodeFreedom::ends_on_edge || freedom == NodeFreedom::slides_on_line ||
           freedom == NodeFreedom::slides_on_surface;
  }

  /// What a smoother is asked for.
  template <int dim>
  struct SmoothingTask
  {
    const std::vector<NodeFreedom> &freedom; ///< of the nodes

    /// At nodes that slide on a wall or a line, the wall's normal; at nodes that slide or end on an edge, its direction
    /// (3D). Unit length.
    const std::vector<Vec<dim>> &wall_normal;

    double spacing;      ///< the wanted distance of nodes, h [m]
    double target = 0.6; ///< wanted smallest insphere radius, in units of the regular cell's

    /// Whether no wall is in the way of a node of the boundary to a place; empty: none ever is.
    std::function<bool(unsigned int node, const Vec<dim> &x)> is_reachable = {};
  };

  /// What a smoother did.
  struct SmoothingReport
  {
    unsigned int n_moved_nodes  = 0;
    unsigned int n_flips        = 0; ///< of edges
    unsigned int n_peeled_cells = 0; ///< taken off the surface
    unsigned int n_freed_nodes  = 0; ///< that have lost their cells so
    unsigned int n_lifts        = 0; ///< moves of nodes of the surface that have changed the volume
    double       mean_move      = 0; ///< of the moved nodes [m]
    double       largest_move   = 0; ///< [m]
    double       peeled_volume  = 0; ///< of the peeled cells [m^dim]
    double       lifted_volume  = 0; ///< what those moves have added [m^dim]
    double       slid_volume = 0; ///< what nodes have added that slide on walls, as the walls' other nodes lie a little
                                  ///< off them [m^dim]
    double volume_change = 0;     ///< of the mesh [m^dim]
    double seconds       = 0;     ///< CPU time

    /// Adds what a further smoother did, but for the moves, which do not add up: see measure_moves().
    void add(const SmoothingReport &other)
    {
      n_flips += other.n_flips;
      n_peeled_cells += other.n_peeled_cells;
      n_freed_nodes += other.n_freed_nodes;
      n_lifts += other.n_lifts;
      peeled_volume += other.peeled_volume;
      lifted_volume += other.lifted_volume;
      slid_volume += other.slid_volume;
      volume_change += other.volume_change;
      seconds += other.seconds;
    }
  };

  /// Improves a simplex mesh by moving nodes or changing cells.
  template <int dim>
  class MeshSmoother : public Plugin
  {
  public:
    static constexpr const char *interface_name = "mesh smoother";
    static constexpr int         dimension      = dim;

    /// Improves the mesh in place and tells what it did. In a debug build the result is checked, see
    /// smoothing_violation().
    /// @param mesh no cell is inverted; the order of cells and boundary facets may change
    /// @param position of the nodes [m]
    SmoothingReport smooth(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task);

  protected:
    /// What smooth() does to the mesh. Flips and peeled cells are to be counted in the report; the rest is measured.
    /// @post no violation, see smoothing_violation()
    virtual void improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task,
                         SmoothingReport &report) = 0;
  };

  /// Number and lengths of the nodes' moves, for the report.
  template <int dim>
  void measure_moves(const std::vector<Vec<dim>> &before, const std::vector<Vec<dim>> &after, SmoothingReport &report);

  /// Checks what every smoother owes: no cell is inverted (the smallest signed insphere radius is not negative, or at
  /// least what it was), fixed nodes stay, those of walls and edges stay on them,
  /// every node keeps a cell unless it slides on the surface and is counted, none gets cells that had none,
  /// `boundary` is that of the cells and the same as before except for peeled cells, facets between fixed
  /// nodes (an interface) stay even so, and the volume is kept to round-off but for what the report says of it.
  /// @return the first violation in words, empty if there is none
  template <int dim>
  std::string smoothing_violation(const SimplexMesh<dim> &mesh_before, const std::vector<Vec<dim>> &before,
                                  const SimplexMesh<dim> &mesh_after, const std::vector<Vec<dim>> &after,
                                  const SmoothingTask<dim> &task, const SmoothingReport &report);
} // namespace Breakwater
