#include "unit/structure/scene.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/simulation/domain_group.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    using Joint = DomainGroup<2>::Joint;

    std::string box(const std::string &mesh, const std::string &more = "")
    {
      return "set Mesh = box(" + mesh + ")\nset Degree = 1\n" + more +
             material_section("Saint Venant Kirchhoff", 1000, 1e5, 0.3);
    }

    /// Structures from the texts of their sections, called A, B and so on, in a group.
    struct Bodies
    {
      explicit Bodies(const std::vector<std::string> &texts, const std::vector<Joint> &joints,
                      const bool is_set_up = true)
      {
        std::vector<DomainGroup<2>::Member> members;
        for (const std::string &text : texts)
          {
            scenes.push_back(std::make_unique<Scene<2>>(text, false));
            members.push_back({std::string(1, static_cast<char>('A' + members.size())), &body(members.size()), true});
          }
        group = std::make_unique<DomainGroup<2>>(members, joints, "the ties");
        if (is_set_up)
          group->setup("", no_forces, scenes.front()->context);
      }

      ExplicitDomain<2>         &body(const unsigned int k) { return *scenes[k]->structure; }
      const WetSurface<2>       &surface(const unsigned int k) { return body(k).wet_surface(); }
      std::pair<int, int>        only_pair() { return joint_nodes(surface(0).position, surface(1).position).at(0); }
      static std::vector<Vec<2>> none(const WetSurface<2> &surface)
      {
        return std::vector<Vec<2>>(surface.position.size());
      }

      void run(const double duration)
      {
        const unsigned int n = std::ceil(duration / (0.5 * group->stable_time_step()));
        for (unsigned int k = 0; k < n; ++k)
          {
            group->advance_free(duration / n);
            group->end_step();
          }
      }

      BodyForces<2>                          no_forces;
      std::vector<std::unique_ptr<Scene<2>>> scenes;
      std::unique_ptr<DomainGroup<2>>        group;
    };

    std::string message_of(const std::vector<std::string> &texts, const std::vector<Joint> &joints)
    {
      Bodies bodies(texts, joints, false);
      try
        {
          bodies.group->setup("", bodies.no_forces, bodies.scenes.front()->context);
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "no InputError";
    }

    unsigned int node_at(const WetSurface<2> &surface, const Vec<2> &place)
    {
      for (unsigned int i = 0; i < surface.position.size(); ++i)
        if (norm(surface.position[i] - place) < 1e-12)
          return i;
      throw std::logic_error("there is no node");
    }

    /// Largest distance between the joined nodes of the first two bodies [m].
    double gap(Bodies &bodies, const std::vector<std::pair<unsigned int, unsigned int>> &pairs)
    {
      double largest = 0;
      for (const auto &[i, j] : pairs)
        largest = std::max(largest, norm(bodies.surface(0).position[i] - bodies.surface(1).position[j]));
      return largest;
    }

    const std::string swinging = "set Clamp =\nset Wet boundaries = all\nset Initial velocity = 0.5*x*x, 3*x*x\n";
    const std::string left = box("0, 0; 0.2, 0.1; 4, 2", swinging), right = box("0.2, 0; 0.5, 0.1; 6, 2", swinging);
  } // namespace

  TEST(DomainGroup, JoinedPiecesMoveAsTheWhole)
  {
    Bodies               pieces({left, right}, {{0, 1}}), whole({box("0, 0; 0.5, 0.1; 10, 2", swinging)}, {});
    const WetSurface<2> &a = pieces.group->wet_surface(), &b = whole.group->wet_surface();
    std::vector<std::pair<unsigned int, unsigned int>> same;
    for (unsigned int i = 0; i < a.position.size(); ++i)
      same.emplace_back(i, node_at(b, a.position[i]));
    const Vec<2> start = a.position[0];
    pieces.run(0.2);
    whole.run(0.2);
    for (const auto &[i, j] : same)
      EXPECT_LT(norm(a.position[i] - b.position[j]), 1e-12);
    EXPECT_GT(norm(a.position[0] - start), 0.01); // of the way of about 0.1 m
    EXPECT_NEAR(pieces.group->balance().energy(), whole.group->balance().energy(), 1e-10);
  }

  TEST(DomainGroup, ItsSurfaceHasJoinedNodesOnceAndNoFacetsInside)
  {
    Bodies               bodies({left, right}, {{0, 1}});
    const WetSurface<2> &surface = bodies.group->wet_surface();
    EXPECT_EQ(surface.position.size(), 24u); // around 10 by 2 cells; the joint's inner node has no facet
    EXPECT_EQ(surface.facets.size(), 24u);
    EXPECT_EQ(surface.bodies, std::vector<std::string>({"A", "B"}));
    ASSERT_EQ(surface.body_of_facet.size(), 24u);
    for (std::size_t f = 0; f < 24; ++f)
      EXPECT_EQ(surface.body_of_facet[f],
                surface.position[surface.facets[f][0]][0] + surface.position[surface.facets[f][1]][0] > 0.4 ? 1u : 0u);
    double mass = 0;
    for (const double m : surface.mass)
      mass += m;
    const double cell = 1000 * 0.05 * 0.05;
    EXPECT_NEAR(mass, cell * (20 - 9), 1e-12); // without the nine nodes inside
  }

  TEST(DomainGroup, AForceOnAJoinedNodeIsSharedByMass)
  {
    Bodies       bodies({left, box("0.2, 0; 0.5, 0.1; 3, 2", swinging)}, {{0, 1}});
    const auto  &surface = bodies.group->wet_surface();
    const auto   node    = node_at(surface, {{0.2, 0.}});
    const Vec<2> before  = surface.acceleration[node];
    auto         force   = Bodies::none(surface);
    force[node]          = {{3., -2.}};
    bodies.group->add_link_force(force, 0.);
    const double mass = 1000 * (0.05 * 0.05 + 0.1 * 0.05) / 4;
    EXPECT_NEAR(surface.mass[node], mass, 1e-14);
    for (unsigned int k = 0; k < 2; ++k)
      {
        const Vec<2> change = bodies.surface(k).acceleration[node_at(bodies.surface(k), {{0.2, 0.}})] - before;
        EXPECT_LT(norm(change - (1 / mass) * force[node]), 1e-9); // of 5
      }
  }

  TEST(DomainGroup, AHeldNodeHoldsTheOther)
  {
    Bodies     bodies({box("0, 0; 0.2, 0.1; 4, 2", "set Clamp = right\nset Wet boundaries = right, top, bottom\n"),
                       box("0.2, 0; 0.5, 0.1; 6, 2", "set Clamp =\nset Initial velocity = 0, 3*(x - 0.2)\n")},
                      {{0, 1}});
    const auto node = node_at(bodies.surface(1), {{0.2, 0.05}});
    bodies.run(0.05);
    EXPECT_LT(norm(bodies.surface(1).position[node] - Vec<2>{{0.2, 0.05}}), 1e-15);
    EXPECT_GT(bodies.body(1).balance().strain_energy, 0.1); // of the 5 J at the start
  }

  TEST(DomainGroup, LentMassIsSharedInProportion)
  {
    Bodies              bodies({left, box("0.2, 0; 0.5, 0.1; 3, 2", swinging)}, {{0, 1}});
    std::vector<double> lent = bodies.group->wet_surface().mass;
    for (double &mass : lent)
      mass *= 0.5;
    const double before = bodies.surface(1).mass[node_at(bodies.surface(1), {{0.2, 0.}})];
    bodies.group->lend_mass(lent);
    EXPECT_NEAR(bodies.surface(1).mass[node_at(bodies.surface(1), {{0.2, 0.}})], 0.5 * before, 1e-15);
  }

  TEST(DomainGroup, AStopOfOneBodyStopsJoinedNodesOfBoth)
  {
    const std::string falling = "set Clamp =\nset Wet boundaries = all\nset Initial velocity = 1, -2\n";
    Bodies            bodies({box("0, 0.01; 0.2, 0.11; 4, 2", falling + "set Stops = 0, 0; 0, 1 | 0.21, 0; -1, 0\n"),
                              box("0.2, 0.01; 0.5, 0.11; 3, 2", falling)},
                             {{0, 1}});
    const auto        pairs = joint_nodes(bodies.surface(0).position, bodies.surface(1).position);
    const auto corner = node_at(bodies.surface(1), {{0.2, 0.01}}), free = node_at(bodies.surface(1), {{0.5, 0.01}});
    double     lowest = 0, lowest_free = 0, farthest = 0, largest_gap = 0;
    for (unsigned int k = 0; k < 100; ++k)
      {
        bodies.run(0.0002);
        lowest      = std::min(lowest, bodies.surface(1).position[corner][1]);
        lowest_free = std::min(lowest_free, bodies.surface(1).position[free][1]);
        largest_gap = std::max(largest_gap, gap(bodies, pairs));
        for (const auto &[i, j] : pairs)
          farthest = std::max(farthest, bodies.surface(1).position[j][0]);
      }
    EXPECT_NEAR(lowest, 0, 1e-15);
    EXPECT_NEAR(farthest, 0.21, 1e-15); // the second plane
    EXPECT_LT(lowest_free, -0.01);      // what is not joined goes through
    EXPECT_LT(largest_gap, 1e-15);
  }

  TEST(DomainGroup, WhatTheStopTakesGoesThroughTheJoint)
  {
    const std::string falling = "set Clamp =\nset Wet boundaries = all\nset Initial velocity = 0, -2\n";
    Bodies            bodies(
                 {box("0, 0; 0.1, 0.1; 1, 1", falling + "set Stops = 0, 0; 0, 1\n"), box("0.1, 0; 0.2, 0.1; 1, 1", falling)},
                 {{0, 1}});
    const double momentum = bodies.body(1).balance().momentum[1];
    bodies.run(0.002);
    Row row;
    bodies.body(1).add_history(row);
    const auto force = std::find_if(row.begin(), row.end(), [](const auto &column) {
      return column.first == "force on B y [N]";
    });
    ASSERT_NE(force, row.end());
    EXPECT_NEAR(0.002 * force->second, bodies.body(1).balance().momentum[1] - momentum, 1e-12);
    EXPECT_GT(bodies.body(1).balance().momentum[1], momentum + 0.1); // of -20
  }

  TEST(DomainGroup, RestartHasTheSameBits)
  {
    Bodies one({left, right}, {{0, 1}}), two({left, right}, {{0, 1}});
    one.run(0.02);
    std::stringstream state;
    one.group->save(state);
    two.group->load(state);
    one.run(0.02);
    two.run(0.02);
    for (std::size_t i = 0; i < one.group->wet_surface().position.size(); ++i)
      for (int d = 0; d < 2; ++d)
        EXPECT_EQ(one.group->wet_surface().position[i][d], two.group->wet_surface().position[i][d]);
  }

  TEST(DomainGroup, SaysWhatDoesNotFitTogether)
  {
    EXPECT_NE(
      message_of({left, box("0.3, 0; 0.5, 0.1; 6, 2", swinging)}, {{0, 1}})
        .find("the ties: \"A\" and \"B\" are tied to each other, but their wet boundaries have no node in common"),
      std::string::npos);
    EXPECT_NE(message_of({left, right}, {}).find("touch at 3 nodes but are not tied to each other; add \"A and B\""),
              std::string::npos);
    EXPECT_NE(message_of({left, box("0.2, 0; 0.5, 0.1; 6, 2", "set Clamp =\nset Initial velocity = 0, 1\n")}, {{0, 1}})
                .find("at time 0 they move apart by"),
              std::string::npos);
  }
} // namespace Breakwater
