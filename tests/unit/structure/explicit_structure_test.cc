#include "scene.h"

#include <breakwater/base/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Breakwater
{
  namespace
  {
    const std::string soft = material_section("Saint Venant Kirchhoff", 1000, 1e5, 0.3);

    std::string message_of(const std::string &parameters)
    {
      try
        {
          Scene<3> scene(parameters, false);
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "no InputError";
    }

    double total(const DomainBalance<3> &balance)
    {
      return balance.kinetic_energy + balance.strain_energy;
    }

    const std::string tumbling = "set Mesh = box(0, 0, 0; 0.3, 0.2, 0.1; 3, 2, 1)\nset Degree = 2\n"
                                 "set Initial velocity = 1 - 5*y + 4*x*x, 5*x, 0.3 + y*z*10\n" +
                                 soft;
  } // namespace

  TEST(ExplicitStructure, FreeFlightIsExact)
  {
    Scene<3>   scene("set Mesh = box(0, 0, 0; 0.3, 0.2, 0.1; 3, 2, 1)\nset Initial velocity = 3, -1, 2\n" + soft, true,
                     {{0, -10, 0}});
    const auto before = scene.structure->balance();
    const auto start  = scene.structure->output_mesh().position;
    scene.run(0.5);
    const auto after = scene.structure->balance();
    const auto end   = scene.structure->output_mesh().position;
    for (std::size_t i = 0; i < start.size(); ++i)
      EXPECT_LT(norm(end[i] - start[i] - Vec<3>{{1.5, -0.5 - 1.25, 1.}}), 1e-11);
    EXPECT_NEAR(after.mass, 6., 1e-12);
    EXPECT_NEAR(after.momentum[1], 6 * (-1. - 5.), 1e-10);
    EXPECT_NEAR(after.kinetic_energy + after.potential_energy, before.kinetic_energy + before.potential_energy, 1e-9);
    EXPECT_LT(after.strain_energy, 1e-15);
  }

  TEST(ExplicitStructure, ABlockThrownAtAStopNeverCrossesItAndBouncesWithLessEnergy)
  {
    Scene<3>     scene("set Mesh = box(0.01, 0, 0; 0.3, 0.2, 0.1; 3, 2, 1)\nset Initial velocity = -0.5, 1, 0\n"
                           "set Stops = 0, 0, 0; 2, 0, 0 | 0, -9, 0; 0, 1, 0\n" +
                         soft,
                       true, {});
    const double energy  = total(scene.structure->balance());
    double       least_x = 1, largest_energy = 0;
    for (unsigned int k = 0; k < 60; ++k)
      {
        scene.run(0.002);
        for (const Vec<3> &x : scene.structure->output_mesh().position)
          least_x = std::min(least_x, x[0]);
        largest_energy = std::max(largest_energy, total(scene.structure->balance()));
      }
    const auto after = scene.structure->balance();
    EXPECT_LT(least_x, 1e-12);
    EXPECT_GT(least_x, -1e-12);
    EXPECT_LT(largest_energy, energy * (1 + 1e-3));
    EXPECT_GT(after.momentum[0], 0.1 * after.mass);
    EXPECT_NEAR(after.momentum[1], after.mass, 1e-9 * after.mass);
  }

  TEST(ExplicitStructure, TumblingKeepsMomentumAndEnergy)
  {
    double drift[2];
    for (const int halved : {0, 1})
      {
        Scene<3>   scene("set Fraction of the bound = " + std::to_string(halved ? 0.4 : 0.8) + "\n" + tumbling);
        const auto before = scene.structure->balance();
        drift[halved]     = 0;
        scene.run(0.5, [&](double) {
          const auto now = scene.structure->balance();
          drift[halved]  = std::max(drift[halved], std::abs(total(now) / total(before) - 1));
        });
        const auto after = scene.structure->balance();
        EXPECT_LT(norm(after.momentum - before.momentum), 1e-11 * norm(before.momentum));
        EXPECT_GT(after.strain_energy, 1e-3 * total(before)) << "the case must deform";
      }
    std::cout << "largest energy error: " << drift[0] << ", at half the step " << drift[1] << "\n";
    EXPECT_LT(drift[0], 5e-3);
    EXPECT_LT(drift[1], drift[0] / 3.5); // second order
  }

  TEST(ExplicitStructure, StepFollowsTheDeformation)
  {
    // Clamped on both sides and blown up: the cells stiffen, and the step must become smaller.
    Scene<2>     scene("set Mesh = box(0, 0; 1, 0.05; 20, 1)\nset Degree = 2\nset Clamp = left, right\n"
                           "set Initial velocity = 0, 6*sin(pi*x)\n" +
                       material_section("Saint Venant Kirchhoff", 1000, 1e5, 0.));
    const double before = scene.structure->stable_time_step();
    const double energy = scene.structure->balance().kinetic_energy;
    double       least = before, largest_energy = 0;
    for (double time = 0; time < 0.5;)
      {
        const double time_step = scene.structure->stable_time_step();
        scene.step(time_step);
        time += time_step;
        const auto now = scene.structure->balance();
        least          = std::min(least, scene.structure->stable_time_step());
        largest_energy = std::max(largest_energy, now.kinetic_energy + now.strain_energy);
      }
    std::cout << "smallest step over the first: " << least / before << ", largest energy over the first "
              << largest_energy / energy << "\n";
    EXPECT_LT(least, 0.6 * before);
    EXPECT_LT(largest_energy, 1.002 * energy);
  }

  TEST(ExplicitStructure, AStepBeyondTheBoundIsUnstable)
  {
    for (const double factor : {1., 1.2})
      {
        Scene<2>     scene("set Mesh = box(0, 0; 0.4, 0.3; 4, 3)\nset Degree = 1\nset Fraction of the bound = 1\n"
                               "set Initial velocity = 1e-3*sin(100*x*y), 0\n" +
                           material_section("linear elastic", 1000, 1e5, 0.3));
        const double energy    = scene.structure->balance().kinetic_energy;
        const double time_step = factor * scene.structure->stable_time_step();
        double       ratio     = 0;
        for (unsigned int n = 0; n < 200 && ratio < 1000; ++n)
          {
            scene.step(time_step);
            ratio = std::max(ratio, scene.structure->balance().kinetic_energy / energy);
          }
        if (factor == 1)
          {
            EXPECT_LT(ratio, 4.);
          }
        else
          {
            EXPECT_GT(ratio, 100.);
          }
      }
  }

  TEST(ExplicitStructure, LinkForcesAreForces)
  {
    const std::string beam =
      "set Mesh = box(0, 0, 0; 0.3, 0.1, 0.1; 4, 1, 1)\nset Degree = 1\nset Clamp = left\n" + soft;
    const Vec<3> gravity{{0, -5, 1}};
    Scene<3>     pulled("set Wet boundaries = right, left, bottom, top, front, back\n" + beam);
    Scene<3>     heavy(beam, true, gravity);
    const auto  &surface = pulled.structure->wet_surface();

    std::vector<Vec<3>> force(surface.position.size());
    for (std::size_t i = 0; i < force.size(); ++i)
      if (surface.inverse_mass[i][0] > 0)
        force[i] = (1 / surface.inverse_mass[i][0]) * gravity;
    pulled.structure->add_link_force(force, 0.);
    const double time_step = heavy.structure->stable_time_step();
    for (unsigned int n = 0; n < 200; ++n)
      {
        pulled.structure->advance_free(time_step);
        pulled.structure->add_link_force(force, time_step);
        pulled.structure->end_step();
        heavy.step(time_step);
      }
    const auto a = pulled.structure->output_mesh(), b = heavy.structure->output_mesh();
    double     largest = 0, difference = 0;
    for (std::size_t i = 0; i < a.fields[0].values.size(); ++i)
      {
        largest    = std::max(largest, std::abs(a.fields[0].values[i]));
        difference = std::max(difference, std::abs(a.fields[0].values[i] - b.fields[0].values[i]));
      }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(difference, 1e-11 * largest);
  }

  TEST(ExplicitStructure, DampingDecaysAsItShould)
  {
    // A rigid flight: v = v0 exp(-alpha t).
    Scene<2> scene("set Mesh = box(0, 0; 1, 1; 1, 1)\nset Damping = 2\nset Initial velocity = 1, 0\n"
                   "set Fraction of the bound = 0.1\n" +
                   material_section("linear elastic", 1000, 1e7, 0.));
    scene.run(1.);
    const auto balance = scene.structure->balance();
    EXPECT_NEAR(balance.momentum[0] / balance.mass, std::exp(-2.), 1e-3 * std::exp(-2.));
  }

  TEST(ExplicitStructure, WetSurfaceLeavesOutTheClampAndHoldsItsRim)
  {
    Scene<3>    scene("set Mesh = box(0, 0, 0; 0.1, 0.4, 0.2; 1, 2, 1)\nset Degree = 2\nset Clamp = bottom\n" + soft);
    const auto &surface = scene.structure->wet_surface();
    EXPECT_EQ(surface.facets.size(), 4u * (1 + 2 * 2 * 2)); // top; each of the 2 x 2 pairs of sides has 2 cells
    EXPECT_EQ(surface.position.size(), 3u * 5 * 3 - 3 - 1); // all but those inside, and inside the clamped side
    for (std::size_t i = 0; i < surface.position.size(); ++i)
      EXPECT_EQ(surface.inverse_mass[i][1] == 0, surface.position[i][1] == 0);

    Scene<3> some("set Mesh = box(0, 0, 0; 0.1, 0.4, 0.2; 1, 2, 1)\nset Wet boundaries = left\n" + soft);
    EXPECT_EQ(some.structure->wet_surface().facets.size(), 8u);
    Scene<3> none("set Mesh = box(0, 0, 0; 0.1, 0.4, 0.2; 1, 2, 1)\nset Wet boundaries = none\n" + soft);
    EXPECT_TRUE(none.structure->wet_surface().position.empty());
  }

  TEST(ExplicitStructure, WetSurfaceFollowsTheMotion)
  {
    Scene<2> scene("set Mesh = box(0, 0; 0.1, 0.4; 1, 2)\nset Initial velocity = 1, 2\n" + soft, true, {{0., 3.}});
    EXPECT_NEAR(scene.structure->wet_surface().acceleration[0][1], 3., 1e-12);
    const Vec<2> start = scene.structure->wet_surface().position[0];
    scene.step(1e-3);
    EXPECT_NEAR(scene.structure->wet_surface().position[0][0] - start[0], 1e-3, 1e-12);
    EXPECT_NEAR(scene.structure->wet_surface().velocity[0][1], 2 + 3e-3, 1e-12);
  }

  TEST(ExplicitStructure, GravityMayBeSwitchedOff)
  {
    Scene<2> scene("set Mesh = box(0, 0; 1, 1; 1, 1)\nset Body forces act = false\n" + soft, true, {{0., -10.}});
    scene.run(0.1);
    EXPECT_EQ(scene.structure->balance().kinetic_energy, 0);
    EXPECT_EQ(scene.structure->balance().potential_energy, 0);
  }

  TEST(ExplicitStructure, RestartHasTheSameBits)
  {
    Scene<3>     first(tumbling), second(tumbling);
    const double time_step = first.structure->stable_time_step();
    for (unsigned int n = 0; n < 13; ++n)
      first.step(time_step);
    std::stringstream stream;
    first.structure->save(stream);
    second.structure->load(stream);
    for (unsigned int n = 0; n < 20; ++n)
      {
        EXPECT_EQ(first.structure->stable_time_step(), second.structure->stable_time_step());
        first.step(first.structure->stable_time_step());
        second.step(second.structure->stable_time_step());
      }
    const auto a = first.structure->output_mesh(), b = second.structure->output_mesh();
    for (std::size_t field = 0; field < a.fields.size(); ++field)
      EXPECT_EQ(a.fields[field].values, b.fields[field].values);

    Scene<3>          other("set Mesh = box(0, 0, 0; 1, 1, 1; 1, 1, 1)\n" + soft);
    std::stringstream again;
    first.structure->save(again);
    EXPECT_THROW(other.structure->load(again), InputError);
  }

  TEST(ExplicitStructure, OutputSplitsCellsOfDegreeTwo)
  {
    Scene<3>   scene("set Mesh = box(0, 0, 0; 2, 2, 2; 2, 1, 1)\nset Degree = 2\n" + soft);
    const auto output = scene.structure->output_mesh();
    EXPECT_EQ(output.position.size(), 5u * 3 * 3);
    ASSERT_EQ(output.cells.size(), 2u * 8 * 8);
    for (std::size_t cell = 0; cell < output.cells.size(); cell += 8)
      for (int vertex = 0; vertex < 8; ++vertex)
        {
          const Vec<3> edge = output.position[output.cells[cell + vertex]] - output.position[output.cells[cell]];
          EXPECT_NEAR(edge[0], vertex % 2 * 0.5, 1e-14);
          EXPECT_NEAR(edge[1], vertex / 2 % 2 * 1., 1e-14);
          EXPECT_NEAR(edge[2], vertex / 4 * 1., 1e-14);
        }
  }

  TEST(ExplicitStructure, StopsWhenACellTurnsInsideOut)
  {
    Scene<2> scene("set Mesh = box(0, 0; 1, 1; 2, 2)\nset Clamp = left\nset Initial velocity = -300*x, 0\n" + soft);
    try
      {
        scene.run(0.1);
        FAIL() << "no BreakdownError";
      }
    catch (const BreakdownError &error)
      {
        const std::string message = error.what();
        for (const char *part : {"Beam: cell", "undeformed centre at (", "inside out at", " s"})
          EXPECT_NE(message.find(part), std::string::npos) << message;
      }
  }

  TEST(ExplicitStructure, StopsWhenTheStateIsNotFinite)
  {
    Scene<2>            scene("set Mesh = box(0, 0; 1, 1; 2, 2)\n" + soft);
    std::vector<Vec<2>> force(scene.structure->wet_surface().position.size());
    force[0][1] = std::nan("");
    scene.structure->advance_free(1e-4);
    scene.structure->add_link_force(force, 1e-4);
    EXPECT_THROW(
      {
        scene.structure->end_step();
        scene.step(1e-4);
      },
      BreakdownError);
  }

  TEST(ExplicitStructure, SaysWhatIsWrongInTheParameterFile)
  {
    const std::string                                      mesh  = "set Mesh = box(0, 0, 0; 1, 1, 1; 1, 1, 1)\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
      {mesh, "needs a material"},
      {soft, "box(x0, y0, z0; x1, y1, z1; nx, ny, nz)"},
      {mesh + "set Clamp = botom\n" + soft, "left, right, bottom, top, front, back"},
      {mesh + "set Wet boundaries = all, top\n" + soft, "no boundary \"all\""},
      {mesh + "set Degree = 3\n" + soft, "3"},
      {mesh + "set Initial velocity = 1, 2\n" + soft, "3 are needed"},
      {mesh + "set Initial velocity = x +* y, 0, 0\n" + soft, "\"x +* y\" is no expression"},
      {mesh + "set Initial velocity = 1, 1/(x - 0.5), 0\n" + soft, "no finite value"},
      {mesh + "set Fraction of the bound = 1.5\n" + soft, "1.5"},
      {mesh + material_section("Saint Venant Kirchhoff", 1000, 1e5, 0.5), "Poisson's ratio"},
      {mesh + material_section("Saint Venant Kirchhof", 1000, 1e5, 0.3), "Saint Venant Kirchhoff"}};
    for (const auto &[text, expected] : cases)
      {
        const std::string message = message_of(text);
        EXPECT_NE(message.find(expected), std::string::npos) << message;
        std::cout << "  " << message << "\n";
      }
  }

  TEST(ExplicitStructure, RefusesAMappingThatTurnsACornerInsideOut)
  {
    // The corner of the unit square that goes to (0.45, 0.45) m lies behind the line between its neighbours, while the
    // Jacobian is positive at all Gauss points.
    for (const char *degree : {"1", "2"})
      try
        {
          Scene<2> scene("set Mesh = box(0, 0; 1, 1; 1, 1)\nset Mapping = x - 0.55*x*y, y - 0.55*x*y\nset Degree = " +
                         std::string(degree) + "\n" + soft);
          ADD_FAILURE() << "no InputError";
        }
      catch (const InputError &error)
        {
          EXPECT_NE(std::string(error.what()).find("corner at (0.45, 0.45) m"), std::string::npos) << error.what();
        }
  }

  TEST(ExplicitStructure, InitialVelocityIsGivenByExpressions)
  {
    const std::string mesh = "set Mesh = box(0, 2; 0.5, 3; 1, 1)\nset Degree = 1\n";
    Scene<2>          scene(mesh + "set Initial velocity = max(x, y) * 2, sin(pi*x)\n" + soft);
    const auto       &surface = scene.structure->wet_surface();
    ASSERT_EQ(surface.position.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
      {
        EXPECT_DOUBLE_EQ(surface.velocity[i][0], 2 * surface.position[i][1]);
        EXPECT_DOUBLE_EQ(surface.velocity[i][1], surface.position[i][0] > 0 ? 1. : 0.);
      }
    // Finite at the centre of the box, but not at the nodes on its left.
    EXPECT_THROW(Scene<2>(mesh + "set Initial velocity = 1, 1/x\n" + soft), InputError);
  }

  // Whoever borrows the mass moves along: with the inertia that is missing given back as a force, nothing changes.
  TEST(ExplicitStructure, LentMassIsInertiaOnly)
  {
    const std::string   beam = "set Mesh = box(0, 0; 0.3, 0.1; 4, 1)\nset Clamp = left\nset Damping = 3\n" + soft;
    Scene<2>            whole(beam, true, {{0., -5.}}), lending(beam, true, {{0., -5.}});
    const auto         &surface   = lending.structure->wet_surface();
    const double        time_step = 0.3 * whole.structure->stable_time_step();
    std::vector<double> mass      = surface.mass;
    for (double &m : mass)
      m *= 0.5;
    lending.structure->lend_mass(mass);
    EXPECT_NEAR(lending.structure->stable_time_step() / whole.structure->stable_time_step(), std::sqrt(0.5), 1e-3);
    EXPECT_DOUBLE_EQ(surface.mass[0], mass[0]);
    EXPECT_EQ(lending.structure->balance().mass, whole.structure->balance().mass);

    // At a free node a = (M / M') a_whole; the borrower's force is -m a, a = a_free / 2 of the node with half its mass.
    const auto borrow = [&](const double step) {
      std::vector<Vec<2>> force(mass.size());
      for (std::size_t i = 0; i < mass.size(); ++i)
        if (surface.inverse_mass[i][0] > 0)
          force[i] = -0.5 * mass[i] * surface.acceleration[i];
      lending.structure->add_link_force(force, step);
    };
    borrow(0.);
    for (unsigned int n = 0; n < 100; ++n)
      {
        whole.step(time_step);
        lending.structure->advance_free(time_step);
        borrow(time_step);
        lending.structure->end_step();
      }
    for (std::size_t i = 0; i < mass.size(); ++i)
      EXPECT_NEAR(norm(surface.position[i] - whole.structure->wet_surface().position[i]), 0, 2e-6);
    EXPECT_GT(norm(surface.velocity.back()), 1e-3);
  }

  TEST(ExplicitStructure, RefusesAForeignSurface)
  {
    Scene<2> scene("set Mesh = box(0, 0; 1, 1; 1, 1)\n" + soft);
    EXPECT_FALSE(scene.structure->can_adopt_surface());
    EXPECT_THROW(scene.structure->adopt_surface({}), InputError);
  }
} // namespace Breakwater
