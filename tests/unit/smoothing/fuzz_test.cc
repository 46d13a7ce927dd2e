#include <gtest/gtest.h>
#include <mesh_smoothers/elastic_analogy.h>
#include <mesh_smoothers/elastic_analogy_then_getme.h>
#include <mesh_smoothers/flips_and_optimization.h>
#include <mesh_smoothers/getme.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "clouds.h"

using namespace Breakwater;

namespace
{
  /// All smoothers, by their names.
  template <int dim>
  std::vector<std::pair<std::string, std::unique_ptr<MeshSmoother<dim>>>> all_smoothers()
  {
    std::vector<std::pair<std::string, std::unique_ptr<MeshSmoother<dim>>>> result;
    result.emplace_back("elastic analogy", std::make_unique<ElasticAnalogy<dim>>());
    result.emplace_back("GETMe", std::make_unique<Getme<dim>>());
    result.emplace_back("elastic analogy then GETMe", std::make_unique<ElasticAnalogyThenGetme<dim>>());
    result.emplace_back("flips and optimization", std::make_unique<FlipsAndOptimization<dim>>());
    return result;
  }

  constexpr unsigned int n_clouds = 200;

  /// Clouds of ten kinds: lattices with and without jitter, random ones, duplicates, sheets, planes, clusters.
  template <int dim>
  std::vector<Vec<dim>> cloud(const unsigned int seed)
  {
    Random                random(seed);
    const unsigned int    kind = seed % 10, n = dim == 2 ? 12 : 5;
    std::vector<Vec<dim>> x     = jittered_lattice<dim>(n, kind == 0 ? 0. : kind == 1 ? 1e-13 : 0.45, random);
    const auto            noise = [&](const double size) {
      Vec<dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = size * (2 * random() - 1);
      return result;
    };
    switch (kind)
      {
        case 2: // at random
          for (Vec<dim> &node : x)
            for (int d = 0; d < dim; ++d)
              node[d] = n * random();
          break;
        case 3: // duplicates, some of them exact
          for (unsigned int k = 0; k < 20; ++k)
            x.push_back(x[k * 6] + noise(k % 2 == 0 ? 1e-12 : 0.));
          break;
        case 4: // a sheet one node thick, nearly flat
          for (Vec<dim> &node : x)
            node[dim - 1] = 0.5 + 1e-3 * random();
          break;
        case 5: // two layers
          for (Vec<dim> &node : x)
            node[dim - 1] = (random() < 0.5 ? 0. : 0.7) + 0.05 * random();
          break;
        case 6: // all in one plane
          for (Vec<dim> &node : x)
            node[dim - 1] = 0.25;
          break;
        case 7: // a cluster
          for (unsigned int k = 0; k < 60; ++k)
            x.push_back(x[x.size() / 2] + noise(0.1 + 0.2 * random()));
          break;
        case 8: // on a sphere, and its centre
          x.resize(60);
          for (Vec<dim> &node : x)
            {
              node                = noise(1.);
              const double length = norm(node);
              node *= length > 0 ? 1.2 / length : 0.;
            }
          x.push_back({});
          break;
        case 9: // stretched
          for (Vec<dim> &node : x)
            node[0] *= 0.3;
          break;
        default:
          break;
      }
    return x;
  }

  template <int dim>
  void fuzz()
  {
    unsigned int n_meshes = 0;
    for (unsigned int seed = 0; seed < n_clouds; ++seed)
      {
        const TestMesh<dim> original = mesh_of_cloud<dim>(cloud<dim>(seed));
        n_meshes += !original.mesh.cells.empty();
        for (const auto &[name, smoother] : all_smoothers<dim>())
          {
            TestMesh<dim>         mesh   = original;
            const SmoothingReport report = smoother->smooth(mesh.mesh, mesh.position, original.task(0.5));
            EXPECT_EQ(smoothing_violation(original.mesh, original.position, mesh.mesh, mesh.position,
                                          original.task(0.5), report),
                      "")
              << name << " in " << dim << " dimensions, cloud " << seed;
            if (!mesh.mesh.cells.empty())
              {
                EXPECT_GE(mesh.smallest_r(), original.smallest_r() * (1 - 1e-9))
                  << name << " in " << dim << " dimensions, cloud " << seed;
              }
          }
      }
    std::printf("%d dimensions: %u of %u clouds have cells\n", dim, n_meshes, n_clouds);
    EXPECT_GT(n_meshes, n_clouds / 2);
  }

  TEST(MeshSmoothers, KeepTheirPromisesOnAnyCloudInTwoDimensions)
  {
    fuzz<2>();
  }
  TEST(MeshSmoothers, KeepTheirPromisesOnAnyCloudInThreeDimensions)
  {
    fuzz<3>();
  }
} // namespace
