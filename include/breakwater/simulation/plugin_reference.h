#pragma once

#include <breakwater/base/plugin_registry.h>

#include <iosfwd>

namespace Breakwater
{
  /// A table of all registered plugins: interface, name, library and one line about each.
  void print_plugin_list(std::ostream &stream, const PluginRegistry &registry);

  /// The entries of a scene and of every registered plugin, with documentation and defaults. A plugin for 2D and 3D
  /// is shown once, as in 3D.
  void print_plugin_reference(std::ostream &stream, const PluginRegistry &registry);
} // namespace Breakwater
