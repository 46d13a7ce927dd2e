#pragma once

#include <breakwater/interfaces/postprocessor.h>

#include <string>

namespace Breakwater
{
  /// How far a fluid has come in a direction: the largest x . e over the nodes of its cells. Isolated nodes, the spray
  /// ahead of the front, do not count.
  template <int dim>
  class Front : public Postprocessor<dim>
  {
  public:
    Front() { direction_[0] = 1; }

    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    void setup(const std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> &domains) override;
    void add_history(double time, Row &row) override;

  private:
    std::string                domain_name_ = "Fluid";
    std::string                name_        = "front";
    Vec<dim>                   direction_;
    const ExplicitDomain<dim> *domain_ = nullptr;
  };
} // namespace Breakwater
