#pragma once

#include <breakwater/interfaces/postprocessor.h>

#include <string>

namespace Breakwater
{
  /// The height of water over a place: the wet length of a straight wire through it, as a wave gauge in a tank measures
  /// it. Air under a breaking wave does not count; spray hardly does.
  template <int dim>
  class Gauge : public Postprocessor<dim>
  {
  public:
    Gauge() { direction_[1] = 1; }

    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    void setup(const std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> &domains) override;
    void add_history(double time, Row &row) override;

  private:
    std::string                domain_name_ = "Fluid";
    std::string                name_        = "gauge";
    Vec<dim>                   place_; ///< [m]
    Vec<dim>                   direction_;
    const ExplicitDomain<dim> *domain_ = nullptr;
  };
} // namespace Breakwater
