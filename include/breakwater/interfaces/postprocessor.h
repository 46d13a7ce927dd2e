#pragma once

#include <breakwater/interfaces/explicit_domain.h>

#include <vector>

namespace Breakwater
{
  /// Computes more columns of history.csv from the domains, at every history time.
  template <int dim>
  class Postprocessor : public Plugin
  {
  public:
    static constexpr const char *interface_name = "postprocessor";
    static constexpr int         dimension      = dim;

    /// @param domains by name, e.g. "Fluid", "Obstacle"; they outlive the postprocessor
    virtual void setup(const std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> &domains) = 0;

    /// Adds columns, always the same.
    virtual void add_history(double time, Row &row) = 0;
  };
} // namespace Breakwater
