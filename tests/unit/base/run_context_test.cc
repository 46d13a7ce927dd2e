#include "message_of.h"

#include <breakwater/base/run_context.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace Breakwater;

namespace
{
  std::string content_of(const std::filesystem::path &file)
  {
    std::ifstream      stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /// Uses CPU time.
  void work(const double seconds)
  {
    const double end = cpu_time() + seconds;
    while (cpu_time() < end)
      ;
  }
} // namespace

TEST(CsvTable, IsWholeAfterEveryRowAndGoesOnWhenAppended)
{
  const std::string file = "table.csv";
  {
    CsvTable table(file);
    table.add_row({{"time [s]", 0}, {"mass [kg]", 1. / 3}});
    EXPECT_EQ(content_of(file), "time [s],mass [kg]\n0,0.3333333333\n");
  }
  CsvTable table(file, true);
  table.add_row({{"time [s]", 1}, {"mass [kg]", 2}});
  EXPECT_EQ(content_of(file), "time [s],mass [kg]\n0,0.3333333333\n1,2\n");
  EXPECT_NE(message_of([&] {
              table.add_row({{"time [s]", 2}});
            }),
            "no error");
  EXPECT_NE(message_of([&] {
              table.add_row({{"time [s]", 2}, {"volume [m^3]", 2}});
            }),
            "no error");
}

TEST(PhaseTimer, DoesNotCountTheInnerPhaseInTheOuterOne)
{
  RunContext context(".");
  {
    PhaseTimer outer(context, Phase::solver);
    work(0.01);
    {
      PhaseTimer inner(context, Phase::remeshing);
      work(0.04);
    }
    EXPECT_LT(outer.seconds(), 0.03);
    work(0.01);
  }
  EXPECT_GE(context.cpu_seconds(Phase::solver), 0.02);
  EXPECT_LT(context.cpu_seconds(Phase::solver), 0.04);
  EXPECT_GE(context.cpu_seconds(Phase::remeshing), 0.04);
}

TEST(RunContext, KeepsTheLargestAndSurvivesSaveAndLoad)
{
  RunContext context(".");
  context.set_summary_max("gap", 1);
  context.set_summary_max("gap", 3);
  context.set_summary_max("gap", 2);
  context.cell_steps = 7;
  std::stringstream stream;
  context.save(stream);

  RunContext other(".");
  other.load(stream);
  EXPECT_EQ(other.summary().at("gap"), 3);
  EXPECT_EQ(other.cell_steps, 7ul);
}

TEST(RunContext, GivesTheReasonOfAnEffectThatIsLeftOut)
{
  RunContext context(".");
  context.note_effect("viscosity", false, "the fluid is inviscid");
  context.note_effect("tension", true, "");
  EXPECT_EQ(context.effects_skipped(), std::vector<std::string>{"viscosity (the fluid is inviscid)"});
  EXPECT_EQ(context.effects_active(), std::vector<std::string>{"tension"});
}
