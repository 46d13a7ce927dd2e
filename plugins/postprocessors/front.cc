#include "front.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>
#include <limits>

#include "domain_by_name.h"

namespace Breakwater
{
  template <int dim>
  void Front<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Domain", domain_name_, "Name of the fluid");
    reader.add("Direction", direction_, "Direction in which the front moves; its length does not matter");
    reader.add("Name", name_, "The column of history.csv is \"NAME position [m]\"");
  }


  template <int dim>
  void Front<dim>::check_parameters(ParameterReader &reader)
  {
    const double length = norm(direction_);
    if (!(length > 0))
      reader.fail("Direction", "needs a component that is not zero");
    direction_ *= 1 / length;
  }


  template <int dim>
  void Front<dim>::setup(const std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> &domains)
  {
    domain_ = &domain_by_name(domains, domain_name_, "Front");
  }


  // not a number while there is no cell
  template <int dim>
  void Front<dim>::add_history(const double, Row &row)
  {
    const OutputMesh<dim> mesh     = domain_->output_mesh();
    double                position = -std::numeric_limits<double>::infinity();
    if (mesh.vertices_per_cell > 1)
      for (const unsigned int node : mesh.cells)
        position = std::max(position, dot(mesh.position[node], direction_));
    row.emplace_back(name_ + " position [m]", position > -std::numeric_limits<double>::infinity() ?
                                                position :
                                                std::numeric_limits<double>::quiet_NaN());
  }


  template class Front<2>;
  template class Front<3>;
} // namespace Breakwater
