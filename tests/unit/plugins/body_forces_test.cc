#include <body_forces/expression_force.h>
#include <body_forces/gravity.h>
#include <body_forces/shaking_table.h>
#include <breakwater/base/parameter_file.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "given_parameters.h"
#include "unit/base/message_of.h"

using namespace Breakwater;

namespace
{
  template <int dim>
  void check_gravity(const std::string &acceleration, const Vec<dim> &expected)
  {
    Gravity<dim> gravity;
    GivenParameters::read(gravity, {{"Acceleration", acceleration}});
    EXPECT_TRUE(gravity.is_uniform());

    const Vec<dim>        place = {{0.3, -0.2}};
    std::vector<Vec<dim>> sum(2, place);
    gravity.add_acceleration(0.5, {place, place}, sum);
    for (int d = 0; d < dim; ++d)
      {
        EXPECT_DOUBLE_EQ(sum[1][d], place[d] + expected[d]);
        // the force is minus the gradient of the potential
        Vec<dim> forward = place, backward = place;
        forward[d] += 0.5;
        backward[d] -= 0.5;
        EXPECT_NEAR(gravity.potential(backward) - gravity.potential(forward), expected[d], 1e-12);
      }
  }

  TEST(Gravity, AcceleratesAndHasAPotential)
  {
    check_gravity<2>("1.5, -9.81", {{1.5, -9.81}});
    check_gravity<3>("0, -9.81, 2", {{0, -9.81, 2}});
  }

  TEST(Gravity, WantsOneComponentPerDimension)
  {
    Gravity<2> gravity;
    EXPECT_THROW(GivenParameters::read(gravity, {{"Acceleration", "0, -9.81, 0"}}), InputError);
  }

  using Values = std::map<std::string, std::string>;

  /// The acceleration [m/s^2] at a place and time.
  template <int dim>
  Vec<dim> acceleration_at(const BodyForce<dim> &force, const double time, const Vec<dim> &place)
  {
    std::vector<Vec<dim>> sum(1);
    force.add_acceleration(time, {place}, sum);
    return sum[0];
  }

  template <int dim>
  void check_equal(const Vec<dim> &a, const Vec<dim> &b)
  {
    for (int d = 0; d < dim; ++d)
      EXPECT_NEAR(a[d], b[d], 1e-14);
  }

  TEST(ExpressionForce, DependsOnPlaceAndTime)
  {
    ExpressionForce<2> force;
    GivenParameters::read(force, {{"Acceleration", "x*sin(pi*t), pow(y, 2) - if(x < 1, 0, 10)"}});
    EXPECT_FALSE(force.is_uniform());
    check_equal<2>(acceleration_at<2>(force, 0.5, {{0.3, 3}}), {{0.3, 9}});
    check_equal<2>(acceleration_at<2>(force, 0.25, {{2, 3}}), {{std::sqrt(2.), -1}});
    EXPECT_EQ(force.potential({{1, 2}}), 0.);

    ExpressionForce<3> in_space;
    GivenParameters::read(in_space, {{"Acceleration", "y, z, x + t"}});
    check_equal<3>(acceleration_at<3>(in_space, 10, {{1, 2, 3}}), {{2, 3, 11}});
  }

  TEST(ExpressionForce, AddsToWhatIsThere)
  {
    ExpressionForce<2> force;
    GivenParameters::read(force, {{"Acceleration", "x, -1"}});
    std::vector<Vec<2>> sum = {{{1, 2}}, {{3, 4}}};
    force.add_acceleration(0, {{{10, 0}}, {{20, 0}}}, sum);
    check_equal<2>(sum[0], {{11, 1}});
    check_equal<2>(sum[1], {{23, 3}});
  }

  TEST(ExpressionForce, PotentialIsAnExpressionOfThePlace)
  {
    ExpressionForce<2> force;
    GivenParameters::read(force, {{"Acceleration", "-4*x, -9.81"}, {"Potential", "2*x^2 + 9.81*y"}});
    EXPECT_DOUBLE_EQ(force.potential({{3, 2}}), 18 + 19.62);
    const double d = 1e-3;
    const auto   a = acceleration_at<2>(force, 0, {{3, 2}});
    EXPECT_NEAR((force.potential({{3 - d, 2}}) - force.potential({{3 + d, 2}})) / (2 * d), a[0], 1e-9);
    EXPECT_NEAR((force.potential({{3, 2 - d}}) - force.potential({{3, 2 + d}})) / (2 * d), a[1], 1e-9);
  }

  template <template <int> class Force>
  std::string message_about(const Values &values)
  {
    Force<2> force;
    return message_of([&] {
      GivenParameters::read(force, values);
    });
  }

  void expect_in(const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }

  TEST(ExpressionForce, SaysWhatIsWrong)
  {
    expect_in(message_about<ExpressionForce>({}), "Acceleration: the force is missing: give 2 expressions");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "0, 0, 1"}}),
              "Acceleration: 3 expressions where 2 are needed");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "0, x +"}}),
              "Acceleration: \"x +\" is no expression in x, y, t and pi: ");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "z, 0"}}), "Acceleration: \"z\" is no expression");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "0, "}}), "Acceleration: \"\" is no expression");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "0, rand()"}}), "must not use random numbers");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "0, 1"}, {"Potential", "y*t"}}),
              "Potential: \"y*t\" is no expression in x, y and pi: ");
    expect_in(message_about<ExpressionForce>({{"Acceleration", "0, 1"}, {"Potential", "y, x"}}),
              "Potential: 2 expressions where 1 is needed");
  }

  TEST(ExpressionForce, StopsWhereItHasNoFiniteValue)
  {
    ExpressionForce<2> force;
    GivenParameters::read(force, {{"Acceleration", "0, 1/x"}, {"Potential", "log(x)"}});
    EXPECT_NO_THROW(acceleration_at<2>(force, 0, {{1, 0}}));
    try
      {
        acceleration_at<2>(force, 0.25, {{0, 3}});
        ADD_FAILURE() << "no error";
      }
    catch (const BreakdownError &error)
      {
        expect_in(error.what(), "no finite value at (0, 3) m and 0.250000 s, component 2");
      }
    EXPECT_THROW(force.potential({{0, 3}}), BreakdownError);
  }

  TEST(ShakingTable, SineWithASmoothStart)
  {
    ShakingTable<2> table;
    GivenParameters::read(table, {{"Direction", "3, 4"}, {"Amplitude", "2"}, {"Frequency", "0.5"}, {"Ramp time", "1"}});
    EXPECT_FALSE(table.is_uniform());
    check_equal<2>(acceleration_at<2>(table, 0, {}), {{0, 0}});
    // half of the ramp: r = 1/2, sin(pi / 2)
    check_equal<2>(acceleration_at<2>(table, 0.5, {}), {{0.6, 0.8}});
    check_equal<2>(acceleration_at<2>(table, 2.5, {{7, 8}}), {{1.2, 1.6}});
    EXPECT_EQ(table.potential({{1, 1}}), 0.);
  }

  /// Writes a table for a test and gives its name.
  std::string table_file(const std::string &text)
  {
    const std::string name = testing::TempDir() + "breakwater_shaking_table.txt";
    std::ofstream(name) << text;
    return name;
  }

  TEST(ShakingTable, TableIsLinearBetweenItsTimes)
  {
    ShakingTable<3> table;
    GivenParameters::read(table,
                          {{"Direction", "0, 0, -2"},
                           {"Table file", table_file("# time, acceleration\n0.5 1\n1,3 # a comma\n\n 2\t-1\r\n")}});
    const double times[] = {0, 0.499, 0.5, 0.75, 1, 1.25, 2, 2.001}, expected[] = {0, 0, 1, 2, 3, 2, -1, 0};
    for (unsigned int i = 0; i < 8; ++i)
      check_equal<3>(acceleration_at<3>(table, times[i], {}), {{0, 0, -expected[i]}});
  }

  TEST(ShakingTable, SaysWhatIsWrong)
  {
    expect_in(message_about<ShakingTable>({}), "Amplitude: the shaking is missing");
    expect_in(message_about<ShakingTable>({{"Amplitude", "1"}, {"Direction", "0, 0"}}), "Direction: must not be zero");
    expect_in(message_about<ShakingTable>({{"Amplitude", "1"}, {"Table file", "a"}}), "Amplitude: give either");
    expect_in(message_about<ShakingTable>({{"Ramp time", "1"}, {"Table file", "a"}}), "Ramp time: a table file");
    expect_in(message_about<ShakingTable>({{"Amplitude", "1"}, {"Frequency", "0"}}), "Frequency: out of range");

    const auto message_about_table = [](const std::string &text) {
      return message_about<ShakingTable>({{"Table file", table_file(text)}});
    };
    expect_in(message_about<ShakingTable>({{"Table file", "/nowhere/table"}}),
              "Table file: can't read the file \"/nowhere/table\"");
    expect_in(message_about_table("0 1\n2 1\n1 0\n"),
              "table.txt:3: the times must increase, but 1.000000 s follows 2.000000 s");
    expect_in(message_about_table("0 1\n0 1\n"), "table.txt:2: the times must increase");
    expect_in(message_about_table("time acceleration\n0 1\n"), "table.txt:1: wanted the time and 1 number");
    expect_in(message_about_table("0 1\n1 2 3\n"), "table.txt:2: wanted the time and 1 number");
    expect_in(message_about_table("0 1\n1\n"), "table.txt:2: wanted the time and 1 number");
    expect_in(message_about_table("0 1\n1 2x\n"), "table.txt:2: wanted the time and 1 number");
    expect_in(message_about_table("0 1\n"), "needs two lines or more, it has 1");
    expect_in(message_about_table(""), "needs two lines or more, it has 0");
    expect_in(message_about<ShakingTable>({{"Table file", testing::TempDir()}}), "Table file: ");
  }

  /// What the user sees of an error in an expression: file, line, entry and value.
  TEST(ExpressionForce, ErrorsNameTheLineOfTheFile)
  {
    std::istringstream text("set Potential = y\nset Acceleration = 0, x +\n");
    ExpressionForce<2> force;
    const std::string  message = message_of([&] {
      read_parameters(force, PluginRegistry(), scan_parameters(text, "scene.prm"));
    });
    expect_in(message, "scene.prm:2: ");
    expect_in(message, "entry \"Acceleration\", value \"0, x +\"");
  }
} // namespace
