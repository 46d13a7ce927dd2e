#pragma once

#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/plugin.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace Breakwater
{
  /// A parameter reader for unit tests: hands given values to a plugin's members, without a file.
  /// fail() throws InputError("ENTRY: message"); a value that no entry takes is an error.
  class GivenParameters : public ParameterReader
  {
  public:
    explicit GivenParameters(std::map<std::string, std::string> values)
      : values_(std::move(values))
    {
    }

    /// Reads the values into the plugin, then checks them.
    static void read(Plugin &plugin, std::map<std::string, std::string> values)
    {
      GivenParameters reader(std::move(values));
      plugin.declare_parameters(reader);
      for (const auto &[name, value] : reader.values_)
        if (reader.taken_.count(name) == 0)
          throw InputError(name + ": there is no such entry");
      plugin.check_parameters(reader);
    }

    void add(const std::string &name, double &member, const std::string &, const Range range) override
    {
      convert(name, member);
      if (!(member >= range.lower && member <= range.upper))
        fail(name, "out of range");
    }
    void add(const std::string &name, unsigned int &member, const std::string &, unsigned int, unsigned int) override
    {
      convert(name, member);
    }
    void add(const std::string &name, bool &member, const std::string &) override { convert(name, member); }
    void add(const std::string &name, std::string &member, const std::string &) override { take(name, member); }
    void add(const std::string &name, std::string &member, const std::string &,
             const std::vector<std::string> &choices) override
    {
      take(name, member);
      for (const std::string &choice : choices)
        if (choice == member)
          return;
      fail(name, "not one of the choices");
    }
    void add(const std::string &name, std::vector<std::string> &member, const std::string &) override
    {
      std::string text;
      if (take(name, text))
        member = {text};
    }
    void add(const std::string &name, std::vector<double> &member, const std::string &, unsigned int,
             unsigned int) override
    {
      std::string text;
      if (take(name, text))
        member = numbers(text);
    }

    void                     enter_section(const std::string &) override {}
    void                     leave_section() override {}
    std::vector<std::string> section_titles() const override { return {}; }
    std::string              where(const std::string &name) const override { return name; }
    const PluginRegistry    &registry() const override { return registry_; }
    void                     note_new_plugin() override {}

  protected:
    void add_fixed(const std::string &name, double *values, const unsigned int n, const std::string &) override
    {
      std::string text;
      if (!take(name, text))
        return;
      const std::vector<double> given = numbers(text);
      if (given.size() != n)
        fail(name, "wrong number of components");
      for (unsigned int i = 0; i < n; ++i)
        values[i] = given[i];
    }

  private:
    bool take(const std::string &name, std::string &member)
    {
      const auto value = values_.find(name);
      if (value == values_.end())
        return false;
      taken_[name] = true;
      member       = value->second;
      return true;
    }

    template <class Number>
    void convert(const std::string &name, Number &member)
    {
      std::string text;
      if (take(name, text))
        std::istringstream(text) >> member;
    }

    static std::vector<double> numbers(std::string text)
    {
      for (char &c : text)
        if (c == ',')
          c = ' ';
      std::istringstream  stream(text);
      std::vector<double> result;
      for (double number; stream >> number;)
        result.push_back(number);
      return result;
    }

    std::map<std::string, std::string> values_;
    std::map<std::string, bool>        taken_;
    PluginRegistry                     registry_;
  };
} // namespace Breakwater
