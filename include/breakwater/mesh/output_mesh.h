#pragma once

#include <breakwater/base/vec.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// A mesh with fields at its nodes, as plain data for the output: lines of vertex (1 per cell: isolated nodes),
  /// simplex (dim + 1) or hypercube cells (2^dim, in deal.II's vertex order).
  template <int dim>
  struct OutputMesh
  {
    struct Field
    {
      std::string         name;         ///< "velocity [m/s]" without the unit: "velocity"
      unsigned int        n_components; ///< 1 or dim
      std::vector<double> values;       ///< [node][component]
    };

    std::vector<Vec<dim>>     position; ///< current positions [m]
    unsigned int              vertices_per_cell = dim + 1;
    std::vector<unsigned int> cells; ///< [cell][vertex]
    std::vector<Field>        fields;
  };
} // namespace Breakwater
