#include <breakwater/base/run_context.h>
#include <breakwater/interfaces/mesh_smoother.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Breakwater
{
  namespace
  {
    template <int dim>
    double volume_of(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position)
    {
      double volume = 0;
      for (const auto &cell : mesh.cells)
        volume += signed_volume(corners(position, cell));
      return volume;
    }

    template <int dim>
    double smallest_radius(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position)
    {
      double smallest = 0;
      for (const auto &cell : mesh.cells)
        smallest = std::min(smallest, insphere_radius(corners(position, cell)));
      return smallest;
    }

    template <int dim>
    std::vector<char> nodes_with_cells(const SimplexMesh<dim> &mesh, const std::size_t n_nodes)
    {
      std::vector<char> result(n_nodes, 0);
      for (const auto &cell : mesh.cells)
        for (const unsigned int node : cell)
          result[node] = 1;
      return result;
    }

    template <class Facet>
    std::vector<Facet> sorted(std::vector<Facet> facets)
    {
      if constexpr (std::tuple_size<Facet>::value > 2)
        for (Facet &facet : facets)
          std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
      std::sort(facets.begin(), facets.end());
      return facets;
    }

    /// The facets of cells that no other cell has, the other way round, in rising order.
    template <int dim>
    std::vector<typename SimplexMesh<dim>::Facet> boundary_of(const SimplexMesh<dim> &mesh)
    {
      using Facet = typename SimplexMesh<dim>::Facet;
      std::vector<Facet> facets, opposite;
      for (const auto &cell : mesh.cells)
        for (int a = 0; a <= dim; ++a)
          {
            Facet facet = outward_facet<dim>(cell, a);
            facets.push_back(facet);
            std::swap(facet[0], facet[1]);
            opposite.push_back(facet);
          }
      facets   = sorted(facets);
      opposite = sorted(opposite);
      std::vector<Facet> result;
      std::set_difference(facets.begin(), facets.end(), opposite.begin(), opposite.end(), std::back_inserter(result));
      return result;
    }

    /// True if a node of a wall or of an edge has been moved off it, by more than round-off.
    template <int dim>
    bool has_left_walls(const SmoothingTask<dim> &task, const unsigned int node, const Vec<dim> &move)
    {
      const double largest = 1e-9 * task.spacing;
      switch (task.freedom[node])
        {
          case NodeFreedom::slides_on_wall:
          case NodeFreedom::slides_on_line:
            return std::abs(dot(move, task.wall_normal[node])) > largest;
          case NodeFreedom::slides_on_edge:
          case NodeFreedom::ends_on_edge:
            return norm(dim == 2 ? move : move - task.wall_normal[node] * dot(move, task.wall_normal[node])) > largest;
          default:
            return false;
        }
    }

    /// True if every facet of the first list whose nodes are all fixed is in the second; both are in rising order.
    template <class Facet>
    bool has_all_fixed(const std::vector<Facet> &a, const std::vector<Facet> &b,
                       const std::vector<NodeFreedom> &freedom)
    {
      std::vector<Facet> lost;
      std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(lost));
      return std::none_of(lost.begin(), lost.end(), [&](const Facet &facet) {
        return std::all_of(facet.begin(), facet.end(), [&](const unsigned int node) {
          return freedom[node] == NodeFreedom::fixed;
        });
      });
    }
  } // namespace


  template <int dim>
  SmoothingReport MeshSmoother<dim>::smooth(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position,
                                            const SmoothingTask<dim> &task)
  {
    const double                start  = cpu_time();
    const std::vector<Vec<dim>> before = position;
#ifdef DEBUG
    const SimplexMesh<dim> mesh_before = mesh;
#endif
    const double    volume = volume_of(mesh, position);
    SmoothingReport report;
    improve(mesh, position, task, report);
    measure_moves(before, position, report);
    report.volume_change = volume_of(mesh, position) - volume;
    report.seconds       = cpu_time() - start;
#ifdef DEBUG
    const std::string violation = smoothing_violation(mesh_before, before, mesh, position, task, report);
    if (!violation.empty())
      throw std::logic_error("A mesh smoother broke its promise: " + violation);
#endif
    return report;
  }


  template <int dim>
  void measure_moves(const std::vector<Vec<dim>> &before, const std::vector<Vec<dim>> &after, SmoothingReport &report)
  {
    report.n_moved_nodes = 0;
    report.largest_move  = 0;
    double sum           = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      {
        const double move = norm(after[i] - before[i]);
        report.n_moved_nodes += move > 0;
        sum += move;
        report.largest_move = std::max(report.largest_move, move);
      }
    report.mean_move = report.n_moved_nodes > 0 ? sum / report.n_moved_nodes : 0.;
  }


  template <int dim>
  std::string smoothing_violation(const SimplexMesh<dim> &mesh_before, const std::vector<Vec<dim>> &before,
                                  const SimplexMesh<dim> &mesh_after, const std::vector<Vec<dim>> &after,
                                  const SmoothingTask<dim> &task, const SmoothingReport &report)
  {
    for (std::size_t i = 0; i < before.size(); ++i)
      {
        const double move = norm(after[i] - before[i]);
        if (!std::isfinite(move))
          return "node " + std::to_string(i) + " is nowhere";
        if (task.freedom[i] == NodeFreedom::fixed && move > 0)
          return "fixed node " + std::to_string(i) + " has moved";
        if (has_left_walls(task, i, after[i] - before[i]))
          return "node " + std::to_string(i) + " has left its wall";
      }
    const std::vector<char> had_cells = nodes_with_cells(mesh_before, before.size()),
                            has_cells = nodes_with_cells(mesh_after, before.size());
    unsigned int n_freed              = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (!had_cells[i] && has_cells[i])
        return "node " + std::to_string(i) + ", which had no cells, has got some";
      else if (had_cells[i] && !has_cells[i])
        {
          ++n_freed;
          if (!is_on_surface(task.freedom[i]))
            return "node " + std::to_string(i) + ", not on the surface, has lost its cells";
        }
    if (n_freed != report.n_freed_nodes)
      return std::to_string(n_freed) + " nodes have lost their cells, reported are " +
             std::to_string(report.n_freed_nodes);
    if (smallest_radius(mesh_after, after) < smallest_radius(mesh_before, before))
      return "a cell is inverted";

    const auto old_boundary = sorted(mesh_before.boundary), boundary = sorted(mesh_after.boundary);
    if (boundary != boundary_of(mesh_after))
      return "the boundary is not that of the cells";
    if (report.n_peeled_cells == 0 && boundary != old_boundary)
      return "the boundary has changed";
    if (!has_all_fixed(old_boundary, boundary, task.freedom))
      return "a facet between fixed nodes has been opened";

    const double volume = volume_of(mesh_before, before), new_volume = volume_of(mesh_after, after);
    const double unexplained = new_volume + report.peeled_volume - report.lifted_volume - report.slid_volume - volume;
    if (!(std::abs(unexplained) <= 1e-12 * volume))
      return "the volume has changed from " + std::to_string(volume) + " by " + std::to_string(unexplained / volume) +
             " of it";
    return "";
  }


  template class MeshSmoother<2>;
  template class MeshSmoother<3>;
  template void        measure_moves<2>(const std::vector<Vec<2>> &, const std::vector<Vec<2>> &, SmoothingReport &);
  template void        measure_moves<3>(const std::vector<Vec<3>> &, const std::vector<Vec<3>> &, SmoothingReport &);
  template std::string smoothing_violation<2>(const SimplexMesh<2> &, const std::vector<Vec<2>> &,
                                              const SimplexMesh<2> &, const std::vector<Vec<2>> &,
                                              const SmoothingTask<2> &, const SmoothingReport &);
  template std::string smoothing_violation<3>(const SimplexMesh<3> &, const std::vector<Vec<3>> &,
                                              const SimplexMesh<3> &, const std::vector<Vec<3>> &,
                                              const SmoothingTask<3> &, const SmoothingReport &);
} // namespace Breakwater
