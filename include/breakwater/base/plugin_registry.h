#pragma once

#include <breakwater/base/plugin.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Breakwater
{
  /// The plugins that the loaded libraries offer, by interface and name. Owned by main; nothing is global.
  class PluginRegistry
  {
  public:
    using Factory = std::function<std::unique_ptr<Plugin>()>;

    struct Entry
    {
      std::string name;        ///< as the manual writes it, also the title of its section: "Saint Venant Kirchhoff"
      std::string description; ///< one line
      std::string library;     ///< bare name of the library that brought it, "core" for what is built in
      Factory     factory;
    };

    /// Adds a plugin: `registry.add<EquationOfState, Tait>("Tait", "one line")`.
    /// @throws InputError if that name is taken.
    template <class Interface, class Implementation>
    void add(const std::string &name, const std::string &description)
    {
      add_entry(Interface::interface_name, Interface::dimension, name, description, [] {
        return std::make_unique<Implementation>();
      });
    }

    /// A new plugin of that name; upper and lower case do not matter.
    /// @throws InputError with the known names and the nearest one if there is none.
    template <class Interface>
    std::unique_ptr<Interface> create(const std::string &name) const
    {
      std::unique_ptr<Plugin> plugin = find(Interface::interface_name, Interface::dimension, name).factory();
      Interface              *cast   = dynamic_cast<Interface *>(plugin.get());
      if (cast == nullptr)
        throw_wrong_type(Interface::interface_name, name);
      plugin.release();
      return std::unique_ptr<Interface>(cast);
    }

    /// The entry of a plugin. @throws InputError as create().
    const Entry &find(const std::string &interface_name, int dimension, const std::string &name) const;

    /// Names of all plugins of an interface, sorted.
    std::vector<std::string> names(const std::string &interface_name, int dimension) const;

    /// All entries by (interface name, dimension), for listing.
    const std::map<std::pair<std::string, int>, std::vector<Entry>> &entries() const { return entries_; }

    /// From now on add() notes this library as the origin.
    void set_current_library(const std::string &library) { current_library_ = library; }

  private:
    void                     add_entry(const std::string &interface_name, int dimension, const std::string &name,
                                       const std::string &description, Factory factory);
    [[noreturn]] static void throw_wrong_type(const std::string &interface_name, const std::string &name);

    std::map<std::pair<std::string, int>, std::vector<Entry>> entries_;
    std::string                                               current_library_ = "core";
  };
} // namespace Breakwater
