#pragma once

#include <string>
#include <vector>

namespace Breakwater
{
  /// Numbers at increasing times, as tables for motions and forces have them.
  struct TimedRows
  {
    std::vector<double>              times; ///< [s]
    std::vector<std::vector<double>> rows;  ///< of equal length
  };

  /// Reads lines "t, value, value..." separated by blanks or commas; what follows a # is a comment.
  /// @param n_least, n_most how many values may follow the time
  /// @throws InputError with the file and the line if the file can't be read, a line has another number of values or one
  /// that is not finite, the times don't increase, or there are fewer than two lines
  TimedRows read_timed_rows(const std::string &file, unsigned int n_least, unsigned int n_most);
} // namespace Breakwater
