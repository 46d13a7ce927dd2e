#pragma once

#include <breakwater/interfaces/explicit_domain.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// What the entry "Probes" names: "tip: Obstacle(0.292, 0.08, 0.075)".
  struct ProbePlace
  {
    std::string         name;   ///< "tip"
    std::string         domain; ///< "Obstacle"
    std::vector<double> point;  ///< in the undeformed body [m]
  };

  /// Places separated by semicolons. @throws InputError where the text has another form
  std::vector<ProbePlace> parse_probes(const std::string &text);

  /// Follows the node of a structure that was nearest to a point of the undeformed body, and adds its displacement
  /// to history.csv: "NAME displacement x [m]".
  template <int dim>
  class Probe
  {
  public:
    /// @pre the domain is set up and at time 0; it outlives the probe
    /// @throws InputError if no node is near enough: within a tenth of the longest edge of the cells at the nearest
    /// node, whose place the message tells
    Probe(const ProbePlace &place, const ExplicitDomain<dim> &domain);

    void add_history(Row &row) const;

  private:
    std::string                name_;
    const ExplicitDomain<dim> *domain_;
    Vec<dim>                   undeformed_;            ///< of the node [m]
    bool                       is_on_surface_ = false; ///< the node belongs to the wet surface, cheap to read
    unsigned int               node_          = 0;     ///< of the wet surface or of the output mesh
  };
} // namespace Breakwater
