#include "cloud.h"

#include <pfem_fluid/fluid_shape.h>
#include <pfem_fluid/node_cloud.h>
#include <unit/base/message_of.h>
#include <unit/plugins/given_parameters.h>

#include <limits>

using namespace Breakwater;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  const GivenParameters reader{std::map<std::string, std::string>{}};

  template <int dim>
  BoxShape<dim> tank()
  {
    BoxShape<dim> box{"box", {}, {}};
    std::fill_n(box.upper.c, dim, 1.);
    return box;
  }

  template <int dim>
  FluidShape<dim> shape_of(const std::string &text)
  {
    return FluidShape<dim>(text, tank<dim>(), reader);
  }

  template <int dim>
  SizeField<dim> size_of(const std::string &text)
  {
    return SizeField<dim>(text, tank<dim>().lower, tank<dim>().upper);
  }

  /// The nodes of a shape and the mesh that the fluid starts with.
  template <int dim>
  struct Filled
  {
    FluidShape<dim>       shape;
    SizeField<dim>        size;
    std::vector<Vec<dim>> nodes;
    SimplexMesh<dim>      mesh;

    Filled(const std::string &text, const std::string &spacing)
      : shape(shape_of<dim>(text))
      , size(size_of<dim>(spacing))
      , nodes(shape.place_nodes(size, {}))
      , mesh(alpha_shape<dim>(triangulation_of<dim>(nodes), 1.4 * size.largest(), [this](const auto &cell) {
        const Simplex<dim> x = corners<dim>(nodes, cell);
        Vec<dim>           center;
        for (const Vec<dim> &corner : x)
          center += corner * (1. / (dim + 1));
        return shape.distance(center) < 0.1 * size(center);
      }))
    {
    }

    double volume() const { return volume_of(mesh, nodes); }

    /// Least distance of two nodes in units of the local spacing.
    double least_distance() const
    {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          least = std::min(least, norm(nodes[i] - nodes[j]) / std::max(size(nodes[i]), size(nodes[j])));
      return least;
    }

    double largest_distance_outside() const
    {
      double largest = 0;
      for (const Vec<dim> &x : nodes)
        largest = std::max(largest, shape.distance(x) / size(x));
      return largest;
    }
  };

  template <int dim>
  struct Case
  {
    std::string text, spacing;
    double      volume;
    double      tolerance; ///< of the volume, relative
  };

  template <int dim>
  void check(const std::vector<Case<dim>> &cases)
  {
    for (const Case<dim> &c : cases)
      {
        const Filled<dim> filled(c.text, c.spacing);
        const double      error = filled.volume() / c.volume - 1;
        std::cout << c.text << ", h = " << c.spacing << ": " << filled.nodes.size() << " nodes, volume off by "
                  << 100 * error << " %, nodes " << filled.least_distance() << " h apart\n";
        EXPECT_LT(std::abs(error), c.tolerance) << c.text;
        EXPECT_GE(filled.least_distance(), 0.4) << c.text;
        EXPECT_LE(filled.largest_distance_outside(), 0.11) << c.text;
      }
  }
} // namespace


TEST(FluidShape, OneBoxHasExactlyTheNodesOfTheLattice)
{
  const auto                nodes    = shape_of<3>("box(0, 0, 0; 0.5, 0.4, 0.3)").place_nodes(size_of<3>("0.06"), {});
  const BoxShape<3>         box      = {"box", {}, {{0.5, 0.4, 0.3}}};
  const std::vector<Vec<3>> expected = fill_box(box, {}, 0.06);
  ASSERT_EQ(nodes.size(), expected.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int d = 0; d < 3; ++d)
      EXPECT_EQ(nodes[i][d], expected[i][d]);
}


TEST(FluidShape, HasTheVolumeItShouldHaveIn2D)
{
  check<2>({{"sphere(0.5, 0.5; 0.32)", "0.04", pi * 0.1024, 1e-3},
            {"ellipse(0.5, 0.5; 0.4, 0.2)", "0.04", pi * 0.08, 3e-3},
            {"polygon(0.1, 0.1; 0.9, 0.1; 0.9, 0.4; 0.5, 0.4; 0.5, 0.9; 0.1, 0.9)", "0.04", 0.44, 1e-10},
            {"half space(0.5, 0.5; 0.2, 1)", "0.04", 0.5, 1e-10},
            {"half space(0.5, 0.25; 0, 1)", "0.04", 0.25, 1e-10},
            {"box(0, 0; 0.5, 0.3) + box(0.5, 0; 1, 0.6)", "0.04", 0.45, 1e-10},
            {"box(0, 0; 1, 0.3) + sphere(0.5, 0.7; 0.2)", "0.04", 0.3 + pi * 0.04, 1e-3},
            {"box(0, 0; 1, 0.5) + box(0.3, 0.2; 0.6, 0.8)", "0.04", 0.59, 0.01},
            {"box(0, 0; 1, 1) - sphere(0.5, 0.5; 0.25)", "0.04", 1 - pi * 0.0625, 2e-3}});
}


TEST(FluidShape, HasTheVolumeItShouldHaveIn3D)
{
  check<3>({{"sphere(0.5, 0.5, 0.5; 0.48)", "0.06", 4 * pi / 3 * 0.110592, 3e-3},
            {"ellipsoid(0.5, 0.5, 0.5; 0.45, 0.35, 0.25)", "0.06", 4 * pi / 3 * 0.039375, 0.01},
            {"cylinder(0.2, 0.5, 0.5; 0.8, 0.5, 0.5; 0.3)", "0.06", pi * 0.09 * 0.6, 0.01},
            {"prism(0.1, 0.6; 0.1, 0.1; 0.9, 0.1; 0.9, 0.4; 0.5, 0.4; 0.5, 0.9; 0.1, 0.9)", "0.06", 0.22, 1e-10},
            {"half space(0.5, 0.5, 0.5; 0.2, 1, 0.1)", "0.08", 0.5, 1e-10},
            {"box(0, 0, 0; 1, 0.3, 1) + sphere(0.5, 0.7, 0.5; 0.2)", "0.06", 0.3 + 4 * pi / 3 * 0.008, 2e-3}});
}


TEST(FluidShape, GradedNodesFillTheShapeWithOnePerCellOfSpace)
{
  check<2>(
    {{"box(0, 0; 1, 1)", "0.015 + 0.05*y", 1., 1e-10}, {"sphere(0.5, 0.5; 0.4)", "0.01 + 0.1*x", pi * 0.16, 0.01}});
  check<3>({{"box(0, 0, 0; 1, 1, 1)", "0.05 + 0.1*y", 1., 1e-10}});

  // N = integral of dV / h^2 over the unit square, h = 0.01 + 0.04 y: 1 / 0.01 / 0.04 (1 - 1 / 5)
  const double n2 = Filled<2>("box(0, 0; 1, 1)", "0.01 + 0.04*y").nodes.size() / 2000.;
  // In the unit cube with h = 0.04 + 0.08 y: 1 / (2 * 0.08) (1 / 0.04^2 - 1 / 0.12^2)
  const double n3 = Filled<3>("box(0, 0, 0; 1, 1, 1)", "0.04 + 0.08*y").nodes.size() / 3472.;
  std::cout << "nodes per cell of space: " << n2 << " in 2D, " << n3 << " in 3D\n";
  EXPECT_NEAR(n2, 1., 0.05);
  EXPECT_NEAR(n3, 1., 0.15); // nodes on faces stand for less than h^3 each
}


TEST(FluidShape, BodiesThatDoNotTouchAreNotConnected)
{
  // 1.5 spacings apart: the alpha shape alone would close the gap.
  const Filled<2> filled("box(0, 0; 1, 0.3) + sphere(0.5, 0.66; 0.3)", "0.04");
  const auto      is_drop = [&](const unsigned int i) {
    return filled.nodes[i][1] > 0.33;
  };
  for (const auto &cell : filled.mesh.cells)
    EXPECT_EQ(std::count_if(cell.begin(), cell.end(), is_drop) % 3, 0);
}


TEST(FluidShape, SprayIsNodesFarFromEachOtherWithoutCells)
{
  const Filled<3> filled("spray(0, 0, 0; 1, 1, 0.5; 500)", "0.02");
  EXPECT_EQ(filled.nodes.size(), 500u);
  EXPECT_TRUE(filled.mesh.cells.empty());
  EXPECT_GT(filled.least_distance(), 2.5);
}


TEST(FluidShape, WrongTextsAreExplained)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
    {"", "no shape is given. Where the fluid is"},
    {"box(0, 0; 1, 1) +", "a shape is missing behind \"box(0, 0; 1, 1) +\""},
    {"box(0, 0; 1)", "in box(0, 0; 1): 3 numbers are given; expected box(x, y; X, Y)"},
    {"box(0, 1; 1, 0)", "the second corner must be larger"},
    {"sphre(0, 0; 1)", "there is no shape \"sphre\" in 2D; did you mean \"sphere\"?"},
    {"cylinder(0, 0; 1)", "there is no shape \"cylinder\" in 2D"},
    {"sphere(0, 0; -1)", "radii must be positive"},
    {"sphere(0, zero; 1)", "\"zero; 1\" is no number"},
    {"polygon(0, 0; 1, 0)", "a polygon needs three corners"},
    {"polygon(0, 0; 1, 1; 1, 0; 0, 1)", "cross each other"},
    {"half space(0, 0; 0, 0)", "the normal is zero"},
    {"half space(0, -1; 0.5, 1)", "nothing of the box around all walls"},
    {"box(0, 0; 1, 1) * sphere(0, 0; 1)", "expected + or - between two shapes, found \"* sphere(0, 0; 1)\""},
    {"mesh(no.msh)", "can't read the file"}};
  for (const auto &[text, expected] : cases)
    {
      const std::string message = message_of([&, t = text]() {
        shape_of<2>(t);
      });
      EXPECT_NE(message.find(expected), std::string::npos) << text << ": " << message;
    }
}


TEST(NodeCloud, KnowsWhetherAPlaceIsFree)
{
  Noise        noise(3);
  NodeCloud<3> cloud(0.01, 0.3);
  for (int i = 0; i < 500; ++i)
    cloud.add(noise.vec<3>());
  for (int i = 0; i < 500; ++i)
    {
      const Vec<3> x       = noise.vec<3>();
      double       nearest = 10;
      for (const Vec<3> &y : cloud.places())
        nearest = std::min(nearest, norm(x - y));
      for (const double distance : {0.011, 0.05, 0.1, 0.17, 0.3})
        EXPECT_EQ(cloud.is_free(x, distance), nearest >= distance);
    }
}
