#pragma once

#include <breakwater/base/vec.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// Evaluates dim expressions in x, y, z [m] and pi (the syntax of muParser), one for each component of a vector.
  /// @throws InputError if there are not dim expressions, or one can't be evaluated
  template <int dim>
  std::vector<Vec<dim>> evaluate_expressions(const std::vector<std::string> &expressions,
                                             const std::vector<Vec<dim>>    &position);
} // namespace Breakwater
