#include <breakwater/base/exceptions.h>

#include <gtest/gtest.h>
#include <pfem_fluid/wall_surface.h>

#include <cmath>

using namespace Breakwater;

namespace
{
  using Segment  = WallSurface<2>::Piece;
  using Triangle = WallSurface<3>::Piece;

  /// The square (0, 0; 1, 1), one of its sides given the wrong way round.
  std::vector<Segment> square()
  {
    const Vec<2> a{{0, 0}}, b{{1, 0}}, c{{1, 1}}, d{{0, 1}};
    return {{a, b}, {c, b}, {c, d}, {d, a}};
  }

  /// A regular polygon of radius 1 about the origin.
  std::vector<Segment> circle(const unsigned int n)
  {
    const auto corner = [n](const unsigned int k) {
      const double angle = 2 * M_PI * k / n;
      return Vec<2>{{std::cos(angle), std::sin(angle)}};
    };
    std::vector<Segment> pieces;
    for (unsigned int k = 0; k < n; ++k)
      pieces.push_back({corner(k), corner((k + 1) % n)});
    return pieces;
  }

  /// The unit cube, 12 triangles.
  std::vector<Triangle> cube()
  {
    constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::vector<Triangle> pieces;
    const auto            corner = [](const int k) {
      return Vec<3>{{double(k & 1), double(k >> 1 & 1), double(k >> 2 & 1)}};
    };
    for (const auto &f : faces)
      {
        pieces.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
        pieces.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
      }
    return pieces;
  }

  Vec<2> normal_below(const WallSurface<2> &surface)
  {
    WallSurface<2>::Foot foot;
    EXPECT_TRUE(surface.nearest({{0.5, 0.1}}, 0.2, surface.n_patches(), foot));
    return foot.normal;
  }
} // namespace


TEST(WallSurface, NormalsPointIntoTheFluidWhateverTheOrderOfTheCorners)
{
  EXPECT_NEAR(normal_below(WallSurface<2>(square(), FluidSide::inside))[1], 1., 1e-15);
  EXPECT_NEAR(normal_below(WallSurface<2>(square(), FluidSide::outside))[1], -1., 1e-15);
}


TEST(WallSurface, FlatFacesArePatchesOfTheirOwn)
{
  const WallSurface<3> box(cube(), FluidSide::inside);
  EXPECT_EQ(box.n_patches(), 6u);
  for (unsigned int patch = 0; patch < 6; ++patch)
    EXPECT_TRUE(box.is_flat(patch));
}


TEST(WallSurface, ShallowBendsAreOneCurvedPatch)
{
  const WallSurface<2> round(circle(24), FluidSide::inside), edged(circle(8), FluidSide::inside);
  EXPECT_EQ(round.n_patches(), 1u);
  EXPECT_FALSE(round.is_flat(0));
  EXPECT_EQ(edged.n_patches(), 8u);
}


TEST(WallSurface, NearestPlaceIsOnAFaceOrAnEdge)
{
  const WallSurface<3> box(cube(), FluidSide::outside);
  WallSurface<3>::Foot foot;
  ASSERT_TRUE(box.nearest({{0.3, 0.6, 1.2}}, 0.5, box.n_patches(), foot));
  EXPECT_NEAR(foot.distance, 0.2, 1e-15);
  EXPECT_NEAR(foot.place[0], 0.3, 1e-15);
  EXPECT_NEAR(foot.normal[2], 1., 1e-15);
  ASSERT_TRUE(box.nearest({{1.3, 0.5, 1.4}}, 0.6, box.n_patches(), foot));
  EXPECT_NEAR(foot.distance, 0.5, 1e-15);
  EXPECT_FALSE(box.nearest({{0.5, 0.5, 1.2}}, 0.1, box.n_patches(), foot)) << "beyond reach";
}


TEST(WallSurface, KnowsWhatIsSolid)
{
  const WallSurface<3> tank(cube(), FluidSide::inside), obstacle(cube(), FluidSide::outside);
  for (const bool inside : {true, false})
    {
      const Vec<3> x{{0.5, 0.5, inside ? 0.9 : 1.1}};
      EXPECT_EQ(tank.is_in_solid(x), !inside);
      EXPECT_EQ(obstacle.is_in_solid(x), inside);
    }
}


TEST(WallSurface, HolesInASolidAreSolidOfTheOtherSense)
{
  std::vector<Segment> pieces = square();
  for (Segment piece : square())
    {
      for (Vec<2> &x : piece)
        x = {{0.25 + 0.5 * x[0], 0.25 + 0.5 * x[1]}};
      pieces.push_back(piece);
    }
  const WallSurface<2> ring(pieces, FluidSide::inside);
  EXPECT_FALSE(ring.is_in_solid({{0.1, 0.5}}));
  EXPECT_TRUE(ring.is_in_solid({{0.5, 0.5}}));
  WallSurface<2>::Foot foot;
  ASSERT_TRUE(ring.nearest({{0.2, 0.5}}, 0.1, ring.n_patches(), foot));
  EXPECT_NEAR(foot.normal[0], -1., 1e-15) << "into the fluid between the squares";
}


TEST(WallSurface, StopsPathsOutOfTheFluidOnly)
{
  const WallSurface<3>     tank(cube(), FluidSide::inside);
  WallSurface<3>::Crossing crossing;
  const Vec<3>             in{{0.3, 0.4, 0.9}}, out{{0.3, 0.4, 1.3}};
  ASSERT_TRUE(tank.first_crossing(in, out, crossing));
  EXPECT_NEAR(crossing.place[2], 1., 1e-15);
  EXPECT_NEAR(crossing.normal[2], -1., 1e-15);
  EXPECT_FALSE(tank.first_crossing(out, in, crossing));
  EXPECT_FALSE(tank.first_crossing(in, {{0.9, 0.1, 0.1}}, crossing));
}


TEST(WallSurface, NoPathSlipsThroughBetweenPieces)
{
  const WallSurface<3>     tank(cube(), FluidSide::inside);
  WallSurface<3>::Crossing crossing;
  for (double s = 0; s <= 1; s += 0.125) // along the diagonal of a face, where two triangles meet
    EXPECT_TRUE(tank.first_crossing({{0.5, 0.5, 0.5}}, {{2 * s - 0.5, 2 * s - 0.5, 1.5}}, crossing)) << s;
}


TEST(WallSurface, StopsPathsFromBothSidesOfAThinWall)
{
  const WallSurface<2>     gate({{Vec<2>{{0, 0}}, Vec<2>{{0, 1}}}}, FluidSide::both);
  WallSurface<2>::Crossing crossing;
  for (const double side : {1., -1.})
    {
      ASSERT_TRUE(gate.first_crossing({{0.1 * side, 0.5}}, {{-0.1 * side, 0.5}}, crossing));
      EXPECT_NEAR(crossing.normal[0], side, 1e-15);
    }
  EXPECT_FALSE(gate.first_crossing({{0.1, 1.1}}, {{-0.1, 1.1}}, crossing)) << "over its end";
}


TEST(WallSurface, SeparatesWhatItStandsBetween)
{
  const WallSurface<2> gate({{Vec<2>{{0, 0}}, Vec<2>{{0, 1}}}}, FluidSide::both);
  EXPECT_TRUE(gate.separates({{1e-6, 0.5}}, {{-0.3, 0.6}}));
  EXPECT_FALSE(gate.separates({{1e-6, 0.5}}, {{1e-6, 0.9}}));
  EXPECT_FALSE(gate.separates({{0.1, 1.2}}, {{-0.1, 1.1}}));
}


TEST(WallSurface, ChordsOfABendAreNotSeparatedButThoseThroughABodyAre)
{
  const WallSurface<2> post(circle(48), FluidSide::outside);
  const auto           at = [](const double angle) {
    return Vec<2>{{(1 + 1e-6) * std::cos(angle), (1 + 1e-6) * std::sin(angle)}};
  };
  EXPECT_FALSE(post.separates(at(0.3), at(0.5)));
  EXPECT_TRUE(post.separates(at(0.3), at(1.8)));
  const WallSurface<2> plate({{Vec<2>{{0, 0}}, Vec<2>{{9, 0}}},
                              {Vec<2>{{9, 0}}, Vec<2>{{9, 0.1}}},
                              {Vec<2>{{9, 0.1}}, Vec<2>{{0, 0.1}}},
                              {Vec<2>{{0, 0.1}}, Vec<2>{{0, 0}}}},
                             FluidSide::outside);
  EXPECT_TRUE(plate.separates({{4, -1e-6}}, {{5, 0.1 + 1e-6}})) << "through a thin plate at a small angle";
}


TEST(WallSurface, OneSidedSurfaceMustBeClosed)
{
  std::vector<Segment> open = square();
  open.pop_back();
  EXPECT_THROW(WallSurface<2>(open, FluidSide::inside), InputError);
  EXPECT_NO_THROW(WallSurface<2>(open, FluidSide::both));
  EXPECT_THROW(WallSurface<2>({}, FluidSide::both), InputError);
}


TEST(WallSurface, PlacesOnEdgesAreThoseBetweenPatches)
{
  EXPECT_EQ(WallSurface<2>(square(), FluidSide::inside).places_on_edges(0.1).size(), 4u);
  EXPECT_EQ(WallSurface<2>(circle(24), FluidSide::inside).places_on_edges(0.1).size(), 0u);
  EXPECT_EQ(WallSurface<3>(cube(), FluidSide::inside).places_on_edges(0.5).size(), 12u * 3u);
}
