#pragma once

#include <breakwater/base/plugin_registry.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Finds plugin libraries by bare name in a fixed list of folders and loads them.
  ///
  /// A parameter file names libraries; the folders come from the program's place, its command line and its
  /// environment alone. A parameter file therefore can't load code from anywhere else.
  class PluginLibraries
  {
  public:
    /// @param folders searched in this order; those that don't exist are passed over
    explicit PluginLibraries(std::vector<std::filesystem::path> folders);

    /// The folders for this program: `added` (the command line), those of the environment variable
    /// BREAKWATER_PLUGIN_PATH (separated by colons), then the one that belongs to the program itself.
    static std::vector<std::filesystem::path> default_folders(const std::vector<std::filesystem::path> &added = {});

    /// Loads the library libNAME.so and registers its plugins; nothing happens if that was done before. Its ABI tag
    /// is compared before anything else of the library is called. A library is never unloaded.
    /// @throws InputError for a name with a folder in it, a library that is not there (with the nearest name), can't
    /// be loaded, is no plugin library, or has another ABI tag (with both tags)
    void load(const std::string &name, PluginRegistry &registry);

    /// Bare names of all libraries in the folders, sorted.
    std::vector<std::string> available() const;

    const std::vector<std::filesystem::path> &folders() const { return folders_; }

  private:
    std::filesystem::path find(const std::string &name) const;

    std::vector<std::filesystem::path> folders_;
    std::set<std::string>              loaded_;
  };
} // namespace Breakwater
