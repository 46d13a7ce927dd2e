#pragma once

#include <breakwater/base/vec.h>

#include <utility>
#include <vector>

namespace Breakwater
{
  /// All pairs of nodes (number in a, number in b) that are at most `tolerance` [m] apart, in the order of a.
  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>> common_nodes(const std::vector<Vec<dim>> &a,
                                                                  const std::vector<Vec<dim>> &b, double tolerance);
} // namespace Breakwater
