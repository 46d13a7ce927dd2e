#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/area_vector.h>

#include <gtest/gtest.h>
#include <pfem_fluid/rigid_motion.h>
#include <pfem_fluid/stl_file.h>
#include <pfem_fluid/wall_shapes.h>
#include <unit/base/message_of.h>
#include <unit/plugins/given_parameters.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

using namespace Breakwater;

namespace
{
  std::string write(const std::string &name, const std::string &text)
  {
    const std::string file = ::testing::TempDir() + name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  template <int dim>
  WallShape<dim> shape_of(const std::string &text, const FluidSide side = FluidSide::inside)
  {
    const GivenParameters reader(std::map<std::string, std::string>{});
    return parse_wall_shape<dim>(text, side, reader);
  }

  template <int dim>
  std::string error_of(const std::string &text, const FluidSide side = FluidSide::inside)
  {
    return message_of([&] {
      shape_of<dim>(text, side);
    });
  }

  /// Volume that the pieces of a surface enclose.
  template <int dim>
  double volume_in(const std::vector<std::array<Vec<dim>, dim>> &pieces)
  {
    double volume = 0;
    for (const auto &piece : pieces)
      volume += dot(area_vector<dim>(piece), piece[0]) / dim;
    return volume;
  }

  const std::string ascii_triangle = "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5e0 0\n"
                                     "endloop\nendfacet\n";

  RigidMotion<3> motion_of(const std::map<std::string, std::string> &values)
  {
    GivenParameters reader(values);
    RigidMotion<3>  motion;
    motion.declare_parameters(reader);
    motion.check_parameters(reader);
    return motion;
  }
} // namespace


TEST(WallShapes, BoxesWithTheFluidInsideArePlanes)
{
  EXPECT_EQ(shape_of<3>("open box(0, 0, 0; 1, 2, 3)").planes.size(), 5u);
  EXPECT_TRUE(shape_of<3>("box(0, 0, 0; 1, 2, 3)").pieces.empty());
}


TEST(WallShapes, BoxAsAnObstacleIsASurface)
{
  const auto shape = shape_of<3>("box(0, 0, 0; 1, 2, 3)", FluidSide::outside);
  EXPECT_TRUE(shape.planes.empty());
  EXPECT_NEAR(volume_in<3>(shape.pieces), 6., 1e-14);
}


TEST(WallShapes, PlaneHasAUnitNormal)
{
  const auto plane = shape_of<2>("plane(1, 2; 3, 4)").planes.at(0);
  EXPECT_EQ(plane.place[1], 2.);
  EXPECT_NEAR(plane.normal[0], 0.6, 1e-15);
}


TEST(WallShapes, PrismOfAPolygonThatIsNotConvexHasItsVolume)
{
  // An L of area 3, 2 high; its corners run clockwise.
  const auto shape = shape_of<3>("prism(0, 2; 0, 0; 0, 2; 1, 2; 1, 1; 2, 1; 2, 0)");
  EXPECT_NEAR(std::abs(volume_in<3>(WallSurface<3>(shape.pieces, FluidSide::outside).pieces())), 6., 1e-14);
}


TEST(WallShapes, LineIsOpenAndASheetHasNoLids)
{
  EXPECT_EQ(shape_of<2>("line(0, 0; 1, 0; 1, 1)", FluidSide::both).pieces.size(), 2u);
  EXPECT_EQ(shape_of<3>("sheet(0, 1; 0, 0; 1, 0; 1, 1)", FluidSide::both).pieces.size(), 4u);
}


TEST(WallShapes, MistakesAreExplained)
{
  EXPECT_NE(error_of<2>("blob(1, 2)").find("unknown shape 'blob'"), std::string::npos);
  EXPECT_NE(error_of<2>("polygon(0, 0; 1, 0)").find("at least 3 points"), std::string::npos);
  EXPECT_NE(error_of<2>("polygon(0, 0; 1; 1, 1)").find("two coordinates"), std::string::npos);
  EXPECT_NE(error_of<2>("polygon(0, 0; 1, q; 1, 1)").find("\"q\" is no number"), std::string::npos);
  EXPECT_NE(error_of<2>("line(0, 0; 1, 0)").find("Fluid side = both"), std::string::npos);
  EXPECT_NE(error_of<2>("plane(0, 0; 0, 0)").find("normal must not be zero"), std::string::npos);
  EXPECT_NE(error_of<2>("plane(0, 0; 0, 1)", FluidSide::outside).find("leave out"), std::string::npos);
  EXPECT_NE(error_of<2>("open box(0, 0; 1, 1)", FluidSide::outside).find("open box"), std::string::npos);
  EXPECT_NE(error_of<2>("tank.stl").find("3D only"), std::string::npos);
  EXPECT_NE(error_of<3>("/no/such/tank.stl").find("can't read"), std::string::npos);
  EXPECT_NE(error_of<3>("prism(0, 1; 0, 0; 1, 1; 1, 0; 0, 1)").find("crosses itself"), std::string::npos);
  EXPECT_NE(error_of<3>("prism(1, 0; 0, 0; 1, 0; 0, 1)").find("lower and the upper z"), std::string::npos);
}


TEST(WallShapes, GmshSurfaceGivesTriangles)
{
  const std::string file = write("surface.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n"
                                                "3 0 1 0\n$EndNodes\n$Elements\n2\n1 1 2 0 1 1 2\n2 2 2 0 1 1 2 3\n"
                                                "$EndElements\n");
  EXPECT_EQ(shape_of<3>(file, FluidSide::both).pieces.size(), 1u);
  EXPECT_EQ(shape_of<2>(file, FluidSide::both).pieces.size(), 1u);
}


TEST(StlFile, AsciiGivesTriangles)
{
  const auto triangles =
    read_stl(write("a.stl", "solid a name\n" + ascii_triangle + ascii_triangle + "endsolid a name\n"));
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_EQ(triangles[1][2][1], 1.5);
}


TEST(StlFile, BinaryThatStartsWithSolidGivesTriangles)
{
  std::string   text(80, ' ');
  std::uint32_t n           = 1;
  float         numbers[12] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0};
  text.replace(0, 5, "solid");
  text.append(reinterpret_cast<const char *>(&n), sizeof(n));
  text.append(reinterpret_cast<const char *>(numbers), sizeof(numbers));
  text.append(2, '\0');
  const auto triangles = read_stl(write("b.stl", text));
  ASSERT_EQ(triangles.size(), 1u);
  EXPECT_EQ(triangles[0][2][1], 2.);
}


TEST(StlFile, MistakesAreExplained)
{
  const auto error = [](const std::string &text) {
    return message_of([&] {
      read_stl(write("c.stl", text));
    });
  };
  EXPECT_NE(error("nothing").find("is no STL file"), std::string::npos);
  EXPECT_NE(error("solid a\nendsolid a\n").find("no triangles"), std::string::npos);
  EXPECT_NE(error("solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 z\n").find("c.stl:4: wanted a coordinate"),
            std::string::npos);
  EXPECT_NE(error("solid a\n" + ascii_triangle.substr(0, 43)).find("the end of the file"), std::string::npos);
}


TEST(RigidMotion, TranslatesAndRotates)
{
  const Pose<3> pose = motion_of({{"Translation", "t; 0; 2*t"}, {"Rotation", "pi/2*t"}, {"Center", "1 0 0"}}).pose(1.);
  const Vec<3>  x0{{2, 0, 5}}, x = pose.to_world(x0);
  EXPECT_NEAR(x[0], 2., 1e-14);
  EXPECT_NEAR(x[1], 1., 1e-14);
  EXPECT_NEAR(x[2], 7., 1e-14);
  EXPECT_LT(norm(pose.to_body(x) - x0), 1e-14);
}


TEST(RigidMotion, TurnsAboutAnyAxis)
{
  const Vec<3> x = motion_of({{"Rotation", "pi/2"}, {"Axis", "2 0 0"}}).pose(0.).to_world({{3, 1, 0}});
  EXPECT_NEAR(x[0], 3., 1e-14);
  EXPECT_NEAR(x[1], 0., 1e-14);
  EXPECT_NEAR(x[2], 1., 1e-14);
}


TEST(RigidMotion, TableIsMetAtItsTimesAndSmoothBetween)
{
  const std::string file = write("motion.csv", "# t, x, y\n0, 0, 0\n1, 1, 0\n2, 4, 0\n3, 4, 1\n");
  const MotionTable table(file, 2, 3);
  for (int t = 0; t <= 3; ++t)
    EXPECT_EQ(table.value(t, 0), t == 0 ? 0. : t == 1 ? 1. : 4.);
  EXPECT_EQ(table.value(-1., 0), 0.);
  EXPECT_EQ(table.value(9., 1), 1.);
  EXPECT_EQ(table.value(1., 2), 0.) << "no angle is given";
  const double d = 1e-6;
  EXPECT_NEAR((table.value(1 + d, 0) - table.value(1, 0)) / d, (table.value(1, 0) - table.value(1 - d, 0)) / d, 1e-4);
}


TEST(RigidMotion, MistakesAreExplained)
{
  const auto error = [](const std::map<std::string, std::string> &values) {
    return message_of([&] {
      motion_of(values);
    });
  };
  EXPECT_NE(error({{"Translation", "t; 0"}}).find("2 expressions where 3"), std::string::npos);
  EXPECT_NE(error({{"Translation", "x; 0; 0"}}).find("time t only"), std::string::npos);
  EXPECT_NE(error({{"Rotation", "1/t"}}).find("not finite"), std::string::npos);
  EXPECT_NE(error({{"Axis", "0 0 0"}}).find("zero"), std::string::npos);
  EXPECT_NE(error({{"Motion table", "/no/such.csv"}}).find("can't read"), std::string::npos);
  EXPECT_NE(error({{"Motion table", write("m1.csv", "0 0 0 0\n0 1 1 1\n")}}).find("must increase"), std::string::npos);
  EXPECT_NE(error({{"Motion table", write("m2.csv", "0 0 0\n1 1 1\n")}}).find("m2.csv:1"), std::string::npos);
}
