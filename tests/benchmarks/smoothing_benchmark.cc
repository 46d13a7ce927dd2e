// Mesh smoothers on an evolving cloud of nodes: remesh, smooth, advect, again and again (figure 3 of Meduri, Cremonesi
// and Perego: the stable step before and after smoothing at every remesh).
//
// smoothing_benchmark [nodes [remeshes [smoother[+smoother ...]=target ...]]] > smoothing.csv
//
// The cloud is a slab on a floor with free sides and top, in a field of vortices that changes and turns round, so that
// the surface folds and breaks. Nodes that come too close are taken away, edges that grow too long get a node in their
// middle. Every smoother works on a cloud of its own, which it changes. Units: the spacing of the nodes is 1.

#include <mesh_smoothers/elastic_analogy.h>
#include <mesh_smoothers/elastic_analogy_then_getme.h>
#include <mesh_smoothers/flips_and_optimization.h>
#include <mesh_smoothers/getme.h>
#include <pfem_fluid/alpha_shape.h>
#include <pfem_fluid/lattice.h>

#include <breakwater/base/run_context.h>
#include <breakwater/mesh/quality.h>
#include <breakwater/mesh/quality_report.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <sstream>
#include <string>

namespace
{
  using namespace Breakwater;
  using Cell = SimplexMesh<3>::Cell;

  constexpr double pi = 3.14159265358979;

  /// A velocity without divergence, and without a vertical part on the floor z = 0: the curl of a sum of waves.
  class Vortices
  {
  public:
    explicit Vortices(const double size)
    {
      std::mt19937 random(7);
      const auto   noise = [&]() {
        return random() * (1. / std::mt19937::max());
      };
      for (unsigned int k = 0; k < n_waves; ++k)
        {
          Wave        &wave  = waves_[k];
          const double angle = 2 * pi * noise(), number = 2 * pi / size * (1 + 2 * noise());
          wave.number = {{number * std::cos(angle), number * std::sin(angle), pi / size * (1 + 2 * noise())}};
          wave.vector = {{std::cos(2 * pi * noise()), std::sin(2 * pi * noise()), 0}};
          wave.phase  = 2 * pi * noise();
          wave.period = 30 + 60 * noise();
        }
    }

    /// @param time in remeshes
    Vec<3> operator()(const Vec<3> &x, const double time) const
    {
      Vec<3> u;
      for (const Wave &wave : waves_)
        {
          const double amplitude  = std::cos(2 * pi * time / wave.period + wave.phase);
          const double along      = wave.number[0] * x[0] + wave.number[1] * x[1] + wave.phase;
          const double horizontal = std::cos(along), slope = -std::sin(along),
                       vertical = std::sin(wave.number[2] * x[2]);
          // A = a cos(k . x) sin(kz z), u = curl A
          u[0] -= amplitude * wave.vector[1] * horizontal * wave.number[2] * std::cos(wave.number[2] * x[2]);
          u[1] += amplitude * wave.vector[0] * horizontal * wave.number[2] * std::cos(wave.number[2] * x[2]);
          u[2] += amplitude * slope * vertical * (wave.vector[1] * wave.number[0] - wave.vector[0] * wave.number[1]);
        }
      return u;
    }

  private:
    static constexpr unsigned int n_waves = 6;
    struct Wave
    {
      Vec<3> number, vector;
      double phase = 0, period = 1;
    };
    Wave waves_[n_waves];
  };

  class Cloud
  {
  public:
    explicit Cloud(const double n_nodes)
      : side_(std::cbrt(n_nodes / 0.6))
      , vortices_(side_)
    {
      const BoxShape<3>         box   = {"box", {}, {{side_, side_, 0.6 * side_}}};
      const std::vector<Vec<3>> nodes = fill_box(box, {}, 1.);
      for (const unsigned int i : hilbert_order(nodes))
        position.push_back(nodes[i]);
    }

    /// @return CPU seconds of a new triangulation with alpha shape
    double triangulate()
    {
      DelaunayMesh<3> triangulation;
      const double    start = cpu_time();
      triangulation.rebuild(position);
      mesh = alpha_shape<3>(triangulation, 1.3, [this](const Cell &cell) {
        return std::any_of(cell.begin(), cell.end(), [this](const unsigned int i) {
          return !is_on_floor(i);
        });
      });
      return cpu_time() - start;
    }

    std::vector<NodeFreedom> freedom() const
    {
      std::vector<NodeFreedom> result(position.size(), NodeFreedom::free);
      std::vector<char>        is_surface(position.size(), 0);
      for (const auto &facet : mesh.boundary)
        if (std::any_of(facet.begin(), facet.end(), [this](const unsigned int i) {
              return !is_on_floor(i);
            }))
          for (const unsigned int i : facet)
            is_surface[i] = 1;
      for (std::size_t i = 0; i < position.size(); ++i)
        if (is_surface[i])
          result[i] = is_on_floor(i) ? NodeFreedom::slides_on_line : NodeFreedom::slides_on_surface;
        else if (is_on_floor(i))
          result[i] = NodeFreedom::slides_on_wall;
      return result;
    }

    /// Until a node has moved by 0.2 against the mean of a cell, as the fluid does.
    void advect(const double time)
    {
      constexpr unsigned int n_steps = 4;
      double                 fastest = 0;
      for (const Cell &cell : mesh.cells)
        {
          Vec<3> mean, velocity[4];
          for (int a = 0; a < 4; ++a)
            mean += (velocity[a] = vortices_(position[cell[a]], time)) * 0.25;
          for (const Vec<3> &v : velocity)
            fastest = std::max(fastest, norm(v - mean));
        }
      const double step = 0.2 / fastest / n_steps;
      for (unsigned int k = 0; k < n_steps; ++k)
        for (Vec<3> &x : position)
          x += vortices_(x + vortices_(x, time) * (0.5 * step), time) * step;
    }

    /// Takes nodes away that are closer than 0.5 to another, and puts one into the middle of edges longer than 2.2.
    void manage_nodes()
    {
      std::vector<char>                        goes(position.size(), 0), is_taken(position.size(), 0);
      std::vector<Vec<3>>                      added;
      std::vector<std::array<unsigned int, 2>> edges;
      for (const Cell &cell : mesh.cells)
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b)
            if (cell[a] < cell[b])
              edges.push_back({{cell[a], cell[b]}});
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      for (const auto &[i, k] : edges)
        {
          const double length = norm(position[i] - position[k]);
          if (is_taken[i] || is_taken[k] || (length >= 0.5 && length <= 2.2))
            continue;
          is_taken[i] = is_taken[k] = 1;
          if (length < 0.5)
            goes[is_on_floor(k) ? i : k] = 1;
          else
            added.push_back((position[i] + position[k]) * 0.5);
        }
      std::size_t n = 0;
      for (std::size_t i = 0; i < position.size(); ++i)
        if (!goes[i])
          position[n++] = position[i];
      position.resize(n);
      position.insert(position.end(), added.begin(), added.end());
    }

    double volume() const
    {
      double sum = 0;
      for (const Cell &cell : mesh.cells)
        sum += signed_volume(corners(position, cell));
      return sum;
    }

    std::vector<Vec<3>> position;
    SimplexMesh<3>      mesh;

  private:
    bool is_on_floor(const unsigned int i) const { return position[i][2] == 0; }

    double   side_;
    Vortices vortices_;
  };

  std::unique_ptr<MeshSmoother<3>> make_smoother(const std::string &name)
  {
    if (name == "elastic analogy")
      return std::make_unique<ElasticAnalogy<3>>();
    if (name == "elastic analogy then getme")
      return std::make_unique<ElasticAnalogyThenGetme<3>>();
    if (name == "getme")
      return std::make_unique<Getme<3>>();
    if (name == "flips and optimization")
      return std::make_unique<FlipsAndOptimization<3>>();
    std::fprintf(stderr, "There is no smoother '%s'\n", name.c_str());
    std::exit(1);
  }

  /// @param text "smoother=target", or several smoothers joined by +
  void run(const std::string &text, const double n_nodes, const unsigned int n_remeshes)
  {
    const std::size_t end = text.find('=');
    if (end == std::string::npos)
      {
        std::fprintf(stderr, "'%s' has no target: write smoother=target, as in getme=0.2\n", text.c_str());
        std::exit(1);
      }
    const double                                  target = std::stod(text.substr(end + 1));
    std::vector<std::unique_ptr<MeshSmoother<3>>> smoothers;
    std::istringstream                            names(text.substr(0, end));
    for (std::string name; std::getline(names, name, '+');)
      smoothers.push_back(make_smoother(name));

    Cloud  cloud(n_nodes);
    double smallest_at_end = 0;
    for (unsigned int k = 0; k < n_remeshes; ++k)
      {
        const double              triangulation = cloud.triangulate();
        const double              volume        = cloud.volume();
        const QualityReport       before        = mesh_quality<3>(cloud.mesh, cloud.position, 1.);
        const auto                freedom       = cloud.freedom();
        const std::vector<Vec<3>> normal(cloud.position.size(), {{0, 0, -1}}); // of the floor
        const auto                start = cloud.position;
        SmoothingReport           report;
        for (const auto &smoother : smoothers)
          report.add(smoother->smooth(cloud.mesh, cloud.position, {freedom, normal, 1., target}));
        measure_moves(start, cloud.position, report);
        const QualityReport after = mesh_quality<3>(cloud.mesh, cloud.position, 1.);
        std::printf(
          "%s,%u,%zu,%zu,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%u,%u,%.6g,%.6g,%.6g,%u,%.6g,%.6g,%.6g\n",
          text.c_str(), k, cloud.position.size(), cloud.mesh.cells.size(), before.smallest_radius,
          after.smallest_radius, before.smallest, before.thousandth, before.hundredth, before.median, after.smallest,
          after.thousandth, after.hundredth, report.n_flips, report.n_moved_nodes, report.mean_move,
          report.largest_move, report.volume_change / volume, report.n_peeled_cells, smallest_at_end, triangulation,
          report.seconds);
        std::fflush(stdout);
        cloud.advect(k);
        smallest_at_end = mesh_quality<3>(cloud.mesh, cloud.position, 1.).smallest;
        cloud.manage_nodes();
      }
  }
} // namespace


int main(int argc, char **argv)
{
  const double             n_nodes    = argc > 1 ? std::atof(argv[1]) : 120000;
  const unsigned int       n_remeshes = argc > 2 ? std::atoi(argv[2]) : 50;
  std::vector<std::string> cases(argv + std::min(argc, 3), argv + argc);
  if (cases.empty())
    cases = {"elastic analogy=0.2", "getme=0.2", "elastic analogy+getme=0.2", "elastic analogy then getme=0.2",
             "flips and optimization=0.6"};
  std::printf(
    "smoother,remesh,nodes,cells,insphere radius before,insphere radius after,smallest r before,0.1 %% before,"
    "1 %% before,median before,smallest r after,0.1 %% after,1 %% after,flips,moved nodes,mean move,"
    "largest move,volume change,peeled cells,smallest r at end of last cycle,triangulation [CPU s],"
    "smoothing [CPU s]\n");
  for (const std::string &text : cases)
    run(text, n_nodes, n_remeshes);
}
