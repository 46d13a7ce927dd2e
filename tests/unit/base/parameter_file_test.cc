#include "message_of.h"
#include "test_interface.h"

#include <breakwater/base/parameter_file.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace Breakwater;
using Testing::Law;

namespace
{
  class Spring : public Law
  {
  public:
    void declare_parameters(ParameterReader &reader) override
    {
      reader.add("Stiffness", stiffness_, "Stiffness [N/m].", Range::positive());
    }
    void check_parameters(ParameterReader &reader) override
    {
      if (stiffness_ > 1000)
        reader.fail("Stiffness", "is too stiff for the step; take at most 1000");
    }
    double value() const override { return stiffness_; }

  private:
    double stiffness_ = 10;
  };

  /// A law that chooses laws: plugins of plugins take more passes.
  class Series : public Law
  {
  public:
    Series()
      : laws_("Laws", "", "The laws in series.")
    {
    }
    void   declare_parameters(ParameterReader &reader) override { laws_.declare_parameters(reader); }
    void   check_parameters(ParameterReader &reader) override { laws_.check_parameters(reader); }
    double value() const override
    {
      double sum = 0;
      for (const auto &law : laws_.plugins())
        sum += law->value();
      return sum;
    }

  private:
    PluginList<Law> laws_;
  };

  struct Scene : public Plugin
  {
    double                        spacing = 0.1;
    unsigned int                  degree  = 1;
    bool                          is_wet  = false;
    std::string                   title;
    std::string                   side = "left";
    std::vector<std::string>      names;
    std::vector<double>           numbers;
    Vec<2>                        place{{1, 2}};
    PluginList<Law>               laws{"Laws", "spring", "Laws."};
    std::map<std::string, double> walls;

    void declare_parameters(ParameterReader &reader) override
    {
      reader.add("Spacing", spacing, "Spacing [m].", Range::positive());
      reader.add("Degree", degree, "Degree.", 1, 2);
      reader.add("Wet", is_wet, "Wet?");
      reader.add("Title", title, "Title.");
      reader.add("Side", side, "Side.", {"left", "right"});
      reader.add("Names", names, "Names.");
      reader.add("Numbers", numbers, "Numbers.", 0, 3);
      reader.add("Place", place, "Place [m].");
      {
        SectionScope scope(reader, "Laws");
        laws.declare_parameters(reader);
      }
      SectionScope scope(reader, "Walls");
      for (const std::string &title : reader.section_titles())
        walls.emplace(title, 0.);
      for (auto &[title, height] : walls)
        {
          SectionScope inner_scope(reader, title);
          reader.add("Height", height, "Height [m].", Range{0, 5});
        }
    }
    void check_parameters(ParameterReader &reader) override
    {
      SectionScope scope(reader, "Laws");
      laws.check_parameters(reader);
    }
  };

  PluginRegistry laws()
  {
    PluginRegistry registry;
    registry.add<Law, Spring>("Spring", "a spring");
    registry.add<Law, Series>("Series", "laws in series");
    return registry;
  }

  ParameterText text_of(const std::string &text)
  {
    std::istringstream stream(text);
    return scan_parameters(stream, "scene.prm");
  }

  Scene scene_of(const std::string &text)
  {
    Scene scene;
    read_parameters(scene, laws(), text_of(text));
    return scene;
  }

  std::string error_of(const std::string &text)
  {
    return message_of([&] {
      scene_of(text);
    });
  }
} // namespace

TEST(ParameterFile, GivesMembersTheirValues)
{
  const Scene scene = scene_of("set Spacing = 2.5e-1  # a comment\n"
                               "set Degree=2\n"
                               "SET wet = true\n"
                               "set Title = a title \\ # goes on\n   in two lines\n"
                               "set side = RIGHT\n"
                               "set Names = a, b c\n"
                               "set Numbers = 1, 2.5\n"
                               "set Place = 3, -4\n");
  EXPECT_EQ(scene.spacing, 0.25);
  EXPECT_EQ(scene.degree, 2u);
  EXPECT_TRUE(scene.is_wet);
  EXPECT_EQ(scene.title, "a title in two lines");
  EXPECT_EQ(scene.side, "right");
  EXPECT_EQ(scene.names, (std::vector<std::string>{"a", "b c"}));
  EXPECT_EQ(scene.numbers, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(scene.place[1], -4);
}

TEST(ParameterFile, KeepsDefaultsOfWhatIsNotSet)
{
  const Scene scene = scene_of("");
  EXPECT_EQ(scene.spacing, 0.1);
  EXPECT_EQ(scene.laws.front().value(), 10);
}

TEST(ParameterFile, GivesTwoInstancesOfAPluginTwoSections)
{
  const Scene scene = scene_of("subsection Laws\n"
                               "  set Laws = spring, spring\n"
                               "  subsection Spring\n set Stiffness = 3\n end\n"
                               "  subsection Spring 2\n set Stiffness = 4\n end\n"
                               "end\n");
  ASSERT_EQ(scene.laws.size(), 2u);
  EXPECT_EQ(scene.laws[0].value(), 3);
  EXPECT_EQ(scene.laws[1].value(), 4);
}

TEST(ParameterFile, ReadsPluginsOfPlugins)
{
  const Scene scene = scene_of("subsection Laws\n"
                               "  set Laws = series\n"
                               "  subsection Series\n"
                               "    set Laws = series, spring\n"
                               "    subsection Series\n"
                               "      set Laws = spring\n"
                               "      subsection Spring\n set Stiffness = 100\n end\n"
                               "    end\n"
                               "    subsection Spring\n set Stiffness = 20\n end\n"
                               "  end\n"
                               "end\n");
  EXPECT_EQ(scene.laws.front().value(), 120);
}

TEST(ParameterFile, ReadsSectionsThatTheUserNames)
{
  const Scene scene = scene_of("subsection Walls\n"
                               "  subsection Tank\n set Height = 1\n end\n"
                               "  subsection My lid\n set Height = 2\n end\n"
                               "end\n");
  EXPECT_EQ(scene.walls, (std::map<std::string, double>{{"Tank", 1}, {"My lid", 2}}));
}

TEST(ParameterFile, FindsFilesBesideItself)
{
  struct Wall : Plugin
  {
    std::string path;
    void        declare_parameters(ParameterReader &reader) override
    {
      std::string name = "tank.stl";
      reader.add("File", name, "File.");
      path = reader.file_path(name).string();
    }
  };
  const auto path_of = [](const std::string &scene, const std::string &file) {
    std::istringstream stream("set File = " + file);
    Wall               wall;
    read_parameters(wall, laws(), scan_parameters(stream, scene));
    return wall.path;
  };
  EXPECT_EQ(path_of("folder/scene.prm", "tank.stl"), "folder/tank.stl");
  EXPECT_EQ(path_of("scene.prm", "tank.stl"), "tank.stl");
  EXPECT_EQ(path_of("folder/scene.prm", "/there/tank.stl"), "/there/tank.stl");
}

TEST(ParameterFile, NamesTheNearestEntryForAnUnknownOne)
{
  EXPECT_EQ(error_of("\nset Spacng = 1\n"),
            "scene.prm:2: at the top level, the entry \"Spacng\" is unknown; did you mean \"Spacing\"? Allowed here: "
            "Degree, Names, Numbers, Place, Side, Spacing, Title, Wet");
  EXPECT_EQ(error_of("subsection Laws\n subsection Spring\n set Stifness = 1\n end\nend\n"),
            "scene.prm:3: in section \"Laws/Spring\", the entry \"Stifness\" is unknown; did you mean \"Stiffness\"? "
            "Allowed here: Stiffness");
}

TEST(ParameterFile, NamesTheNearestSectionForAnUnknownOne)
{
  EXPECT_EQ(error_of("subsection Lawss\nend\n"),
            "scene.prm:1: at the top level, the section \"Lawss\" is unknown; did you mean \"Laws\"? Allowed here: "
            "Laws, Walls (a plugin's section is known where that plugin is chosen)");
}

TEST(ParameterFile, TellsWhatIsAllowedForAValueOutOfRange)
{
  EXPECT_EQ(error_of("set Spacing = -1\n"),
            "scene.prm:1: at the top level, entry \"Spacing\", value \"-1\": allowed: a number > 0");
  EXPECT_EQ(error_of("set Spacing = nan\n"),
            "scene.prm:1: at the top level, entry \"Spacing\", value \"nan\": allowed: a number > 0");
  EXPECT_EQ(error_of("set Degree = 3\n"),
            "scene.prm:1: at the top level, entry \"Degree\", value \"3\": allowed: a whole number >= 1 and <= 2");
  EXPECT_EQ(error_of("set Wet = perhaps\n"),
            "scene.prm:1: at the top level, entry \"Wet\", value \"perhaps\": allowed: true or false");
  EXPECT_EQ(
    error_of("set Side = lft\n"),
    "scene.prm:1: at the top level, entry \"Side\", value \"lft\": did you mean \"left\"? allowed: left, right");
  EXPECT_EQ(
    error_of("set Place = 1, 2, 3\n"),
    "scene.prm:1: at the top level, entry \"Place\", value \"1, 2, 3\": allowed: 2 numbers, separated by commas");
  EXPECT_EQ(error_of("set Numbers = 1, 2, 3, 4\n"),
            "scene.prm:1: at the top level, entry \"Numbers\", value \"1, 2, 3, 4\": allowed: 0 to 3 numbers, "
            "separated by commas");
  EXPECT_EQ(error_of("subsection Walls\n subsection Tank\n set Height = 6\n end\nend\n"),
            "scene.prm:3: in section \"Walls/Tank\", entry \"Height\", value \"6\": allowed: a number >= 0 and <= 5");
}

TEST(ParameterFile, NamesTheNearestPluginForAnUnknownOne)
{
  EXPECT_EQ(error_of("subsection Laws\n set Laws = sprig\nend\n"),
            "scene.prm:2: in section \"Laws\", entry \"Laws\", value \"sprig\": no law is called \"sprig\"; did you "
            "mean \"Spring\"? Allowed here: Series, Spring");
}

TEST(ParameterFile, ReportsCombinationsWhereTheyWereSet)
{
  EXPECT_EQ(error_of("subsection Laws\n subsection Spring\n set Stiffness = 2000\n end\nend\n"),
            "scene.prm:3: in section \"Laws/Spring\", entry \"Stiffness\", value \"2000\": is too stiff for the step; "
            "take at most 1000");
}

TEST(ParameterFile, RefusesWhatHasNoForm)
{
  EXPECT_EQ(
    error_of("set Spacing = 1\nset spacing = 2\n"),
    "scene.prm:2: at the top level, the entry \"spacing\" is set twice, first at scene.prm:1; keep one of them");
  EXPECT_EQ(error_of("subsection Walls\n subsection Tank\n set Height = 1\n end\n"),
            "scene.prm:1: the subsection \"Walls\" has no \"end\" up to the end of the file");
  EXPECT_EQ(error_of("end\n"), "scene.prm:1: an \"end\" without its \"subsection\"");
  EXPECT_EQ(error_of("\nSpacing = 1\n"),
            "scene.prm:2: can't read the line \"Spacing = 1\"; allowed are: set NAME = VALUE, subsection NAME, end, "
            "and # before a comment");
}

TEST(ParameterFile, LetsTheCommandLineReplaceAndAddEntries)
{
  ParameterText text = text_of("set Spacing = 1\n");
  override_parameter(text, "spacing=2");
  override_parameter(text, "Walls/Tank/Height = 3");
  Scene scene;
  read_parameters(scene, laws(), text);
  EXPECT_EQ(scene.spacing, 2);
  EXPECT_EQ(scene.walls.at("Tank"), 3);

  override_parameter(text, "Laws/Sprng/Stiffness=1");
  EXPECT_EQ(message_of([&] {
              read_parameters(scene, laws(), text);
            }),
            "command line: in section \"Laws\", the section \"Sprng\" is unknown; did you mean \"Spring\"? Allowed "
            "here: Spring (a plugin's section is known where that plugin is chosen)");
  EXPECT_NE(message_of([&] {
              override_parameter(text, "Spacing");
            }),
            "no error");
}

TEST(ParameterFile, PrintsWhatItReadsBack)
{
  const std::string source = "set Spacing = 0.25\nsubsection Laws\n set Laws = series\n subsection Series\n set Laws = "
                             "spring\n subsection Spring\n set Stiffness = 77\n end\n end\nend\n";
  Scene             printed;
  std::ostringstream stream;
  print_parameters(stream, printed, laws(), text_of(source));
  EXPECT_NE(stream.str().find("Stiffness [N/m]. Allowed: a number > 0."), std::string::npos) << stream.str();
  EXPECT_NE(stream.str().find("default: 0.1"), std::string::npos) << stream.str();

  const Scene again = scene_of(stream.str());
  EXPECT_EQ(again.spacing, 0.25);
  EXPECT_EQ(again.laws.front().value(), 77);
}
