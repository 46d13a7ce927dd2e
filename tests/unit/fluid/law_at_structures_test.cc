#include <gtest/gtest.h>
#include <pfem_fluid/law_at_structures.h>
#include <unit/base/message_of.h>

using namespace Breakwater;

namespace
{
  using Slips = std::vector<char>;

  /// Three facets of two bodies.
  WetSurface<2> gate_and_flap()
  {
    WetSurface<2> surface;
    surface.position.resize(4);
    surface.facets        = {{0, 1}, {1, 2}, {2, 3}};
    surface.bodies        = {"Gate", "Flap"};
    surface.body_of_facet = {0, 1, 0};
    return surface;
  }

  Slips slips(const std::string &text)
  {
    return LawAtStructures(text).slips(gate_and_flap());
  }

  std::string complaint(const std::string &text)
  {
    return message_of([&text]() {
      slips(text);
    });
  }
} // namespace


TEST(LawAtStructures, IsOneForAllOrOneForEach)
{
  EXPECT_EQ(slips("no slip"), Slips({0, 0, 0}));
  EXPECT_EQ(slips("free slip"), Slips({1, 1, 1}));
  EXPECT_EQ(slips("Gate: free slip, Flap: no slip"), Slips({1, 0, 1}));
  EXPECT_EQ(slips("Flap: free slip"), Slips({0, 1, 0})) << "no slip where nothing is said";
  EXPECT_EQ(LawAtStructures("free slip").slips(WetSurface<2>()), Slips());
}


TEST(LawAtStructures, SaysWhetherAnySlips)
{
  EXPECT_TRUE(LawAtStructures("free slip").asks_for_slip());
  EXPECT_TRUE(LawAtStructures("Gate: no slip, Flap: free slip").asks_for_slip());
  EXPECT_FALSE(LawAtStructures("Gate: no slip").asks_for_slip());
}


TEST(LawAtStructures, SaysWhatIsWrong)
{
  EXPECT_EQ(complaint("fre slip"),
            "the law \"fre slip\" is unknown; did you mean \"free slip\"? Allowed here: no slip, free slip");
  EXPECT_EQ(complaint("Gat: free slip"), "no structure that meets the fluid is called \"Gat\"; did you mean "
                                         "\"Gate\"? Allowed here: Gate, Flap");
  EXPECT_EQ(complaint("Gate: free slip, no slip"),
            "can't read \"no slip\"; the form of a list is NAME: LAW, several of them separated by commas");
  EXPECT_EQ(complaint("Gate: free slip, Gate: no slip"), "\"Gate\" is named twice");
  EXPECT_EQ(complaint(""), "a law is needed: no slip or free slip");
  EXPECT_EQ(message_of([]() {
              LawAtStructures("Gate: free slip").slips(WetSurface<2>());
            }),
            "no structure that meets the fluid is called \"Gate\"");
}
