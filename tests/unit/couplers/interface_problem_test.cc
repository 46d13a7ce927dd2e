#include <couplers/interface_problem.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// Nodes of a first domain, each tied to a point between two neighbouring nodes of a second one; the second one's
    /// first node is held, and its last one in y.
    struct Line
    {
      Line(const unsigned int n_places, const unsigned int n_owners)
        : first(n_places)
        , second(n_owners)
      {
        for (unsigned int r = 0; r < n_places; ++r)
          {
            const double       x = (r + 0.5) / n_places * (n_owners - 1);
            const unsigned int k = std::min<unsigned int>(x, n_owners - 2);
            places.push_back({{{0, r, 1.}, {1, k, x - k - 1}, {1, k + 1, k - x}}, 0});
            first.inverse_mass[r] = {{1.3 + std::sin(r), 1.3 + std::sin(r)}};
          }
        for (unsigned int k = 0; k < n_owners; ++k)
          second.inverse_mass[k] = {{0.7 + 0.3 * std::cos(k), 0.7 + 0.3 * std::cos(k)}};
        second.inverse_mass.front()   = {};
        second.inverse_mass.back()[1] = 0;
      }

      struct Surface : WetSurface<2>
      {
        explicit Surface(const unsigned int n) { inverse_mass.resize(n); }
      };
      Surface                first, second;
      std::vector<TiedPlace> places;
    };

    /// Largest component of H lambda - g, H lambda the mismatch of the velocities c M^-1 W^T lambda.
    double residual(const Line &line, const std::vector<double> &factor, const std::vector<Vec<2>> &lambda,
                    const std::vector<Vec<2>> &g)
    {
      const WetSurface<2>             *surfaces[2] = {&line.first, &line.second};
      std::vector<std::vector<Vec<2>>> velocity;
      for (const WetSurface<2> *surface : surfaces)
        velocity.emplace_back(surface->inverse_mass.size());
      for (std::size_t r = 0; r < line.places.size(); ++r)
        for (const auto &e : line.places[r].entries)
          for (int d = 0; d < 2; ++d)
            velocity[e.domain][e.node][d] +=
              factor[e.domain] * surfaces[e.domain]->inverse_mass[e.node][d] * e.weight * lambda[r][d];
      double largest = 0;
      for (std::size_t r = 0; r < line.places.size(); ++r)
        {
          Vec<2> rest = -1. * g[r];
          for (const auto &e : line.places[r].entries)
            rest += e.weight * velocity[e.domain][e.node];
          largest = std::max(largest, norm(rest));
        }
      return largest;
    }
  } // namespace

  // More places than shared nodes: the equations of these nodes are solved. Fewer: those of the places.
  TEST(InterfaceProblem, IsSolvedWithMoreAndWithFewerPlacesThanOwners)
  {
    for (const unsigned int direct_up_to : {1000u, 0u})
      for (const unsigned int n_owners : {6u, 40u})
        for (const std::vector<double> &factor : {std::vector<double>{1e-4, 1e-4}, {1e-6, 1e-3}, {1e-3, 1e-6}})
          {
            const Line          line(30, n_owners);
            std::vector<Vec<2>> g;
            for (unsigned int r = 0; r < 30; ++r)
              g.push_back({{std::sin(3. * r), std::cos(5. * r)}});
            InterfaceProblem<2> problem(line.places, direct_up_to);
            const auto          lambda = problem.solve({&line.first, &line.second}, factor, g);
            EXPECT_LT(residual(line, factor, lambda, g), 1e-11) << n_owners << " owners, steps of " << factor[0];
            EXPECT_EQ(problem.n_iterations() > 0, direct_up_to == 0);
          }
  }

  TEST(InterfaceProblem, FollowsMassesThatChange)
  {
    Line                line(30, 6);
    std::vector<Vec<2>> g(30, Vec<2>{{1., 2.}});
    InterfaceProblem<2> problem(line.places, 1000);
    problem.solve({&line.first, &line.second}, {1e-4, 1e-4}, g);
    for (Vec<2> &inverse_mass : line.second.inverse_mass)
      inverse_mass *= 2.;
    ++line.second.revision;
    const auto lambda = problem.solve({&line.first, &line.second}, {1e-4, 1e-4}, g);
    EXPECT_LT(residual(line, {1e-4, 1e-4}, lambda, g), 1e-12);
  }
} // namespace Breakwater
