#include "getme.h"

#include "star_mesh.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace Breakwater
{
  namespace
  {
    /// A shorter step is tried by this factor.
    constexpr double shortening = 0.75;

    /// A move must make the worst cell's insphere larger by this factor: less is not worth its steps.
    constexpr double least_gain = 1.01;

    template <int dim>
    double mean_edge(const Simplex<dim> &x)
    {
      double sum = 0;
      for (int a = 0; a <= dim; ++a)
        for (int b = 0; b < a; ++b)
          sum += norm(x[a] - x[b]);
      return sum / (dim * (dim + 1) / 2);
    }

    // x_k' = x_k + s n_k / |n_k|^((dim - 2) / (dim - 1)) with n_k the normal of the opposite face towards the node, as
    // long as the edge (2D) or twice the area (3D); then scaled about the centroid, which stays, to the mean edge
    // that was: a sliver has no volume to keep.
    template <int dim>
    Simplex<dim> transform(const Simplex<dim> &x, const double step)
    {
      Simplex<dim> result = area_vectors(x);
      Vec<dim>     centroid;
      for (int a = 0; a <= dim; ++a)
        {
          result[a] *= dim == 2 ? 2 : 6;
          const double length = norm(result[a]);
          if (dim == 3 && length > 0)
            result[a] *= 1 / std::sqrt(length);
          result[a] = x[a] + step * result[a];
          centroid += result[a] * (1. / (dim + 1));
        }
      const double scale = mean_edge(x) / mean_edge(result);
      for (Vec<dim> &corner : result)
        corner = centroid + scale * (corner - centroid);
      return result;
    }

    /// Moves the corners of a cell, and collects those that have moved. @return whether that made it better
    template <int dim>
    bool move_corners(StarMesh<dim> &mesh, const unsigned int c, const GetmeControl &control,
                      std::vector<unsigned int> &moved)
    {
      const double       before = mesh.r(c);
      const Simplex<dim> from = mesh.corners_of(c), to = transform(from, control.step);
      const auto         cell = mesh.cell(c);
      moved.clear();
      for (int a = 0; a <= dim; ++a)
        {
          Vec<dim> displacement = to[a] - from[a];
          for (unsigned int trial = 0; trial < control.n_trials; ++trial, displacement *= shortening)
            if (mesh.try_move(cell[a], displacement, least_gain * before))
              {
                moved.push_back(cell[a]);
                break;
              }
        }
      return mesh.r(c) >= least_gain * before;
    }
  } // namespace


  void GetmeControl::declare(ParameterReader &reader)
  {
    reader.add("Step", step, "Length of the first step tried, in the lengths of the transformation [-]", {0.001, 10.});
    reader.add("Trials", n_trials, "Steps tried for a move, each 0.75 of the one before", 1, 100);
    reader.add("Moves per cell", n_moves_per_cell, "Largest number of moves, over the number of bad cells", 1, 10000);
  }


  template <int dim>
  void smooth_by_transformations(StarMesh<dim> &mesh, const GetmeControl &control)
  {
    // Worst first, then by number. An entry that is out of date, as its cell has changed since, is passed over; a cell
    // that could not be improved waits until something around it has changed.
    using Candidate = std::pair<double, unsigned int>;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<Candidate>> queue;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.r(c) < mesh.target())
        queue.emplace(mesh.r(c), c);
    const std::size_t         n_most = queue.size() * control.n_moves_per_cell;
    std::vector<char>         is_waiting(mesh.n_cells(), 0);
    std::vector<unsigned int> moved;
    std::size_t               n_moves = 0;
    while (!queue.empty() && n_moves < n_most)
      {
        const auto [r, c] = queue.top();
        queue.pop();
        if (r != mesh.r(c) || is_waiting[c])
          continue;
        ++n_moves;
        is_waiting[c] = !move_corners(mesh, c, control, moved);
        for (const unsigned int node : moved)
          for (const unsigned int other : mesh.star(node))
            if (mesh.r(other) < mesh.target() && !(other == c && is_waiting[c]))
              {
                is_waiting[other] = 0;
                queue.emplace(mesh.r(other), other);
              }
      }
  }


  template void smooth_by_transformations<2>(StarMesh<2> &, const GetmeControl &);
  template void smooth_by_transformations<3>(StarMesh<3> &, const GetmeControl &);
} // namespace Breakwater
