#include "one_wall.h"

#include <gtest/gtest.h>
#include <pfem_fluid/walls.h>

#include <cmath>
#include <sstream>

using namespace Breakwater;

namespace
{
  /// The tank (0, 0, 0; 1, 2, 3).
  template <int dim>
  Walls<dim> tank(const std::string &law, const std::string &kind = "open box")
  {
    return walls_of<dim>(OneWall(kind + (dim == 2 ? "(0, 0; 1, 2)" : "(0, 0, 0; 1, 2, 3)"), law));
  }

  constexpr double spacing_of_nodes = 0.1;

  template <int dim>
  Walls<dim> wall_of(const std::map<std::string, std::string> &values)
  {
    Walls<dim> walls = walls_of<dim>(OneWall(values));
    walls.set_spacing(spacing_of_nodes);
    return walls;
  }

  /// A column of the history at a time.
  template <int dim>
  double history_of(Walls<dim> &walls, const double time, const std::string &name)
  {
    Row row;
    walls.add_history(time, row);
    for (const auto &[column, value] : row)
      if (column == name)
        return value;
    ADD_FAILURE() << "no column " << name;
    return 0;
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
  walls.constrain(origin, a, v, 1., 0., true, contacts);
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
  walls.constrain(origin, a, v, 1., 0., true, contacts);
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
  walls.constrain(origin, a, v, 1., 0., true, contacts);
  EXPECT_EQ(a[1], -1.);
  EXPECT_EQ(v[1], -3.);
}


TEST(Walls, ConstrainWithoutSlipHoldsAllDirectionsUntilRelease)
{
  Walls<3> walls = tank<3>("no slip");
  double   a[3] = {7., -1., 5.}, v[3] = {2., 0., 1.};
  Contacts contacts = contacts_of({bottom});
  walls.constrain(origin, a, v, 1., 0., true, contacts);
  for (int d = 0; d < 3; ++d)
    {
      EXPECT_EQ(a[d], 0.);
      EXPECT_EQ(v[d], 0.);
    }
  double away[3] = {7., 1., 5.};
  walls.constrain(origin, away, v, 1., 0., true, contacts);
  EXPECT_TRUE(contacts.empty());
  EXPECT_EQ(away[0], 7.);
}


TEST(Walls, ConstrainPullsWhereItMayNotRelease)
{
  Walls<2> walls = tank<2>("free slip");
  double   a[2] = {7., 1.}, v[2] = {2., 3.};
  Contacts contacts = contacts_of({bottom});
  walls.constrain(origin, a, v, 1., 0., false, contacts);
  EXPECT_EQ(a[0], 7.);
  EXPECT_EQ(a[1], 0.);
  EXPECT_EQ(v[1], 0.);
  EXPECT_EQ(contacts, contacts_of({bottom}));
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


TEST(Walls, ObliquePlaneTakesItsNormalPart)
{
  Walls<2> walls = wall_of<2>({{"Shape", "plane(0, 0; 1, 1)"}});
  double   x[2] = {-0.1, -0.1}, v[2] = {-1., 0.};
  Contacts contacts;
  EXPECT_TRUE(walls.stop({{0, 0}}, x, v, 1., contacts));
  EXPECT_NEAR(x[0], 0., 1e-16);
  EXPECT_NEAR(v[0], -0.5, 1e-15);
  EXPECT_NEAR(v[1], 0.5, 1e-15);
  double a[2] = {-2., 0.};
  walls.constrain(x, a, v, 1., 0., true, contacts);
  EXPECT_NEAR(a[0], -1., 1e-15);
  EXPECT_NEAR(a[1], 1., 1e-15);
}


TEST(Walls, CornerOfObliquePlanesLetsNothingPass)
{
  const Walls<3> walls = wall_of<3>({{"Shape", "prism(-9, 9; 0, 0; 1, 0.3; 0.3, 1)"}});
  const Vec<3>   corner{{1e-7, 1e-7, 0.}};
  double         vector[3] = {1., 2., 3.};
  walls.mask(corner.c, vector, walls.faces_at(corner, 1e-3));
  EXPECT_NEAR(vector[0], 0., 1e-14);
  EXPECT_NEAR(vector[1], 0., 1e-14);
  EXPECT_NEAR(vector[2], 3., 1e-14) << "along the edge";
}


TEST(Walls, NodeOnAnAcceleratedWallFollowsIt)
{
  Walls<2> walls  = wall_of<2>({{"Shape", "plane(0, 0; 1, 0)"}, {"Translation", "sin(3*t)^2; 0"}, {"Law", "no slip"}});
  const double dt = 0.01;
  double       x[2] = {0, 0}, v[2] = {0, 0}, a[2] = {0, 0};
  Contacts     contacts = walls.faces_at({}, 1e-9);
  for (int n = 1; n <= 40; ++n)
    {
      walls.act(0.5 * dt);
      walls.move(n * dt, dt);
      const Vec<2> x_old{{x[0], x[1]}};
      for (int d = 0; d < 2; ++d)
        {
          v[d] += 0.5 * dt * a[d];
          x[d] += dt * v[d];
          a[d] = d == 0 ? -50 : 7; // pressed on more than the wall ever draws away
        }
      walls.stop(x_old, x, v, 2., contacts);
      walls.constrain(x, a, v, 2., 0., true, contacts);
      walls.begin_forces();
      for (int d = 0; d < 2; ++d)
        v[d] += 0.5 * dt * a[d];
      walls.finish_step();
      EXPECT_NEAR(x[0], std::pow(std::sin(3 * n * dt), 2), 1e-13);
      EXPECT_NEAR(v[0], 3 * std::sin(6 * n * dt), 0.03) << "a central difference";
      EXPECT_FALSE(contacts.empty());
    }
  EXPECT_NEAR(v[1], 0., 1e-15);
}


TEST(Walls, ImpulseOfAStopIsTheWallsMeanForce)
{
  Walls<2> walls = wall_of<2>({{"Shape", "plane(0, 0; 0, 1)"}, {"Reference point", "1 0"}});
  double   x[2] = {3., -0.1}, v[2] = {5., -4.};
  Contacts contacts;
  EXPECT_EQ(history_of(walls, 0., "force on Tank y [N]"), 0.);
  walls.stop({{3, 0.1}}, x, v, 2., contacts);
  Row row;
  walls.add_history(0.5, row);
  EXPECT_EQ(row[1].first, "force on Tank y [N]");
  EXPECT_NEAR(row[1].second, -2 * 4 / 0.5, 1e-14);
  EXPECT_NEAR(row[2].second, -2 * 4 / 0.5 * 2, 1e-14) << "its moment about x = 1";
  EXPECT_EQ(history_of(walls, 1., "force on Tank y [N]"), 0.) << "nothing since";
}


TEST(Walls, ForceActsForItsDuration)
{
  Walls<2> walls = wall_of<2>({{"Shape", "open box(0, 0; 1, 1)"}});
  double   x[2] = {0.5, 0.}, v[2] = {0, 0}, a[2] = {3., -9.};
  Contacts contacts = walls.faces_at({{0.5, 0.}}, 0.);
  walls.constrain(x, a, v, 2., 0., true, contacts);
  EXPECT_NEAR(history_of(walls, 0., "force on Tank y [N]"), -18., 1e-14) << "without time, the force itself";
  walls.act(0.1);
  EXPECT_NEAR(history_of(walls, 0.2, "force on Tank y [N]"), -9., 1e-14);
  EXPECT_NEAR(history_of(walls, 0.2, "force on Tank x [N]"), 0., 1e-14);
}


TEST(Walls, ThinWallKeepsNodesOnTheirSides)
{
  Walls<2> walls = wall_of<2>({{"Shape", "line(0, 0; 0, 1)"}, {"Fluid side", "both"}});
  for (const double side : {1., -1.})
    {
      double   x[2] = {-0.02 * side, 0.5}, v[2] = {-side, 1.};
      Contacts contacts;
      EXPECT_TRUE(walls.stop({{0.03 * side, 0.4}}, x, v, 1., contacts));
      EXPECT_GT(side * x[0], 0.);
      EXPECT_LT(side * x[0], 1e-5);
      EXPECT_NEAR(v[0], 0., 1e-15);
      EXPECT_NEAR(v[1], 1., 1e-15);
      EXPECT_FALSE(contacts.empty());

      const Vec<2> below{{x[0], x[1]}};
      x[1] = 1.2;
      walls.stop(below, x, v, 1., contacts);
      EXPECT_TRUE(contacts.empty()) << "it has left over the wall's end";
    }
}


TEST(Walls, NodeWedgedInASharpCornerStaysInside)
{
  Walls<2>     walls = wall_of<2>({{"Shape", "polygon(0, 0; 1, 0.1; 1, 0.3; 0.9, 0.3)"}});
  double       x[2] = {-0.2, -0.05}, v[2] = {-1., 0.};
  Contacts     contacts;
  const Vec<2> start{{0.05, 0.01}};
  walls.stop(start, x, v, 1., contacts);
  EXPECT_GE(x[0], 0.);
  EXPECT_GE(x[1], 0.1 * x[0]);
  EXPECT_LE(x[1], x[0] / 3);
}


TEST(Walls, NavierSlipIsSteadyAtForceOverFriction)
{
  Walls<2>     walls = wall_of<2>({{"Shape", "plane(0, 0; 0, 1)"}, {"Law", "navier slip"}, {"Slip length", "0.1"}});
  const double k = 40, dt = 0.1; // k dt = 4: far beyond an explicit step
  double       x[2] = {0, 0}, v[2] = {0, 0}, a[2] = {0, 0};
  Contacts     contacts = walls.faces_at({}, 0.);
  for (int n = 1; n <= 60; ++n)
    {
      walls.move(n * dt, dt);
      v[0] += 0.5 * dt * a[0];
      a[0] = 2;
      a[1] = -1;
      walls.constrain(x, a, v, 1., k, true, contacts);
      v[0] += 0.5 * dt * a[0];
      walls.finish_step();
    }
  EXPECT_NEAR(v[0], 2 / k, 1e-9);
}


TEST(Walls, SlipConductanceIsAreaOverLength)
{
  Walls<2> walls = wall_of<2>({{"Shape", "plane(0, 0; 0, 1)"}, {"Law", "navier slip"}, {"Slip length", "0.1"}});
  const std::array<Vec<2>, 2> facet{Vec<2>{{0, 0}}, Vec<2>{{0.3, 0}}};
  EXPECT_NEAR(walls.slip_conductance(walls.faces_at({}, 0.), facet), 3., 1e-14);
  EXPECT_EQ(walls.slip_conductance(Contacts(), facet), 0.);
}


TEST(Walls, CheckpointBringsBackForcesAndPoses)
{
  const std::map<std::string, std::string> values = {{"Shape", "plane(0, 0; 0, 1)"}, {"Translation", "0; t"}};
  Walls<2>                                 walls = wall_of<2>(values), copy = wall_of<2>(values);
  walls.move(0.5, 0.1);
  double   x[2] = {0, 0.2}, v[2] = {0, -1};
  Contacts contacts;
  walls.stop({{0, 0.6}}, x, v, 1., contacts);
  std::stringstream stream;
  walls.save(stream);
  copy.load(stream);
  EXPECT_EQ(copy.faces_at({{0., 0.5}}, 1e-12), walls.faces_at({{0., 0.5}}, 1e-12));
  EXPECT_FALSE(copy.faces_at({{0., 0.5}}, 1e-12).empty());
  EXPECT_EQ(history_of(copy, 1., "force on Tank y [N]"), history_of(walls, 1., "force on Tank y [N]"));
  EXPECT_EQ(copy.work(), walls.work());
  EXPECT_GT(copy.work(), 0.);
}


TEST(Walls, InitialNodesInSolidsGoAndNewOnesStandOnTheWall)
{
  const Walls<2>      walls = wall_of<2>({{"Shape", "polygon(0.5, 0.5; 1.5, 0.5; 1, 1.5)"}, {"Fluid side", "outside"}});
  std::vector<Vec<2>> lattice;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j)
      lattice.push_back({{0.1 * i, 0.1 * j}});
  const auto   nodes     = walls.fit(lattice, SizeField<2>(spacing_of_nodes), [](const Vec<2> &) {
    return true;
  });
  unsigned int n_on_wall = 0;
  for (const Vec<2> &x : nodes)
    {
      EXPECT_FALSE(x[1] > 0.5 && x[1] - 0.5 < 2 * std::min(x[0] - 0.5, 1.5 - x[0])) << x[0] << " " << x[1];
      n_on_wall += !walls.faces_at(x, 1e-6).empty();
    }
  EXPECT_GE(n_on_wall, 25u); // its circumference is 32 spacings
  EXPECT_LE(n_on_wall, 42u);
  for (const Vec<2> &corner : {Vec<2>{{0.5, 0.5}}, Vec<2>{{1.5, 0.5}}, Vec<2>{{1., 1.5}}})
    EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [&](const Vec<2> &x) {
      return norm(x - corner) < 1e-5;
    }));
}
