#pragma once

#include <breakwater/interfaces/mesh_smoother.h>
#include <breakwater/mesh/quality_report.h>
#include <pfem_fluid/alpha_shape.h>

#include <algorithm>
#include <random>
#include <vector>

namespace Breakwater
{
  /// A mesh with what may move. The spacing of its nodes is 1.
  template <int dim>
  struct TestMesh
  {
    SimplexMesh<dim>         mesh;
    std::vector<Vec<dim>>    position;
    std::vector<NodeFreedom> freedom;
    std::vector<Vec<dim>>    wall_normal;

    SmoothingTask<dim> task(const double target) const { return {freedom, wall_normal, 1., target}; }
    double             smallest_r() const { return mesh_quality(mesh, position, 1.).smallest; }
  };

  /// Triangulates a cloud and lets its boundary slide: on a floor at height 0, else as a free surface.
  template <int dim>
  TestMesh<dim> mesh_of_cloud(const std::vector<Vec<dim>> &position)
  {
    TestMesh<dim> result;
    result.position = position;
    DelaunayMesh<dim> triangulation;
    triangulation.rebuild(position);
    const auto is_on_floor = [&](const unsigned int i) {
      return position[i][dim - 1] == 0;
    };
    result.mesh = alpha_shape<dim>(triangulation, 1.3, [&](const typename SimplexMesh<dim>::Cell &cell) {
      return !std::all_of(cell.begin(), cell.end(), is_on_floor);
    });
    result.freedom.assign(position.size(), NodeFreedom::free);
    Vec<dim> down;
    down[dim - 1] = -1;
    result.wall_normal.assign(position.size(), down);
    for (std::size_t i = 0; i < position.size(); ++i)
      if (is_on_floor(i))
        result.freedom[i] = NodeFreedom::slides_on_wall;
    for (const auto &facet : result.mesh.boundary)
      if (!std::all_of(facet.begin(), facet.end(), is_on_floor))
        for (const unsigned int i : facet)
          result.freedom[i] = is_on_floor(i) ? NodeFreedom::slides_on_line : NodeFreedom::slides_on_surface;
    return result;
  }

  /// Random numbers that are the same everywhere, between 0 and 1.
  class Random
  {
  public:
    explicit Random(const unsigned int seed)
      : engine_(seed)
    {
    }
    double operator()() { return engine_() / (1. + std::mt19937::max()); }

  private:
    std::mt19937 engine_;
  };

  /// Nodes at random on a lattice of n^dim cubes, each thrown about by up to `jitter`.
  template <int dim>
  std::vector<Vec<dim>> jittered_lattice(const unsigned int n, const double jitter, Random &random)
  {
    std::vector<Vec<dim>> result;
    for (unsigned int k = 0, n_all = dim == 2 ? n * n : n * n * n; k < n_all; ++k)
      {
        Vec<dim>     x;
        unsigned int rest = k;
        for (int d = 0; d < dim; ++d, rest /= n)
          x[d] = rest % n + ((d == dim - 1 && rest % n == 0) ? 0. : jitter * (2 * random() - 1));
        result.push_back(x);
      }
    return result;
  }
} // namespace Breakwater
