#include <gtest/gtest.h>
#include <postprocessors/front.h>
#include <postprocessors/gauge.h>

#include <cmath>

#include "given_parameters.h"

using namespace Breakwater;

namespace
{
  /// A domain that has nothing but a mesh to show.
  template <int dim>
  class MeshDomain : public ExplicitDomain<dim>
  {
  public:
    OutputMesh<dim> mesh;

    void                   setup(const std::string &, const BodyForces<dim> &, RunContext &) override {}
    double                 stable_time_step() const override { return 1; }
    void                   advance_free(double) override {}
    void                   add_link_force(const std::vector<Vec<dim>> &, double) override {}
    void                   end_step() override {}
    const WetSurface<dim> &wet_surface() const override { return surface_; }
    unsigned int           adopt_surface(const WetSurface<dim> &) override { return 0; }
    bool                   can_adopt_surface() const override { return false; }
    void                   lend_mass(const std::vector<double> &) override {}
    void                   correct_surface(const std::vector<Vec<dim>> &) override {}
    DomainBalance<dim>     balance() const override { return {}; }
    void                   add_history(Row &) override {}
    OutputMesh<dim>        output_mesh() const override { return mesh; }
    void                   save(std::ostream &) const override {}
    void                   load(std::istream &) override {}

  private:
    WetSurface<dim> surface_;
  };

  /// The unit square with a hole of air over y in (0.5, 0.75), and a node far ahead that has no cell.
  MeshDomain<2> layers()
  {
    MeshDomain<2> domain;
    for (const double y : {0., 0.5, 0.75, 1.})
      for (const double x : {0., 1.})
        domain.mesh.position.push_back({{x, y}});
    domain.mesh.position.push_back({{7, 0.1}});
    domain.mesh.cells = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6};
    return domain;
  }

  /// The unit cube in six tetrahedra around its diagonal.
  MeshDomain<3> cube()
  {
    MeshDomain<3> domain;
    for (unsigned int i = 0; i < 8; ++i)
      domain.mesh.position.push_back({{double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)}});
    domain.mesh.cells = {0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7, 0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7};
    return domain;
  }

  template <int dim>
  double measure(Postprocessor<dim> &postprocessor, const MeshDomain<dim> &domain, const std::string &column,
                 const std::map<std::string, std::string> &parameters)
  {
    GivenParameters::read(postprocessor, parameters);
    postprocessor.setup({{"Obstacle", nullptr}, {"Fluid", &domain}});
    Row row;
    postprocessor.add_history(0., row);
    EXPECT_EQ(row.size(), 1u);
    EXPECT_EQ(row.front().first, column);
    return row.front().second;
  }

  TEST(Front, IsTheForemostNodeOfACell)
  {
    const MeshDomain<2> domain = layers();
    Front<2>            ahead, up, diagonal;
    EXPECT_DOUBLE_EQ(measure(ahead, domain, "front position [m]", {}), 1);
    EXPECT_DOUBLE_EQ(measure(up, domain, "top position [m]", {{"Name", "top"}, {"Direction", "0, 3"}}), 1);
    EXPECT_DOUBLE_EQ(measure(diagonal, domain, "front position [m]", {{"Direction", "1, 1"}}), std::sqrt(2.));
  }

  TEST(Front, IsNotANumberWithoutCells)
  {
    MeshDomain<2> domain = layers();
    domain.mesh.cells.clear();
    Front<2> front;
    EXPECT_TRUE(std::isnan(measure(front, domain, "front position [m]", {})));
  }

  TEST(Gauge, MeasuresTheWetLength)
  {
    const MeshDomain<2> domain = layers();
    Gauge<2>            inside, edge, outside, slanted;
    EXPECT_NEAR(measure(inside, domain, "gauge height [m]", {{"Place", "0.3, 0"}}), 0.75, 1e-14);
    EXPECT_NEAR(measure(edge, domain, "gauge height [m]", {{"Place", "0, -4"}}), 0.75, 1e-14);
    EXPECT_EQ(measure(outside, domain, "gauge height [m]", {{"Place", "1.3, 0"}}), 0.);
    EXPECT_NEAR(measure(slanted, domain, "h1 height [m]", {{"Place", "0, 0"}, {"Direction", "1, 1"}, {"Name", "h1"}}),
                0.75 * std::sqrt(2.), 1e-14);
  }

  // along the diagonal of the cube and its faces the wire is in several cells at once
  TEST(Gauge, CountsSharedFacesOnce)
  {
    const MeshDomain<3> domain = cube();
    Gauge<3>            inside, face, diagonal;
    EXPECT_NEAR(measure(inside, domain, "gauge height [m]", {{"Place", "0.3, 0.5, 0.6"}}), 1, 1e-14);
    EXPECT_NEAR(measure(face, domain, "gauge height [m]", {{"Place", "0.5, 0, 0.5"}}), 1, 1e-14);
    EXPECT_NEAR(measure(diagonal, domain, "gauge height [m]", {{"Place", "0, 0, 0"}, {"Direction", "1, 1, 1"}}),
                std::sqrt(3.), 1e-14);
  }

  TEST(Postprocessors, NameTheDomainThatIsMissing)
  {
    Gauge<2>            gauge;
    const MeshDomain<2> domain = layers();
    GivenParameters::read(gauge, {{"Domain", "Water"}});
    EXPECT_THROW(gauge.setup({{"Fluid", &domain}}), InputError);
    Front<2> front;
    EXPECT_THROW(GivenParameters::read(front, {{"Direction", "0, 0"}}), InputError);
  }
} // namespace
