#pragma once

#include <stdexcept>
#include <string>

namespace Breakwater
{
  /// The user's input is wrong: one message that names the file, the section, the value seen and what is allowed.
  /// Caught in main alone; exit status 1.
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A numerical breakdown: the run can't go on. The message names the cell or node, the place, the time and the
  /// cause. Caught in main alone, after outputs were closed; exit status 2.
  class BreakdownError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace Breakwater
