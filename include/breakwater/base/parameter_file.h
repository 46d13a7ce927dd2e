#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/base/plugin_registry.h>

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace Breakwater
{
  /// What a parameter file says, entry by entry, with the place of each: the file's text before anything is known
  /// about what is allowed. Names compare without regard to upper and lower case.
  struct ParameterText
  {
    using Path = std::vector<std::string>;

    struct Entry
    {
      std::string place; ///< "scene.prm:12" or "command line"
      Path        section;
      std::string name;
      std::string value;
    };
    struct Section
    {
      std::string place;
      Path        path;
    };

    std::string          name; ///< "folder/scene.prm", for messages and to find files that stand beside it
    std::vector<Entry>   entries;
    std::vector<Section> sections; ///< in the order of the file

    /// The entry of that name, nullptr if there is none.
    const Entry *find(const Path &section, const std::string &name) const;
  };

  /// Reads the text of a parameter file: "set NAME = VALUE", "subsection NAME", "end", comments after #, lines that
  /// go on after a backslash.
  /// @throws InputError at a line of another form, a second "set" of an entry, a subsection without its end
  ParameterText scan_parameters(std::istream &stream, const std::string &file_name);
  ParameterText scan_parameter_file(const std::filesystem::path &file);

  /// Adds "Section/Entry=value" of the command line, in place of what the file says.
  /// @throws InputError if it has no "="
  void override_parameter(ParameterText &text, const std::string &assignment);

  enum class Strictness
  {
    strict, ///< all that the text says must be declared
    lenient ///< what is not declared is passed over
  };

  /// Gives the text's values to what the root and the plugins that it chooses declare: passes of declaring and
  /// setting are repeated until no pass makes a new plugin; then all of the text must have been declared, and
  /// check_parameters() runs (unless lenient).
  /// @throws InputError one message with the place, the section, the entry, what is allowed and the nearest name
  void read_parameters(Plugin &root, const PluginRegistry &registry, const ParameterText &text,
                       Strictness strictness = Strictness::strict);

  /// Writes all entries that root and its chosen plugins declare, with their documentation, values and defaults, in
  /// the form of a parameter file. An empty text gives the defaults.
  void print_parameters(std::ostream &stream, Plugin &root, const PluginRegistry &registry, const ParameterText &text);
} // namespace Breakwater
