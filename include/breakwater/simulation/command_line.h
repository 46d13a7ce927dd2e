#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace Breakwater
{
  /// What the command line asks for.
  struct CommandLine
  {
    enum class Task
    {
      run,
      validate,
      list_plugins,
      print_parameters,
      print_help,
      print_version
    };

    Task                               task = Task::run;
    std::filesystem::path              parameter_file; ///< may be empty for list_plugins and print_parameters
    std::vector<std::string>           overrides;      ///< "Section/Entry=value"
    std::vector<std::filesystem::path> plugin_folders;
    std::filesystem::path              output_directory; ///< empty: the scene's
    bool                               resume = false;
  };

  /// @throws InputError for an unknown option (with the nearest one), a missing value, a missing or second file
  CommandLine parse_command_line(const std::vector<std::string> &arguments);

  /// The text that --help prints.
  std::string command_line_help();
} // namespace Breakwater
