#include <breakwater/mesh/quality.h>
#include <breakwater/mesh/volume_operator.h>

namespace Breakwater
{
  template <int dim>
  std::vector<double> volume_operator_row_sums(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position,
                                               const std::vector<double> &mass)
  {
    std::vector<std::array<double, dim + 1>> lengths(mesh.cells.size());
    std::vector<double>                      column_sums(position.size(), 0.);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const Simplex<dim> area = area_vectors(corners(position, mesh.cells[c]));
        for (int a = 0; a <= dim; ++a)
          {
            lengths[c][a] = norm(area[a]);
            column_sums[mesh.cells[c][a]] += lengths[c][a];
          }
      }
    for (std::size_t i = 0; i < column_sums.size(); ++i)
      column_sums[i] = mass[i] > 0 ? column_sums[i] / mass[i] : 0.;

    std::vector<double> row_sums(position.size(), 0.);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        double sum = 0;
        for (int a = 0; a <= dim; ++a)
          sum += lengths[c][a] * column_sums[mesh.cells[c][a]];
        sum /= dim + 1;
        for (int a = 0; a <= dim; ++a)
          row_sums[mesh.cells[c][a]] += sum;
      }
    return row_sums;
  }

  template std::vector<double> volume_operator_row_sums<2>(const SimplexMesh<2> &, const std::vector<Vec<2>> &,
                                                           const std::vector<double> &);
  template std::vector<double> volume_operator_row_sums<3>(const SimplexMesh<3> &, const std::vector<Vec<3>> &,
                                                           const std::vector<double> &);
} // namespace Breakwater
