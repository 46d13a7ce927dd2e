#include <breakwater/base/exceptions.h>

#include <couplers/interface_problem.h>
#include <couplers/resampled_surface.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace Breakwater;

namespace
{
  template <int dim>
  unsigned int node_at(WetSurface<dim> &surface, const Vec<dim> &x)
  {
    for (unsigned int i = 0; i < surface.position.size(); ++i)
      if (norm(surface.position[i] - x) < 1e-12)
        return i;
    surface.position.push_back(x);
    surface.velocity.push_back({});
    surface.acceleration.push_back({});
    Vec<dim> inverse_mass;
    for (int d = 0; d < dim; ++d)
      inverse_mass[d] = 1 / (1 + x[0]);
    surface.inverse_mass.push_back(inverse_mass);
    surface.mass.push_back(1 + x[0]);
    return surface.position.size() - 1;
  }

  /// A step: a tread of 3 x 2 facets on the square z = 0 with edges of 0.6 m, then a riser of 3 x 4 facets up to z = 1.
  WetSurface<3> step_in_space()
  {
    WetSurface<3> surface;
    const auto    add = [&surface](const double x, const double y, const double z, const Vec<3> &v) {
      const Vec<3> u{{0.2, 0, 0}}, a{{x, y, z}};
      surface.facets.push_back(
           {node_at(surface, a), node_at(surface, a + u), node_at(surface, a + u + v), node_at(surface, a + v)});
    };
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 2; ++j)
          add(0.2 * i, 0.3 * j, 0, {{0, 0.3, 0}});
        for (unsigned int k = 0; k < 4; ++k)
          add(0.2 * i, 0.6, 0.25 * k, {{0, 0, 0.25}});
      }
    return surface;
  }

  /// A corner in the plane, of 3 segments of 0.1 m along x and 2 of 0.2 m along y.
  WetSurface<2> corner_in_plane()
  {
    WetSurface<2>             surface;
    const std::vector<Vec<2>> places = {{{0, 0}}, {{0.1, 0}}, {{0.2, 0}}, {{0.3, 0}}, {{0.3, 0.2}}, {{0.3, 0.4}}};
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      {
        const unsigned int a = node_at(surface, places[k]);
        surface.facets.push_back({a, node_at(surface, places[k + 1])});
      }
    return surface;
  }

  template <int dim>
  void expect_nodes_on_facets(const WetSurface<dim> &owner, const ResampledSurface<dim> &resampled)
  {
    ASSERT_EQ(resampled.weights.size(), resampled.surface.position.size());
    for (std::size_t i = 0; i < resampled.weights.size(); ++i)
      {
        Vec<dim> x;
        double   sum = 0;
        for (const auto &w : resampled.weights[i])
          {
            EXPECT_GT(w.weight, 0);
            x += w.weight * owner.position[w.node];
            sum += w.weight;
          }
        EXPECT_NEAR(sum, 1, 1e-15);
        EXPECT_LT(norm(x - resampled.surface.position[i]), 1e-15);
      }
  }


  TEST(ResampledSurface, HasItsOwnSpacingOnEachSideOfAnEdge)
  {
    const WetSurface<3> step = step_in_space();
    for (const auto &[spacing, nx, ny, nz] :
         {std::array<double, 4>{0.06, 10, 10, 17}, {0.2, 3, 3, 5}, {0.31, 2, 2, 3}, {5, 1, 1, 1}})
      {
        const auto resampled = resample_surface(step, spacing);
        EXPECT_EQ(resampled.surface.facets.size(), nx * (ny + nz));
        EXPECT_EQ(resampled.surface.position.size(), (nx + 1) * (ny + nz + 1)) << "nodes of the edge are there once";
        expect_nodes_on_facets(step, resampled);
        Vec<3> area;
        for (const auto &f : resampled.surface.facets)
          {
            const auto &x = resampled.surface.position;
            area += 0.5 * cross(x[f[2]] - x[f[0]], x[f[3]] - x[f[1]]);
          }
        EXPECT_LT(norm(area - Vec<3>{{0, -0.6, 0.36}}), 1e-14) << "facets face where the owner's do";
      }
  }


  TEST(ResampledSurface, KeepsCornersInThePlane)
  {
    const WetSurface<2> corner = corner_in_plane();
    for (const auto &[spacing, n] : {std::pair<double, unsigned int>{0.04, 18}, {0.15, 5}, {1., 2}})
      {
        const auto resampled = resample_surface(corner, spacing);
        EXPECT_EQ(resampled.surface.facets.size(), n);
        EXPECT_EQ(resampled.surface.position.size(), n + 1);
        expect_nodes_on_facets(corner, resampled);
        EXPECT_TRUE(
          std::any_of(resampled.surface.position.begin(), resampled.surface.position.end(), [](const auto &x) {
            return norm(x - Vec<2>{{0.3, 0}}) < 1e-15;
          }));
      }
  }


  TEST(ResampledSurface, KeepsTheEndsOfBodies)
  {
    WetSurface<2> line;
    for (unsigned int i = 0; i <= 10; ++i)
      node_at(line, {{0.1 * i, 0.}});
    for (unsigned int i = 0; i < 10; ++i)
      {
        line.facets.push_back({i, i + 1});
        line.body_of_facet.push_back(i < 3 ? 0 : 1);
      }
    line.bodies          = {"A", "B"};
    const auto resampled = resample_surface(line, 0.25).surface;
    EXPECT_EQ(resampled.bodies, line.bodies);
    EXPECT_EQ(resampled.body_of_facet, std::vector<unsigned int>({0, 1, 1, 1}));
    EXPECT_NEAR(resampled.position[resampled.facets[1][0]][0], 0.3, 1e-15);
  }


  TEST(ResampledSurface, RefusesASurfaceThatIsNoGrid)
  {
    WetSurface<3> step = step_in_space();
    step.facets.erase(step.facets.begin());
    EXPECT_THROW(resample_surface(step, 0.1), InputError);
  }


  TEST(ResampledSurface, MassIsSharedWithItsMomentum)
  {
    const WetSurface<3> step = step_in_space();
    for (const double spacing : {0., 0.05, 0.3, 0.7})
      {
        const auto          resampled = spacing > 0 ? resample_surface(step, spacing) : copy_of_surface(step);
        std::vector<double> carried, lent;
        share_mass(step, resampled, 0.4, carried, lent);
        for (std::size_t k = 0; k < lent.size(); ++k)
          {
            EXPECT_LE(lent[k], 0.4 * step.mass[k] * (1 + 1e-14));
            EXPECT_GE(lent[k], spacing == 0 ? 0.4 * step.mass[k] * (1 - 1e-14) : 0.);
            double momentum = 0; // of the carried masses if this node alone moves at 1 m/s
            for (std::size_t i = 0; i < carried.size(); ++i)
              for (const auto &w : resampled.weights[i])
                momentum += w.node == k ? w.weight * carried[i] : 0.;
            EXPECT_NEAR(momentum, lent[k], 1e-15);
          }
        const double sum = std::accumulate(lent.begin(), lent.end(), 0.);
        EXPECT_GT(sum, 0.05 * std::accumulate(step.mass.begin(), step.mass.end(), 0.));
        EXPECT_GT(*std::min_element(carried.begin(), carried.end()), 0);
      }
  }


  /// A quarter of a circle of radius 1 m in elements of degree 2, in 3D that of a cylinder 0.5 m high.
  template <int dim>
  WetSurface<dim> arc(const unsigned int n_elements)
  {
    WetSurface<dim>    surface;
    const unsigned int n_layers = dim == 2 ? 1 : 3;
    for (unsigned int k = 0; k < n_layers; ++k)
      for (unsigned int i = 0; i <= 2 * n_elements; ++i)
        {
          const double angle = i * M_PI / (4. * n_elements);
          Vec<dim>     x;
          x[0] = std::cos(angle);
          x[1] = std::sin(angle);
          if constexpr (dim == 3)
            x[2] = 0.25 * k;
          node_at(surface, x);
          surface.is_middle.push_back(i % 2 == 1 || k == 1);
        }
    const unsigned int width = 2 * n_elements + 1;
    for (unsigned int i = 0; i + 1 < width; ++i)
      {
        if constexpr (dim == 2)
          surface.facets.push_back({i, i + 1});
        else
          for (unsigned int k = 0; k < 2; ++k)
            surface.facets.push_back({k * width + i, k * width + i + 1, (k + 1) * width + i + 1, (k + 1) * width + i});
      }
    return surface;
  }

  /// Largest distance of the nodes of another spacing from the circle [m].
  template <int dim>
  double error_of_arc(const unsigned int n_elements, const bool is_linear)
  {
    WetSurface<dim> owner = arc<dim>(n_elements);
    if (is_linear)
      owner.is_middle.clear();
    double largest = 0;
    for (const auto &x : resample_surface(owner, 0.03).surface.position)
      largest = std::max(largest, std::abs(std::hypot(x[0], x[1]) - 1));
    return largest;
  }

  TEST(ResampledSurface, NodesOnElementsOfDegreeTwoLieOnTheCurvedSurface)
  {
    for (const unsigned int n : {2, 4})
      {
        EXPECT_GT(error_of_arc<2>(n, false) / error_of_arc<2>(2 * n, false), 12);
        EXPECT_GT(error_of_arc<3>(n, false) / error_of_arc<3>(2 * n, false), 12);
        EXPECT_LT(error_of_arc<2>(n, true) / error_of_arc<2>(2 * n, true), 5);
        EXPECT_LT(error_of_arc<2>(n, false), 0.1 * error_of_arc<2>(n, true));
      }
  }


  TEST(ResampledSurface, MassOnElementsOfDegreeTwoIsPositiveAndSharedWithItsMomentum)
  {
    const WetSurface<3> owner = arc<3>(3);
    for (const double spacing : {0.04, 0.11, 0.3, 0.8})
      {
        const auto          resampled = resample_surface(owner, spacing);
        std::vector<double> carried, lent(owner.mass.size()), momentum(owner.mass.size());
        share_mass(owner, resampled, 0.5, carried, lent);
        for (std::size_t i = 0; i < carried.size(); ++i)
          {
            EXPECT_GT(carried[i], 0);
            double sum = 0;
            for (const auto &w : resampled.weights[i])
              {
                momentum[w.node] += w.weight * carried[i];
                sum += w.weight;
              }
            EXPECT_NEAR(sum, 1, 1e-14);
          }
        for (std::size_t k = 0; k < lent.size(); ++k)
          {
            EXPECT_NEAR(lent[k], momentum[k], 1e-14);
            EXPECT_LE(lent[k], 0.5 * owner.mass[k] * (1 + 1e-14));
          }
        EXPECT_GT(std::accumulate(lent.begin(), lent.end(), 0.),
                  0.05 * std::accumulate(owner.mass.begin(), owner.mass.end(), 0.));
      }
  }


  /// v . (L - W^T mu W) v over v . M v, of what is lent and carried.
  double part_of_motion(const WetSurface<3> &owner, const ResampledSurface<3> &resampled,
                        const std::vector<double> &carried, const std::vector<double> &lent,
                        const std::vector<double> &v)
  {
    double part = 0, all = 0;
    for (std::size_t k = 0; k < v.size(); ++k)
      {
        part += lent[k] * v[k] * v[k];
        all += owner.mass[k] * v[k] * v[k];
      }
    for (std::size_t i = 0; i < carried.size(); ++i)
      {
        double velocity = 0;
        for (const auto &w : resampled.weights[i])
          velocity += w.weight * v[w.node];
        part -= carried[i] * velocity * velocity;
      }
    return part / all;
  }

  TEST(ResampledSurface, TellsHowMuchMassMayMoveApart)
  {
    for (const WetSurface<3> &owner : {step_in_space(), arc<3>(3)})
      for (const double spacing : {0., 0.02, 0.11, 0.3})
        {
          const auto          resampled = spacing > 0 ? resample_surface(owner, spacing) : copy_of_surface(owner);
          std::vector<double> carried, lent;
          share_mass(owner, resampled, 0.5, carried, lent);
          const double bound = part_that_moves_apart(owner, resampled, carried, lent);
          EXPECT_LE(bound, spacing == 0 ? 0 : 0.5 * (1 + 1e-14));
          double largest = 0;
          for (unsigned int seed = 1; seed < 200; ++seed)
            {
              std::vector<double> v;
              for (std::size_t k = 0; k < owner.mass.size(); ++k)
                v.push_back(std::sin(1. + seed * seed + 7. * seed * k));
              largest = std::max(largest, part_of_motion(owner, resampled, carried, lent, v));
            }
          EXPECT_LE(largest, bound + 1e-14);
          EXPECT_GE(largest, 0.3 * bound) << "and is not far off";
        }
  }


  // With the multipliers the velocities at all places are the same, and momentum is what it was.
  TEST(InterfaceProblem, MakesVelocitiesTheSame)
  {
    WetSurface<3>          owner     = step_in_space();
    const auto             resampled = resample_surface(owner, 0.09);
    WetSurface<3>          nodes     = resampled.surface;
    std::vector<TiedPlace> places;
    owner.inverse_mass[3]    = {{0, 0, 0}}; // held
    owner.inverse_mass[5][1] = 0;           // held in one direction: these have different matrices then
    for (unsigned int i = 0; i < nodes.position.size(); ++i)
      {
        places.push_back({{{0, i, 1.}}, 0});
        for (const auto &w : resampled.weights[i])
          places.back().entries.push_back({1, w.node, -w.weight});
      }
    std::vector<Vec<3>> gap(places.size());
    for (std::size_t r = 0; r < gap.size(); ++r)
      gap[r] = {{std::sin(3. * r), std::cos(5. * r), std::sin(7. * r + 1)}};
    for (const unsigned int direct_up_to : {0u, 1000u})
      {
        InterfaceProblem<3> problem(places, direct_up_to);
        EXPECT_FALSE(problem.is_diagonal());
        const std::vector<double> factor = {2e-5, 7e-5};
        const auto                lambda = problem.solve({&nodes, &owner}, factor, gap);
        EXPECT_EQ(problem.n_iterations() > 0, direct_up_to == 0);

        std::vector<Vec<3>> change_of_nodes(nodes.position.size()), change_of_owner(owner.position.size());
        for (std::size_t r = 0; r < places.size(); ++r)
          for (const auto &e : places[r].entries)
            for (int d = 0; d < 3; ++d)
              (e.domain == 0 ? change_of_nodes : change_of_owner)[e.node][d] -=
                e.weight * lambda[r][d] * factor[e.domain] * (e.domain == 0 ? nodes : owner).inverse_mass[e.node][d];
        for (std::size_t r = 0; r < places.size(); ++r)
          {
            Vec<3> rest = gap[r];
            for (const auto &e : places[r].entries)
              rest += e.weight * (e.domain == 0 ? change_of_nodes : change_of_owner)[e.node];
            EXPECT_LT(norm(rest), 1e-11);
          }
      }
    // Copies share no node: nothing is solved.
    EXPECT_TRUE(InterfaceProblem<3>({{{{0, 0, 1.}, {1, 4, -1.}}, 0}, {{{0, 1, 1.}, {1, 2, -1.}}, 0}}, 0).is_diagonal());
  }
} // namespace
