#include "cloud.h"

#include <pfem_fluid/openings.h>
#include <unit/base/message_of.h>
#include <unit/plugins/given_parameters.h>

using namespace Breakwater;

namespace
{
  constexpr double density = 1000;

  using Values = std::map<std::string, std::string>;

  template <int dim>
  Inflow<dim> inflow_of(const Values &values)
  {
    GivenParameters reader(values);
    Inflow<dim>     inflow("Jet");
    inflow.declare_parameters(reader);
    inflow.check_parameters(reader);
    inflow.set_up(SizeField<dim>(0.01), density);
    return inflow;
  }

  const Values segment_2d = {
    {"Opening", "segment(0, 1; 0.1, 1)"}, {"Normal", "0, -2"}, {"Speed", "2*t"}, {"Until", "1"}};
  const Values disc_3d      = {{"Opening", "disc(0, 1, 0; 0.05)"}, {"Normal", "0, -1, 0"}, {"Flow rate", "0.01"}};
  const Values rectangle_3d = {
    {"Opening", "rectangle(0, 1, 0; 0.1, 1, 0; 0, 1, 0.07)"}, {"Normal", "0, -1, 0"}, {"Speed", "1"}};

  Values with(Values values, const std::string &entry, const std::string &value)
  {
    values[entry] = value;
    return values;
  }
} // namespace


TEST(Inflow, ALayerHasTheMassOfOneSpacingInSegmentsDiscsAndRectangles)
{
  const auto check = [](auto jet, auto nodes, const double area) {
    (void)jet.advance(0, 1);
    ASSERT_TRUE(jet.layer_is_due());
    jet.add_layer(nodes, 1, 1);
    double mass = 0, least = 1e300;
    for (const double m : nodes.mass)
      {
        mass += m;
        least = std::min(least, m);
      }
    EXPECT_NEAR(mass / (density * area * 0.01), 1., 1e-13);
    EXPECT_NEAR(jet.mass(), mass, 1e-13 * mass);
    EXPECT_GT(least, 0.15 * mass / nodes.n);
  };
  check(inflow_of<2>(segment_2d), FluidNodes<2>(), 0.1);
  check(inflow_of<3>(disc_3d), FluidNodes<3>(), 3.14159265358979323846 * 0.0025);
  check(inflow_of<3>(rectangle_3d), FluidNodes<3>(), 0.007);
}


TEST(Inflow, LayersStandWhereThePlugHasTakenThem)
{
  Inflow<2>     jet = inflow_of<2>(segment_2d);
  FluidNodes<2> nodes;
  // Speed 2 t: after 0.2 s the way is 0.04 m, which is 3 layers and a half.
  for (int step = 0; step < 20; ++step)
    (void)jet.advance(0.01 * step, 0.01);
  for (int layer = 0; layer < 4; ++layer)
    {
      ASSERT_TRUE(jet.layer_is_due());
      jet.add_layer(nodes, 0.2, 1);
      EXPECT_NEAR(nodes.xp[nodes.n - 1][1], 1 - 0.04 + (layer + 0.5) * 0.01, 1e-12);
      EXPECT_NEAR(nodes.v[nodes.n - 1][1], -0.4, 1e-12);
      EXPECT_EQ(nodes.inflow[nodes.n - 1], 1);
    }
  EXPECT_FALSE(jet.layer_is_due());
  EXPECT_FALSE(jet.has_released({{0.05, 0.985}}));
  EXPECT_TRUE(jet.has_released({{0.05, 0.975}}));
}


TEST(Inflow, MovesOnlyWhileItIsOpen)
{
  Inflow<2> jet = inflow_of<2>(with(segment_2d, "From", "0.5"));
  EXPECT_EQ(norm(jet.advance(0, 0.1)), 0.);
  EXPECT_NEAR(norm(jet.advance(0.45, 0.1)), 0.5 * 2 * 0.525, 1e-12) << "half of the step";
  EXPECT_EQ(norm(jet.advance(1, 0.1)), 0.);
  EXPECT_FALSE(jet.is_open(0.4));
  EXPECT_TRUE(jet.is_open(0.5));
  EXPECT_FALSE(jet.is_open(1));
}


TEST(Inflow, FlowRateIsSpeedTimesArea)
{
  EXPECT_NEAR(inflow_of<3>(disc_3d).velocity(0)[1], -0.01 / (3.14159265358979323846 * 0.0025), 1e-12);
}


TEST(Inflow, WrongEntriesAreExplained)
{
  const std::vector<std::pair<Values, std::string>> cases = {
    {with(segment_2d, "Normal", "0, 0"), "the direction of the flow is missing"},
    {with(segment_2d, "Normal", "1, -1"), "not at a right angle"},
    {with(segment_2d, "Opening", "disc(0, 1; 1)"), "there is no shape \"disc\" in 2D"},
    {with(segment_2d, "Opening", ""), "a shape is missing"},
    {with(segment_2d, "Flow rate", "1"), "either the speed or the flow rate"},
    {with(segment_2d, "Speed", ""), "either the speed or the flow rate"},
    {with(segment_2d, "Speed", "fast"), "\"fast\" is no expression"},
    {with(segment_2d, "Speed", "t - 1"), "it must be finite and not negative"},
    {with(segment_2d, "From", "2"), "must end after it has started"}};
  for (const auto &[values, expected] : cases)
    {
      const std::string message = message_of([&, v = values]() {
        inflow_of<2>(v);
      });
      EXPECT_NE(message.find(expected), std::string::npos) << message << " instead of " << expected;
    }
  EXPECT_THROW(inflow_of<2>(with(segment_2d, "Speed", "1 - t")).velocity(2), BreakdownError);
}


TEST(FluidNodes, RemoveKeepsTheOrderOfTheOthers)
{
  FluidNodes<2> nodes;
  nodes.resize(5);
  for (std::size_t i = 0; i < 5; ++i)
    nodes.mass[i] = nodes.xp[i][1] = i;
  nodes.remove({0, 1, 0, 1, 0});
  ASSERT_EQ(nodes.n, 3u);
  for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(nodes.mass[i], 2. * i);
      EXPECT_EQ(nodes.xp[i][1], 2. * i);
    }
  EXPECT_EQ(nodes.volume.size(), 3u);
}
