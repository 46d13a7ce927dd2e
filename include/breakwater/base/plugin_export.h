#pragma once

#include <breakwater/base/abi.h>
#include <breakwater/base/plugin_registry.h>

/// Exports what breakwater looks for in a plugin library: its ABI tag, compared before anything else of the library
/// runs, and the function whose body follows, which adds its plugins to `registry`.
///
///   BREAKWATER_PLUGIN_LIBRARY(registry)
///   {
///     registry.add<EquationOfState, Tait>("Tait", "...");
///   }
#define BREAKWATER_PLUGIN_LIBRARY(registry)                                                                            \
  extern "C" __attribute__((visibility("default"))) const char *breakwater_plugin_abi_tag()                            \
  {                                                                                                                    \
    return BREAKWATER_ABI_TAG;                                                                                         \
  }                                                                                                                    \
  extern "C" __attribute__((visibility("default"))) void breakwater_register_plugins(                                  \
    Breakwater::PluginRegistry &registry)
