#include <breakwater/mesh/quality.h>
#include <breakwater/mesh/quality_report.h>

#include <algorithm>

namespace Breakwater
{
  template <int dim>
  QualityReport mesh_quality(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position, const double spacing)
  {
    QualityReport       report;
    std::vector<double> radii;
    radii.reserve(mesh.cells.size());
    for (const auto &cell : mesh.cells)
      radii.push_back(insphere_radius(corners(position, cell)));
    if (radii.empty())
      return report;
    const double unit = 1. / reference_insphere_radius<dim>(spacing);
    auto         end  = radii.end();
    // The smaller fraction is among those below the larger one.
    const auto quantile = [&](const double fraction) {
      const auto place = radii.begin() + static_cast<std::size_t>(fraction * (radii.size() - 1));
      if (place < end)
        std::nth_element(radii.begin(), place, end);
      end = place + 1;
      return *place * unit;
    };
    report.median          = quantile(0.5);
    report.hundredth       = quantile(0.01);
    report.thousandth      = quantile(0.001);
    report.smallest        = quantile(0.);
    report.smallest_radius = radii.front();
    return report;
  }

  template QualityReport mesh_quality<2>(const SimplexMesh<2> &, const std::vector<Vec<2>> &, double);
  template QualityReport mesh_quality<3>(const SimplexMesh<3> &, const std::vector<Vec<3>> &, double);
} // namespace Breakwater
