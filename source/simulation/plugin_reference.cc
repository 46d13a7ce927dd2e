#include <breakwater/base/parameter_file.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/simulation/plugin_reference.h>
#include <breakwater/simulation/simulation.h>

#include <iomanip>
#include <ostream>

namespace Breakwater
{
  namespace
  {
    /// One entry of the list: a plugin by interface and name, its 3D version before its 2D one.
    struct Listed
    {
      std::string                  dimensions;
      const PluginRegistry::Entry *entry;
    };
    using List = std::map<std::string, std::map<std::string, Listed>>;

    List list_of(const PluginRegistry &registry)
    {
      List list;
      for (const auto &[key, entries] : registry.entries())
        for (const PluginRegistry::Entry &entry : entries)
          {
            Listed &listed = list[key.first][entry.name];
            if (key.second != 0)
              listed.dimensions += (listed.dimensions.empty() ? "" : ", ") + std::to_string(key.second) + "D";
            listed.entry = &entry; // ascending in the dimension
          }
      return list;
    }

    /// All plugins as if a scene had chosen them, a section per interface.
    class PluginReference : public Plugin
    {
    public:
      explicit PluginReference(const List &list)
      {
        for (const auto &[interface_name, plugins] : list)
          for (const auto &[name, listed] : plugins)
            plugins_[interface_name][name] = listed.entry->factory();
      }

      void declare_parameters(ParameterReader &reader) override
      {
        for (const auto &[interface_name, plugins] : plugins_)
          {
            SectionScope scope(reader, interface_name);
            for (const auto &[name, plugin] : plugins)
              {
                SectionScope inner_scope(reader, name);
                plugin->declare_parameters(reader);
              }
          }
      }

    private:
      std::map<std::string, std::map<std::string, std::unique_ptr<Plugin>>> plugins_;
    };
  } // namespace

  void print_plugin_list(std::ostream &stream, const PluginRegistry &registry)
  {
    for (const auto &[interface_name, plugins] : list_of(registry))
      {
        stream << interface_name << '\n';
        for (const auto &[name, listed] : plugins)
          stream << "  " << std::left << std::setw(24) << name << std::setw(8) << listed.dimensions << std::setw(20)
                 << listed.entry->library << ' ' << listed.entry->description << '\n';
      }
  }

  void print_plugin_reference(std::ostream &stream, const PluginRegistry &registry)
  {
    const ParameterText nothing;
    stream << "# The entries of a scene\n";
    Simulation<3> simulation;
    print_parameters(stream, simulation, registry, nothing);
    stream << "\n# The entries of each plugin, which stand where a scene chooses it, by kind\n";
    PluginReference reference(list_of(registry));
    print_parameters(stream, reference, registry, nothing);
  }
} // namespace Breakwater
