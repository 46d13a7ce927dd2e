#include <breakwater/base/exceptions.h>
#include <breakwater/simulation/energy_rise.h>
#include <breakwater/simulation/field_output.h>
#include <breakwater/simulation/json_object.h>
#include <breakwater/simulation/probe.h>

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

using namespace Breakwater;

TEST(EnergyRise, IsTheLargestWithinAnyWindow)
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const double                           window = 0.05;
  for (unsigned int trial = 0; trial < 50; ++trial)
    {
      std::vector<double> times, energies;
      EnergyRise          rise(window);
      double              time = 0, exact = 0;
      for (unsigned int i = 0; i < 200; ++i)
        {
          time += 0.01 * uniform(random);
          times.push_back(time);
          energies.push_back(uniform(random) - 0.02 * i);
          rise.add(time, energies.back());
          for (unsigned int j = 0; j < i; ++j)
            if (times[j] >= time - window)
              exact = std::max(exact, energies[i] - energies[j]);
        }
      EXPECT_DOUBLE_EQ(rise.largest(), exact);
    }
}

TEST(EnergyRise, ForgetsWhatIsOlderThanTheWindow)
{
  EnergyRise rise(1);
  rise.add(0, 0);
  rise.add(0.9, 1);
  rise.add(1.8, 2);
  rise.add(5, 100);
  EXPECT_EQ(rise.largest(), 1);
}

TEST(EnergyRise, GoesOnAfterSaveAndLoad)
{
  EnergyRise rise(1), copy(1);
  rise.add(0, 3);
  rise.add(0.5, 1);
  std::stringstream stream;
  rise.save(stream);
  copy.load(stream);
  copy.add(1.2, 5);
  EXPECT_EQ(copy.largest(), 4);
}

TEST(JsonObject, EscapesTextAndHasNoInfiniteNumbers)
{
  JsonObject object;
  object.add("name", std::string("a \"b\"\n\\"));
  object.add("number", 0.1);
  object.add("infinite", 1. / 0.);
  object.add("count", 3ul);
  object.add("list", std::vector<std::string>{"x", "y"});
  object.add("inner", std::vector<std::pair<std::string, double>>{{"a", 1}, {"b", 2}});
  EXPECT_EQ(object.text(), "{\n  \"name\": \"a \\\"b\\\"\\u000a\\\\\",\n  \"number\": 0.1,\n  \"infinite\": null,\n"
                           "  \"count\": 3,\n  \"list\": [\"x\", \"y\"],\n  \"inner\": {\"a\": 1, \"b\": 2}\n}\n");
}

TEST(Probes, AreReadFromText)
{
  const auto probes = parse_probes("tip: My wall(0.1, -2e-3, 3); other: B(1, 2);");
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[0].name, "tip");
  EXPECT_EQ(probes[0].domain, "My wall");
  EXPECT_EQ(probes[0].point, (std::vector<double>{0.1, -2e-3, 3}));
  EXPECT_EQ(probes[1].domain, "B");
  EXPECT_TRUE(parse_probes(" ").empty());
  for (const char *wrong : {"tip", "tip: B", "B(1, 2)", "tip: B(1, x)", "tip: B(1, 2", "a(b: c)"})
    EXPECT_THROW(parse_probes(wrong), InputError) << wrong;
}

TEST(FieldOutput, WritesLooseNodesApartAndRemovesAnEarlierRun)
{
  namespace fs = std::filesystem;
  fs::create_directories("fields");
  OutputMesh<2> mesh;
  mesh.position = {{{0, 0}}, {{1, 0}}, {{0, 1}}, {{2, 2}}};
  mesh.cells    = {0, 1, 2};
  mesh.fields   = {{"pressure", 1, {1, 2, 3, 4}}, {"velocity", 2, {0, 0, 0, 0, 0, 0, 1, 1}}};
  {
    FieldOutput output("fields");
    output.write<2>(0.25, {{"My water", mesh}});
  }
  std::ifstream      stream("fields/solution.pvd");
  std::ostringstream pvd;
  pvd << stream.rdbuf();
  EXPECT_NE(pvd.str().find("timestep=\"0.25\" group=\"\" part=\"0\" name=\"My water\" file=\"My_water-0001.vtu\""),
            std::string::npos)
    << pvd.str();
  EXPECT_NE(pvd.str().find("file=\"My_water-nodes-0001.vtu\""), std::string::npos) << pvd.str();
  EXPECT_TRUE(fs::exists("fields/My_water-nodes-0001.vtu"));

  FieldOutput("fields").remove_earlier();
  EXPECT_TRUE(fs::is_empty("fields"));
}
