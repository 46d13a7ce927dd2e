#include "scene.h"

#include <gtest/gtest.h>
#include <structure/cell_kernel.h>

#include <cmath>
#include <random>

namespace Breakwater
{
  namespace
  {
    template <int dimension, unsigned int polynomial_degree>
    struct Cells
    {
      static constexpr int          dim    = dimension;
      static constexpr unsigned int degree = polynomial_degree;
    };

    /// A box of 2 x 3 (x 2) cells with its kernel and a material of the real library.
    template <class Cells>
    class CellKernelTest : public ::testing::Test
    {
    public:
      static constexpr int dim = Cells::dim;
      using Field              = std::vector<Vec<dim>>;

      CellKernelTest()
      {
        PluginLibraries libraries({BREAKWATER_TEST_PLUGIN_FOLDER});
        libraries.load("materials", registry_);
        use("Saint Venant Kirchhoff");
      }

      void use(const std::string &model)
      {
        material = registry_.create<Material<dim>>(model);
        std::istringstream text("set Density = 2700\nset Young's modulus = 1e6\nset Poisson's ratio = 0.3\n");
        read_parameters(*material, registry_, scan_parameters(text, "test.prm"));
        mesh = make_solid_mesh<dim>(
          parse_box_mesh<dim>(dim == 2 ? "box(1, 0; 1.4, 0.9; 2, 3)" : "box(1, 0, 0; 1.4, 0.9, 0.5; 2, 3, 2)"),
          Cells::degree);
        kernel = make_cell_kernel<dim>(mesh, *material);
      }

      static double volume() { return dim == 2 ? 0.36 : 0.18; }

      /// u = H X with H row by row, plus a shift.
      Field linear_displacement(const std::vector<double> &h) const
      {
        Field u(mesh.nodes.size());
        for (std::size_t i = 0; i < u.size(); ++i)
          for (int c = 0; c < dim; ++c)
            {
              u[i][c] = 0.1 + c;
              for (int d = 0; d < dim; ++d)
                u[i][c] += h[c * dim + d] * mesh.nodes[i][d];
            }
        return u;
      }

      /// A rotation by 100 degrees about z, minus 1.
      static std::vector<double> rotation()
      {
        const double c = std::cos(1.745), s = std::sin(1.745);
        return dim == 2 ? std::vector<double>{c - 1, -s, s, c - 1} :
                          std::vector<double>{c - 1, -s, 0, s, c - 1, 0, 0, 0, 0};
      }

      static std::vector<double> strain()
      {
        return dim == 2 ? std::vector<double>{0.05, 0.02, -0.1, 0.08} :
                          std::vector<double>{0.05, 0.02, -0.1, 0.08, -0.03, 0.07, 0.01, 0.04, 0.1};
      }

      Field random_field(const double size) const
      {
        std::mt19937                           generator(1);
        std::uniform_real_distribution<double> uniform(-size, size);
        Field                                  u(mesh.nodes.size());
        for (Vec<dim> &vector : u)
          for (double &component : vector.c)
            component = uniform(generator);
        return u;
      }

      Field force(const Field &u) const
      {
        Field f(u.size());
        kernel->add_internal_force(u, f);
        return f;
      }

      /// Largest eigenvalue of the assembled M^-1 K: power iteration on the tangent, without any use of cells.
      double assembled_eigenvalue(const Field &u) const
      {
        const std::vector<double> mass       = kernel->lumped_mass();
        Field                     x          = random_field(1);
        double                    eigenvalue = 0;
        for (unsigned int iteration = 0; iteration < 400; ++iteration)
          {
            const double step = 1e-6;
            Field        plus = u, minus = u;
            for (std::size_t i = 0; i < u.size(); ++i)
              {
                plus[i] += step * x[i];
                minus[i] -= step * x[i];
              }
            plus             = force(plus);
            minus            = force(minus);
            double stiffness = 0, inertia = 0, length = 0;
            for (std::size_t i = 0; i < u.size(); ++i)
              {
                const Vec<dim> kx = (0.5 / step) * (minus[i] - plus[i]);
                stiffness += dot(x[i], kx);
                inertia += mass[i] * dot(x[i], x[i]);
                x[i]   = (1 / mass[i]) * kx;
                length = std::max(length, norm(x[i]));
              }
            for (Vec<dim> &value : x)
              value *= 1 / length;
            eigenvalue = stiffness / inertia;
          }
        return eigenvalue;
      }

      double bound(const Field &u) const
      {
        CellEigenvalues eigenvalues = kernel->start_eigenvalues();
        return kernel->bound_eigenvalue(u, eigenvalues, 0.);
      }

      static double largest(const Field &values)
      {
        double result = 0;
        for (const Vec<dim> &value : values)
          result = std::max(result, norm(value));
        return result;
      }

      std::unique_ptr<Material<dim>>   material;
      SolidMesh<dim>                   mesh;
      std::unique_ptr<CellKernel<dim>> kernel;

    private:
      PluginRegistry registry_;
    };

    using AllCells = ::testing::Types<Cells<2, 1>, Cells<2, 2>, Cells<3, 1>, Cells<3, 2>>;
  } // namespace

  TYPED_TEST_SUITE(CellKernelTest, AllCells);

  TYPED_TEST(CellKernelTest, MassIsDensityTimesVolume)
  {
    double sum = 0;
    for (const double mass : this->kernel->lumped_mass())
      {
        EXPECT_GT(mass, 0);
        sum += mass;
      }
    EXPECT_NEAR(sum, 2700 * this->volume(), 1e-11 * sum);
  }

  TYPED_TEST(CellKernelTest, RigidMotionMakesNeitherForceNorEnergy)
  {
    const auto u = this->linear_displacement(this->rotation());
    EXPECT_LT(this->largest(this->force(u)), 1e-8); // of 1e6 Pa times a cell's face of 0.07 m2
    EXPECT_LT(std::abs(this->kernel->strain_energy(u)), 1e-18 * 1e6);
  }

  TYPED_TEST(CellKernelTest, LinearLawTakesARotationForStrain)
  {
    this->use("Linear elastic");
    EXPECT_GT(this->kernel->strain_energy(this->linear_displacement(this->rotation())), 1e4 * this->volume());
  }

  TYPED_TEST(CellKernelTest, UniformStrainIsInBalanceInside)
  {
    constexpr int     dim   = TypeParam::dim;
    const auto        u     = this->linear_displacement(this->strain());
    const auto        force = this->force(u);
    std::vector<char> on_boundary(force.size());
    for (const auto &facet : this->mesh.facets)
      for (const unsigned int node : facet.nodes)
        on_boundary[node] = true;
    Vec<dim> sum;
    for (std::size_t i = 0; i < force.size(); ++i)
      {
        sum += force[i];
        if (!on_boundary[i])
          {
            EXPECT_LT(norm(force[i]), 1e-8);
          }
      }
    EXPECT_LT(norm(sum), 1e-8);
    EXPECT_NEAR(this->kernel->strain_energy(u), this->volume() * this->material->strain_energy(this->strain().data()),
                1e-10);
  }

  TYPED_TEST(CellKernelTest, ForceIsMinusTheGradientOfTheEnergy)
  {
    for (const char *model : {"Saint Venant Kirchhoff", "Linear elastic"})
      {
        this->use(model);
        const auto u         = this->random_field(0.02);
        const auto f         = this->force(u);
        auto       direction = this->random_field(1);
        std::rotate(direction.begin(), direction.begin() + 5, direction.end());
        const double step = 1e-5;
        auto         plus = u, minus = u;
        double       power = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          {
            plus[i] += step * direction[i];
            minus[i] -= step * direction[i];
            power += dot(f[i], direction[i]);
          }
        const double slope = (this->kernel->strain_energy(plus) - this->kernel->strain_energy(minus)) / (2 * step);
        EXPECT_NEAR(power, -slope, 1e-6 * std::abs(slope));
      }
  }

  TYPED_TEST(CellKernelTest, EigenvalueOfCellsBoundsThatOfTheMesh)
  {
    for (const double strain : {0., 1., -2.})
      {
        std::vector<double> h = this->strain();
        for (double &component : h)
          component *= strain;
        auto       u     = this->linear_displacement(h);
        const auto noise = this->random_field(strain == 0 ? 0 : 0.004);
        for (std::size_t i = 0; i < u.size(); ++i)
          u[i] += noise[i];
        const double assembled = this->assembled_eigenvalue(u), bound = this->bound(u);
        EXPECT_GE(bound, 0.99 * assembled);
        EXPECT_LE(bound, 1.5 * assembled);
        std::cout << "strain " << strain << ": bound over largest eigenvalue " << bound / assembled << "\n";
      }
  }

  TYPED_TEST(CellKernelTest, VonMisesStressOfUniformTension)
  {
    constexpr int       dim = TypeParam::dim;
    std::vector<double> h(dim * dim);
    h[0]            = 1e-6; // small: stress = lambda + 2 mu along x, lambda across
    const double mu = 1e6 / 2.6, lambda = 1e6 * 0.3 / (1.3 * 0.4);
    const double along = 1e-6 * (lambda + 2 * mu), across = 1e-6 * lambda;
    const double expected = dim == 3 ? along - across : std::sqrt(along * along - along * across + across * across);
    for (const double stress : this->kernel->von_mises_stress(this->linear_displacement(h)))
      EXPECT_NEAR(stress, expected, 1e-5 * expected);
  }

  TYPED_TEST(CellKernelTest, FacetsCloseTheBodyAndPointOutwards)
  {
    constexpr int dim = TypeParam::dim;
    Vec<dim>      area;
    double        flux = 0; // integral of X.n = dim times the volume
    for (const auto &facet : this->mesh.facets)
      {
        const auto &x = this->mesh.nodes;
        Vec<dim>    normal, centre;
        if constexpr (dim == 2)
          {
            const Vec<2> tangent = x[facet.nodes[1]] - x[facet.nodes[0]];
            normal               = {{tangent[1], -tangent[0]}};
          }
        else
          normal = 0.5 * cross(x[facet.nodes[2]] - x[facet.nodes[0]], x[facet.nodes[3]] - x[facet.nodes[1]]);
        for (const unsigned int node : facet.nodes)
          centre += (1. / facet.nodes.size()) * x[node];
        area += normal;
        flux += dot(normal, centre);
        EXPECT_GT(normal[facet.boundary / 2] * (facet.boundary % 2 == 0 ? -1 : 1), 0);
      }
    EXPECT_LT(norm(area), 1e-14);
    EXPECT_NEAR(flux, dim * this->volume(), 1e-13);
  }
} // namespace Breakwater
