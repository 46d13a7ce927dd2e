#include "law_at_structures.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/base/parameter_reader.h>

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    bool is_free_slip(const std::string &law)
    {
      const std::vector<std::string> laws = {"no slip", "free slip"};
      if (std::find(laws.begin(), laws.end(), law) == laws.end())
        throw InputError("the law \"" + law + "\" is unknown" + suggestion(law, laws));
      return law == "free slip";
    }
  } // namespace


  const char *LawAtStructures::documentation()
  {
    return "Whether the fluid at the surface of a structure moves with it (`no slip`) or slides along it without a "
           "force (`free slip`); or a list of structures with their laws, `NAME: free slip, NAME: no slip`, in which "
           "those that are not named have no slip. Walls have laws of their own.";
  }


  LawAtStructures::LawAtStructures(const std::string &text)
  {
    const std::vector<std::string> parts = split_list(text);
    if (parts.size() == 1 && text.find(':') == std::string::npos)
      {
        others_slip_ = is_free_slip(parts.front());
        return;
      }
    for (const std::string &part : parts)
      {
        const std::size_t colon = part.find(':');
        if (colon == std::string::npos)
          throw InputError("can't read \"" + part +
                           "\"; the form of a list is NAME: LAW, several of them separated by "
                           "commas");
        const std::string body = trim(part.substr(0, colon));
        if (std::any_of(named_.begin(), named_.end(), [&body](const Named &named) {
              return named.body == body;
            }))
          throw InputError("\"" + body + "\" is named twice");
        named_.push_back({body, is_free_slip(trim(part.substr(colon + 1)))});
      }
    if (named_.empty())
      throw InputError("a law is needed: no slip or free slip");
  }


  bool LawAtStructures::asks_for_slip() const
  {
    return others_slip_ || std::any_of(named_.begin(), named_.end(), [](const Named &named) {
             return named.slips;
           });
  }


  template <int dim>
  std::vector<char> LawAtStructures::slips(const WetSurface<dim> &surface) const
  {
    std::vector<char> of_body(surface.bodies.size(), others_slip_);
    for (const Named &named : named_)
      {
        const auto body = std::find(surface.bodies.begin(), surface.bodies.end(), named.body);
        if (body == surface.bodies.end())
          throw InputError("no structure that meets the fluid is called \"" + named.body + "\"" +
                           (surface.bodies.empty() ? "" : suggestion(named.body, surface.bodies)));
        of_body[body - surface.bodies.begin()] = named.slips;
      }
    std::vector<char> result(surface.facets.size(), others_slip_);
    for (std::size_t f = 0; f < surface.body_of_facet.size(); ++f)
      result[f] = of_body[surface.body_of_facet[f]];
    return result;
  }

  template std::vector<char> LawAtStructures::slips(const WetSurface<2> &) const;
  template std::vector<char> LawAtStructures::slips(const WetSurface<3> &) const;
} // namespace Breakwater
