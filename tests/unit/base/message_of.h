#pragma once

#include <breakwater/base/exceptions.h>

#include <string>

namespace Breakwater
{
  /// The message of the InputError that a call throws; "no error" if it throws none.
  template <class Call>
  std::string message_of(const Call &call)
  {
    try
      {
        call();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace Breakwater
