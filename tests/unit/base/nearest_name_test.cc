#include <breakwater/base/nearest_name.h>

#include <gtest/gtest.h>

using namespace Breakwater;

TEST(NearestName, CountsEditsAndSwapsAndIgnoresCase)
{
  EXPECT_EQ(edit_distance("Spacing", "spacing"), 0u);
  EXPECT_EQ(edit_distance("Spacng", "Spacing"), 1u);
  EXPECT_EQ(edit_distance("Spaicng", "Spacing"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(NearestName, NamesOnlyWhatIsSimilar)
{
  const std::vector<std::string> known = {"Density", "Viscosity", "Spacing"};
  EXPECT_EQ(nearest_name("density", known), "Density");
  EXPECT_EQ(nearest_name("Vicosity", known), "Viscosity");
  EXPECT_EQ(nearest_name("Colour", known), "");
  EXPECT_EQ(suggestion("Spacng", known), "; did you mean \"Spacing\"? Allowed here: Density, Viscosity, Spacing");
  EXPECT_EQ(suggestion("Colour", {}), "; allowed here: nothing");
}
