#include <breakwater/base/exceptions.h>
#include <breakwater/simulation/ties.h>

#include <gtest/gtest.h>

using namespace Breakwater;

namespace
{
  std::string message_of(const std::vector<std::string> &texts, const bool has_fluid,
                         const std::vector<std::string> &structures)
  {
    try
      {
        find_ties(texts, has_fluid, structures);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no InputError";
  }
} // namespace

TEST(Ties, AreReadFromText)
{
  EXPECT_EQ(parse_ties({" Fluid and  My gate ", "My gate and B"}),
            (std::vector<TiedNames>{{"Fluid", "My gate"}, {"My gate", "B"}}));
  EXPECT_THROW(parse_ties({"Fluid, Gate"}), InputError);
}

TEST(Ties, GoWithoutSayingForAFluidAndForTwoStructures)
{
  EXPECT_EQ(find_ties({}, true, {"A", "B"}), (std::vector<TiedNames>{{"Fluid", "A"}, {"Fluid", "B"}}));
  EXPECT_EQ(find_ties({}, false, {"A", "B"}), (std::vector<TiedNames>{{"A", "B"}}));
  EXPECT_NE(message_of({}, false, {"A", "B", "C"}).find("say which of the structures are tied"), std::string::npos);
}

TEST(Ties, AChainReachesTheFluid)
{
  EXPECT_EQ(find_ties({"Fluid and A", "C and B", "B and A"}, true, {"A", "B", "C"}).size(), 3u);
  EXPECT_NE(message_of({"Fluid and A", "B and C"}, true, {"A", "B", "C"}).find("nothing ties \"B\" to the fluid"),
            std::string::npos);
}

TEST(Ties, SayWhatIsWrong)
{
  EXPECT_NE(message_of({"Fluid and Gat"}, true, {"Gate"}).find("no body is called \"Gat\"; did you mean \"Gate\""),
            std::string::npos)
    << message_of({"Fluid and Gat"}, true, {"Gate"});
  EXPECT_NE(message_of({"A and A"}, false, {"A", "B"}).find("tied to itself"), std::string::npos);
  EXPECT_NE(message_of({"A and B", "B and A"}, false, {"A", "B"}).find("tied twice"), std::string::npos);
}
