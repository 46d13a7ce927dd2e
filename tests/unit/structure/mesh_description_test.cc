#include <breakwater/base/exceptions.h>

#include <gtest/gtest.h>
#include <structure/mesh_description.h>

namespace Breakwater
{
  namespace
  {
    /// The message of the InputError that `call` throws.
    template <class Call>
    std::string message_of(const Call &call)
    {
      try
        {
          call();
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "no InputError";
    }
  } // namespace

  TEST(MeshDescription, ReadsBoxes)
  {
    const auto box = parse_box_mesh<3>("  Box( 0.292, -1e-2, 0 ;0.304,0.08,0.15; 2, 10, 19 ) ");
    EXPECT_EQ(box.lower[0], 0.292);
    EXPECT_EQ(box.lower[1], -0.01);
    EXPECT_EQ(box.upper[2], 0.15);
    EXPECT_EQ(box.n_cells, (std::array<unsigned int, 3>{{2, 10, 19}}));
    EXPECT_EQ(parse_box_mesh<2>("box(0, 0; 1, 2; 3, 4)").n_cells[1], 4u);
  }

  TEST(MeshDescription, ReadsStops)
  {
    const auto stops = parse_stops<2>("0.1, 0; -2, 0 | 0, -1e-2; 0, 1");
    ASSERT_EQ(stops.size(), 2u);
    EXPECT_EQ(stops[0].place[0], 0.1);
    EXPECT_EQ(stops[0].normal[0], -1);
    EXPECT_EQ(stops[1].place[1], -0.01);
    EXPECT_TRUE(parse_stops<3>(" ").empty());
  }

  TEST(MeshDescription, SaysWhatIsWrongWithAStop)
  {
    for (const auto &[text, expected] : {std::pair<const char *, const char *>{"0, 0", "1 parts"},
                                         {"0, 0; 0, 0", "no length"},
                                         {"0, 0, 0; 1, 0", "3 numbers where 2"},
                                         {"0, x; 1, 0", "\"x\" is no number"}})
      EXPECT_NE(message_of([text = text] {
                  parse_stops<2>(text);
                }).find(expected),
                std::string::npos)
        << text;
  }

  TEST(MeshDescription, SaysWhatIsWrongWithABox)
  {
    const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "no mesh is given"},
      {"sphere(0, 0; 1, 1; 1, 1)", "does not read box(...)"},
      {"box(0, 0; 1, 1; 1, 1", "does not read box(...)"},
      {"box(0, 0; 1, 1)", "2 parts"},
      {"box(0, 0, 0; 1, 1, 1; 1, 1, 1)", "3 numbers where 2"},
      {"box(0, a; 1, 1; 1, 1)", "\"a\" is no number"},
      {"box(0, 1; 1, 1; 1, 1)", "smaller"},
      {"box(0, 0; 1, 1; 1, 1.5)", "whole"},
      {"box(0, 0; 1, 1; 0, 1)", "whole"},
      {"box(0, 0; nan, 1; 1, 1)", "no number"}};
    for (const auto &[text, expected] : cases)
      {
        const std::string message = message_of([&text = text] {
          parse_box_mesh<2>(text);
        });
        EXPECT_NE(message.find(expected), std::string::npos) << text << ": " << message;
        EXPECT_NE(message.find("box(x0, y0; x1, y1; nx, ny)"), std::string::npos) << message;
      }
  }

  TEST(MeshDescription, BoundariesByName)
  {
    EXPECT_EQ((parse_boundaries<2>({"Top", "left"})), (std::array<bool, 4>{{true, false, false, true}}));
    const std::string message = message_of([] {
      parse_boundaries<2>({"front"});
    });
    EXPECT_NE(message.find("left, right, bottom, top"), std::string::npos) << message;
    EXPECT_NE(message_of([] {
                parse_boundaries<3>({"top", "top"});
              }).find("twice"),
              std::string::npos);
  }
} // namespace Breakwater
