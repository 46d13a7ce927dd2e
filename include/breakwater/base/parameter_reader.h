#pragma once

#include <breakwater/base/exceptions.h>
#include <breakwater/base/plugin_registry.h>
#include <breakwater/base/vec.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Allowed values of a number, bounds included.
  struct Range
  {
    double lower = -std::numeric_limits<double>::max();
    double upper = std::numeric_limits<double>::max();

    static Range positive() { return {std::numeric_limits<double>::min(), std::numeric_limits<double>::max()}; }
    static Range not_negative() { return {0., std::numeric_limits<double>::max()}; }
  };

  /// Binds members of objects to the entries of a parameter file (dealii::ParameterHandler does the work, out of
  /// sight of the plugins, whose files therefore compile fast).
  ///
  /// add() states an entry of the current section: its name in sentence case, the member that holds the default and
  /// takes the value, its meaning with the unit, and what is allowed.
  class ParameterReader
  {
  public:
    virtual ~ParameterReader() = default;

    virtual void add(const std::string &name, double &member, const std::string &documentation, Range range = {}) = 0;
    virtual void add(const std::string &name, unsigned int &member, const std::string &documentation,
                     unsigned int lower = 0, unsigned int upper = std::numeric_limits<int>::max())                = 0;
    virtual void add(const std::string &name, bool &member, const std::string &documentation)                     = 0;
    /// Any text.
    virtual void add(const std::string &name, std::string &member, const std::string &documentation) = 0;
    /// One of the choices.
    virtual void add(const std::string &name, std::string &member, const std::string &documentation,
                     const std::vector<std::string> &choices) = 0;
    /// A list of texts, separated by commas.
    virtual void add(const std::string &name, std::vector<std::string> &member, const std::string &documentation) = 0;
    /// A list of numbers, separated by commas.
    virtual void add(const std::string &name, std::vector<double> &member, const std::string &documentation,
                     unsigned int n_min = 0, unsigned int n_max = 1000) = 0;

    /// A vector of dim numbers (components beyond dim that a file gives are an error).
    template <int dim>
    void add(const std::string &name, Vec<dim> &member, const std::string &documentation)
    {
      add_fixed(name, member.c, dim, documentation);
    }

    virtual void enter_section(const std::string &name) = 0;
    virtual void leave_section()                        = 0;

    /// Titles of the sections that the file has below the current one, in its order: for sections that the user
    /// names, such as "Walls/Tank".
    virtual std::vector<std::string> section_titles() const = 0;

    /// An entry of the current section as messages name it: where it was set, and its value.
    virtual std::string where(const std::string &name) const = 0;

    /// Stops with an InputError about an entry of the current section: where(), then `message`.
    [[noreturn]] void fail(const std::string &name, const std::string &message) const
    {
      throw InputError(where(name) + ": " + message);
    }

    /// Where to find a file that an entry names: relative to the folder of the parameter file.
    virtual std::filesystem::path file_path(const std::string &name) const { return name; }

    virtual const PluginRegistry &registry() const = 0;

    /// A plugin was made in this pass: another pass is needed to read its entries.
    virtual void note_new_plugin() = 0;

    /// True while the complete reference is printed rather than a file read (no file: defaults only).
    virtual bool is_reference() const { return false; }

  protected:
    virtual void add_fixed(const std::string &name, double *values, unsigned int n,
                           const std::string &documentation) = 0;
  };

  /// Enters a section and leaves it at the end of the scope.
  class SectionScope
  {
  public:
    SectionScope(ParameterReader &reader, const std::string &name)
      : reader_(reader)
    {
      reader_.enter_section(name);
    }
    ~SectionScope() { reader_.leave_section(); }
    SectionScope(const SectionScope &)            = delete;
    SectionScope &operator=(const SectionScope &) = delete;

  private:
    ParameterReader &reader_;
  };

  /// An entry that lists plugins of one interface by name, and those plugins, each with a section of its own.
  /// A name that is listed twice gets the sections "Name" and "Name 2".
  template <class Interface>
  class PluginList
  {
  public:
    /// @param n_max how many names the entry may hold: 1 for a choice, and an empty entry chooses none
    PluginList(std::string entry, std::string default_names, std::string documentation, unsigned int n_max = 1000);

    void declare_parameters(ParameterReader &reader);
    void check_parameters(ParameterReader &reader) const;

    bool                                           empty() const { return plugins_.empty(); }
    std::size_t                                    size() const { return plugins_.size(); }
    Interface                                     &operator[](const std::size_t i) { return *plugins_[i]; }
    const Interface                               &operator[](const std::size_t i) const { return *plugins_[i]; }
    const std::vector<std::string>                &names() const { return names_; }
    const std::vector<std::unique_ptr<Interface>> &plugins() const { return plugins_; }
    Interface                                     &front() { return *plugins_.front(); }
    const Interface                               &front() const { return *plugins_.front(); }

  private:
    std::string                             entry_;
    std::string                             value_; ///< what the entry holds
    std::string                             made_;  ///< the value for which plugins_ were made
    std::string                             documentation_;
    unsigned int                            n_max_;
    std::vector<std::string>                names_;  ///< as registered
    std::vector<std::string>                titles_; ///< of the sections
    std::vector<std::unique_ptr<Interface>> plugins_;
  };

  /// Splits a list "a, b" at its commas and trims each part; empty parts are left out.
  std::vector<std::string> split_list(const std::string &text);

  template <class Interface>
  PluginList<Interface>::PluginList(std::string entry, std::string default_names, std::string documentation,
                                    const unsigned int n_max)
    : entry_(std::move(entry))
    , value_(std::move(default_names))
    , documentation_(std::move(documentation))
    , n_max_(n_max)
  {
  }

  template <class Interface>
  void PluginList<Interface>::declare_parameters(ParameterReader &reader)
  {
    const std::string wanted = value_;
    if (wanted != made_)
      {
        const std::vector<std::string> parts = split_list(wanted);
        if (parts.size() > n_max_)
          reader.fail(entry_, "at most " + std::to_string(n_max_) + " may be named here");
        names_.clear();
        titles_.clear();
        plugins_.clear();
        for (const std::string &part : parts)
          {
            try
              {
                const auto  &entry    = reader.registry().find(Interface::interface_name, Interface::dimension, part);
                unsigned int n_before = 0;
                for (const std::string &name : names_)
                  n_before += name == entry.name;
                names_.push_back(entry.name);
                titles_.push_back(n_before == 0 ? entry.name : entry.name + " " + std::to_string(n_before + 1));
                plugins_.push_back(reader.registry().create<Interface>(part));
              }
            catch (const std::runtime_error &error)
              {
                reader.fail(entry_, error.what());
              }
          }
        made_ = wanted;
        reader.note_new_plugin();
      }

    reader.add(entry_, value_, documentation_);
    for (std::size_t i = 0; i < plugins_.size(); ++i)
      {
        SectionScope scope(reader, titles_[i]);
        plugins_[i]->declare_parameters(reader);
      }
  }

  template <class Interface>
  void PluginList<Interface>::check_parameters(ParameterReader &reader) const
  {
    for (std::size_t i = 0; i < plugins_.size(); ++i)
      {
        SectionScope scope(reader, titles_[i]);
        plugins_[i]->check_parameters(reader);
      }
  }
} // namespace Breakwater
