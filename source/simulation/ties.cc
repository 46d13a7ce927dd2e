#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/simulation/ties.h>

#include <algorithm>
#include <set>

namespace Breakwater
{
  namespace
  {
    void check_name(const std::string &name, const std::vector<std::string> &names)
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError("no body is called \"" + name + "\"" + suggestion(name, names));
    }

    /// Without the bodies that a chain of ties connects to the first one.
    std::set<std::string> not_connected(const std::vector<std::string> &names, const std::vector<TiedNames> &ties)
    {
      std::set<std::string> loose(names.begin() + 1, names.end());
      for (std::size_t n_before = loose.size() + 1; n_before != loose.size();)
        {
          n_before = loose.size();
          for (const auto &[a, b] : ties)
            if (loose.count(a) != loose.count(b))
              {
                loose.erase(a);
                loose.erase(b);
              }
        }
      return loose;
    }
  } // namespace


  std::vector<TiedNames> parse_ties(const std::vector<std::string> &texts)
  {
    const std::string      word = " and ";
    std::vector<TiedNames> ties;
    for (const std::string &text : texts)
      {
        const std::size_t place = text.find(word);
        if (place == std::string::npos)
          throw InputError("can't read the tie \"" + text +
                           "\"; the form is NAME and NAME, several of them separated "
                           "by commas");
        ties.emplace_back(trim(text.substr(0, place)), trim(text.substr(place + word.size())));
      }
    return ties;
  }


  std::vector<TiedNames> find_ties(const std::vector<std::string> &texts, const bool has_fluid,
                                   const std::vector<std::string> &structures)
  {
    std::vector<TiedNames> ties = parse_ties(texts);
    if (ties.empty() && has_fluid)
      for (const std::string &structure : structures)
        ties.emplace_back(fluid_name, structure);
    if (ties.empty() && structures.size() == 2)
      ties.emplace_back(structures[0], structures[1]);
    if (ties.empty())
      throw InputError("say which of the structures are tied: NAME and NAME, several of them separated by commas");

    std::vector<std::string> names = structures;
    if (has_fluid)
      names.insert(names.begin(), fluid_name);
    std::set<TiedNames> seen;
    for (const auto &[a, b] : ties)
      {
        check_name(a, names);
        check_name(b, names);
        if (a == b)
          throw InputError("\"" + a + "\" can't be tied to itself");
        if (!seen.insert(std::minmax(a, b)).second)
          throw InputError("\"" + a + "\" and \"" + b + "\" are tied twice");
      }
    if (has_fluid)
      for (const std::string &loose : not_connected(names, ties))
        throw InputError("nothing ties \"" + loose + "\" to the fluid, which would flow through it; add \"" +
                         fluid_name + " and " + loose + "\"");
    return ties;
  }


  void fail_without_common_node(const std::string &ties_place, const std::string &first, const std::string &second)
  {
    throw InputError(ties_place + ": \"" + first + "\" and \"" + second +
                     "\" are tied to each other, but their wet boundaries have no node in common; let them touch with "
                     "equal cells there: the boundaries must be wet in both, and not clamped in both");
  }
} // namespace Breakwater
