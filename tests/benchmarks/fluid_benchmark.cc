// Speed of the fluid's loops over cells, of the triangulation and of the machine itself.
//
// items_per_second counts cells (for a full step: cell-steps) by CPU time; the machine's limits are the peak of
// multiply-adds that the compiler reaches (items: flops) and the triad of McCalpin's STREAM (bytes_per_second).

#include <pfem_fluid/alpha_shape.h>
#include <pfem_fluid/kernels.h>
#include <pfem_fluid/lattice.h>
#include <pfem_fluid/mass_exchange.h>
#include <pfem_fluid/node_partition.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <random>

namespace
{
  using namespace Breakwater;

  /// A cube of about n nodes with random velocities and pressures.
  struct Cloud
  {
    std::vector<Vec<3>>     position;
    DelaunayMesh<3>         triangulation;
    SimplexMesh<3>          mesh;
    std::vector<Quad>       xp, v, density_slope, force;
    std::vector<double>     volume;
    static constexpr double spacing = 0.01;

    explicit Cloud(const double n_nodes)
    {
      const double      side  = spacing * std::cbrt(n_nodes);
      const BoxShape<3> box   = {"box", {}, {{side, side, side}}};
      const auto        nodes = fill_box(box, {}, spacing);
      for (const unsigned int i : hilbert_order(nodes))
        position.push_back(nodes[i]);
      triangulate();
      std::mt19937 random(1);
      const auto   noise = [&]() {
        return random() * (1. / std::mt19937::max());
      };
      xp.resize(position.size());
      v = density_slope = force = xp;
      volume.resize(xp.size());
      for (std::size_t i = 0; i < xp.size(); ++i)
        {
          for (int d = 0; d < 3; ++d)
            {
              xp[i][d] = position[i][d];
              v[i][d]  = noise();
            }
          xp[i][3]            = 1000 * noise();
          density_slope[i][3] = 1000 + noise();
        }
    }

    void triangulate()
    {
      triangulation.rebuild(position);
      cut();
    }

    void cut()
    {
      mesh = alpha_shape<3>(triangulation, 1.4 * spacing, [](const SimplexMesh<3>::Cell &) {
        return true;
      });
    }
  };

  Cloud &cloud(const std::int64_t n_nodes)
  {
    static std::map<std::int64_t, Cloud> clouds; // one of each size for all benchmarks
    return clouds.try_emplace(n_nodes, n_nodes).first->second;
  }

  template <class Work>
  void repeat(benchmark::State &state, Work work)
  {
    Cloud &c = cloud(state.range(0));
    for (auto _ : state)
      work(c);
    state.SetItemsProcessed(state.iterations() * c.mesh.cells.size());
    state.counters["cells"] = c.mesh.cells.size();
  }

  void volumes(benchmark::State &state)
  {
    repeat(state, [](Cloud &c) {
      compute_volumes<3>(c.mesh.cells, c.xp, c.volume);
    });
  }

  ForceEffects effects(const bool viscous, const bool diffusion)
  {
    ForceEffects result;
    result.viscous              = viscous;
    result.density_diffusion    = diffusion;
    result.viscosity            = 1e-3;
    result.least_viscous_volume = 0.01 * std::pow(Cloud::spacing, 3);
    return result;
  }

  /// The two passes of a step: volumes, then forces.
  void step(benchmark::State &state, const bool viscous, const bool diffusion)
  {
    const ForceEffects chosen = effects(viscous, diffusion);
    repeat(state, [&](Cloud &c) {
      compute_volumes<3>(c.mesh.cells, c.xp, c.volume);
      compute_forces<3>(c.mesh.cells, chosen, c.xp, c.v, c.density_slope, c.force);
    });
  }

  void forces(benchmark::State &state)
  {
    const ForceEffects chosen = effects(false, false);
    repeat(state, [&](Cloud &c) {
      compute_forces<3>(c.mesh.cells, chosen, c.xp, c.v, c.density_slope, c.force);
    });
  }

  FluidNodes<3> nodes_of(const Cloud &c)
  {
    FluidNodes<3> nodes;
    nodes.resize(c.position.size());
    nodes.xp = c.xp;
    nodes.v  = c.v;
    std::fill(nodes.has_cells.begin(), nodes.has_cells.end(), 1);
    return nodes;
  }

  void node_pairs(benchmark::State &state)
  {
    repeat(state, [nodes = FluidNodes<3>()](Cloud &c) mutable {
      if (nodes.n == 0)
        nodes = nodes_of(c);
      benchmark::DoNotOptimize(NodePairs<3>(nodes, c.mesh.cells));
    });
  }

  /// From masses that are wrong by up to 1 %, different at each node.
  void mass_exchange(benchmark::State &state)
  {
    unsigned int n_iterations = 0;
    repeat(state, [&](Cloud &c) {
      FluidNodes<3> nodes = nodes_of(c);
      compute_volumes<3>(c.mesh.cells, nodes.xp, nodes.volume);
      for (std::size_t i = 0; i < nodes.n; ++i)
        {
          nodes.density[i] = 1000;
          nodes.mass[i]    = 1000 * nodes.volume[i] * (1 + 0.01 * c.v[i][0]);
        }
      const NodePairs<3> pairs(nodes, c.mesh.cells);
      n_iterations = exchange_mass<3>(nodes, c.mesh.cells, pairs, std::vector<double>(nodes.n, 0.), 0., 1000.,
                                      Cloud::spacing, ExchangeControl())
                       .n_iterations;
    });
    state.counters["iterations"] = n_iterations;
  }

  void triangulation(benchmark::State &state)
  {
    repeat(state, [](Cloud &c) {
      c.triangulate();
    });
    state.counters["nodes"] = cloud(state.range(0)).position.size();
  }

  void alpha_shape_of_triangulation(benchmark::State &state)
  {
    repeat(state, [](Cloud &c) {
      c.cut();
    });
  }

  /// The nodes go to and fro in waves of about 20 spacings, by about state.range(1) hundredths of a spacing against
  /// their neighbours; those on the sides of the cube stay on them.
  void triangulation_repair(benchmark::State &state)
  {
    Cloud                    &c     = cloud(state.range(0));
    const std::vector<Vec<3>> start = c.position;
    std::vector<Vec<3>>       moved = start;
    double                    side  = 0;
    for (const Vec<3> &x : start)
      side = std::max(side, x[0]);
    const double wave_number = 2 * 3.14159265358979 * std::round(side / (20 * Cloud::spacing)) / side;
    const double amplitude   = 0.01 * state.range(1) / wave_number;
    for (std::size_t i = 0; i < start.size(); ++i)
      for (int d = 0; d < 3; ++d)
        if (start[i][d] != 0 && start[i][d] != side)
          moved[i][d] +=
            amplitude * std::sin(wave_number * start[i][d]) * std::cos(wave_number * start[i][(d + 1) % 3]);
    c.triangulation.rebuild(start);
    std::size_t n_flips = 0, n_full = 0;
    bool        is_moved = false;
    for (auto _ : state)
      {
        is_moved          = !is_moved;
        const auto report = c.triangulation.update(is_moved ? moved : start);
        n_flips += report.n_flips;
        n_full += report.is_full;
      }
    c.triangulation.rebuild(start);
    state.SetItemsProcessed(state.iterations() * c.mesh.cells.size());
    state.counters["flips"] = static_cast<double>(n_flips) / state.iterations();
    state.counters["full"]  = static_cast<double>(n_full) / state.iterations();
  }

  void sizes(benchmark::internal::Benchmark *benchmark)
  {
    benchmark->Arg(2000)->Arg(17000)->Arg(120000)->Arg(680000)->Unit(benchmark::kMillisecond);
  }

  /// Owners and parts of all ranks; `twice` is the share of cells that more than one rank computes.
  void parts_of_ranks(benchmark::State &state)
  {
    const Cloud       &c       = cloud(state.range(0));
    const unsigned int n_ranks = state.range(1);
    std::size_t        n_cells = 0;
    for (auto _ : state)
      {
        n_cells = 0;
        for (const auto &part : partition<3>(c.mesh.cells, owners_by_bisection(c.position, n_ranks), n_ranks))
          n_cells += part.cells.size();
      }
    state.SetItemsProcessed(state.iterations() * c.mesh.cells.size());
    state.counters["twice"] = static_cast<double>(n_cells) / c.mesh.cells.size() - 1;
  }

  void peak_multiply_adds(benchmark::State &state)
  {
    constexpr int n = 32;
    double        x[n];
    for (int i = 0; i < n; ++i)
      x[i] = 1e-3 * i;
    for (auto _ : state)
      {
        for (int k = 0; k < 1000; ++k)
          for (int i = 0; i < n; ++i)
            x[i] = x[i] * 0.999 + 1e-6;
        benchmark::DoNotOptimize(x);
      }
    state.SetItemsProcessed(state.iterations() * 2000 * n);
  }

  void triad(benchmark::State &state)
  {
    std::vector<double> a(state.range(0)), b(state.range(0), 1.), c(state.range(0), 2.);
    for (auto _ : state)
      {
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] = b[i] + 0.5 * c[i];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
      }
    state.SetBytesProcessed(state.iterations() * 24 * a.size());
  }
} // namespace

BENCHMARK(volumes)->Apply(sizes);
BENCHMARK(forces)->Apply(sizes);
BENCHMARK_CAPTURE(step, inviscid, false, false)->Apply(sizes);
BENCHMARK_CAPTURE(step, viscous, true, false)->Apply(sizes);
BENCHMARK_CAPTURE(step, diffusion, false, true)->Apply(sizes);
BENCHMARK_CAPTURE(step, viscous_diffusion, true, true)->Apply(sizes);
BENCHMARK(node_pairs)->Apply(sizes);
BENCHMARK(mass_exchange)->Apply(sizes);
BENCHMARK(triangulation)->Arg(13000)->Arg(120000)->Unit(benchmark::kMillisecond);
BENCHMARK(alpha_shape_of_triangulation)->Arg(13000)->Arg(120000)->Unit(benchmark::kMillisecond);
BENCHMARK(triangulation_repair)
  ->ArgsProduct({{13000, 120000}, {0, 5, 20}})
  ->ArgNames({"nodes", "hundredths_of_h"})
  ->Unit(benchmark::kMillisecond);
BENCHMARK(parts_of_ranks)
  ->ArgsProduct({{120000, 680000}, {2, 8, 32}})
  ->ArgNames({"nodes", "ranks"})
  ->Unit(benchmark::kMillisecond);
BENCHMARK(peak_multiply_adds);
BENCHMARK(triad)->Arg(1 << 12)->Arg(1 << 17)->Arg(1 << 24);
BENCHMARK_MAIN();
