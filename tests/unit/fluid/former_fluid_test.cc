#include <pfem_fluid/former_fluid.h>

#include <gtest/gtest.h>

using namespace Breakwater;

namespace
{
  /// Two triangles 0 1 2 and 1 3 2, of a square with the corners 0, 1, 3, 2.
  SimplexMesh<2> square()
  {
    return {{{0, 1, 2}, {1, 3, 2}}, {{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
  }
  constexpr unsigned int new_node = 1000;
} // namespace


TEST(FormerFluid, KnowsItsCellsByTheirOldNumbers)
{
  const FormerFluid<2> former(square(), {3, 2, 1, 0, new_node}); // the numbers have been turned round
  EXPECT_TRUE(former.had({3, 2, 1}));
  EXPECT_TRUE(former.had({1, 3, 2}));
  EXPECT_FALSE(former.had({0, 1, 3})) << "3 2 0 was none";
  EXPECT_FALSE(former.had({0, 1, 4})) << "a new node";
}


TEST(FormerFluid, KnowsWhichSideOfItsSurfaceWasFluid)
{
  const FormerFluid<2> former(square(), {0, 1, 2, 3, new_node});
  EXPECT_TRUE(former.had_surface_of({0, 1, 4})) << "behind the side 0 1";
  EXPECT_FALSE(former.had_surface_of({1, 0, 4})) << "before it";
  EXPECT_FALSE(former.had_surface_of({1, 2, 4})) << "the diagonal was inside";
}


TEST(FormerFluid, FindsAFacetWhateverItsFirstNode)
{
  const SimplexMesh<3> one{{{0, 1, 2, 3}}, {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const FormerFluid<3> former(one, {0, 1, 2, 3, new_node});
  EXPECT_TRUE(former.had_surface_of({4, 1, 2, 3}));
  EXPECT_TRUE(former.had_surface_of({4, 3, 1, 2}));
  EXPECT_FALSE(former.had_surface_of({4, 2, 1, 3})) << "on the other side";
}
