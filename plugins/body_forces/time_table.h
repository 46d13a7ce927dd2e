#pragma once

#include <string>
#include <vector>

namespace Breakwater
{
  /// A quantity given at some times, linear in between and 0 before the first and after the last of them.
  class TimeTable
  {
  public:
    TimeTable() = default;

    /// Reads lines "time value" in two columns separated by blanks or a comma; what follows a # is a comment.
    /// @throws InputError if the file can't be read, a line has another form, or the times don't increase
    explicit TimeTable(const std::string &file);

    double value(double time) const;

  private:
    std::vector<double> times_; ///< increasing [s]
    std::vector<double> values_;
  };
} // namespace Breakwater
