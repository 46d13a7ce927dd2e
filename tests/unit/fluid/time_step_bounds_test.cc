#include "cloud.h"

#include <pfem_fluid/node_pairs.h>
#include <time_step_bounds/insphere.h>
#include <time_step_bounds/spectral.h>
#include <unit/plugins/given_parameters.h>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class TimeStepBounds : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(TimeStepBounds, Dimensions);

  using Matrix = std::vector<std::vector<double>>;

  /// Largest eigenvalue of a symmetric matrix by Jacobi's rotations.
  double largest_eigenvalue(Matrix a)
  {
    const std::size_t n = a.size();
    for (int sweep = 0; sweep < 30; ++sweep)
      for (std::size_t p = 0; p < n; ++p)
        for (std::size_t q = 0; q < p; ++q)
          {
            if (a[p][q] == 0)
              continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t     = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1), s = t * c;
            for (std::size_t k = 0; k < n; ++k)
              {
                const double kp = a[k][p], kq = a[k][q];
                a[k][p] = c * kp - s * kq;
                a[k][q] = s * kp + c * kq;
              }
            for (std::size_t k = 0; k < n; ++k)
              {
                const double pk = a[p][k], qk = a[q][k];
                a[p][k] = c * pk - s * qk;
                a[q][k] = s * pk + c * qk;
              }
          }
    double largest = a[0][0];
    for (std::size_t k = 0; k < n; ++k)
      largest = std::max(largest, a[k][k]);
    return largest;
  }

  /// A small block of fluid, c = 30 m/s, with uneven masses and stiffnesses.
  template <int dim>
  struct Sample
  {
    SimplexMesh<dim>      mesh;
    std::vector<Vec<dim>> position;
    std::vector<double>   mass, stiffness, sound_speed, row_sums;
    double                viscosity = 0, least_viscous_volume = 0;

    Sample()
    {
      BoxState<dim> state;
      for (int d = 0; d < dim; ++d)
        state.shape.upper[d] = (dim == 2 ? 0.4 : 0.25) + 0.01 * d;
      position = fill_box(state, spacing);
      mesh     = mesh_of<dim>(position);
      Noise               noise(4);
      std::vector<double> volume(position.size());
      for (const auto &cell : mesh.cells)
        for (const unsigned int i : cell)
          volume[i] += signed_volume(corners<dim>(position, cell)) / (dim + 1);
      for (std::size_t i = 0; i < position.size(); ++i)
        {
          mass.push_back(1000 * volume[i] * (1 + 0.1 * noise()));
          stiffness.push_back(1000 * 30 * 30 / volume[i] * (1 + 0.1 * noise()));
          sound_speed.push_back(30);
        }
      row_sums = row_sums_of(mass);
    }

    std::vector<double> row_sums_of(const std::vector<double> &masses) const
    {
      FluidNodes<dim> nodes;
      nodes.resize(position.size());
      for (std::size_t i = 0; i < nodes.n; ++i)
        std::copy_n(position[i].c, dim, nodes.xp[i].c);
      return NodePairs<dim>(nodes, mesh.cells).row_sums(masses);
    }

    LinearizedFluid<dim> fluid() const
    {
      return {mesh, position, mass, stiffness, sound_speed, row_sums, viscosity, least_viscous_volume};
    }

    /// M^-1/2 D^T W D M^-1/2, D by differences of the nodal volumes.
    Matrix acoustic_matrix() const
    {
      const std::size_t n = position.size();
      Matrix            D(n, std::vector<double>(n * dim)), result(n * dim, std::vector<double>(n * dim));
      std::vector<Quad> xp(n);
      for (std::size_t i = 0; i < n; ++i)
        for (int d = 0; d < dim; ++d)
          xp[i][d] = position[i][d];
      for (std::size_t j = 0; j < n; ++j)
        for (int d = 0; d < dim; ++d)
          {
            std::vector<double> up(n), down(n);
            const double        x = xp[j][d], step = 0.01 * spacing; // V is linear in each coordinate
            xp[j][d] = x + step;
            compute_volumes<dim>(mesh.cells, xp, up);
            xp[j][d] = x - step;
            compute_volumes<dim>(mesh.cells, xp, down);
            xp[j][d] = x;
            for (std::size_t i = 0; i < n; ++i)
              D[i][j * dim + d] = (up[i] - down[i]) / (2 * step);
          }
      for (std::size_t p = 0; p < n * dim; ++p)
        for (std::size_t q = 0; q < n * dim; ++q)
          {
            for (std::size_t i = 0; i < n; ++i)
              result[p][q] += D[i][p] * stiffness[i] * D[i][q];
            result[p][q] /= std::sqrt(mass[p / dim] * mass[q / dim]);
          }
      return result;
    }

    /// M^-1/2 C M^-1/2, from the viscous forces of unit velocities.
    Matrix viscous_matrix() const
    {
      const std::size_t n = position.size();
      Matrix            result(n * dim, std::vector<double>(n * dim));
      std::vector<Quad> xp(n), v(n), force(n);
      for (std::size_t i = 0; i < n; ++i)
        for (int d = 0; d < dim; ++d)
          xp[i][d] = position[i][d];
      ForceEffects effects;
      effects.viscous              = true;
      effects.viscosity            = viscosity;
      effects.least_viscous_volume = least_viscous_volume;
      for (std::size_t q = 0; q < n * dim; ++q)
        {
          v[q / dim][q % dim] = 1;
          compute_forces<dim>(mesh.cells, effects, xp, v, v, force);
          v[q / dim][q % dim] = 0;
          for (std::size_t p = 0; p < n * dim; ++p)
            result[p][q] = -force[p / dim][p % dim] / std::sqrt(mass[p / dim] * mass[q / dim]);
        }
      return result;
    }
  };

  template <int dim>
  double spectral(const Sample<dim> &sample, const std::string &method, const unsigned int n_iterations = 20)
  {
    SpectralBound<dim> rule;
    GivenParameters::read(rule, {{"Method", method}, {"Iterations", std::to_string(n_iterations)}});
    return rule.bound(sample.fluid());
  }
} // namespace


TYPED_TEST(TimeStepBounds, PowerIterationFindsTheLargestFrequency)
{
  constexpr int     dim = TypeParam::value;
  const Sample<dim> sample;
  const double      exact = 2 / std::sqrt(largest_eigenvalue(sample.acoustic_matrix()));
  EXPECT_NEAR(spectral(sample, "power iteration", 5000) / exact, 1., 1e-6);
  // From below in frequency, that is from above in the step, at any number of iterations.
  for (const unsigned int n : {1, 5, 20, 100})
    EXPECT_GE(spectral(sample, "power iteration", n), exact * (1 - 1e-9)) << n;
}


TYPED_TEST(TimeStepBounds, PowerIterationGoesOnWhereItStopped)
{
  constexpr int      dim = TypeParam::value;
  const Sample<dim>  sample;
  SpectralBound<dim> rule;
  GivenParameters::read(rule, {{"Method", "power iteration"}, {"Iterations", "10"}});
  double last = rule.bound(sample.fluid());
  EXPECT_NEAR(last / spectral(sample, "power iteration", 10), 1., 1e-14);
  last = rule.bound(sample.fluid());
  EXPECT_NEAR(last / spectral(sample, "power iteration", 20), 1., 1e-9);
}


TYPED_TEST(TimeStepBounds, GershgorinIsSafeAndNotFarOff)
{
  constexpr int     dim = TypeParam::value;
  const Sample<dim> sample;
  const double      exact = 2 / std::sqrt(largest_eigenvalue(sample.acoustic_matrix()));
  const double      bound = spectral(sample, "gershgorin");
  EXPECT_LE(bound, exact);
  EXPECT_GE(bound, exact / 2);
}


TYPED_TEST(TimeStepBounds, RowSumsScaleWithTheMasses)
{
  constexpr int dim = TypeParam::value;
  Sample<dim>   sample;
  const auto    sums = sample.row_sums_of(sample.mass);
  auto          mass = sample.mass;
  for (double &m : mass)
    m *= 4;
  const auto quarter = sample.row_sums_of(mass);
  for (std::size_t i = 0; i < sums.size(); ++i)
    {
      EXPECT_GT(sums[i], 0.);
      EXPECT_NEAR(quarter[i] * 4 / sums[i], 1., 1e-14);
    }
}


TYPED_TEST(TimeStepBounds, ViscosityShortensTheStep)
{
  constexpr int dim = TypeParam::value;
  Sample<dim>   sample;
  const double  inviscid = spectral(sample, "gershgorin");
  sample.viscosity       = 10;
  const double some      = spectral(sample, "gershgorin");
  sample.viscosity       = 1000;
  const double much      = spectral(sample, "gershgorin");
  EXPECT_LT(some, inviscid);
  EXPECT_LT(much, 0.5 * some);
}


// Without pressure the limit is 2 / lambda, lambda the largest eigenvalue of M^-1 C.
TYPED_TEST(TimeStepBounds, ViscousBoundIsSafe)
{
  constexpr int dim = TypeParam::value;
  Sample<dim>   sample;
  sample.viscosity = 10;
  for (double &w : sample.stiffness)
    w = 0;
  const double exact = 2 / largest_eigenvalue(sample.viscous_matrix());
  const double bound = spectral(sample, "gershgorin");
  EXPECT_LE(bound, exact);
  EXPECT_GE(bound, exact / 4);
}


TYPED_TEST(TimeStepBounds, InsphereRuleOnARegularCell)
{
  constexpr int    dim = TypeParam::value;
  Sample<dim>      sample;
  constexpr double edge = 0.2;
  if constexpr (dim == 2)
    sample.position = {{{0, 0}}, {{edge, 0}}, {{0.5 * edge, std::sqrt(3.) / 2 * edge}}};
  else
    sample.position = {{{0, 0, 0}},
                       {{edge, 0, 0}},
                       {{0.5 * edge, std::sqrt(3.) / 2 * edge, 0}},
                       {{0.5 * edge, std::sqrt(3.) / 6 * edge, std::sqrt(2. / 3.) * edge}}};
  sample.mesh.cells = {{}};
  for (unsigned int a = 0; a <= dim; ++a)
    sample.mesh.cells[0][a] = a;
  sample.sound_speed[1] = 40; // the fastest corner counts
  const double radius   = dim == 2 ? edge / std::sqrt(12.) : edge / std::sqrt(24.);
  EXPECT_NEAR(InsphereBound<dim>().bound(sample.fluid()), radius / 40, 1e-15);
}


TYPED_TEST(TimeStepBounds, InsphereRuleIsThatOfTheWorstCell)
{
  constexpr int dim = TypeParam::value;
  Sample<dim>   sample;
  Noise         noise(7);
  for (std::size_t i = 0; i < sample.position.size(); ++i)
    {
      sample.position[i] += 0.2 * spacing * noise.template vec<dim>();
      sample.sound_speed[i] *= 1 + 0.2 * noise();
    }
  double least = 1e300;
  for (const auto &cell : sample.mesh.cells)
    {
      double fastest = 0;
      for (const unsigned int i : cell)
        fastest = std::max(fastest, sample.sound_speed[i]);
      least = std::min(least, std::abs(insphere_radius(corners<dim>(sample.position, cell))) / fastest);
    }
  EXPECT_EQ(InsphereBound<dim>().bound(sample.fluid()), least);
}


TYPED_TEST(TimeStepBounds, AreInfiniteWithoutCells)
{
  constexpr int dim = TypeParam::value;
  Sample<dim>   sample;
  sample.mesh.cells.clear();
  sample.row_sums.assign(sample.position.size(), 0.);
  EXPECT_TRUE(std::isinf(InsphereBound<dim>().bound(sample.fluid())));
  EXPECT_TRUE(std::isinf(spectral(sample, "gershgorin")));
  EXPECT_TRUE(std::isinf(spectral(sample, "power iteration")));
}
