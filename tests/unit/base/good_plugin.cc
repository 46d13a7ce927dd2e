#include "test_interface.h"

#include <breakwater/base/plugin_export.h>

namespace
{
  class FromLibrary : public Breakwater::Testing::Law
  {
  public:
    double value() const override { return 42; }
  };
} // namespace

BREAKWATER_PLUGIN_LIBRARY(registry)
{
  registry.add<Breakwater::Testing::Law, FromLibrary>("From library", "a law of a loaded library");
}
