#pragma once

#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/plugin.h>

namespace Breakwater::Testing
{
  /// An interface for the tests of base.
  class Law : public Plugin
  {
  public:
    static constexpr const char *interface_name = "law";
    static constexpr int         dimension      = 0;

    virtual double value() const = 0;
  };
} // namespace Breakwater::Testing
