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
  } // namespace


  template <int dim>
  std::vector<double> volume_operator_row_sums(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position,
                                               const std::vector<double> &mass)
  {
    const std::size_t         n = position.size();
    const CornersAtNodes<dim> corners_at(mesh.cells, n);
    std::vector<Simplex<dim>> area;
    area.reserve(mesh.cells.size());
    for (const auto &cell : mesh.cells)
      area.push_back(area_vectors(corners(position, cell)));

    // Row i of D: entries of its neighbors k, gathered from the cells around i.
    constexpr unsigned int    none = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> row_start(n + 1, 0), column, place(n, none);
    std::vector<double>       length, column_sums(n, 0.);
    column.reserve((dim == 2 ? 7 : 16) * n);
    length.reserve((dim == 2 ? 7 : 16) * n);
    std::vector<Vec<dim>> row;
    for (std::size_t i = 0; i < n; ++i)
      {
        row.clear();
        for (unsigned int k = corners_at.start[i]; k < corners_at.start[i + 1]; ++k)
          {
            const unsigned int c = corners_at.corner[k] / (dim + 1);
            for (int a = 0; a <= dim; ++a)
              {
                const unsigned int j = mesh.cells[c][a];
                if (place[j] == none)
                  {
                    place[j] = row.size();
                    row.push_back(area[c][a]);
                    column.push_back(j);
                  }
                else
                  row[place[j]] += area[c][a];
              }
          }
        row_start[i + 1] = column.size();
        for (unsigned int k = row_start[i]; k < row_start[i + 1]; ++k)
          {
            place[column[k]] = none;
            length.push_back(norm(row[k - row_start[i]]) / (dim + 1));
            column_sums[column[k]] += length.back();
          }
      }
    for (std::size_t i = 0; i < n; ++i)
      column_sums[i] = mass[i] > 0 ? column_sums[i] / mass[i] : 0.;

    std::vector<double> row_sums(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      for (unsigned int k = row_start[i]; k < row_start[i + 1]; ++k)
        row_sums[i] += length[k] * column_sums[column[k]];
    return row_sums;
  }

  template std::vector<double> volume_operator_row_sums<2>(const SimplexMesh<2> &, const std::vector<Vec<2>> &,
                                                           const std::vector<double> &);
  template std::vector<double> volume_operator_row_sums<3>(const SimplexMesh<3> &, const std::vector<Vec<3>> &,
                                                           const std::vector<double> &);
} // namespace Breakwater
