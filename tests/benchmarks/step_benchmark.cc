// Speed of whole time steps of the fluid, as a scene runs them, and of their parts.
//
// items_per_second counts cell-steps by CPU time. With BREAKWATER_INSTRUCTION_SET=baseline in the environment the
// loops over cells are those of the compiler's baseline.

#include <breakwater/base/parameter_file.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/plugin_library.h>
#include <breakwater/base/run_context.h>
#include <breakwater/interfaces/explicit_domain.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace
{
  using namespace Breakwater;

  /// The effects of a scene, in the words of the parameter file.
  struct Effects
  {
    std::string rheology, stabilization;
  };
  const std::string none =
    "set Density diffusion = 0\nset Velocity filter = 0\nset Divergence filter = 0\nset Cell stiffness = 0\n";
  const std::string only_diffusion = "set Velocity filter = 0\nset Divergence filter = 0\nset Cell stiffness = 0\n";
  const std::string only_stiffness = "set Density diffusion = 0\nset Velocity filter = 0\nset Divergence filter = 0\n";
  const std::string all            = "";

  /// A cube of water of 1 m, at rest in an open tank, of about n nodes.
  std::string tank(const double n_nodes, const Effects &effects)
  {
    std::ostringstream text;
    text << "set Body forces = gravity\n"
            "subsection Gravity\nset Acceleration = 0, -9.81, 0\nend\n"
            "set Fluid = pfem\n"
            "subsection Pfem\n"
         << "set Spacing = " << 1 / std::cbrt(n_nodes) << "\nset Rheology = " << effects.rheology
         << "\nsubsection Initial state\nset Shape = box(0, 0, 0; 1, 1, 1)\nset Pressure = hydrostatic\nend\n"
         << "subsection Walls\nsubsection Tank\nset Shape = open box(0, 0, 0; 1, 1.2, 1)\nend\nend\n"
         << "subsection Tait\nset Reference density = 1000\nset Sound speed = 50\nend\n"
         << "subsection Stabilization\n"
         << effects.stabilization << "end\nend\n";
    return text.str();
  }

  /// A fluid as the program makes it.
  class Scene : public Plugin
  {
  public:
    explicit Scene(const std::string &parameters)
      : body_forces_("Body forces", "", "Accelerations.")
      , fluid_("Fluid", "pfem", "The fluid.", 1)
      , context_(std::filesystem::temp_directory_path())
    {
      PluginLibraries libraries({BREAKWATER_BENCHMARK_PLUGIN_FOLDER});
      PluginRegistry  registry;
      for (const char *name : {"pfem_fluid", "equations_of_state", "rheologies", "body_forces", "time_step_bounds"})
        libraries.load(name, registry);
      std::istringstream text(parameters);
      read_parameters(*this, registry, scan_parameters(text, "benchmark"));
      fluid_.front().setup("Fluid", body_forces_.plugins(), context_);
    }

    void declare_parameters(ParameterReader &reader) override
    {
      body_forces_.declare_parameters(reader);
      fluid_.declare_parameters(reader);
    }
    void check_parameters(ParameterReader &reader) override
    {
      body_forces_.check_parameters(reader);
      fluid_.check_parameters(reader);
    }

    ExplicitDomain<3> &fluid() { return fluid_.front(); }
    RunContext        &context() { return context_; }

  private:
    PluginList<BodyForce<3>>      body_forces_;
    PluginList<ExplicitDomain<3>> fluid_;
    RunContext                    context_;
  };

  Scene &scene(const std::string &parameters)
  {
    static std::string            made_from; // one at a time: the big ones need gigabytes
    static std::unique_ptr<Scene> made;
    if (made_from != parameters)
      {
        made.reset();
        made      = std::make_unique<Scene>(parameters);
        made_from = parameters;
      }
    return *made;
  }

  /// @param is_whole with checks of the state, velocity filter and what asks for a remesh
  void full_step(benchmark::State &state, const Effects &effects, const bool is_whole)
  {
    Scene              &made       = scene(tank(state.range(0), effects));
    ExplicitDomain<3>  &fluid      = made.fluid();
    const unsigned long cell_steps = made.context().cell_steps, n_remeshes = made.context().n_remeshes;
    for (auto _ : state)
      {
        fluid.advance_free(fluid.stable_time_step());
        if (is_whole)
          fluid.end_step();
      }
    state.SetItemsProcessed(made.context().cell_steps - cell_steps);
    state.counters["cells"]    = static_cast<double>(made.context().cell_steps - cell_steps) / state.iterations();
    state.counters["remeshes"] = made.context().n_remeshes - n_remeshes;
  }

  void sizes(benchmark::internal::Benchmark *benchmark)
  {
    benchmark->Arg(2000)->Arg(17000)->Arg(120000)->Arg(680000)->Unit(benchmark::kMillisecond);
  }
} // namespace

BENCHMARK_CAPTURE(full_step, exact, Effects{"inviscid", none}, false)->Apply(sizes);
BENCHMARK_CAPTURE(full_step, cell_stiffness, Effects{"inviscid", only_stiffness}, false)->Apply(sizes);
BENCHMARK_CAPTURE(full_step, diffusion, Effects{"inviscid", only_diffusion}, false)->Apply(sizes);
BENCHMARK_CAPTURE(full_step, viscous, Effects{"newtonian", none}, false)->Apply(sizes);
BENCHMARK_CAPTURE(full_step, all_effects, Effects{"newtonian", all}, false)->Apply(sizes);
BENCHMARK_CAPTURE(full_step, all_effects_and_end, Effects{"newtonian", all}, true)->Apply(sizes);
