#include <breakwater/base/plugin_registry.h>

// A library built for another program: registering its plugins would be the end of the test.
extern "C" __attribute__((visibility("default"))) const char *breakwater_plugin_abi_tag()
{
  return "breakwater-abi-0 deal.II-0 another compiler";
}

extern "C" __attribute__((visibility("default"))) void breakwater_register_plugins(Breakwater::PluginRegistry &)
{
  __builtin_trap();
}
