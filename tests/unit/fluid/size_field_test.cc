#include <breakwater/base/exceptions.h>
#include <gtest/gtest.h>
#include <pfem_fluid/size_field.h>

using namespace Breakwater;

namespace
{
  const Vec<2> lower{{0, 0}}, upper{{2, 1}};

  Vec<2> at(const double x, const double y)
  {
    return {{x, y}};
  }
} // namespace


TEST(SizeField, OfANumberIsThatNumberEverywhere)
{
  const SizeField<2> size("0.0123", lower, upper);
  EXPECT_TRUE(size.is_uniform());
  EXPECT_EQ(size(at(5, -3)), 0.0123);
  EXPECT_EQ(size.smallest(), 0.0123);
}


TEST(SizeField, OfAConstantExpressionIsUniform)
{
  EXPECT_TRUE(SizeField<3>("0.1 / 4", {{0, 0, 0}}, {{1, 1, 1}}).is_uniform());
}


TEST(SizeField, FollowsALinearExpressionExactly)
{
  const SizeField<2> size("0.01 + 0.1*x + 0.05*y", lower, upper);
  EXPECT_FALSE(size.was_graded());
  EXPECT_NEAR(size(at(0.777, 0.123)), 0.01 + 0.0777 + 0.00615, 1e-12);
  EXPECT_NEAR(size.smallest(), 0.01, 1e-12);
  EXPECT_NEAR(size.largest(), 0.26, 1e-12);
}


TEST(SizeField, OutsideOfTheBoxIsThatOfTheNearestPlace)
{
  const SizeField<2> size("0.01 + 0.1*x", lower, upper);
  EXPECT_NEAR(size(at(-1, 0.5)), 0.01, 1e-12);
  EXPECT_NEAR(size(at(9, 7)), 0.21, 1e-12);
}


TEST(SizeField, AJumpIsGradedFromItsSmallSide)
{
  const SizeField<2> size("if(x < 0.5, 0.01, 0.4)", lower, upper);
  EXPECT_TRUE(size.was_graded());
  for (const double x : {0.55, 0.8, 1.2})
    EXPECT_NEAR(size(at(x, 0.5)), 0.01 + 0.3 * (x - 0.5), 0.001);
  EXPECT_NEAR(size(at(1.99, 0.5)), 0.4, 1e-12);
}


TEST(SizeField, GradesAroundAPointWithinEightPerCent)
{
  const SizeField<3> size("if(x*x + y*y + z*z < 0.01, 0.01, 1)", {{-1, -1, -1}}, {{1, 1, 1}});
  for (const Vec<3> &direction : {Vec<3>{{1, 0, 0}}, Vec<3>{{0.6, 0, 0.8}}, Vec<3>{{0.8, 0.5, 0.33}}})
    {
      const double distance = 0.8 * norm(direction);
      EXPECT_NEAR(size(direction * 0.8) / (0.01 + 0.3 * (distance - 0.1)), 1.05, 0.09);
    }
}


TEST(SizeField, ThatIsNotPositiveIsRefusedWithThePlace)
{
  try
    {
      SizeField<2>("x - 1", lower, upper);
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("it is -1 m at (0, 0) m"), std::string::npos) << error.what();
    }
  EXPECT_THROW(SizeField<2>("-1", lower, upper), InputError);
  EXPECT_THROW(SizeField<2>("fog(x)", lower, upper), InputError);
}
