#include <breakwater/base/abi.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_file.h>
#include <breakwater/base/plugin_library.h>
#include <breakwater/simulation/command_line.h>
#include <breakwater/simulation/plugin_reference.h>
#include <breakwater/simulation/simulation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>

namespace
{
  using namespace Breakwater;

  enum ExitStatus
  {
    success   = 0,
    bad_input = 1,
    breakdown = 2
  };

  void request_stop(int)
  {
    stop_is_requested = 1;
  }

  void load_libraries(const SceneHeader &header, const ParameterText &text, PluginLibraries &libraries,
                      PluginRegistry &registry)
  {
    for (const std::string &name : header.plugin_libraries)
      try
        {
          libraries.load(name, registry);
        }
      catch (const InputError &error)
        {
          const ParameterText::Entry *entry = text.find({}, "Plugin libraries");
          throw InputError((entry == nullptr ? text.name : entry->place) +
                           ": at the top level, entry \"Plugin libraries\": " + error.what());
        }
  }

  template <int dim>
  int run_scene(const CommandLine &command_line, const ParameterText &text, const PluginRegistry &registry)
  {
    Simulation<dim> simulation;
    read_parameters(simulation, registry, text);

    std::ostringstream parameters;
    Simulation<dim>    printed; // a fresh one still knows its defaults
    print_parameters(parameters, printed, registry, text);
    if (command_line.task == CommandLine::Task::print_parameters)
      {
        std::cout << parameters.str();
        return success;
      }
    if (command_line.task == CommandLine::Task::validate)
      {
        simulation.validate();
        std::cout << command_line.parameter_file.string() << " is valid\n";
        return success;
      }
    const typename Simulation<dim>::Options options = {command_line.parameter_file.string(),
                                                       command_line.output_directory, command_line.resume};
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    const bool is_finished = simulation.run(options, parameters.str());
    const auto directory   = simulation.output_directory(options).string();
    std::cout << "Results are in " << directory
              << ": history.csv (curves), solution.pvd (fields, for ParaView), summary.json" << std::endl;
    if (!is_finished)
      std::cerr << "interrupted; --resume goes on from the checkpoint in " << directory << "\n";
    return is_finished ? success : breakdown;
  }

  int execute(const CommandLine &command_line)
  {
    using Task = CommandLine::Task;
    PluginRegistry  registry;
    PluginLibraries libraries(PluginLibraries::default_folders(command_line.plugin_folders));
    if (command_line.task == Task::list_plugins ||
        (command_line.task == Task::print_parameters && command_line.parameter_file.empty()))
      {
        for (const std::string &name : libraries.available())
          libraries.load(name, registry);
        if (command_line.task == Task::list_plugins)
          print_plugin_list(std::cout, registry);
        else
          print_plugin_reference(std::cout, registry);
        return success;
      }

    ParameterText text = scan_parameter_file(command_line.parameter_file);
    for (const std::string &assignment : command_line.overrides)
      override_parameter(text, assignment);
    SceneHeader header;
    read_parameters(header, registry, text, Strictness::lenient);
    load_libraries(header, text, libraries, registry);
    return header.dimension == 2 ? run_scene<2>(command_line, text, registry) :
                                   run_scene<3>(command_line, text, registry);
  }

  /// Without mpirun, Open MPI would start a daemon for ranks to come: none will, and where the network or /sys are
  /// missing, as in a container, that takes seconds and prints warnings. Processes without the daemon share one
  /// directory for the session, which each deletes at its end: one that starts just then would find it gone. A process
  /// alone needs none.
  void prepare_mpi_environment()
  {
    constexpr int keep = 0;
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
      {
        setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
        setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
      }
    setenv("HWLOC_HIDE_ERRORS", "2", keep);
  }

  /// Runs the task; every error ends here as one message on stderr and an exit status.
  int execute_and_report(const CommandLine &command_line)
  {
    const auto report = [](const char *what, const std::string &message, const int status) {
      std::fprintf(stderr, "breakwater: %s%s\n", what, message.c_str());
      return status;
    };
    try
      {
        return execute(command_line);
      }
    catch (const InputError &error)
      {
        return report("", error.what(), bad_input);
      }
    catch (const BreakdownError &error)
      {
        return report("numerical breakdown: ", error.what(), breakdown);
      }
    catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream message;
        error.print_info(message);
        return report("deal.II says: ", message.str(), bad_input);
      }
    catch (const std::bad_alloc &)
      {
        return report("", "there is not enough memory for this scene", bad_input);
      }
    catch (const std::exception &error)
      {
        return report("unexpected error: ", error.what(), bad_input);
      }
  }
} // namespace

int main(int argc, char **argv)
{
  CommandLine command_line;
  try
    {
      command_line = parse_command_line({argv + 1, argv + argc});
    }
  catch (const InputError &error)
    {
      std::fprintf(stderr, "breakwater: %s\n", error.what());
      return bad_input;
    }
  if (command_line.task == CommandLine::Task::print_help)
    return std::cout << command_line_help(), success;
  if (command_line.task == CommandLine::Task::print_version)
    return std::cout << "breakwater " BREAKWATER_VERSION " (" BREAKWATER_ABI_TAG ")\n", success;

  prepare_mpi_environment();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::fprintf(stderr, "breakwater: runs on one rank only so far; start it without mpirun or with -n 1\n");
      return bad_input;
    }
  return execute_and_report(command_line);
}
