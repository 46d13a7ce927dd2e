#pragma once

#include <string>
#include <utility>
#include <vector>

namespace Breakwater
{
  /// A JSON object that is written member by member, in their order. A number that is not finite becomes null.
  class JsonObject
  {
  public:
    void add(const std::string &name, double value);
    void add(const std::string &name, unsigned long value);
    void add(const std::string &name, const std::string &value);
    void add(const std::string &name, const std::vector<std::string> &values);
    void add(const std::string &name, const std::vector<std::pair<std::string, double>> &members);
    void add(const std::string &name, const std::vector<std::pair<std::string, std::string>> &members);

    /// The whole object, with a line break at its end.
    std::string text() const;

    /// Names and values, the values as JSON.
    const std::vector<std::pair<std::string, std::string>> &members() const { return members_; }

  private:
    std::vector<std::pair<std::string, std::string>> members_;
  };
} // namespace Breakwater
