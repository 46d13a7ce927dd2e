#include <breakwater/base/abi.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/base/plugin_library.h>

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string prefix = "lib", suffix = ".so";

    /// A symbol of a loaded library as a function; null if it is not there.
    template <class Function>
    Function function_of(void *library, const char *name)
    {
      return reinterpret_cast<Function>(dlsym(library, name));
    }
  } // namespace

  PluginLibraries::PluginLibraries(std::vector<fs::path> folders)
    : folders_(std::move(folders))
  {
  }

  std::vector<fs::path> PluginLibraries::default_folders(const std::vector<fs::path> &added)
  {
    std::vector<fs::path> folders;
    const auto            add = [&folders](const fs::path &folder) {
      const fs::path absolute = fs::absolute(folder).lexically_normal();
      if (std::find(folders.begin(), folders.end(), absolute) == folders.end())
        folders.push_back(absolute);
    };
    for (const fs::path &folder : added)
      add(folder);
    if (const char *list = std::getenv("BREAKWATER_PLUGIN_PATH"))
      {
        std::istringstream stream(list);
        for (std::string folder; std::getline(stream, folder, ':');)
          if (!folder.empty())
            add(folder);
      }
    // bin/breakwater and lib*/breakwater/plugins, in the build folder as in the installed tree
    const fs::path root = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
    add(root / BREAKWATER_PLUGIN_FOLDER);
    add(root / "lib/breakwater/plugins");
    return folders;
  }

  fs::path PluginLibraries::find(const std::string &name) const
  {
    if (name.empty() || name.find('/') != std::string::npos || name.find("..") != std::string::npos)
      throw InputError("the plugin library \"" + name +
                       "\" must be a bare name, such as \"materials\"; folders come from --plugin-path and "
                       "BREAKWATER_PLUGIN_PATH alone");
    for (const fs::path &folder : folders_)
      if (fs::exists(folder / (prefix + name + suffix)))
        return folder / (prefix + name + suffix);

    std::string looked_in;
    for (const fs::path &folder : folders_)
      looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
    throw InputError("the plugin library \"" + name + "\" is not there" + suggestion(name, available()) +
                     ". Looked for " + prefix + name + suffix + " in: " + looked_in);
  }

  void PluginLibraries::load(const std::string &name, PluginRegistry &registry)
  {
    const fs::path file = find(name);
    if (loaded_.count(name) > 0)
      return;
    void *library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw InputError("the plugin library " + file.string() + " can't be loaded: " + dlerror());

    const auto abi_tag = function_of<const char *(*)()>(library, "breakwater_plugin_abi_tag");
    const auto enroll  = function_of<void (*)(PluginRegistry &)>(library, "breakwater_register_plugins");
    if (abi_tag == nullptr || enroll == nullptr)
      throw InputError(file.string() + " is no plugin library of Breakwater: it does not use " +
                       "BREAKWATER_PLUGIN_LIBRARY (breakwater/base/plugin_export.h)");
    if (std::string(abi_tag()) != BREAKWATER_ABI_TAG)
      throw InputError("the plugin library " + file.string() + " was built for \"" + abi_tag() +
                       "\", but this program is \"" + BREAKWATER_ABI_TAG + "\"; build the library again with " +
                       "this program's headers, compiler and build type");
    registry.set_current_library(name);
    enroll(registry);
    registry.set_current_library("core");
    loaded_.insert(name);
  }

  std::vector<std::string> PluginLibraries::available() const
  {
    std::set<std::string> names;
    for (const fs::path &folder : folders_)
      if (fs::is_directory(folder))
        for (const fs::directory_entry &file : fs::directory_iterator(folder))
          {
            const std::string name = file.path().filename().string();
            if (name.size() > prefix.size() + suffix.size() && name.compare(0, prefix.size(), prefix) == 0 &&
                file.path().extension() == suffix)
              names.insert(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()));
          }
    return {names.begin(), names.end()};
  }
} // namespace Breakwater
