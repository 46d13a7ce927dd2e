#include "cloud.h"

#include <pfem_fluid/node_pairs.h>

#include <algorithm>
#include <limits>

using namespace Breakwater;

namespace
{
  template <class Dimension>
  class Pairs : public ::testing::Test
  {
  };
  TYPED_TEST_SUITE(Pairs, Dimensions);

  /// b_i from full matrices, see NodePairs::row_sums().
  template <int dim>
  std::vector<double> plain_row_sums(const FluidNodes<dim> &nodes, const SimplexMesh<dim> &mesh,
                                     const std::vector<double> &mass)
  {
    std::vector<std::vector<Vec<dim>>> D(nodes.n, std::vector<Vec<dim>>(nodes.n)); // [i][k] = dV_i/dx_k
    for (const auto &cell : mesh.cells)
      {
        const Simplex<dim> area = area_vectors(nodes.corners(cell));
        for (const unsigned int i : cell)
          for (int a = 0; a <= dim; ++a)
            D[i][cell[a]] += area[a] * (1. / (dim + 1));
      }
    std::vector<double> sums(nodes.n, 0.);
    for (std::size_t k = 0; k < nodes.n; ++k)
      {
        double column = 0;
        for (std::size_t j = 0; j < nodes.n; ++j)
          column += norm(D[j][k]);
        for (std::size_t i = 0; i < nodes.n && mass[k] > 0; ++i)
          sums[i] += norm(D[i][k]) * column / mass[k];
      }
    return sums;
  }
} // namespace


// The unit simplex: |dV/dx_k| = 1/dim! at all corners but the one at the origin, where it is sqrt(dim)/dim!. Each of
// the dim + 1 nodes has 1/(dim + 1) of that, so b = sum |dV/dx_k|^2 / ((dim + 1) m) = 2 dim / (dim!^2 (dim + 1) m).
TYPED_TEST(Pairs, RowSumsOfTheUnitSimplex)
{
  constexpr int   dim = TypeParam::value;
  FluidNodes<dim> nodes;
  nodes.resize(dim + 2); // one without a cell
  typename SimplexMesh<dim>::Cell cell;
  for (int a = 0; a <= dim; ++a)
    {
      cell[a] = a;
      if (a > 0)
        nodes.xp[a][a - 1] = 1;
    }
  const double factorial = dim == 2 ? 2 : 6, mass = 3;
  const auto   sums = NodePairs<dim>(nodes, {cell}).row_sums(std::vector<double>(nodes.n, mass));
  for (int a = 0; a <= dim; ++a)
    EXPECT_NEAR(sums[a], 2 * dim / (factorial * factorial * (dim + 1) * mass), 1e-15);
  EXPECT_EQ(sums[dim + 1], 0);
}


TYPED_TEST(Pairs, RowSumsAreThoseOfTheFullMatrices)
{
  constexpr int       dim = TypeParam::value;
  const Block<dim>    block;
  Noise               noise(3);
  std::vector<double> mass(block.nodes.n);
  for (double &m : mass)
    m = 2 + noise();
  mass[block.nodes.n / 2] = std::numeric_limits<double>::infinity();
  mass[block.nodes.n / 3] = 0;
  const auto sums         = NodePairs<dim>(block.nodes, block.mesh.cells).row_sums(mass);
  const auto expected     = plain_row_sums(block.nodes, block.mesh, mass);
  for (std::size_t i = 0; i < sums.size(); ++i)
    EXPECT_NEAR(sums[i], expected[i], 1e-13 * *std::max_element(expected.begin(), expected.end())) << "node " << i;
}
