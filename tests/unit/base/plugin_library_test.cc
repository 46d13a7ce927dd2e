#include "message_of.h"
#include "test_interface.h"

#include <breakwater/base/abi.h>
#include <breakwater/base/plugin_library.h>

#include <gtest/gtest.h>

using namespace Breakwater;

namespace
{
  std::string message_of_loading(const std::string &name)
  {
    PluginRegistry  registry;
    PluginLibraries libraries({BREAKWATER_TEST_TINY_PLUGINS});
    return message_of([&] {
      libraries.load(name, registry);
    });
  }

  bool contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace

TEST(PluginLibraries, LoadsAndRegistersOnce)
{
  PluginRegistry  registry;
  PluginLibraries libraries({"/nowhere", BREAKWATER_TEST_TINY_PLUGINS});
  libraries.load("good_plugin", registry);
  libraries.load("good_plugin", registry);
  EXPECT_EQ(registry.create<Testing::Law>("from library")->value(), 42);
  EXPECT_EQ(registry.find("law", 0, "From library").library, "good_plugin");
}

TEST(PluginLibraries, RefusesAnotherAbiWithBothTagsBeforeItRegisters)
{
  const std::string message = message_of_loading("wrong_abi_plugin");
  EXPECT_TRUE(contains(message, "was built for \"breakwater-abi-0 deal.II-0 another compiler\"")) << message;
  EXPECT_TRUE(contains(message, "but this program is \"" BREAKWATER_ABI_TAG "\"")) << message;
}

TEST(PluginLibraries, RefusesWhatIsNoPluginLibrary)
{
  EXPECT_TRUE(contains(message_of_loading("no_plugin"), "is no plugin library of Breakwater"));
}

TEST(PluginLibraries, LoadsBareNamesOnly)
{
  const std::string folder = BREAKWATER_TEST_TINY_PLUGINS;
  for (const std::string &name : {folder + "/good_plugin", std::string("../plugins/good_plugin"),
                                  std::string("./good_plugin"), std::string("..good_plugin"), std::string()})
    EXPECT_TRUE(contains(message_of_loading(name), "must be a bare name")) << name;
}

TEST(PluginLibraries, NamesTheNearestLibraryAndThePlacesLookedAt)
{
  const std::string message = message_of_loading("god_plugin");
  EXPECT_TRUE(contains(message, "did you mean \"good_plugin\"? Allowed here: good_plugin, no_plugin, wrong_abi_plugin"))
    << message;
  EXPECT_TRUE(contains(message, BREAKWATER_TEST_TINY_PLUGINS)) << message;
}

TEST(PluginLibraries, SearchesWhatTheCommandLineAndTheEnvironmentAdd)
{
  setenv("BREAKWATER_PLUGIN_PATH", "/one:/two", 1);
  const auto folders = PluginLibraries::default_folders({"/zero"});
  unsetenv("BREAKWATER_PLUGIN_PATH");
  ASSERT_GE(folders.size(), 4u);
  EXPECT_EQ(folders[0], "/zero");
  EXPECT_EQ(folders[1], "/one");
  EXPECT_EQ(folders[2], "/two");
}
