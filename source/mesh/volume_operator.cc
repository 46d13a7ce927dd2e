#include <breakwater/mesh/quality.h>
#include <breakwater/mesh/volume_operator.h>

#include <limits>

namespace Breakwater
{
  namespace
  {
    /// The corners of cells at each node: corner a of cell c as c (dim + 1) + a, those of node i from start[i] on.
    template <int dim>
    struct CornersAtNodes
    {
      std::vector<unsigned int> start, corner;

      CornersAtNodes(const std::vector<typename SimplexMesh<dim>::Cell> &cells, const std::size_t n_nodes)
        : start(n_nodes + 1, 0)
        , corner(cells.size() * (dim + 1))
      {
        for (const auto &cell : cells)
          for (const unsigned int i : cell)
            ++start[i + 1];
        for (std::size_t i = 0; i < n_nodes; ++i)
          start[i + 1] += start[i];
        std::vector<unsigned int> next(start.begin(), start.end() - 1);
        for (unsigned int c = 0; c < cells.size(); ++c)
          for (unsigned int a = 0; a <= dim; ++a)
            corner[next[cells[c][a]]++] = c * (dim + 1) + a;
      }
    };

    /// One of the area_vectors() of a cell.
    template <int dim>
    Vec<dim> area_vector(const std::vector<Vec<dim>> &position, const typename SimplexMesh<dim>::Cell &cell,
                         const int corner)
    {
      const auto     facet = outward_facet<dim>(cell, corner);
      const Vec<dim> e     = position[facet[1]] - position[facet[0]];
      if constexpr (dim == 2)
        return {{-0.5 * e[1], 0.5 * e[0]}};
      else
        return cross(position[facet[2]] - position[facet[0]], e) * (1. / 6.);
    }
  } // namespace


  template <int dim>
  std::vector<double> volume_operator_row_sums(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position,
                                               const std::vector<double> &mass)
  {
    const std::size_t         n = position.size();
    const CornersAtNodes<dim> corners_at(mesh.cells, n);

    // Column k of D: entries of its neighbours i, each the sum of A_k over the cells of both.
    std::vector<unsigned int> neighbors, column_of(n, std::numeric_limits<unsigned int>::max());
    std::vector<Vec<dim>>     entry(n);
    std::vector<double>       row_sums(n, 0.), length;
    for (unsigned int k = 0; k < n; ++k)
      {
        if (!(mass[k] > 0))
          continue;
        neighbors.clear();
        for (unsigned int begin = corners_at.start[k]; begin < corners_at.start[k + 1]; ++begin)
          {
            const auto    &cell = mesh.cells[corners_at.corner[begin] / (dim + 1)];
            const Vec<dim> area = area_vector<dim>(position, cell, corners_at.corner[begin] % (dim + 1));
            for (const unsigned int i : cell)
              if (column_of[i] == k)
                entry[i] += area;
              else
                {
                  column_of[i] = k;
                  entry[i]     = area;
                  neighbors.push_back(i);
                }
          }
        double column_sum = 0;
        length.clear();
        for (const unsigned int i : neighbors)
          {
            length.push_back(norm(entry[i]) / (dim + 1));
            column_sum += length.back();
          }
        for (std::size_t j = 0; j < neighbors.size(); ++j)
          row_sums[neighbors[j]] += length[j] * column_sum / mass[k];
      }
    return row_sums;
  }

  template std::vector<double> volume_operator_row_sums<2>(const SimplexMesh<2> &, const std::vector<Vec<2>> &,
                                                           const std::vector<double> &);
  template std::vector<double> volume_operator_row_sums<3>(const SimplexMesh<3> &, const std::vector<Vec<3>> &,
                                                           const std::vector<double> &);
} // namespace Breakwater
