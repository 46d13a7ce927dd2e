#include <gtest/gtest.h>
#include <mesh_smoothers/flips.h>

#include <cmath>

#include "clouds.h"

using namespace Breakwater;

namespace
{
  /// n cells around an edge, between nodes on a circle. The edge is close to the side between the first two: the first
  /// cell is a sliver.
  TestMesh<3> ring(const unsigned int n)
  {
    TestMesh<3> result;
    const auto  place = [&](const unsigned int k, const double radius) {
      const double angle = 2 * 3.14159265358979 * (k + 0.1 * (k % 2)) / n;
      return Vec<3>{{radius * std::cos(angle), radius * std::sin(angle), 0}};
    };
    const Vec<3> foot = (place(0, 0.95) + place(1, 0.95)) * 0.5;
    result.position   = {foot - Vec<3>{{0, 0, 0.8}}, foot + Vec<3>{{0, 0, 0.8}}};
    for (unsigned int k = 0; k < n; ++k)
      {
        result.position.push_back(place(k, 1.));
        const unsigned int u = 2 + k, v = 2 + (k + 1) % n;
        result.mesh.cells.push_back({{0, 1, u, v}});
        result.mesh.boundary.push_back({{0, v, u}});
        result.mesh.boundary.push_back({{1, u, v}});
      }
    result.freedom.assign(n + 2, NodeFreedom::fixed);
    return result;
  }

  TEST(Flips, RemoveAnEdgeFromItsRing)
  {
    for (unsigned int n = 3; n <= 7; ++n)
      {
        const TestMesh<3> before = ring(n);
        TestMesh<3>       mesh   = before;
        SmoothingReport   report;
        {
          const auto  task = mesh.task(0.9);
          StarMesh<3> work(mesh.mesh, mesh.position, task);
          Flips<3>    flips(work);
          EXPECT_EQ(flips.improve(0), 1u);
          work.finish(report);
        }
        EXPECT_EQ(mesh.mesh.cells.size(), 2 * (n - 2));
        EXPECT_LT(before.smallest_r(), 0.15);
        EXPECT_GT(mesh.smallest_r(), 0.3);
        EXPECT_EQ(smoothing_violation(before.mesh, before.position, mesh.mesh, mesh.position, before.task(0.9), report),
                  "");
      }
  }

  // Of a ring of eight only a part could be filled anew; an open one would change the boundary.
  TEST(Flips, LeaveLargeAndOpenRingsAlone)
  {
    for (const bool is_open : {false, true})
      {
        TestMesh<3> mesh = ring(is_open ? 5 : 8);
        if (is_open)
          mesh.mesh.cells.pop_back();
        const auto  cells = mesh.mesh.cells;
        const auto  task  = mesh.task(0.9);
        StarMesh<3> work(mesh.mesh, mesh.position, task);
        EXPECT_EQ(Flips<3>(work).improve(0), 0u);
        EXPECT_EQ(mesh.mesh.cells, cells);
      }
  }

  TEST(Flips, TurnTheLongDiagonalOfARhombus)
  {
    TestMesh<2> mesh;
    mesh.position   = {{{-1, 0}}, {{1, 0}}, {{0, 0.5}}, {{0, -0.5}}};
    mesh.mesh.cells = {{{0, 1, 2}}, {{1, 0, 3}}};
    mesh.freedom.assign(4, NodeFreedom::fixed);
    const double before = mesh.smallest_r();
    const auto   task   = mesh.task(0.9);
    StarMesh<2>  work(mesh.mesh, mesh.position, task);
    EXPECT_EQ(Flips<2>(work).improve(0), 1u);
    SmoothingReport report;
    work.finish(report);
    EXPECT_GT(mesh.smallest_r(), 1.2 * before);
    EXPECT_EQ(mesh.mesh.cells.size(), 2u);
  }
} // namespace
