#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/base/plugin_registry.h>

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    std::string interface_title(const std::string &interface_name, const int dimension)
    {
      return dimension == 0 ? interface_name : interface_name + " (in " + std::to_string(dimension) + "D)";
    }
  } // namespace

  const PluginRegistry::Entry &PluginRegistry::find(const std::string &interface_name, const int dimension,
                                                    const std::string &name) const
  {
    const auto                of_interface = entries_.find({interface_name, dimension});
    const std::vector<Entry>  none;
    const std::vector<Entry> &known = of_interface == entries_.end() ? none : of_interface->second;
    for (const Entry &entry : known)
      if (lower_case(entry.name) == lower_case(name))
        return entry;

    const std::string what = "no " + interface_title(interface_name, dimension) + " is called \"" + name + "\"";
    if (known.empty())
      throw InputError(what + ": none of the loaded plugin libraries has a " +
                       interface_title(interface_name, dimension) + "; name its library in \"Plugin libraries\"");
    throw InputError(what + suggestion(name, names(interface_name, dimension)));
  }

  std::vector<std::string> PluginRegistry::names(const std::string &interface_name, const int dimension) const
  {
    std::vector<std::string> result;
    const auto               of_interface = entries_.find({interface_name, dimension});
    if (of_interface != entries_.end())
      for (const Entry &entry : of_interface->second)
        result.push_back(entry.name);
    std::sort(result.begin(), result.end());
    return result;
  }

  void PluginRegistry::add_entry(const std::string &interface_name, const int dimension, const std::string &name,
                                 const std::string &description, Factory factory)
  {
    std::vector<Entry> &known = entries_[{interface_name, dimension}];
    for (const Entry &entry : known)
      if (lower_case(entry.name) == lower_case(name))
        throw InputError("the " + interface_title(interface_name, dimension) + " \"" + name + "\" of the library \"" +
                         current_library_ + "\" is already there, from the library \"" + entry.library +
                         "\"; load only one of them");
    known.push_back({name, description, current_library_, std::move(factory)});
  }

  void PluginRegistry::throw_wrong_type(const std::string &interface_name, const std::string &name)
  {
    throw InputError("the plugin \"" + name + "\" is registered as a " + interface_name +
                     " but is none: its library was built against other headers; build it again");
  }
} // namespace Breakwater
