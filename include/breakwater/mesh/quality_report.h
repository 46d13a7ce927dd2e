#pragma once

#include <breakwater/base/vec.h>
#include <breakwater/mesh/simplex_mesh.h>

#include <limits>
#include <vector>

namespace Breakwater
{
  /// Smallest insphere radius of a mesh, and the distribution of r: that radius in units of the regular cell's.
  struct QualityReport
  {
    double smallest_radius = std::numeric_limits<double>::infinity(); ///< [m]
    double smallest = 0, thousandth = 0, hundredth = 0, median = 0;   ///< minimum and quantiles of r [-]
  };

  /// @param radii insphere radii of the cells [m]
  /// @param spacing of the nodes, which makes the regular cell [m]
  template <int dim>
  QualityReport quality_report(const std::vector<double> &radii, double spacing);

  /// @param position of the nodes [m]
  /// @param spacing of the nodes, which makes the regular cell [m]
  template <int dim>
  QualityReport mesh_quality(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position, double spacing);
} // namespace Breakwater
