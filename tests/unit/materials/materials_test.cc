#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_file.h>
#include <breakwater/base/plugin_library.h>
#include <breakwater/interfaces/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    class MaterialsTest : public ::testing::Test
    {
    public:
      MaterialsTest()
      {
        PluginLibraries libraries({BREAKWATER_TEST_PLUGIN_FOLDER});
        libraries.load("materials", registry_);
      }

      template <int dim>
      std::unique_ptr<Material<dim>> make(const std::string &name, const double poissons_ratio) const
      {
        auto               material = registry_.create<Material<dim>>(name);
        std::ostringstream text;
        text << std::setprecision(17) << "set Density = 2000\n";
        if (name == "Mooney Rivlin")
          {
            const double c = 3e6 / (4 * (1 + poissons_ratio)); // C1 + C2, half of the shear modulus
            text << "set C1 = " << -0.5 * c << "\nset C2 = " << 1.5 * c
                 << "\nset Bulk modulus = " << 1e6 / (1 - 2 * poissons_ratio) << "\n";
          }
        else
          text << "set Young's modulus = 3e6\nset Poisson's ratio = " << poissons_ratio << "\n";
        std::istringstream stream(text.str());
        read_parameters(*material, registry_, scan_parameters(stream, "test.prm"));
        return material;
      }

    protected:
      PluginRegistry registry_;
    };

    const std::vector<std::string> of_large_strain = {"Saint Venant Kirchhoff", "Neo Hookean", "Mooney Rivlin"};
    const std::vector<std::string> laws = {"Linear elastic", "Saint Venant Kirchhoff", "Neo Hookean", "Mooney Rivlin"};

    /// Two displacement gradients: a moderate one and a large one.
    template <int dim>
    std::vector<double> gradients()
    {
      std::vector<double> h(2 * dim * dim);
      for (std::size_t i = 0; i < h.size(); ++i)
        h[i] = (i < h.size() / 2 ? 0.1 : 0.6) * std::sin(1. + 2.7 * i);
      return h;
    }

    /// P = d(energy) / dH, by central differences, at all points of a batch.
    template <int dim>
    void expect_stress_is_slope_of_energy(const Material<dim> &material)
    {
      std::vector<double> h = gradients<dim>(), stress(h.size());
      material.first_piola_stress(h.data(), stress.data(), 2);
      for (std::size_t i = 0; i < h.size(); ++i)
        {
          const double *point = h.data() + i / (dim * dim) * (dim * dim);
          const double  value = h[i], step = 1e-5;
          h[i]               = value + step;
          const double plus  = material.strain_energy(point);
          h[i]               = value - step;
          const double minus = material.strain_energy(point);
          h[i]               = value;
          EXPECT_NEAR(stress[i], (plus - minus) / (2 * step), 1e-8 * std::max(1e5, std::abs(stress[i])));
        }
    }
  } // namespace

  TEST_F(MaterialsTest, StressIsTheSlopeOfTheEnergy)
  {
    for (const std::string &law : laws)
      {
        SCOPED_TRACE(law);
        expect_stress_is_slope_of_energy(*make<2>(law, 0.3));
        expect_stress_is_slope_of_energy(*make<3>(law, 0.3));
      }
  }

  TEST_F(MaterialsTest, TwoDimensionsArePlaneStrain)
  {
    for (const std::string &law : laws)
      {
        const double plane[4] = {0.1, -0.2, 0.05, 0.3};
        const double space[9] = {0.1, -0.2, 0, 0.05, 0.3, 0, 0, 0, 0};
        double       p[4], q[9];
        make<2>(law, 0.4)->first_piola_stress(plane, p, 1);
        make<3>(law, 0.4)->first_piola_stress(space, q, 1);
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            EXPECT_NEAR(p[2 * i + j], q[3 * i + j], 1e-9);
        EXPECT_GT(q[8], 1e5); // what holds the strain plane
        EXPECT_NEAR(make<2>(law, 0.4)->strain_energy(plane), make<3>(law, 0.4)->strain_energy(space), 1e-9);
      }
  }

  TEST_F(MaterialsTest, SmallStrainIsHookesLaw)
  {
    // Uniaxial stress: eps along, -nu eps across, sigma = E eps.
    const double eps = 1e-7, nu = 0.3;
    const double h[9] = {eps, 0, 0, 0, -nu * eps, 0, 0, 0, -nu * eps};
    for (const std::string &law : laws)
      {
        double p[9];
        make<3>(law, nu)->first_piola_stress(h, p, 1);
        EXPECT_NEAR(p[0], 3e6 * eps, 1e-6 * 3e6 * eps);
        EXPECT_NEAR(p[4], 0, 1e-6 * 3e6 * eps);
      }
  }

  TEST_F(MaterialsTest, KirchhoffStretchWithoutLateralStrain)
  {
    // P = F E (F^2 - 1) / 2 at nu = 0.
    const double h[9] = {0.5, 0, 0, 0, 0, 0, 0, 0, 0};
    double       p[9];
    make<3>("Saint Venant Kirchhoff", 0)->first_piola_stress(h, p, 1);
    EXPECT_NEAR(p[0], 1.5 * 3e6 * (1.5 * 1.5 - 1) / 2, 1e-6);
  }

  TEST_F(MaterialsTest, NeoHookeanStretchWithoutLateralStrain)
  {
    // P = mu (F - 1/F) at nu = 0.
    const double h[9] = {0.5, 0, 0, 0, 0, 0, 0, 0, 0};
    double       p[9];
    make<3>("Neo Hookean", 0)->first_piola_stress(h, p, 1);
    EXPECT_NEAR(p[0], 1.5e6 * (1.5 - 1 / 1.5), 1e-6);
  }

  TEST_F(MaterialsTest, MooneyRivlinStretchThatKeepsTheVolume)
  {
    // Principal stretches a and a^-1/2: P_1 - P_2 a^(-3/2) = 2 (a - a^-2) (C1 + C2 / a), whatever the pressure.
    const double a = 1.7, c = 3e6 / (4 * 1.3), b = 1 / std::sqrt(a);
    const double h[9] = {a - 1, 0, 0, 0, b - 1, 0, 0, 0, b - 1};
    double       p[9];
    make<3>("Mooney Rivlin", 0.3)->first_piola_stress(h, p, 1);
    EXPECT_NEAR(p[0] - p[4] * std::pow(a, -1.5), 2 * (a - 1 / (a * a)) * (-0.5 * c + 1.5 * c / a), 1e-6);
  }

  TEST_F(MaterialsTest, StressTurnsWithTheSolid)
  {
    // P(R F) = R P(F), with R a quarter turn: F = 1 + H.
    const double h[4]      = {0.1, 0.2, -0.1, 0.05};
    const double turned[4] = {-h[2] - 1, -1 - h[3], 1 + h[0], h[1] - 1}; // R (1 + H) - 1
    for (const std::string &law : of_large_strain)
      {
        double     p[4], q[4];
        const auto material = make<2>(law, 0.3);
        material->first_piola_stress(h, p, 1);
        material->first_piola_stress(turned, q, 1);
        EXPECT_NEAR(q[0], -p[2], 1e-8);
        EXPECT_NEAR(q[1], -p[3], 1e-8);
        EXPECT_NEAR(q[2], p[0], 1e-8);
        EXPECT_NEAR(q[3], p[1], 1e-8);
        EXPECT_GT(std::abs(p[0]), 1e4);
      }
  }

  TEST_F(MaterialsTest, WaveSpeedAndDensity)
  {
    for (const std::string &law : laws)
      {
        EXPECT_NEAR(make<3>(law, 0)->wave_speed(), std::sqrt(3e6 / 2000), 1e-10);
        EXPECT_NEAR(make<2>(law, 0.3)->wave_speed(), std::sqrt(3e6 * 0.7 / (1.3 * 0.4) / 2000), 1e-10);
        EXPECT_EQ(make<2>(law, 0.3)->density(), 2000);
      }
  }

  TEST_F(MaterialsTest, RefusesAnIncompressibleSolid)
  {
    EXPECT_THROW(make<3>("Linear elastic", 0.5), InputError);
    EXPECT_THROW(make<3>("Saint Venant Kirchhoff", -1), InputError);
    EXPECT_THROW(make<3>("Mooney Rivlin", 0.5), InputError);
  }
} // namespace Breakwater
