#include "cloud.h"

#include <pfem_fluid/structure_contact.h>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class Contact : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(Contact, Dimensions);

  constexpr double thickness = 0.04, height = 0.4, depth = 0.3;

  /// A plate (0, 0, 0; thickness, height, depth), its surface cut into facets of edge 0.1 or less, closed on all
  /// sides. Nodes on edges belong to the facets of all faces around.
  template <int dim>
  WetSurface<dim> plate()
  {
    const unsigned int n[3] = {1, 4, dim == 2 ? 0u : 3u};
    const double       h[3] = {thickness, height / 4, depth / 3};
    WetSurface<dim>    surface;

    std::vector<std::array<unsigned int, 3>> index;
    const auto                               node = [&](const std::array<unsigned int, 3> &ijk) -> unsigned int {
      for (unsigned int k = 0; k < index.size(); ++k)
        if (index[k] == ijk)
          return k;
      index.push_back(ijk);
      Vec<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = ijk[d] * h[d];
      surface.position.push_back(x);
      return index.size() - 1;
    };

    if constexpr (dim == 2)
      {
        // Counterclockwise: the tangent turned by -90 degrees points out.
        std::vector<std::array<unsigned int, 3>> outline;
        outline.push_back({0, 0, 0});
        for (unsigned int j = 0; j <= n[1]; ++j)
          outline.push_back({n[0], j, 0});
        for (unsigned int j = n[1]; j > 0; --j)
          outline.push_back({0, j, 0});
        for (std::size_t k = 0; k < outline.size(); ++k)
          {
            const unsigned int a = node(outline[k]), b = node(outline[(k + 1) % outline.size()]);
            surface.facets.push_back({a, b});
          }
      }
    else
      for (unsigned int d = 0; d < 3; ++d)
        for (const bool upper : {false, true})
          {
            const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
            for (unsigned int i = 0; i < n[e]; ++i)
              for (unsigned int j = 0; j < n[f]; ++j)
                {
                  std::array<std::array<unsigned int, 3>, 4> corner;
                  constexpr unsigned int                     around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
                  for (unsigned int k = 0; k < 4; ++k)
                    {
                      corner[k][d] = upper ? n[d] : 0;
                      corner[k][e] = i + around[k][0];
                      corner[k][f] = j + around[k][1];
                    }
                  if (!upper)
                    std::swap(corner[1], corner[3]);
                  surface.facets.push_back({node(corner[0]), node(corner[1]), node(corner[2]), node(corner[3])});
                }
          }
    surface.velocity.resize(surface.position.size());
    surface.acceleration.resize(surface.position.size());
    surface.inverse_mass.resize(surface.position.size());
    return surface;
  }

  /// Distance to the plate by the formula for a box, negative inside [m].
  template <int dim>
  double exact_distance(const Vec<dim> &x)
  {
    constexpr double size[3] = {thickness, height, depth};
    Vec<dim>         outside;
    double           inside = -1e300;
    for (int d = 0; d < dim; ++d)
      {
        const double q = std::max(-x[d], x[d] - size[d]);
        outside[d]     = std::max(q, 0.);
        inside         = std::max(inside, q);
      }
    return inside > 0 ? norm(outside) : inside;
  }

  template <int dim>
  Vec<dim> place(const double x, const double y, const double z)
  {
    if constexpr (dim == 2)
      return {{x, y}};
    else
      return {{x, y, z}};
  }

  /// The nodes of the plate, and fluid nodes at given places with 0.5 kg each.
  template <int dim>
  FluidNodes<dim> nodes_with(const AdoptedSurface<dim> &surface, const std::vector<Vec<dim>> &fluid)
  {
    FluidNodes<dim> nodes;
    nodes.resize(surface.n_nodes() + fluid.size());
    nodes.n_interface = surface.n_nodes();
    for (std::size_t i = 0; i < nodes.n; ++i)
      {
        const Vec<dim> x = i < nodes.n_interface ? surface.surface().position[i] : fluid[i - nodes.n_interface];
        for (int d = 0; d < dim; ++d)
          nodes.xp[i][d] = x[d];
        nodes.mass[i] = i < nodes.n_interface ? 0. : 0.5;
      }
    return nodes;
  }

  template <int dim>
  unsigned int node_at(const AdoptedSurface<dim> &surface, const Vec<dim> &x)
  {
    const auto &position = surface.surface().position;
    for (unsigned int i = 0; i < position.size(); ++i)
      if (norm(position[i] - x) < 1e-12)
        return i;
    ADD_FAILURE() << "the plate has no such node";
    return 0;
  }

  /// A cell of one interface node (or several) and as many of the fluid nodes as it needs.
  template <int dim>
  bool accepts(const AdoptedSurface<dim> &surface, const std::vector<Vec<dim>> &interface,
               const std::vector<Vec<dim>> &fluid)
  {
    const FluidNodes<dim>           nodes = nodes_with(surface, fluid);
    typename SimplexMesh<dim>::Cell cell;
    std::size_t                     a = 0;
    for (const Vec<dim> &x : interface)
      cell[a++] = node_at(surface, x);
    for (unsigned int i = nodes.n_interface; a <= dim; ++i)
      cell[a++] = i;
    return surface.accepts(cell, nodes);
  }
} // namespace


// Facets are quadrilaterals: any three corners, in any order; three nodes in a row on an edge have none.
TEST(AdoptedSurface, KnowsItsFacets)
{
  const AdoptedSurface<3> surface(plate<3>());
  const auto              node = [&surface](const double y, const double z) {
    return node_at<3>(surface, {{0, y, z}});
  };
  const unsigned int a = node(0.1, 0.1), b = node(0.2, 0.1), c = node(0.2, 0.2), d = node(0.1, 0.2);
  for (const auto &nodes : std::vector<std::array<unsigned int, 3>>{{a, b, c}, {b, a, d}, {d, c, b}, {a, d, c}})
    EXPECT_TRUE(surface.has_facet_of(nodes));
  EXPECT_FALSE(surface.has_facet_of({a, b, node(0.3, 0.1)}));
  EXPECT_FALSE(surface.has_facet_of({a, c, node(0.3, 0.2)}));
}


TYPED_TEST(Contact, AcceptsCellsInFrontOfTheBody)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> surface(plate<dim>());
  EXPECT_TRUE(accepts<dim>(surface, {place<dim>(0, 0.2, 0.1)},
                           {place<dim>(-0.05, 0.15, 0.1), place<dim>(-0.05, 0.25, 0.1), place<dim>(-0.05, 0.2, 0.2)}));
  EXPECT_TRUE(accepts<dim>(surface, {place<dim>(thickness, 0.2, 0.1), place<dim>(thickness, 0.3, 0.1)},
                           {place<dim>(thickness + 0.05, 0.25, 0.1), place<dim>(thickness + 0.05, 0.25, 0.2)}));
}


TYPED_TEST(Contact, RejectsCellsThroughAThinPlate)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> surface(plate<dim>());
  // A node of the left face with fluid on the right.
  EXPECT_FALSE(
    accepts<dim>(surface, {place<dim>(0, 0.2, 0.1)},
                 {place<dim>(thickness + 0.02, 0.2, 0.1), place<dim>(-0.05, 0.25, 0.1), place<dim>(-0.05, 0.2, 0.2)}));
  // Nodes of both faces, fluid on the left.
  EXPECT_FALSE(accepts<dim>(surface, {place<dim>(0, 0.2, 0.1), place<dim>(thickness, 0.2, 0.1)},
                            {place<dim>(-0.05, 0.25, 0.1), place<dim>(-0.05, 0.2, 0.2)}));
}


TYPED_TEST(Contact, AcceptsCellsOverAnEdge)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> surface(plate<dim>());
  EXPECT_TRUE(accepts<dim>(surface, {place<dim>(0, height, 0.1)},
                           {place<dim>(-0.05, height - 0.05, 0.1), place<dim>(0.02, height + 0.05, 0.1),
                            place<dim>(-0.05, height + 0.05, 0.2)}));
  // But not from the side below the edge to a place above the plate, through its corner.
  EXPECT_FALSE(accepts<dim>(surface, {place<dim>(0, height - 0.1, 0.1)},
                            {place<dim>(0.03, height + 0.02, 0.1), place<dim>(-0.05, height - 0.05, 0.1),
                             place<dim>(-0.05, height - 0.05, 0.2)}));
}


TYPED_TEST(Contact, DoesNotCareForCellsWithoutItsNodes)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> surface(plate<dim>());
  EXPECT_TRUE(accepts<dim>(surface, {},
                           {place<dim>(-0.05, 0.1, 0.1), place<dim>(0.1, 0.2, 0.1), place<dim>(-0.05, 0.2, 0.2),
                            place<dim>(-0.05, 0.1, 0.2)}));
}


TYPED_TEST(Contact, SignedDistanceIsThatOfABox)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> surface(plate<dim>());
  Noise                     noise(2);
  unsigned int              n_inside = 0;
  for (int k = 0; k < 2000; ++k)
    {
      const Vec<dim> x        = place<dim>(0.02 + 0.06 * noise(), 0.2 + 0.25 * noise(), 0.15 + 0.2 * noise());
      const double   expected = exact_distance(x);
      n_inside += expected < 0;
      EXPECT_NEAR(surface.signed_distance(x, 0.5), expected, 1e-12) << x[0] << ' ' << x[1];
    }
  EXPECT_GT(n_inside, 100u);
  EXPECT_EQ(surface.signed_distance(place<dim>(-0.3, 0.2, 0.1), 0.1), 0.1) << "farther than it looks";
}


// In front of a sharp edge a place lies behind one of the two faces, and is outside all the same.
TEST(SharpContact, KnowsOutsideFromInsideAtASharpEdge)
{
  WetSurface<2> wedge;
  wedge.position = {{{0., 0.}}, {{1., -0.1}}, {{1., 0.1}}};
  wedge.facets   = {{0, 1}, {1, 2}, {2, 0}};
  const AdoptedSurface<2> surface(wedge);
  for (const double y : {-0.02, -0.001, 0., 0.001, 0.02})
    EXPECT_NEAR(surface.signed_distance({{-0.01, y}}, 1.), std::hypot(0.01, y), 1e-15) << y;
  EXPECT_LT(surface.signed_distance({{0.01, 0.}}, 1.), 0.);
}


TYPED_TEST(Contact, PushesLeakedNodesOutAndHandsTheirMomentumOn)
{
  constexpr int   dim  = TypeParam::value;
  WetSurface<dim> body = plate<dim>();
  for (Vec<dim> &v : body.velocity)
    v = place<dim>(0.5, 0., 0.);
  const AdoptedSurface<dim> surface(body);
  // Just inside the left face and going on, inside the right face but going out, in front, and far away.
  const std::vector<Vec<dim>> fluid = {place<dim>(0.005, 0.23, 0.12), place<dim>(thickness - 0.004, 0.12, 0.21),
                                       place<dim>(-0.01, 0.2, 0.1), place<dim>(-2., 0.2, 0.1)};
  FluidNodes<dim>             nodes = nodes_with(surface, fluid);
  const std::size_t           first = nodes.n_interface;
  const Vec<dim>              in = place<dim>(3., 1., -2.), out = place<dim>(2., 1., 0.);
  for (int d = 0; d < dim; ++d)
    {
      nodes.v[first][d]     = in[d];
      nodes.v[first + 1][d] = out[d];
      nodes.v[first + 2][d] = in[d];
    }
  std::vector<Vec<dim>> impulse(first);
  EXPECT_EQ(surface.push_out(nodes, 0.2, 0., impulse), 2u);

  // Back on the surface, at the nearest place.
  EXPECT_NEAR(norm(nodes.position(first) - place<dim>(0., 0.23, 0.12)), 0., 1e-14);
  EXPECT_NEAR(norm(nodes.position(first + 1) - place<dim>(thickness, 0.12, 0.21)), 0., 1e-14);
  EXPECT_EQ(norm(nodes.position(first + 2) - fluid[2]), 0.);

  // No velocity into the body, which itself moves; along it and out of it nothing changes.
  EXPECT_NEAR(norm(nodes.velocity(first) - place<dim>(0.5, 1., -2.)), 0., 1e-14);
  EXPECT_NEAR(norm(nodes.velocity(first + 1) - out), 0., 1e-14);
  EXPECT_EQ(norm(nodes.velocity(first + 2) - in), 0.);

  Vec<dim> sum;
  for (const Vec<dim> &i : impulse)
    sum += i;
  EXPECT_NEAR(norm(sum - (in - nodes.velocity(first)) * nodes.mass[first]), 0., 1e-14);
  EXPECT_GT(norm(sum), 1.);
}


TYPED_TEST(Contact, KeepsADistanceFromNodesOutsideWithoutTouchingTheirVelocity)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> surface(plate<dim>());
  FluidNodes<dim>           nodes = nodes_with(surface, {place<dim>(-0.002, 0.2, 0.1), place<dim>(-0.02, 0.2, 0.1)});
  const std::size_t         first = nodes.n_interface;
  nodes.v[first][0]               = 1;
  std::vector<Vec<dim>> impulse(first);
  EXPECT_EQ(surface.push_out(nodes, 0.1, 0.01, impulse), 0u);
  EXPECT_NEAR(norm(nodes.position(first) - place<dim>(-0.01, 0.2, 0.1)), 0., 1e-14);
  EXPECT_NEAR(norm(nodes.position(first + 1) - place<dim>(-0.02, 0.2, 0.1)), 0., 1e-14);
  EXPECT_EQ(nodes.v[first][0], 1);
  for (const Vec<dim> &i : impulse)
    EXPECT_EQ(norm(i), 0.);
}


// Two plates, the second one far to the right: each pushes out of itself, what lies between them is left alone.
TYPED_TEST(Contact, SeveralBodiesStandOneAfterTheOther)
{
  constexpr int   dim    = TypeParam::value;
  WetSurface<dim> second = plate<dim>();
  for (Vec<dim> &x : second.position)
    x[0] += 1;
  WetSurface<dim> first = plate<dim>();
  first.bodies          = {"A"};
  second.bodies         = {"B", "C"};
  first.body_of_facet.assign(first.facets.size(), 0);
  second.body_of_facet.assign(second.facets.size(), 1);
  AdoptedSurface<dim> surface(first);
  const unsigned int  n_first = surface.n_nodes();
  EXPECT_EQ(surface.append(second), n_first);
  EXPECT_EQ(surface.n_nodes(), 2 * n_first);
  EXPECT_EQ(surface.surface().facets.back()[0], second.facets.back()[0] + n_first);
  EXPECT_EQ(surface.surface().bodies, std::vector<std::string>({"A", "B", "C"}));
  EXPECT_EQ(surface.surface().body_of_facet.front(), 0u);
  EXPECT_EQ(surface.surface().body_of_facet.back(), 2u);

  FluidNodes<dim> nodes =
    nodes_with(surface, {place<dim>(0.5, 0.2, 0.1), place<dim>(0.001, 0.2, 0.1), place<dim>(1.001, 0.2, 0.1)});
  std::vector<Vec<dim>> impulse(nodes.n_interface);
  EXPECT_EQ(surface.push_out(nodes, 0.1, 0., impulse), 2u);
  EXPECT_NEAR(nodes.xp[nodes.n - 3][0], 0.5, 1e-15);
  EXPECT_NEAR(nodes.xp[nodes.n - 2][0], 0, 1e-12);
  EXPECT_NEAR(nodes.xp[nodes.n - 1][0], 1, 1e-12);
}


TYPED_TEST(Contact, PushesNothingOutOfNoBody)
{
  constexpr int             dim = TypeParam::value;
  const AdoptedSurface<dim> none;
  FluidNodes<dim>           nodes = nodes_with<dim>(none, {place<dim>(0.01, 0.2, 0.1)});
  std::vector<Vec<dim>>     impulse;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.push_out(nodes, 0.2, 0., impulse), 0u);
}


TYPED_TEST(Contact, FollowsTheBodyWhenNormalsAreUpdated)
{
  constexpr int       dim = TypeParam::value;
  AdoptedSurface<dim> surface(plate<dim>());
  const Vec<dim>      x = place<dim>(1.01, 0.2, 0.15);
  EXPECT_GT(surface.signed_distance(x, 2.), 0.9);
  for (Vec<dim> &p : surface.surface().position)
    p[0] += 1.;
  surface.update_normals();
  EXPECT_NEAR(surface.signed_distance(x, 2.), -0.01, 1e-12);
}
