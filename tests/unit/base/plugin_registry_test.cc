#include "message_of.h"
#include "test_interface.h"

#include <breakwater/base/plugin_registry.h>

#include <gtest/gtest.h>

using namespace Breakwater;
using Testing::Law;

namespace
{
  class One : public Law
  {
  public:
    double value() const override { return 1; }
  };
  class Two : public Law
  {
  public:
    double value() const override { return 2; }
  };
} // namespace

TEST(PluginRegistry, MakesPluginsByNameWithoutRegardToCase)
{
  PluginRegistry registry;
  registry.add<Law, One>("Law one", "");
  registry.add<Law, Two>("Law two", "");
  EXPECT_EQ(registry.create<Law>("law TWO")->value(), 2);
  EXPECT_EQ(registry.find("law", 0, "LAW one").name, "Law one");
  EXPECT_EQ(registry.names("law", 0), (std::vector<std::string>{"Law one", "Law two"}));
}

TEST(PluginRegistry, NamesTheNearestForAnUnknownOne)
{
  PluginRegistry registry;
  registry.add<Law, One>("Newtonian", "");
  EXPECT_EQ(message_of([&] {
              registry.create<Law>("newtonan");
            }),
            "no law is called \"newtonan\"; did you mean \"Newtonian\"? Allowed here: Newtonian");
}

TEST(PluginRegistry, SaysThatNoLibraryHasAnInterface)
{
  const PluginRegistry registry;
  EXPECT_EQ(message_of([&] {
              registry.find("material", 3, "rubber");
            }),
            "no material (in 3D) is called \"rubber\": none of the loaded plugin libraries has a material (in 3D); "
            "name its library in \"Plugin libraries\"");
}

TEST(PluginRegistry, RefusesASecondPluginOfTheSameName)
{
  PluginRegistry registry;
  registry.set_current_library("first");
  registry.add<Law, One>("Law", "");
  registry.set_current_library("second");
  EXPECT_EQ(message_of([&] {
              registry.add<Law, Two>("LAW", "");
            }),
            "the law \"LAW\" of the library \"second\" is already there, from the library \"first\"; load only one "
            "of them");
}
