#include "cloud.h"
#include "one_wall.h"

#include <pfem_fluid/interface_slip.h>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class Slip : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(Slip, Dimensions);

  /// Two facets, x = 0 and y = 0, that meet at a right angle in node 1; node 0 is on the first alone, node 2 on the
  /// second. In 3D nodes 3 to 5 are those at z = 1.
  template <int dim>
  WetSurface<dim> angle()
  {
    WetSurface<dim>    surface;
    const unsigned int n_layers = dim == 2 ? 1 : 2;
    for (unsigned int k = 0; k < n_layers; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        {
          Vec<dim> x;
          x[i == 2 ? 0 : 1] = i == 1 ? 0. : -1.;
          if constexpr (dim == 3)
            x[2] = k;
          surface.position.push_back(x);
        }
    for (unsigned int i = 0; i < 2; ++i)
      {
        if constexpr (dim == 2)
          surface.facets.push_back({i, i + 1});
        else
          surface.facets.push_back({i, i + 1, i + 4, i + 3});
      }
    return surface;
  }

  /// Nodes on the surface and one of the fluid away from it, with a cell of all nodes of the first face and this one.
  template <int dim>
  struct Scene
  {
    /// @param slips whether the fluid slips at the first and at the second face
    explicit Scene(const Walls<dim> &walls = {}, const std::vector<char> &slips = {1, 1})
    {
      const WetSurface<dim> surface = angle<dim>();
      nodes.resize(surface.position.size() + 1);
      nodes.n_interface = surface.position.size();
      for (std::size_t i = 0; i < nodes.n_interface; ++i)
        for (int d = 0; d < dim; ++d)
          nodes.xp[i][d] = surface.position[i][d];
      Vec<dim> x;
      x[0] = 1;
      x[1] = -0.5;
      for (int d = 0; d < dim; ++d)
        nodes.xp[fluid()][d] = x[d];
      if constexpr (dim == 2)
        cells = {{0, 1, 3}};
      else
        cells = {{0, 1, 3, 6}};
      if (signed_volume(nodes.corners(cells[0])) < 0)
        std::swap(cells[0][0], cells[0][1]);
      for (std::size_t i = 0; i < nodes.n; ++i)
        nodes.walls[i] = walls.faces_at(nodes.position(i), 1e-9);
      slip.set_up(surface, slips);
      slip.find_neighbours(nodes, cells);
      slip.update_directions(nodes, walls);
      for (std::size_t i = 0; i < nodes.n; ++i)
        for (int d = 0; d < dim; ++d)
          nodes.force[i][d] = 1. + i + 10 * d;
    }
    unsigned int fluid() const { return nodes.n_interface; }

    FluidNodes<dim>                              nodes;
    std::vector<typename SimplexMesh<dim>::Cell> cells;
    InterfaceSlip<dim>                           slip;
  };

  TYPED_TEST(Slip, takesForcesAlongFacesButNotAcrossEdges)
  {
    constexpr int  dim = TypeParam::value;
    Scene<dim>     scene;
    const auto     before = scene.nodes.force;
    const Vec<dim> weight; // no mass at the nodes
    scene.slip.take_forces_along(scene.nodes, {weight});
    const auto &after = scene.nodes.force;
    EXPECT_EQ(after[0][0], before[0][0]); // normal of the face x = 0
    EXPECT_EQ(after[0][1], 0);
    EXPECT_EQ(after[1][0], before[1][0]); // the edge keeps both normals
    EXPECT_EQ(after[1][1], before[1][1]);
    EXPECT_EQ(after[2][0], 0); // the face y = 0
    EXPECT_EQ(after[2][1], before[2][1]);
    for (unsigned int i = 0; i < 3; ++i)
      for (int d = 2; d < dim; ++d)
        EXPECT_EQ(after[i][d], 0);
    for (unsigned int i = 0; i < 3; ++i)
      for (int d = 0; d < dim; ++d)
        EXPECT_DOUBLE_EQ(after[i][d] + scene.slip.taken_forces()[i][d], before[i][d]);
  }

  /// A tank whose lower face in the last direction cuts the angle: in 2D at node 0, in 3D at nodes 0 to 2.
  template <int dim>
  Walls<dim> tank()
  {
    return walls_of<dim>(OneWall(dim == 2 ? "box(-5, -1; 5, 5)" : "box(-5, -5, 0; 5, 5, 5)"));
  }

  TYPED_TEST(Slip, wallsTakeADirectionMore)
  {
    constexpr int dim = TypeParam::value;
    Scene<dim>    scene(tank<dim>());
    scene.slip.take_forces_along(scene.nodes, {Vec<dim>()});
    const auto slides = [&](const unsigned int i) {
      std::string directions;
      for (int d = 0; d < dim; ++d)
        directions += scene.nodes.force[i][d] == 0 ? "xyz"[d] : '-';
      return directions;
    };
    if constexpr (dim == 2)
      {
        EXPECT_EQ(slides(0), "--"); // the face meets the floor
        EXPECT_EQ(slides(2), "x-");
      }
    else
      {
        EXPECT_EQ(slides(0), "-y-"); // the edge of the face x = 0 with the floor
        EXPECT_EQ(slides(1), "---"); // the corner of both faces with the floor
        EXPECT_EQ(slides(2), "x--");
        EXPECT_EQ(slides(3), "-yz"); // above the floor
        EXPECT_EQ(slides(4), "--z"); // the edge of both faces
      }
  }

  TYPED_TEST(Slip, aNodeWithAFaceThatDoesNotSlipSticks)
  {
    constexpr int dim = TypeParam::value;
    Scene<dim>    scene({}, {1, 0});
    const auto    before = scene.nodes.force;
    scene.slip.take_forces_along(scene.nodes, {Vec<dim>()});
    EXPECT_EQ(scene.nodes.force[0][1], 0); // on the first face alone
    for (const unsigned int i : {1, 2})
      for (int d = 0; d < dim; ++d)
        EXPECT_EQ(scene.nodes.force[i][d], before[i][d]);
    scene.nodes.v[scene.fluid()][1] = 5;
    scene.slip.add_slip(scene.nodes);
    EXPECT_DOUBLE_EQ(scene.nodes.v[0][1], 5);
    EXPECT_EQ(scene.nodes.v[1][1], 0);
  }

  TYPED_TEST(Slip, leavesTheWeightOfTiedFluidInBalance)
  {
    constexpr int dim = TypeParam::value;
    Scene<dim>    scene;
    Vec<dim>      gravity;
    gravity[1]              = -9.81;
    scene.nodes.mass[0]     = 2;
    scene.nodes.force[0]    = {};
    scene.nodes.force[0][1] = 2 * 9.81; // the pressure carries it
    scene.slip.take_forces_along(scene.nodes, {gravity});
    EXPECT_DOUBLE_EQ(scene.slip.taken_forces()[0][1], 0);
    EXPECT_DOUBLE_EQ(scene.nodes.force[0][1], 2 * 9.81);
  }

  TYPED_TEST(Slip, givesViscousForcesAlongTheFaceToTheFluid)
  {
    constexpr int dim = TypeParam::value;
    Scene<dim>    scene;
    const auto    before = scene.nodes.force; // without pressure all of it is viscous
    scene.slip.pass_viscous_forces_on(scene.nodes, scene.cells, ForceEffects());
    const auto &after = scene.nodes.force;
    EXPECT_EQ(after[0][1], 0);
    EXPECT_EQ(after[0][0], before[0][0]);
    for (int d = 0; d < dim; ++d)
      {
        double change = 0;
        for (std::size_t i = 0; i < scene.nodes.n; ++i)
          change += after[i][d] - before[i][d];
        EXPECT_NEAR(change, 0, 1e-12);
      }
  }

  TYPED_TEST(Slip, pressureIsNotPassedOn)
  {
    constexpr int dim = TypeParam::value;
    Scene<dim>    scene;
    for (Quad &force : scene.nodes.force)
      force = {};
    const auto area = area_vectors(scene.nodes.corners(scene.cells[0]));
    for (int a = 0; a <= dim; ++a)
      {
        scene.nodes.xp[scene.cells[0][a]][3] = 7;
        for (int d = 0; d < dim; ++d)
          scene.nodes.force[scene.cells[0][a]][d] = 7 * area[a][d];
      }
    const auto before = scene.nodes.force;
    scene.slip.pass_viscous_forces_on(scene.nodes, scene.cells, ForceEffects());
    for (std::size_t i = 0; i < scene.nodes.n; ++i)
      for (int d = 0; d < dim; ++d)
        EXPECT_NEAR(scene.nodes.force[i][d], before[i][d], 1e-12);
  }

  TYPED_TEST(Slip, theFluidAtTheSurfaceMovesWithTheFluidAroundAlongIt)
  {
    constexpr int dim = TypeParam::value;
    Scene<dim>    scene;
    scene.nodes.v[scene.fluid()][0] = 3;
    scene.nodes.v[scene.fluid()][1] = 5;
    scene.nodes.v[0][0]             = 2;
    scene.slip.add_slip(scene.nodes);
    EXPECT_DOUBLE_EQ(scene.nodes.v[0][0], 2);
    EXPECT_DOUBLE_EQ(scene.nodes.v[0][1], 5);
    EXPECT_DOUBLE_EQ(scene.nodes.v[1][1], 0); // the edge sticks
    scene.slip.take_slip_back(scene.nodes);
    EXPECT_EQ(scene.nodes.v[0][1], 0);
  }
} // namespace
