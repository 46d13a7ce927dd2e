#include "getme.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/mesh/quality.h>

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

    /// The cells at each node, in compressed rows.
    struct CellsOfNodes
    {
      std::vector<std::size_t>  begin;
      std::vector<unsigned int> cells;

      template <class Cells>
      CellsOfNodes(const Cells &all_cells, const std::size_t n_nodes)
        : begin(n_nodes + 1, 0)
      {
        for (const auto &cell : all_cells)
          for (const unsigned int node : cell)
            ++begin[node + 1];
        for (std::size_t i = 0; i < n_nodes; ++i)
          begin[i + 1] += begin[i];
        cells.resize(begin.back());
        std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
        for (unsigned int c = 0; c < all_cells.size(); ++c)
          for (const unsigned int node : all_cells[c])
            cells[next[node]++] = c;
      }
    };

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

    /// The mesh while it is smoothed, with the insphere radius of each cell.
    template <int dim>
    class Work
    {
    public:
      using Cell = typename SimplexMesh<dim>::Cell;

      Work(const std::vector<Cell> &cells, std::vector<Vec<dim>> &position, const std::vector<char> &is_fixed)
        : cells_(cells)
        , position_(position)
        , is_fixed_(is_fixed)
        , cells_of_nodes_(cells, position.size())
        , radius_(cells.size())
      {
        for (std::size_t c = 0; c < cells.size(); ++c)
          radius_[c] = insphere_radius(corners(c));
      }

      const std::vector<double>       &radius() const { return radius_; }
      const std::vector<unsigned int> &patch() const { return patch_; }

      /// Moves the free nodes of a cell by the transformation, with the longest of the steps s, 0.75 s, ... that every
      /// cell of its patch stands. @return false if there is none: nothing has changed then
      bool improve(const unsigned int cell, double step, const unsigned int n_trials)
      {
        collect_patch(cell);
        const Simplex<dim> before = corners(cell);
        for (unsigned int trial = 0; trial < n_trials; ++trial, step *= shortening)
          {
            place(cell, transform(before, step));
            if (is_acceptable(cell))
              {
                for (std::size_t i = 0; i < patch_.size(); ++i)
                  radius_[patch_[i]] = new_radius_[i];
                return true;
              }
          }
        place(cell, before);
        return false;
      }

    private:
      Simplex<dim> corners(const std::size_t cell) const
      {
        Simplex<dim> x;
        for (int a = 0; a <= dim; ++a)
          x[a] = position_[cells_[cell][a]];
        return x;
      }

      void place(const unsigned int cell, const Simplex<dim> &x)
      {
        for (int a = 0; a <= dim; ++a)
          if (!is_fixed_[cells_[cell][a]])
            position_[cells_[cell][a]] = x[a];
      }

      void collect_patch(const unsigned int cell)
      {
        patch_.clear();
        for (const unsigned int node : cells_[cell])
          if (!is_fixed_[node])
            patch_.insert(patch_.end(), cells_of_nodes_.cells.begin() + cells_of_nodes_.begin[node],
                          cells_of_nodes_.cells.begin() + cells_of_nodes_.begin[node + 1]);
        std::sort(patch_.begin(), patch_.end());
        patch_.erase(std::unique(patch_.begin(), patch_.end()), patch_.end());
      }

      // A cell that was worse already (its own moves failed) must not get worse, all others stay above the old radius.
      bool is_acceptable(const unsigned int cell)
      {
        new_radius_.resize(patch_.size());
        const double old_radius = radius_[cell];
        for (std::size_t i = 0; i < patch_.size(); ++i)
          {
            const unsigned int other = patch_[i];
            new_radius_[i]           = insphere_radius(corners(other));
            const double least =
              other == cell ? least_gain * old_radius : std::min(radius_[other], least_gain * old_radius);
            if (!(new_radius_[i] >= least))
              return false;
          }
        return !patch_.empty();
      }

      const std::vector<Cell> &cells_;
      std::vector<Vec<dim>>   &position_;
      const std::vector<char> &is_fixed_;
      const CellsOfNodes       cells_of_nodes_;
      std::vector<double>      radius_; ///< [m]

      std::vector<unsigned int> patch_;      ///< cells at the free nodes of the present cell
      std::vector<double>       new_radius_; ///< of the patch [m]
    };
  } // namespace


  template <int dim>
  void Getme<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Step", step_, "Length of the first step tried, in the lengths of the transformation [-]", {0.001, 10.});
    reader.add("Trials", n_trials_, "Steps tried for a move, each 0.75 of the one before", 1, 100);
    reader.add("Moves per cell", n_steps_per_cell_, "Largest number of moves, over the number of bad cells", 1, 10000);
  }


  template <int dim>
  void Getme<dim>::improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask &task,
                           SmoothingReport &)
  {
    const double      threshold = task.target * reference_insphere_radius<dim>(task.spacing);
    std::vector<char> is_fixed(position.size());
    for (std::size_t i = 0; i < position.size(); ++i)
      is_fixed[i] = task.freedom[i] != NodeFreedom::free;
    Work<dim> work(mesh.cells, position, is_fixed);

    // worst first, then by number; an entry that is out of date, as its cell has changed since, is passed over
    using Candidate = std::pair<double, unsigned int>;
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<Candidate>> queue;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (work.radius()[c] < threshold)
        queue.emplace(work.radius()[c], c);
    const std::size_t n_most = queue.size() * n_steps_per_cell_;

    for (std::size_t n_steps = 0; !queue.empty() && n_steps < n_most;)
      {
        const auto [radius, cell] = queue.top();
        queue.pop();
        if (radius != work.radius()[cell])
          continue;
        ++n_steps;
        if (work.improve(cell, step_, n_trials_))
          for (const unsigned int other : work.patch())
            if (work.radius()[other] < threshold)
              queue.emplace(work.radius()[other], other);
      }
  }


  template class Getme<2>;
  template class Getme<3>;
} // namespace Breakwater
