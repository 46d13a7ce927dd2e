#include "one_wall.h"

#include <gtest/gtest.h>
#include <pfem_fluid/walls.h>

using namespace Breakwater;

namespace
{
  /// The tank (0, 0, 0; 1, 2, 3).
  template <int dim>
  Walls<dim> tank(const std::string &law, const std::string &kind = "open box")
  {
    OneWall    reader(kind + (dim == 2 ? "(0, 0; 1, 2)" : "(0, 0, 0; 1, 2, 3)"), law);
    Walls<dim> walls;
    walls.declare_parameters(reader);
    walls.check_parameters(reader);
    return walls;
  }

  // The order of the planes of an open box: x lower, x upper, y lower, z lower, z upper.
  constexpr Contacts::Face left = 0, right = 1, bottom = 2, back = 3;

  constexpr double origin[3] = {};

  Contacts contacts_of(const std::vector<Contacts::Face> &faces)
  {
    Contacts contacts;
    for (const Contacts::Face face : faces)
      contacts.add(face);
    return contacts;
  }
} // namespace


TEST(Walls, OpenBoxLacksTheUpperFaceInY)
{
  EXPECT_EQ(tank<2>("free slip").n_faces(), 3u);
  EXPECT_EQ(tank<3>("free slip").n_faces(), 5u);
  EXPECT_EQ(tank<2>("free slip", "box").n_faces(), 4u);
  EXPECT_EQ(tank<3>("free slip", "box").n_faces(), 6u);
}


TEST(Walls, ShapeThatIsNoBoxIsRefused)
{
  OneWall  reader("sphere(0, 0; 1, 2)");
  Walls<2> walls;
  walls.declare_parameters(reader);
  EXPECT_THROW(walls.check_parameters(reader), InputError);
}


TEST(Walls, KnowThePlanesOfAPlace)
{
  const Walls<3> walls = tank<3>("free slip");
  EXPECT_EQ(walls.faces_at({{0.5, 0.5, 0.5}}, 1e-6), Contacts());
  EXPECT_EQ(walls.faces_at({{1e-7, -1e-7, 0.5}}, 1e-6), contacts_of({left, bottom}));
  EXPECT_EQ(walls.faces_at({{1., 0., 0.}}, 0.), contacts_of({right, bottom, back}));
}


TEST(Walls, PressAPlaceOnThePlanesThatItWasAndIsNear)
{
  const Walls<3> walls = tank<3>("free slip");
  const Vec<3>   x     = walls.pressed_on({{0.03, 0.04, 0.05}}, {{0.02, 0.3, -0.01}}, 0.5, 0.1);
  EXPECT_DOUBLE_EQ(x[0], 0.01);
  EXPECT_DOUBLE_EQ(x[1], 0.04); // came from afar
  EXPECT_DOUBLE_EQ(x[2], -0.005);
}


TEST(Walls, StopIsAnInelasticImpact)
{
  Walls<2> walls = tank<2>("free slip");
  double   x[2] = {1.1, 0.5}, v[2] = {3., 4.};
  Contacts contacts;
  walls.stop({}, x, v, 0., contacts);
  EXPECT_EQ(x[0], 1.);
  EXPECT_EQ(x[1], 0.5);
  EXPECT_EQ(v[0], 0.);
  EXPECT_EQ(v[1], 4.);
  EXPECT_EQ(contacts, contacts_of({right}));
}


TEST(Walls, StopKeepsAVelocityThatLeadsBack)
{
  Walls<2> walls = tank<2>("free slip");
  double   x[2] = {-0.1, 0.5}, v[2] = {3., 4.};
  Contacts contacts;
  walls.stop({}, x, v, 0., contacts);
  EXPECT_EQ(x[0], 0.);
  EXPECT_EQ(v[0], 3.);
}


TEST(Walls, StopLeavesNodesInsideAndOnAPlaneAlone)
{
  Walls<2> walls = tank<2>("no slip");
  double   x[2] = {0., 5.}, v[2] = {-3., 4.};
  Contacts contacts;
  walls.stop({}, x, v, 0., contacts);
  EXPECT_EQ(v[0], -3.);
  EXPECT_EQ(v[1], 4.);
  EXPECT_TRUE(contacts.empty());
}


TEST(Walls, StopWithoutSlipTakesTheWholeVelocity)
{
  Walls<3> walls = tank<3>("no slip");
  double   x[3] = {0.5, -0.1, 0.5}, v[3] = {3., 4., 5.};
  Contacts contacts;
  walls.stop({}, x, v, 0., contacts);
  EXPECT_EQ(x[1], 0.);
  for (const double component : v)
    EXPECT_EQ(component, 0.);
  EXPECT_EQ(contacts, contacts_of({bottom}));
}


TEST(Walls, StopInACornerMakesBothContacts)
{
  Walls<2> walls = tank<2>("free slip");
  double   x[2] = {1.2, -0.3}, v[2] = {1., -1.};
  Contacts contacts;
  walls.stop({}, x, v, 0., contacts);
  EXPECT_EQ(x[0], 1.);
  EXPECT_EQ(x[1], 0.);
  EXPECT_EQ(v[0], 0.);
  EXPECT_EQ(v[1], 0.);
  EXPECT_EQ(contacts, contacts_of({right, bottom}));
}


TEST(Walls, ConstrainHoldsWhatIsPressedOn)
{
  Walls<2> walls = tank<2>("free slip");
  double   a[2] = {7., -9.81}, v[2] = {2., -1e-3};
  Contacts contacts = contacts_of({bottom});
  walls.constrain(origin, a, v, 1., 0., contacts);
  EXPECT_EQ(a[0], 7.);
  EXPECT_EQ(a[1], 0.);
  EXPECT_EQ(v[0], 2.);
  EXPECT_EQ(v[1], 0.);
  EXPECT_EQ(contacts, contacts_of({bottom}));
}


TEST(Walls, ConstrainReleasesWhatIsPulledAway)
{
  Walls<2> walls = tank<2>("free slip");
  double   a[2] = {7., 1.}, v[2] = {2., 0.};
  Contacts contacts = contacts_of({bottom, right}); // the right wall's inside is at smaller x: 7 presses on
  walls.constrain(origin, a, v, 1., 0., contacts);
  EXPECT_EQ(a[0], 0.);
  EXPECT_EQ(a[1], 1.);
  EXPECT_EQ(v[0], 0.);
  EXPECT_EQ(contacts, contacts_of({right}));
}


TEST(Walls, ConstrainWithoutContactChangesNothing)
{
  Walls<2> walls = tank<2>("no slip");
  double   a[2] = {7., -1.}, v[2] = {2., -3.};
  Contacts contacts;
  walls.constrain(origin, a, v, 1., 0., contacts);
  EXPECT_EQ(a[1], -1.);
  EXPECT_EQ(v[1], -3.);
}


TEST(Walls, ConstrainWithoutSlipHoldsAllDirectionsUntilRelease)
{
  Walls<3> walls = tank<3>("no slip");
  double   a[3] = {7., -1., 5.}, v[3] = {2., 0., 1.};
  Contacts contacts = contacts_of({bottom});
  walls.constrain(origin, a, v, 1., 0., contacts);
  for (int d = 0; d < 3; ++d)
    {
      EXPECT_EQ(a[d], 0.);
      EXPECT_EQ(v[d], 0.);
    }
  double away[3] = {7., 1., 5.};
  walls.constrain(origin, away, v, 1., 0., contacts);
  EXPECT_TRUE(contacts.empty());
  EXPECT_EQ(away[0], 7.);
}


TEST(Walls, MaskTakesBothSenses)
{
  for (const double sign : {1., -1.})
    {
      double slip[3] = {sign, sign, sign}, stick[3] = {sign, sign, sign}, free[3] = {sign, sign, sign};
      tank<3>("free slip").mask(origin, slip, contacts_of({left, bottom}));
      tank<3>("no slip").mask(origin, stick, contacts_of({bottom}));
      tank<3>("no slip").mask(origin, free, Contacts());
      EXPECT_EQ(slip[0], 0.);
      EXPECT_EQ(slip[1], 0.);
      EXPECT_EQ(slip[2], sign);
      for (int d = 0; d < 3; ++d)
        {
          EXPECT_EQ(stick[d], 0.);
          EXPECT_EQ(free[d], sign);
        }
    }
}
