#pragma once

#include <breakwater/base/exceptions.h>
#include <breakwater/interfaces/postprocessor.h>

#include <string>
#include <utility>
#include <vector>

namespace Breakwater
{
  /// The domain of that name. @throws InputError with the known names if there is none
  template <int dim>
  const ExplicitDomain<dim> &domain_by_name(
    const std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> &domains, const std::string &name,
    const std::string &postprocessor)
  {
    std::string known;
    for (const auto &[known_name, domain] : domains)
      {
        if (known_name == name)
          return *domain;
        known += (known.empty() ? "\"" : ", \"") + known_name + "\"";
      }
    throw InputError("Postprocessor " + postprocessor + ": there is no domain \"" + name + "\"; the scene has " +
                     (known.empty() ? "none" : known) + ".");
  }
} // namespace Breakwater
