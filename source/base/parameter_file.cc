#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/base/parameter_file.h>
#include <breakwater/base/parameter_reader.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>

namespace Breakwater
{
  namespace
  {
    using Path = ParameterText::Path;

    const std::string any_text = "any text";

    std::string joined(const Path &path)
    {
      std::string text;
      for (const std::string &part : path)
        text += (text.empty() ? "" : "/") + part;
      return text;
    }

    /// Key by which sections and entries are compared.
    std::string key_of(const Path &path)
    {
      return lower_case(joined(path));
    }
    std::string key_of(Path path, const std::string &name)
    {
      path.push_back(name);
      return key_of(path);
    }

    std::string section_text(const Path &path)
    {
      return path.empty() ? "at the top level" : "in section \"" + joined(path) + "\"";
    }

    /// Shortest text that gives the number back.
    std::string number_text(const double value)
    {
      char text[40];
      for (int digits = 6; digits <= 17; ++digits)
        {
          std::snprintf(text, sizeof(text), "%.*g", digits, value);
          if (std::stod(text) == value)
            break;
        }
      return text;
    }

    std::string joined_list(const std::vector<std::string> &parts)
    {
      std::string text;
      for (const std::string &part : parts)
        text += (text.empty() ? "" : ", ") + part;
      return text;
    }

    std::string range_text(const Range &range)
    {
      const double largest = std::numeric_limits<double>::max();
      if (range.lower == std::numeric_limits<double>::min() && range.upper >= largest)
        return "a number > 0";
      std::string text = "a number";
      if (range.lower == std::numeric_limits<double>::min())
        text += " > 0";
      else if (range.lower > -largest)
        text += " >= " + number_text(range.lower);
      if (range.upper < largest)
        text += (range.lower > -largest ? " and <= " : " <= ") + number_text(range.upper);
      return text;
    }
  } // namespace

  const ParameterText::Entry *ParameterText::find(const Path &section, const std::string &name) const
  {
    const std::string key = key_of(section, name);
    for (const Entry &entry : entries)
      if (key_of(entry.section, entry.name) == key)
        return &entry;
    return nullptr;
  }

  namespace
  {
    void add_sections(ParameterText &text, const Path &path, const std::string &place)
    {
      for (std::size_t depth = 1; depth <= path.size(); ++depth)
        {
          const Path part(path.begin(), path.begin() + depth);
          const auto same = [&part](const ParameterText::Section &section) {
            return key_of(section.path) == key_of(part);
          };
          if (std::none_of(text.sections.begin(), text.sections.end(), same))
            text.sections.push_back({place, part});
        }
    }

    /// The word at the start of a line, which is taken off the line.
    std::string take_word(std::string &line)
    {
      const std::size_t end  = std::min(line.find_first_of(" \t="), line.size());
      const std::string word = line.substr(0, end);
      line                   = trim(line.substr(end));
      return word;
    }
  } // namespace

  ParameterText scan_parameters(std::istream &stream, const std::string &file_name)
  {
    ParameterText text;
    text.name = file_name;
    std::vector<std::pair<std::string, std::string>> open; // sections: title, place
    unsigned int                                     line_number = 0;
    for (std::string raw; std::getline(stream, raw);)
      {
        ++line_number;
        const std::string place = file_name + ":" + std::to_string(line_number);
        std::string       line  = trim(raw.substr(0, raw.find('#')));
        while (!line.empty() && line.back() == '\\')
          {
            line.pop_back();
            if (!std::getline(stream, raw))
              throw InputError(place + ": the last line of the file ends in a backslash, but nothing follows");
            ++line_number;
            line = trim(line) + " " + trim(raw.substr(0, raw.find('#')));
          }
        if (line.empty())
          continue;

        const std::string whole = line;
        const std::string word  = lower_case(take_word(line));
        Path              path;
        for (const auto &section : open)
          path.push_back(section.first);
        if (word == "subsection" && !line.empty())
          {
            open.emplace_back(line, place);
            path.push_back(line);
            add_sections(text, path, place);
          }
        else if (word == "end" && line.empty())
          {
            if (open.empty())
              throw InputError(place + ": an \"end\" without its \"subsection\"");
            open.pop_back();
          }
        else if (word == "set" && line.find('=') != std::string::npos && line.front() != '=')
          {
            const std::size_t equal = line.find('=');
            const std::string name  = trim(line.substr(0, equal));
            if (const auto *before = text.find(path, name))
              throw InputError(place + ": " + section_text(path) + ", the entry \"" + name +
                               "\" is set twice, first at " + before->place + "; keep one of them");
            text.entries.push_back({place, path, name, trim(line.substr(equal + 1))});
          }
        else
          throw InputError(place + ": can't read the line \"" + whole +
                           "\"; allowed are: set NAME = VALUE, subsection NAME, end, and # before a comment");
      }
    if (!open.empty())
      throw InputError(open.back().second + ": the subsection \"" + open.back().first +
                       "\" has no \"end\" up to the end of the file");
    return text;
  }

  ParameterText scan_parameter_file(const std::filesystem::path &file)
  {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
      throw InputError("can't read the parameter file " + file.string());
    return scan_parameters(stream, file.string());
  }

  void override_parameter(ParameterText &text, const std::string &assignment)
  {
    const std::size_t equal = assignment.find('=');
    if (equal == std::string::npos || trim(assignment.substr(0, equal)).empty())
      throw InputError("command line: --set needs \"Section/Entry=value\", not \"" + assignment + "\"");
    Path        path;
    std::string left = assignment.substr(0, equal);
    for (std::size_t slash; (slash = left.find('/')) != std::string::npos; left = left.substr(slash + 1))
      path.push_back(trim(left.substr(0, slash)));
    const std::string place = "command line", name = trim(left), value = trim(assignment.substr(equal + 1));
    for (ParameterText::Entry &entry : text.entries)
      if (key_of(entry.section, entry.name) == key_of(path, name))
        {
          entry.place = place;
          entry.value = value;
          return;
        }
    add_sections(text, path, place);
    text.entries.push_back({place, path, name, value});
  }

  namespace
  {
    /// One pass over a parameter text: a fresh ParameterHandler whose entries get the text's values at once.
    class ParameterPass : public ParameterReader
    {
    public:
      /// @param defaults of the entries by key, kept over all passes: a later pass sees members already set
      ParameterPass(const PluginRegistry &registry, const ParameterText &text,
                    std::map<std::string, std::string> &defaults, const bool is_reference)
        : registry_(registry)
        , text_(text)
        , defaults_(defaults)
        , is_reference_(is_reference)
      {
      }

      using ParameterReader::add;

      void add(const std::string &name, double &member, const std::string &documentation, const Range range) override
      {
        declare(name, number_text(member), documentation, dealii::Patterns::Double(range.lower, range.upper),
                range_text(range), [&member](const std::string &value) {
                  member = std::stod(value);
                });
      }

      void add(const std::string &name, unsigned int &member, const std::string &documentation,
               const unsigned int lower, const unsigned int upper) override
      {
        std::string allowed = "a whole number >= " + std::to_string(lower);
        if (upper != static_cast<unsigned int>(std::numeric_limits<int>::max()))
          allowed += " and <= " + std::to_string(upper);
        declare(name, std::to_string(member), documentation, dealii::Patterns::Integer(lower, upper), allowed,
                [&member](const std::string &value) {
                  member = static_cast<unsigned int>(std::stoul(value));
                });
      }

      void add(const std::string &name, bool &member, const std::string &documentation) override
      {
        declare(name, member ? "true" : "false", documentation, dealii::Patterns::Bool(), "true or false",
                [&member](const std::string &value) {
                  member = value == "true";
                });
      }

      void add(const std::string &name, std::string &member, const std::string &documentation) override
      {
        declare(name, member, documentation, dealii::Patterns::Anything(), any_text,
                [&member](const std::string &value) {
                  member = value;
                });
      }

      void add(const std::string &name, std::string &member, const std::string &documentation,
               const std::vector<std::string> &choices) override
      {
        std::string selection;
        for (const std::string &choice : choices)
          selection += (selection.empty() ? "" : "|") + choice;
        declare(
          name, member, documentation, dealii::Patterns::Selection(selection), joined_list(choices),
          [&member](const std::string &value) {
            member = value;
          },
          choices);
      }

      void add(const std::string &name, std::vector<std::string> &member, const std::string &documentation) override
      {
        declare(name, joined_list(member), documentation, dealii::Patterns::Anything(), "a list a, b, ...",
                [&member](const std::string &value) {
                  member = split_list(value);
                });
      }

      void add(const std::string &name, std::vector<double> &member, const std::string &documentation,
               const unsigned int n_min, const unsigned int n_max) override
      {
        const std::string count =
          n_min == n_max ? std::to_string(n_min) : std::to_string(n_min) + " to " + std::to_string(n_max);
        declare(name, numbers_text(member.data(), member.size()), documentation,
                dealii::Patterns::List(dealii::Patterns::Double(), n_min, n_max),
                count + " numbers, separated by commas", [&member](const std::string &value) {
                  member = numbers_of(value);
                });
      }

      void enter_section(const std::string &name) override
      {
        handler_.enter_subsection(name);
        path_.push_back(name);
        known_sections_[key_of(path_)] = path_;
      }

      void leave_section() override
      {
        handler_.leave_subsection();
        path_.pop_back();
      }

      std::vector<std::string> section_titles() const override
      {
        std::vector<std::string> titles;
        for (const ParameterText::Section &section : text_.sections)
          if (section.path.size() == path_.size() + 1 &&
              key_of(Path(section.path.begin(), section.path.end() - 1)) == key_of(path_))
            titles.push_back(section.path.back());
        return titles;
      }

      std::string where(const std::string &name) const override
      {
        const std::string what = section_text(path_) + (name.empty() ? "" : ", entry \"" + name + "\"");
        if (name.empty())
          {
            for (const ParameterText::Section &section : text_.sections)
              if (key_of(section.path) == key_of(path_))
                return section.place + ": " + what;
            return text_.name + ": " + what;
          }
        if (const ParameterText::Entry *entry = text_.find(path_, name))
          return entry->place + ": " + what + ", value \"" + entry->value + "\"";
        const auto        default_value = defaults_.find(key_of(path_, name));
        const std::string not_set       = default_value == defaults_.end() || default_value->second.empty() ?
                                            " (not set)" :
                                            " (not set; its default is \"" + default_value->second + "\")";
        return text_.name + ": " + what + not_set;
      }

      const PluginRegistry &registry() const override { return registry_; }
      void                  note_new_plugin() override { has_new_plugin_ = true; }
      std::filesystem::path file_path(const std::string &name) const override
      {
        return std::filesystem::path(text_.name).parent_path() / name;
      }
      bool is_reference() const override { return is_reference_; }

      bool has_new_plugin() const { return has_new_plugin_; }

      /// @throws InputError if the text has a section or an entry that was not declared in this pass
      void check_that_all_is_known() const
      {
        for (const ParameterText::Section &section : text_.sections)
          if (known_sections_.count(key_of(section.path)) == 0)
            {
              const Path above(section.path.begin(), section.path.end() - 1);
              throw InputError(section.place + ": " + section_text(above) + ", the section \"" + section.path.back() +
                               "\" is unknown" + suggestion(section.path.back(), sections_in(above)) +
                               " (a plugin's section is known where that plugin is chosen)");
            }
        for (const ParameterText::Entry &entry : text_.entries)
          if (known_entries_.count(key_of(entry.section, entry.name)) == 0)
            throw InputError(entry.place + ": " + section_text(entry.section) + ", the entry \"" + entry.name +
                             "\" is unknown" + suggestion(entry.name, entries_in(entry.section)));
      }

      void print(std::ostream &stream) const
      {
        handler_.print_parameters(stream,
                                  dealii::ParameterHandler::PRM | dealii::ParameterHandler::KeepDeclarationOrder);
      }

    protected:
      void add_fixed(const std::string &name, double *values, const unsigned int n,
                     const std::string &documentation) override
      {
        declare(name, numbers_text(values, n), documentation, dealii::Patterns::List(dealii::Patterns::Double(), n, n),
                std::to_string(n) + " numbers, separated by commas", [values, n](const std::string &value) {
                  const std::vector<double> numbers = numbers_of(value);
                  std::copy_n(numbers.begin(), n, values);
                });
      }

    private:
      static std::string numbers_text(const double *values, const std::size_t n)
      {
        std::string text;
        for (std::size_t i = 0; i < n; ++i)
          text += (i == 0 ? "" : ", ") + number_text(values[i]);
        return text;
      }

      static std::vector<double> numbers_of(const std::string &text)
      {
        std::vector<double> numbers;
        for (const std::string &part : split_list(text))
          numbers.push_back(std::stod(part));
        return numbers;
      }

      /// Declares an entry of the current section and gives it the text's value, if it has one.
      void declare(const std::string &name, const std::string &value_now, const std::string &documentation,
                   const dealii::Patterns::PatternBase &pattern, const std::string &allowed,
                   const std::function<void(const std::string &)> &assign, const std::vector<std::string> &choices = {})
      {
        const std::string key           = key_of(path_, name);
        const std::string default_value = defaults_.emplace(key, value_now).first->second;
        if (!known_entries_.emplace(key, name).second)
          throw std::logic_error(section_text(path_) + ", the entry \"" + name + "\" is declared twice");
        handler_.declare_entry(name, default_value, pattern,
                               documentation + (allowed == any_text ? "" : " Allowed: " + allowed + "."));

        const ParameterText::Entry *entry = text_.find(path_, name);
        if (entry == nullptr)
          return;
        std::string value = entry->value;
        for (const std::string &choice : choices)
          if (lower_case(choice) == lower_case(value))
            value = choice;
        if (!pattern.match(value))
          {
            const std::string nearest = nearest_name(value, choices);
            fail(name, (nearest.empty() ? "" : "did you mean \"" + nearest + "\"? ") + "allowed: " + allowed);
          }
        handler_.add_action(name, assign); // called at once with the default, then by set() with the value
        try
          {
            handler_.set(name, value);
          }
        catch (const std::logic_error &) // std::stod and its kin, after the pattern: out of a double's range
          {
            fail(name, "the number is out of range; allowed: " + allowed);
          }
      }

      std::vector<std::string> entries_in(const Path &section) const
      {
        const std::string        prefix = section.empty() ? "" : key_of(section) + "/";
        std::vector<std::string> names;
        for (const auto &[key, name] : known_entries_)
          if (key == prefix + lower_case(name))
            names.push_back(name);
        return names;
      }

      std::vector<std::string> sections_in(const Path &section) const
      {
        std::vector<std::string> titles;
        for (const auto &known : known_sections_)
          if (known.second.size() == section.size() + 1 &&
              key_of(Path(known.second.begin(), known.second.end() - 1)) == key_of(section))
            titles.push_back(known.second.back());
        return titles;
      }

      const PluginRegistry               &registry_;
      const ParameterText                &text_;
      std::map<std::string, std::string> &defaults_;
      const bool                          is_reference_;
      dealii::ParameterHandler            handler_;
      Path                                path_;
      std::map<std::string, Path>         known_sections_; ///< by key
      std::map<std::string, std::string>  known_entries_;  ///< names by key
      bool                                has_new_plugin_ = false;
    };

    /// Passes over the text until one makes no new plugin, the last of which is returned.
    std::unique_ptr<ParameterPass> read_in_passes(Plugin &root, const PluginRegistry &registry,
                                                  const ParameterText                &text,
                                                  std::map<std::string, std::string> &defaults,
                                                  const bool                          is_reference = false)
    {
      // The first pass gives values to entries that choose plugins, so it can't be the last.
      constexpr unsigned int n_max_passes = 50;
      for (unsigned int n = 0; n < n_max_passes; ++n)
        {
          auto pass = std::make_unique<ParameterPass>(registry, text, defaults, is_reference);
          root.declare_parameters(*pass);
          if (n > 0 && !pass->has_new_plugin())
            return pass;
        }
      throw InputError(text.name + ": plugins choose plugins without end");
    }
  } // namespace

  void read_parameters(Plugin &root, const PluginRegistry &registry, const ParameterText &text,
                       const Strictness strictness)
  {
    std::map<std::string, std::string>   defaults;
    const std::unique_ptr<ParameterPass> last = read_in_passes(root, registry, text, defaults);
    if (strictness == Strictness::lenient)
      return;
    last->check_that_all_is_known();
    root.check_parameters(*last);
  }

  void print_parameters(std::ostream &stream, Plugin &root, const PluginRegistry &registry, const ParameterText &text)
  {
    std::map<std::string, std::string> defaults;
    const bool                         is_reference = text.entries.empty() && text.sections.empty();
    const auto                         last         = read_in_passes(root, registry, text, defaults, is_reference);
    last->check_that_all_is_known();
    last->print(stream);
  }
} // namespace Breakwater
