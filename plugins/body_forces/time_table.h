#pragma once

#include <breakwater/base/timed_rows.h>

namespace Breakwater
{
  /// A quantity given at some times, linear in between and 0 before the first and after the last of them.
  class TimeTable
  {
  public:
    TimeTable() = default;

    /// As read_timed_rows(), one value a line. @throws InputError
    explicit TimeTable(const std::string &file);

    double value(double time) const;

  private:
    TimedRows table_;
  };
} // namespace Breakwater
