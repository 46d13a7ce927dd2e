#include "cloud.h"

#include <algorithm>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class Passes : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(Passes, Dimensions);

  const FilterWeights filter_weights{0.2, 1.}; ///< of deviation and divergence

  /// A block whose nodes have moved so far that some cells are flat or inverted, with random fields.
  template <int dim>
  struct Tangle
  {
    Block<dim>          block;
    std::vector<Quad>   x, v, slope;
    std::vector<double> volume, node_density, inverse_mass, cell_volume_at_rest;
    std::vector<Quad>   gradient; ///< a buffer

    explicit Tangle(const double move = 0.6 * spacing)
      : x(block.nodes.xp)
      , v(x.size())
      , slope(x.size())
      , volume(x.size())
      , node_density(x.size())
      , inverse_mass(x.size())
    {
      Noise noise(5);
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          for (int d = 0; d < dim; ++d)
            {
              x[i][d] += move * noise();
              v[i][d]     = noise();
              slope[i][d] = 10 * noise();
            }
          x[i][3]         = 1000 * noise();
          slope[i][3]     = 1000 + 10 * noise();
          node_density[i] = 1000 + 100 * noise();
          inverse_mass[i] = 1. / (node_density[i] * regular_volume<dim>(spacing));
        }
      compute_volumes<dim>(cells(), x, volume);
      for (const auto &cell : cells())
        cell_volume_at_rest.push_back(signed_volume(block.nodes.corners(cell)));
    }

    /// Cells with a stiffness of their own.
    void make_stiff(ForceEffects &effects) const
    {
      effects.cell_stiffness      = 500.;
      effects.least_cell_volume   = 0.05 * regular_volume<dim>(spacing);
      effects.cell_volume_at_rest = cell_volume_at_rest.data();
    }

    const auto &cells() const { return block.mesh.cells; }

    Simplex<dim> corners(const typename SimplexMesh<dim>::Cell &cell) const
    {
      Simplex<dim> result;
      for (int a = 0; a <= dim; ++a)
        result[a] = FluidNodes<dim>::vec(x[cell[a]]);
      return result;
    }
    unsigned int n_inverted() const
    {
      return std::count_if(cells().begin(), cells().end(), [&](const auto &cell) {
        return signed_volume(corners(cell)) < 0;
      });
    }
    std::vector<Quad> forces(const ForceEffects &effects) const
    {
      std::vector<Quad> force(x.size());
      compute_forces<dim>(cells(), effects, x, v, slope, force);
      return force;
    }
  };

  ForceEffects effects_of(const bool viscous, const bool density_diffusion)
  {
    ForceEffects effects;
    effects.viscous              = viscous;
    effects.density_diffusion    = density_diffusion;
    effects.viscosity            = 3.;
    effects.least_viscous_volume = 1e-5;
    return effects;
  }

  /// The formulas of kernels.h, written out component by component.
  template <int dim>
  std::vector<Quad> reference_forces(const Tangle<dim> &t, const ForceEffects &effects)
  {
    std::vector<Quad> force(t.x.size());
    for (std::size_t c = 0; c < t.cells().size(); ++c)
      {
        const auto        &cell = t.cells()[c];
        const Simplex<dim> x = t.corners(cell), area = area_vectors(x);
        const double       volume   = std::abs(signed_volume(x));
        double             pressure = 0, L[dim][dim] = {}, trace = 0, mean[4] = {};
        Vec<dim>           center;
        for (int a = 0; a <= dim; ++a)
          {
            const unsigned int i = cell[a];
            pressure += t.x[i][3] / (dim + 1);
            center += x[a] * (1. / (dim + 1));
            for (int d = 0; d < 4; ++d)
              mean[d] += t.slope[i][d] / (dim + 1);
            for (int d = 0; d < dim; ++d)
              for (int e = 0; e < dim; ++e)
                L[d][e] += t.v[i][d] * area[a][e] / std::max(volume, effects.least_viscous_volume);
          }
        for (int d = 0; d < dim; ++d)
          trace += L[d][d];
        if (effects.cell_stiffness > 0)
          pressure -= effects.cell_stiffness * (signed_volume(x) - t.cell_volume_at_rest[c]) /
                      std::max(t.cell_volume_at_rest[c], effects.least_cell_volume);
        for (int a = 0; a <= dim; ++a)
          {
            Quad &f = force[cell[a]];
            for (int d = 0; d < dim; ++d)
              {
                f[d] += pressure * area[a][d];
                if (effects.viscous)
                  for (int e = 0; e < dim; ++e)
                    f[d] -= effects.viscosity * (L[d][e] + L[e][d] - (d == e ? 2. / 3. * trace : 0.)) * area[a][e];
              }
            if (effects.density_diffusion)
              {
                double rest = t.slope[cell[a]][3] - mean[3];
                for (int d = 0; d < dim; ++d)
                  rest -= mean[d] * (x[a][d] - center[d]);
                f[3] += volume * rest;
              }
          }
      }
    return force;
  }

  /// Largest difference of the first components, relative to the largest entry of that component. The fourth one of a
  /// force means something only with density diffusion.
  double difference(const std::vector<Quad> &a, const std::vector<Quad> &b, const int n_components = 3)
  {
    double worst = 0;
    for (int d = 0; d < n_components; ++d)
      {
        double largest = 1e-300, apart = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
          {
            largest = std::max(largest, std::abs(b[i][d]));
            apart   = std::max(apart, std::abs(a[i][d] - b[i][d]));
          }
        worst = std::max(worst, apart / largest);
      }
    return worst;
  }

  Quad sum_of(const std::vector<Quad> &values)
  {
    Quad sum;
    for (const Quad &q : values)
      for (int d = 0; d < 4; ++d)
        sum[d] += q[d];
    return sum;
  }

  double largest_of(const std::vector<Quad> &values, const int first = 0, const int last = 2)
  {
    double largest = 0;
    for (const Quad &q : values)
      for (int d = first; d <= last; ++d)
        largest = std::max(largest, std::abs(q[d]));
    return largest;
  }

  /// v_d = base_d + sum_e gradient_de x_e
  template <int dim>
  void set_linear_velocity(Tangle<dim> &t, const double gradient[3][3])
  {
    for (std::size_t i = 0; i < t.x.size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          t.v[i][d] = 0.3 * (d + 1);
          for (int e = 0; e < dim; ++e)
            t.v[i][d] += gradient[d][e] * t.x[i][e];
        }
  }

  template <int dim>
  double power_of(const std::vector<Quad> &force, const std::vector<Quad> &v)
  {
    double power = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      for (int d = 0; d < dim; ++d)
        power += force[i][d] * v[i][d];
    return power;
  }

  bool has_avx2()
  {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  }
} // namespace


TYPED_TEST(Passes, BothInstructionSetsAgree)
{
  constexpr int dim = TypeParam::value;
  if (!has_avx2())
    GTEST_SKIP() << "this machine has no AVX2";
  const Tangle<dim> t;
  const auto        n_cells = t.cells().size();
  const auto       *cells   = t.cells().front().data();
  const auto        one = Baseline::element_passes<dim>(), two = Avx2::element_passes<dim>();

  for (const bool viscous : {false, true})
    for (const bool diffusion : {false, true})
      {
        std::vector<Quad> a(t.x.size()), b(t.x.size());
        auto              effects = effects_of(viscous, diffusion);
        t.make_stiff(effects);
        one.forces[viscous][diffusion](cells, n_cells, effects, t.x.data(), t.v.data(), t.slope.data(), a.data());
        two.forces[viscous][diffusion](cells, n_cells, effects, t.x.data(), t.v.data(), t.slope.data(), b.data());
        EXPECT_LT(difference(a, b, diffusion ? 4 : 3), 1e-13) << viscous << diffusion;
      }

  std::vector<double> volume(t.x.size());
  one.volumes(cells, n_cells, t.x.data(), volume.data());
  std::vector<double> other(t.x.size());
  two.volumes(cells, n_cells, t.x.data(), other.data());
  for (std::size_t i = 0; i < volume.size(); ++i)
    EXPECT_NEAR(volume[i], other[i], 1e-13 * regular_volume<dim>(spacing));

  std::vector<Quad> gradient(t.x.size() * dim), other_gradient(t.x.size() * dim);
  one.velocity_gradients(cells, n_cells, t.x.data(), t.v.data(), gradient.data());
  two.velocity_gradients(cells, n_cells, t.x.data(), t.v.data(), other_gradient.data());
  EXPECT_LT(difference(gradient, other_gradient), 1e-13);

  std::vector<Quad> impulse(t.x.size()), other_impulse(t.x.size());
  one.filter_impulses(cells, n_cells, filter_weights, t.x.data(), t.v.data(), gradient.data(), t.node_density.data(),
                      t.inverse_mass.data(), impulse.data());
  two.filter_impulses(cells, n_cells, filter_weights, t.x.data(), t.v.data(), gradient.data(), t.node_density.data(),
                      t.inverse_mass.data(), other_impulse.data());
  EXPECT_LT(difference(impulse, other_impulse), 1e-13);

  // Mass exchange: every seventh node takes no part.
  std::vector<double> weight(n_cells), excess(t.x.size()), active(t.x.size(), 1.), given(t.x.size()), part(t.x.size()),
    taken(t.x.size()), other_taken(t.x.size()), turnover(t.x.size());
  std::vector<Quad> request(n_cells), other_request(n_cells), momentum(t.v), received(t.x.size()),
    other_received(t.x.size());
  Noise noise(8);
  for (double &w : weight)
    w = 1.5 + noise();
  for (std::size_t i = 0; i < t.x.size(); ++i)
    {
      excess[i]      = noise();
      active[i]      = i % 7 != 0;
      part[i]        = 0.5 + 0.5 * noise();
      turnover[i]    = 0.6 + 0.6 * noise();
      momentum[i][3] = 1;
    }
  one.exchange_requests(cells, n_cells, weight.data(), excess.data(), active.data(), request.data(), given.data(),
                        taken.data());
  std::fill(other.begin(), other.end(), 0.);
  two.exchange_requests(cells, n_cells, weight.data(), excess.data(), active.data(), other_request.data(), other.data(),
                        other_taken.data());
  EXPECT_LT(difference(request, other_request, dim + 1), 1e-13);
  for (std::size_t i = 0; i < given.size(); ++i)
    {
      EXPECT_NEAR(given[i], other[i], 1e-12);
      EXPECT_NEAR(taken[i], other_taken[i], 1e-12);
    }
  one.exchange_transfers(cells, n_cells, request.data(), part.data(), turnover.data(), momentum.data(),
                         received.data());
  two.exchange_transfers(cells, n_cells, request.data(), part.data(), turnover.data(), momentum.data(),
                         other_received.data());
  EXPECT_LT(difference(received, other_received, 2), 1e-13);
  for (std::size_t i = 0; i < received.size(); ++i)
    EXPECT_NEAR(received[i][3], other_received[i][3], 1e-12);
  EXPECT_GT(largest_of(received, 3, 3), 0.1);

  std::vector<char>         is_active(active.begin(), active.end());
  std::vector<unsigned int> corners(n_cells * (dim + 1) + 32, 0), place(t.x.size(), 0), other_place(place);
  std::vector<unsigned int> around(dim * corners.size()), other_around(around);
  std::vector<Quad>         sum(around.size()), other_sum(around.size());
  Quad                      own, other_own;
  std::iota(corners.begin(), corners.end() - 32, 0u); // as if all were at one node; their area vectors add up to zero
  ASSERT_EQ(one.pairs_around(cells, corners.data(), n_cells * (dim + 1), t.x.data(), is_active.data(), 0, place.data(),
                             around.data(), sum.data(), &own),
            t.x.size());
  two.pairs_around(cells, corners.data(), n_cells * (dim + 1), t.x.data(), is_active.data(), 0, other_place.data(),
                   other_around.data(), other_sum.data(), &other_own);
  EXPECT_EQ(place, other_place);
  EXPECT_EQ(around, other_around);
  EXPECT_LT(difference(sum, other_sum), 1e-13);
  for (std::size_t j = 0; j < t.x.size(); ++j)
    EXPECT_NEAR(sum[j][3], other_sum[j][3], 1e-13 * regular_volume<dim>(spacing));
  Vec<dim>     expected_own; // of the first corners of all cells, as if these were at one node
  unsigned int n_firsts = 0;
  for (std::size_t c = 0; c < n_cells; ++c)
    {
      corners[n_firsts++] = c * (dim + 1);
      expected_own += area_vectors(t.corners(t.cells()[c]))[0];
    }
  std::fill(place.begin(), place.end(), 0);
  std::fill(other_place.begin(), other_place.end(), 0);
  one.pairs_around(cells, corners.data(), n_firsts, t.x.data(), is_active.data(), 0, place.data(), around.data(),
                   sum.data(), &own);
  two.pairs_around(cells, corners.data(), n_firsts, t.x.data(), is_active.data(), 0, other_place.data(),
                   other_around.data(), other_sum.data(), &other_own);
  const double area_of_cell = regular_volume<dim>(spacing) / spacing;
  EXPECT_GT(norm(expected_own), area_of_cell);
  for (int d = 0; d < dim; ++d)
    {
      EXPECT_NEAR(own[d], expected_own[d], 1e-12 * area_of_cell);
      EXPECT_NEAR(other_own[d], expected_own[d], 1e-12 * area_of_cell);
    }

  const auto &x0 = t.block.nodes.xp;
  EXPECT_NEAR(one.largest_relative_displacement(cells, n_cells, t.x.data(), x0.data()),
              two.largest_relative_displacement(cells, n_cells, t.x.data(), x0.data()), 1e-13 * spacing);
}


TYPED_TEST(Passes, ForcesAreThoseOfThePlainFormulas)
{
  constexpr int     dim = TypeParam::value;
  const Tangle<dim> t;
  ASSERT_GT(t.n_inverted(), 0u);
  for (const bool viscous : {false, true})
    for (const bool diffusion : {false, true})
      {
        auto effects = effects_of(viscous, diffusion);
        EXPECT_LT(difference(t.forces(effects), reference_forces(t, effects), diffusion ? 4 : 3), 1e-12)
          << viscous << diffusion;
        t.make_stiff(effects);
        EXPECT_LT(difference(t.forces(effects), reference_forces(t, effects), diffusion ? 4 : 3), 1e-12)
          << viscous << diffusion;
      }
}


TYPED_TEST(Passes, NodalVolumesSumToTheMeshVolume)
{
  constexpr int     dim = TypeParam::value;
  const Tangle<dim> straight(0.), tangled;
  double            sum = 0, tangled_sum = 0, expected = 0;
  for (std::size_t i = 0; i < straight.volume.size(); ++i)
    {
      sum += straight.volume[i];
      tangled_sum += tangled.volume[i];
    }
  for (const auto &cell : tangled.cells())
    expected += signed_volume(tangled.corners(cell));
  EXPECT_NEAR(sum / box_volume(box_state<dim>()), 1., 1e-13);
  EXPECT_NEAR(tangled_sum / expected, 1., 1e-13);
}


TYPED_TEST(Passes, ForcesMakeNoMomentum)
{
  constexpr int           dim   = TypeParam::value;
  const std::vector<Quad> force = Tangle<dim>().forces(effects_of(true, true));
  const Quad              sum   = sum_of(force);
  for (int d = 0; d < dim; ++d)
    EXPECT_LT(std::abs(sum[d]), 1e-12 * largest_of(force));
}


// Nodal energies E_i = k/2 (V_i - V0_i)^2 with p_i = -dE_i/dV_i.
TYPED_TEST(Passes, PressureForcesAreMinusTheGradientOfTheEnergy)
{
  constexpr int    dim = TypeParam::value;
  Tangle<dim>      t;
  constexpr double k           = 1e9;
  const auto       rest_volume = t.block.nodes.volume;
  const auto       energy      = [&]() {
    double sum = 0;
    compute_volumes<dim>(t.cells(), t.x, t.volume);
    for (std::size_t i = 0; i < t.x.size(); ++i)
      sum += 0.5 * k * std::pow(t.volume[i] - rest_volume[i], 2);
    return sum;
  };
  energy();
  for (std::size_t i = 0; i < t.x.size(); ++i)
    t.x[i][3] = -k * (t.volume[i] - rest_volume[i]);
  const std::vector<Quad> force   = t.forces({});
  const double            largest = largest_of(force);
  constexpr double        step    = 1e-4 * spacing;
  for (std::size_t i = 0; i < t.x.size(); i += 7)
    for (int d = 0; d < dim; ++d)
      {
        const double x    = t.x[i][d];
        t.x[i][d]         = x + step;
        const double up   = energy();
        t.x[i][d]         = x - step;
        const double down = energy();
        t.x[i][d]         = x;
        EXPECT_NEAR(force[i][d], -(up - down) / (2 * step), 1e-7 * largest) << "node " << i;
      }
}


TYPED_TEST(Passes, ViscousForcesVanishInRigidRotation)
{
  constexpr int dim = TypeParam::value;
  Tangle<dim>   t(0.1 * spacing);
  for (Quad &x : t.x)
    x[3] = 0;
  const double rotation[3][3] = {{0, -2, 1}, {2, 0, -3}, {-1, 3, 0}}, shear[3][3] = {{0, 2, 0}, {0, 0, 0}, {0, 0, 0}};
  set_linear_velocity(t, rotation);
  const double at_rotation = largest_of(t.forces(effects_of(true, false)));
  set_linear_velocity(t, shear);
  EXPECT_LT(at_rotation, 1e-12 * largest_of(t.forces(effects_of(true, false))));
}


// A shear flow v_x = gamma y dissipates mu gamma^2 per volume.
TYPED_TEST(Passes, ViscousForcesDissipateShear)
{
  constexpr int dim = TypeParam::value;
  Tangle<dim>   t(0.);
  for (Quad &x : t.x)
    x[3] = 0;
  const double shear[3][3] = {{0, 2, 0}, {0, 0, 0}, {0, 0, 0}};
  set_linear_velocity(t, shear);
  ForceEffects effects         = effects_of(true, false);
  effects.least_viscous_volume = 0;
  EXPECT_NEAR(power_of<dim>(t.forces(effects), t.v) / (-effects.viscosity * 4 * box_volume(box_state<dim>())), 1.,
              1e-12);
}


TYPED_TEST(Passes, ViscousForcesNeverMakeEnergyNotEvenInInvertedCells)
{
  constexpr int dim = TypeParam::value;
  Tangle<dim>   t;
  for (Quad &x : t.x)
    x[3] = 0;
  ASSERT_GT(t.n_inverted(), 0u);
  Noise noise(9);
  for (int k = 0; k < 20; ++k)
    {
      for (Quad &v : t.v)
        for (int d = 0; d < dim; ++d)
          v[d] = noise();
      EXPECT_LT(power_of<dim>(t.forces(effects_of(true, false)), t.v), 0.);
    }
}


TYPED_TEST(Passes, ShearRateIsThatOfTheFlow)
{
  constexpr int       dim = TypeParam::value;
  Tangle<dim>         t(0.);
  std::vector<double> rate;
  const auto          expect = [&](const double gradient[3][3], const double expected) {
    set_linear_velocity(t, gradient);
    compute_shear_rates<dim>(t.cells(), 0., t.x, t.v, rate);
    ASSERT_EQ(rate.size(), t.cells().size());
    for (const double r : rate)
      EXPECT_NEAR(r, expected, 1e-12);
  };
  const double shear[3][3] = {{0, -2, 0}, {0, 0, 0}, {0, 0, 0}}, stretch[3][3] = {{3, 0, 0}, {0, -3, 0}, {0, 0, 0}},
               rotation[3][3] = {{0, -2, 1}, {2, 0, -3}, {-1, 3, 0}};
  expect(shear, 2.);
  expect(stretch, 6.); // sqrt(2 (9 + 9))
  expect(rotation, 0.);
}


TYPED_TEST(Passes, ViscosityMayDifferFromCellToCell)
{
  constexpr int       dim = TypeParam::value;
  const Tangle<dim>   t;
  ForceEffects        effects = effects_of(true, false);
  const auto          uniform = t.forces(effects);
  std::vector<double> viscosity(t.cells().size(), effects.viscosity);
  effects.viscosity      = 1e9; // does not count
  effects.cell_viscosity = viscosity.data();
  EXPECT_LT(difference(t.forces(effects), uniform), 1e-14);

  // Twice the viscosity in one cell: its nodes feel it, all others do not.
  const auto &cell = t.cells().front();
  viscosity[0] *= 2;
  const auto mixed = t.forces(effects);
  for (unsigned int i = 0; i < mixed.size(); ++i)
    {
      const bool in_cell = std::find(cell.begin(), cell.end(), i) != cell.end();
      if (in_cell)
        {
          EXPECT_NE(mixed[i][0], uniform[i][0]);
        }
      else
        {
          EXPECT_EQ(mixed[i][0], uniform[i][0]);
        }
    }
}


TYPED_TEST(Passes, DensityFluxIsBlindToAHydrostaticDensity)
{
  constexpr int dim = TypeParam::value;
  Tangle<dim>   t;
  const double  random_flux = largest_of(t.forces(effects_of(false, true)), 3, 3);
  const Quad    slope       = {{3., -7., 2., 0.}};
  for (std::size_t i = 0; i < t.x.size(); ++i)
    {
      t.slope[i][3] = 1000;
      for (int d = 0; d < dim; ++d)
        {
          t.slope[i][d] = slope[d];
          t.slope[i][3] += slope[d] * t.x[i][d];
        }
    }
  EXPECT_LT(largest_of(t.forces(effects_of(false, true)), 3, 3), 1e-12 * random_flux);
}


TYPED_TEST(Passes, DensityFluxesSumToZero)
{
  const std::vector<Quad> force = Tangle<TypeParam::value>().forces(effects_of(false, true));
  EXPECT_LT(std::abs(sum_of(force)[3]), 1e-11 * largest_of(force, 3, 3));
}


// Where all else is equal, mass flows from dense to thin: the flux is positive at a node that is denser.
TYPED_TEST(Passes, DensityFluxSmoothes)
{
  constexpr int dim = TypeParam::value;
  Tangle<dim>   t(0.);
  for (Quad &q : t.slope)
    q = {{0., 0., 0., 1000.}};
  t.slope[5][3]                 = 1010;
  const std::vector<Quad> force = t.forces(effects_of(false, true));
  EXPECT_GT(force[5][3], 0.);
  for (std::size_t i = 0; i < force.size(); ++i)
    if (i != 5)
      {
        EXPECT_LE(force[i][3], 0.);
      }
}


TYPED_TEST(Passes, FilterIsExactForLinearVelocities)
{
  constexpr int     dim = TypeParam::value;
  Tangle<dim>       t(0.1 * spacing);
  std::vector<Quad> noisy, linear;
  const double      least_volume = 1e-6 * regular_volume<dim>(spacing);
  filter_impulses<dim>(t.cells(), filter_weights, t.x, t.v, t.volume, least_volume, t.node_density, t.inverse_mass,
                       t.gradient, noisy);
  const double gradient[3][3] = {{1, -2, 3}, {0.5, -1, 2}, {4, 1, 0.5}};
  set_linear_velocity(t, gradient);
  filter_impulses<dim>(t.cells(), filter_weights, t.x, t.v, t.volume, least_volume, t.node_density, t.inverse_mass,
                       t.gradient, linear);
  EXPECT_LT(largest_of(linear), 1e-12 * largest_of(noisy));
}


TYPED_TEST(Passes, FilterMakesNoMomentumAndTakesNoiseAway)
{
  constexpr int     dim = TypeParam::value;
  Tangle<dim>       t(0.1 * spacing);
  std::vector<Quad> impulse;
  filter_impulses<dim>(t.cells(), filter_weights, t.x, t.v, t.volume, 0.1 * regular_volume<dim>(spacing),
                       t.node_density, t.inverse_mass, t.gradient, impulse);
  const Quad sum = sum_of(impulse);
  for (int d = 0; d < dim; ++d)
    EXPECT_LT(std::abs(sum[d]), 1e-12 * largest_of(impulse));
  EXPECT_LT(power_of<dim>(impulse, t.v), 0.);
}


TYPED_TEST(Passes, DivergenceFilterTakesOnlyWhatTheNodesDoNotSee)
{
  constexpr int     dim = TypeParam::value;
  Tangle<dim>       t(0.1 * spacing);
  const double      least_volume = 1e-6 * regular_volume<dim>(spacing);
  std::vector<Quad> impulse, uniform;
  filter_impulses<dim>(t.cells(), {0., 1.}, t.x, t.v, t.volume, least_volume, t.node_density, t.inverse_mass,
                       t.gradient, impulse);
  EXPECT_LT(power_of<dim>(impulse, t.v), 0.);
  const Quad sum = sum_of(impulse);
  for (int d = 0; d < dim; ++d)
    EXPECT_LT(std::abs(sum[d]), 1e-12 * largest_of(impulse));

  const double expansion[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}; // the same divergence everywhere
  set_linear_velocity(t, expansion);
  filter_impulses<dim>(t.cells(), {0., 1.}, t.x, t.v, t.volume, least_volume, t.node_density, t.inverse_mass,
                       t.gradient, uniform);
  EXPECT_LT(largest_of(uniform), 1e-12 * largest_of(impulse));
}


TYPED_TEST(Passes, FilterLeavesCellsOfNodesWithoutDensityOut)
{
  constexpr int     dim = TypeParam::value;
  Tangle<dim>       t(0.1 * spacing);
  std::vector<Quad> impulse;
  const auto       &cell  = t.cells()[t.cells().size() / 2];
  t.node_density[cell[0]] = 0;
  filter_impulses<dim>(t.cells(), filter_weights, t.x, t.v, t.volume, 0.1 * regular_volume<dim>(spacing),
                       t.node_density, t.inverse_mass, t.gradient, impulse);
  for (int d = 0; d < 4; ++d)
    EXPECT_EQ(impulse[cell[0]][d], 0.);
  EXPECT_GT(largest_of(impulse), 0.);
}


TYPED_TEST(Passes, RelativeDisplacementIsBlindToTranslation)
{
  constexpr int     dim = TypeParam::value;
  const Tangle<dim> t;
  auto              x = t.x;
  for (Quad &q : x)
    for (int d = 0; d < dim; ++d)
      q[d] += 0.5 * (d + 1);
  EXPECT_LT(largest_relative_displacement<dim>(t.cells(), x, t.x), 1e-14);

  // One node moves by u: against the mean of its cells by u dim / (dim + 1).
  x = t.x;
  x[5][0] += 0.03;
  EXPECT_NEAR(largest_relative_displacement<dim>(t.cells(), x, t.x), 0.03 * dim / (dim + 1), 1e-14);
}


TYPED_TEST(Passes, VolumeChangesAreThoseOfTheAreaVectors)
{
  constexpr int       dim = TypeParam::value;
  const Tangle<dim>   t;
  std::vector<double> change(t.x.size(), 0.), expected = change;
  element_passes<dim>().volume_changes(t.cells().front().data(), t.cells().size(), t.x.data(), t.v.data(),
                                       change.data());
  for (const auto &cell : t.cells())
    {
      const Simplex<dim> area = area_vectors(t.corners(cell));
      double             sum  = 0;
      for (int a = 0; a <= dim; ++a)
        sum += dot(area[a], FluidNodes<dim>::vec(t.v[cell[a]]));
      for (const unsigned int i : cell)
        expected[i] += sum / (dim + 1);
    }
  for (std::size_t i = 0; i < change.size(); ++i)
    EXPECT_NEAR(change[i], expected[i], 1e-12 * spacing);
}


TYPED_TEST(Passes, VolumesRadiiAndEdgesAreThoseOfTheCells)
{
  constexpr int       dim = TypeParam::value;
  const Tangle<dim>   t;
  const std::size_t   n = t.cells().size();
  std::vector<double> volume(n), radius(n), shortest(n), longest(n);
  element_passes<dim>().cell_volumes(t.cells().front().data(), n, t.x.data(), volume.data());
  element_passes<dim>().insphere_radii(t.cells().front().data(), n, t.x.data(), radius.data());
  element_passes<dim>().edge_squares(t.cells().front().data(), n, t.x.data(), shortest.data(), longest.data());
  for (std::size_t c = 0; c < n; ++c)
    {
      const Simplex<dim> x = t.corners(t.cells()[c]);
      EXPECT_NEAR(volume[c], signed_volume(x), 1e-13 * regular_volume<dim>(spacing));
      EXPECT_NEAR(radius[c], insphere_radius(x), 1e-13 * spacing);
      double least = 1e300, most = 0;
      for (int a = 1; a <= dim; ++a)
        for (int b = 0; b < a; ++b)
          {
            least = std::min(least, norm(x[a] - x[b]));
            most  = std::max(most, norm(x[a] - x[b]));
          }
      EXPECT_NEAR(std::sqrt(shortest[c]), least, 1e-13 * spacing);
      EXPECT_NEAR(std::sqrt(longest[c]), most, 1e-13 * spacing);
    }
}


TYPED_TEST(Passes, NothingHappensWithoutCells)
{
  constexpr int                                      dim = TypeParam::value;
  const std::vector<typename SimplexMesh<dim>::Cell> no_cells;
  std::vector<Quad>                                  quads(3, Quad{{1., 2., 3., 4.}}), force(3, Quad{{1., 1., 1., 1.}});
  std::vector<double>                                volume(3, 1.);
  compute_volumes<dim>(no_cells, quads, volume);
  compute_forces<dim>(no_cells, effects_of(true, true), quads, quads, quads, force);
  EXPECT_EQ(largest_of(force, 0, 3), 0.);
  EXPECT_EQ(volume, std::vector<double>(3, 0.));
  EXPECT_EQ(largest_relative_displacement<dim>(no_cells, quads, force), 0.);
}
