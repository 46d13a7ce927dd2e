#include <breakwater/base/abi.h>
#include <breakwater/base/binary_stream.h>
#include <breakwater/base/exceptions.h>
#include <breakwater/simulation/json_object.h>
#include <breakwater/simulation/report.h>
#include <breakwater/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sys/resource.h>

namespace Breakwater
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string checkpoint_format = "breakwater checkpoint 4";

    /// The checkpoint's file: of the last one, or of the one before if the run was stopped between two renamings.
    fs::path checkpoint_file(const fs::path &directory)
    {
      for (const char *folder : {"checkpoint", "checkpoint.old"})
        if (fs::exists(directory / folder / "state.bin"))
          return directory / folder / "state.bin";
      throw InputError("--resume: there is no checkpoint in " + directory.string());
    }

    /// Reads what stands at a checkpoint's start. @return its simulated time [s]
    double read_checkpoint_head(std::istream &stream, const int dim)
    {
      std::string format;
      int         dimension = 0;
      double      time      = 0;
      read_binary(stream, format);
      if (format != checkpoint_format)
        throw InputError("--resume: the checkpoint has the form \"" + format + "\", this program reads \"" +
                         checkpoint_format + "\"");
      read_binary(stream, dimension);
      if (dimension != dim)
        throw InputError("--resume: the checkpoint is of a scene in " + std::to_string(dimension) + "D");
      read_binary(stream, time);
      return time;
    }

    bool is_table(const fs::path &file)
    {
      return file.extension() == ".csv";
    }

    /// Cuts a table's rows after a time [s]; in place, since it may be open to append to.
    void cut_table(const fs::path &file, const double time)
    {
      std::ifstream stream(file);
      std::string   line;
      if (!std::getline(stream, line) || line.rfind("time [s]", 0) != 0)
        return;
      std::uintmax_t size = line.size() + 1;
      while (std::getline(stream, line) && !stream.eof() && std::strtod(line.c_str(), nullptr) <= time * (1 + 1e-9))
        size += line.size() + 1;
      stream.close();
      fs::resize_file(file, size);
    }

    std::map<fs::path, std::uintmax_t> table_sizes(const fs::path &directory)
    {
      std::map<fs::path, std::uintmax_t> sizes;
      for (const fs::directory_entry &entry : fs::directory_iterator(directory))
        if (is_table(entry.path()))
          sizes[entry.path()] = entry.file_size();
      return sizes;
    }

    double peak_memory_bytes()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * static_cast<double>(usage.ru_maxrss);
    }
  } // namespace

  template <int dim>
  fs::path Simulation<dim>::output_directory(const Options &options) const
  {
    if (!options.output_directory.empty())
      return options.output_directory;
    if (!directory_.empty())
      return directory_;
    return "output-" + fs::path(options.parameter_file).stem().string();
  }

  template <int dim>
  void Simulation<dim>::start_output(const Options &options, const std::string &parameters)
  {
    const fs::path  directory = output_directory(options);
    std::error_code error;
    fs::create_directories(directory, error);
    if (!fs::is_directory(directory))
      throw InputError("can't make the output folder " + directory.string() + ": " + error.message());
    field_output_ = std::make_unique<FieldOutput>(directory);
    fs::remove(directory / "summary.json");
    if (!options.resume)
      {
        field_output_->remove_earlier();
        for (const char *file :
             {"history.csv", "remeshing.csv", "report.html", "checkpoint", "checkpoint.new", "checkpoint.old"})
          fs::remove_all(directory / file);
      }
    else
      {
        std::ifstream stream(checkpoint_file(directory), std::ios::binary);
        const double  time = read_checkpoint_head(stream, dim);
        for (const auto &table : table_sizes(directory))
          cut_table(table.first, time);
      }
    context_           = std::make_unique<RunContext>(directory, options.resume);
    context_->n_digits = n_digits_;
    write_whole_file(directory / "parameters.prm", parameters);
  }

  template <int dim>
  void Simulation<dim>::set_up_or_resume(const Options &options)
  {
    const auto sizes = table_sizes(context_->output_directory());
    set_up();
    if (options.resume)
      {
        // Rows that the set-up at time 0 added stand in the tables already.
        for (const auto &[table, size] : sizes)
          fs::resize_file(table, size);
        load_checkpoint();
        return;
      }
    for (const NamedDomain &domain : domains_)
      {
        const DomainBalance<dim> balance = domain.domain->balance();
        monitor_.initial_mass += balance.mass;
        monitor_.initial_potential_energy += balance.potential_energy;
      }
    write_due_output(false);
  }

  template <int dim>
  void Simulation<dim>::write_due_output(const bool is_last)
  {
    const auto is_due = [this](const unsigned long n, const double interval) {
      return interval > 0 && time_ >= static_cast<double>(n) * interval - 1e-9 * interval;
    };
    if (is_due(n_histories_, history_every_) || history_every_ == 0 || (is_last && last_history_time_ < time_))
      {
        write_history();
        last_history_time_ = time_;
        ++n_histories_;
      }
    if (is_due(n_fields_, fields_every_) || n_fields_ == 0 || (is_last && last_fields_time_ < time_))
      {
        write_fields();
        last_fields_time_ = time_;
        ++n_fields_;
      }
  }

  template <int dim>
  void Simulation<dim>::write_history()
  {
    PhaseTimer         timer(*context_, Phase::output);
    DomainBalance<dim> sum;
    for (const NamedDomain &domain : domains_)
      sum += domain.domain->balance();
    const double total_energy = sum.energy();

    Row row = {{"time [s]", time_},
               {"kinetic energy [J]", sum.kinetic_energy},
               {"potential energy [J]", sum.potential_energy},
               {"internal energy [J]", sum.internal_energy},
               {"strain energy [J]", sum.strain_energy},
               {"total energy [J]", total_energy}};
    for (const NamedDomain &domain : domains_)
      domain.domain->add_history(row);
    if (!coupler_.empty())
      {
        const InterfaceBalance &balance = coupler_.front().balance(0);
        const Vec<dim>          force   = coupler_.front().interface_force(0);
        row.emplace_back("interface energy [J]", balance.energy);
        row.emplace_back("interface velocity gap [m/s]", balance.velocity_gap);
        row.emplace_back("interface displacement drift [m]", balance.displacement_drift);
        row.emplace_back("interface displacement taken back [m]", balance.taken_back);
        row.emplace_back("interface substeps [-]", balance.n_substeps);
        row.emplace_back("interface unknowns [-]", balance.n_unknowns);
        row.emplace_back("interface iterations [-]", balance.n_iterations);
        for (int d = 0; d < dim; ++d)
          row.emplace_back(std::string("interface force ") + "xyz"[d] + " [N]", force[d]);
      }
    for (const Probe<dim> &probe : probes_)
      probe.add_history(row);
    for (const auto &postprocessor : postprocessors_.plugins())
      postprocessor->add_history(time_, row);
    row.emplace_back("time step [s]", time_step_);
    context_->table("history").add_row(row);

    if (!std::isfinite(total_energy))
      throw BreakdownError("the energy is not finite any more at t = " + std::to_string(time_) +
                           " s; the last rows of history.csv show what grew");
    monitor_.energy_rise.add(time_, total_energy - sum.received_energy);
    if (const double largest_mass = std::max(monitor_.initial_mass, sum.mass); largest_mass > 0)
      monitor_.largest_mass_drift = std::max(
        monitor_.largest_mass_drift, std::abs(sum.mass - sum.received_mass - monitor_.initial_mass) / largest_mass);
  }

  template <int dim>
  void Simulation<dim>::write_fields()
  {
    PhaseTimer                                           timer(*context_, Phase::output);
    std::vector<std::pair<std::string, OutputMesh<dim>>> meshes;
    for (const NamedDomain &domain : domains_)
      meshes.emplace_back(domain.name == "Fluid" ? "fluid" : domain.name, domain.domain->output_mesh());
    field_output_->write<dim>(time_, meshes);
  }

  // Within a step nodes may be anywhere, but a picture of them shows what went wrong.
  template <int dim>
  void Simulation<dim>::write_fields_at_breakdown()
  {
    if (n_fields_ == 0 || last_fields_time_ >= time_)
      return;
    try
      {
        write_fields();
      }
    catch (const std::exception &)
      {
        // what broke down matters more
      }
  }

  template <int dim>
  template <class AnySimulation, class Visitor>
  void Simulation<dim>::visit_numbers(AnySimulation &simulation, const Visitor &visit)
  {
    visit(simulation.time_step_);
    visit(simulation.kept_step_);
    visit(simulation.n_fields_);
    visit(simulation.n_histories_);
    visit(simulation.last_fields_time_);
    visit(simulation.last_history_time_);
    visit(simulation.monitor_.initial_mass);
    visit(simulation.monitor_.initial_potential_energy);
    visit(simulation.monitor_.largest_mass_drift);
  }


  // Bodies are named, so that a wrong one is recognised.
  template <int dim>
  template <class AnySimulation, class Visitor>
  void Simulation<dim>::visit_parts(AnySimulation &simulation, const Visitor &visit)
  {
    visit("rise of the energy", simulation.monitor_.energy_rise);
    visit("run", *simulation.context_);
    visit("fields", *simulation.field_output_);
    for (const NamedDomain &domain : simulation.domains_)
      visit("body " + domain.name, *domain.domain);
    if (!simulation.coupler_.empty())
      visit("coupler " + simulation.coupler_.names().front(), simulation.coupler_.front());
  }


  template <int dim>
  void Simulation<dim>::write_due_checkpoint()
  {
    const bool by_time = checkpoints_every_ > 0 && time_ - last_checkpoint_time_ >= checkpoints_every_ * (1 - 1e-9);
    const bool by_wall =
      checkpoints_every_wall_ > 0 && progress_->wall_seconds() - last_checkpoint_wall_ >= checkpoints_every_wall_;
    if (by_time || by_wall)
      write_checkpoint();
  }

  template <int dim>
  void Simulation<dim>::write_checkpoint()
  {
    PhaseTimer timer(*context_, Phase::output);
    last_checkpoint_time_   = time_;
    last_checkpoint_wall_   = progress_->wall_seconds();
    const fs::path last     = context_->output_directory() / "checkpoint";
    const fs::path fresh    = context_->output_directory() / "checkpoint.new";
    const fs::path previous = context_->output_directory() / "checkpoint.old";
    fs::remove_all(fresh);
    fs::create_directory(fresh);
    {
      std::ofstream stream(fresh / "state.bin", std::ios::binary);
      write_binary(stream, checkpoint_format);
      write_binary(stream, dim);
      write_binary(stream, time_);
      write_binary(stream, wall_seconds());
      visit_numbers(*this, [&stream](const auto &number) {
        write_binary(stream, number);
      });
      visit_parts(*this, [&stream](const std::string &name, const auto &part) {
        write_binary(stream, name);
        part.save(stream);
      });
      write_binary(stream, checkpoint_format);
      stream.close();
      if (!stream)
        throw InputError("can't write the checkpoint " + fresh.string() + ": is the disk full?");
    }
    fs::remove_all(previous);
    if (fs::exists(last))
      fs::rename(last, previous);
    fs::rename(fresh, last);
    fs::remove_all(previous);
  }

  template <int dim>
  void Simulation<dim>::load_checkpoint()
  {
    std::ifstream stream(checkpoint_file(context_->output_directory()), std::ios::binary);
    time_ = last_checkpoint_time_ = read_checkpoint_head(stream, dim);
    read_binary(stream, earlier_wall_seconds_);
    visit_numbers(*this, [&stream](auto &number) {
      read_binary(stream, number);
    });
    visit_parts(*this, [&stream](const std::string &name, auto &part) {
      std::string saved_name;
      read_binary(stream, saved_name);
      if (saved_name != name)
        throw InputError("--resume: the checkpoint has \"" + saved_name + "\" where the scene has \"" + name + "\"");
      part.load(stream);
    });
    for (const auto &group : groups_)
      group->refresh();
    std::string end;
    read_binary(stream, end);
    if (end != checkpoint_format)
      throw InputError("--resume: the checkpoint does not fit the scene: what a body read is not what it wrote");
  }

  template <int dim>
  void Simulation<dim>::write_summary(const Options &options, const std::string &status,
                                      const std::string &message) const
  {
    const RunContext &context = *context_;
    JsonObject        summary;
    summary.add("status", status);
    if (!message.empty())
      summary.add("message", message);
    summary.add("scene", options.parameter_file);
    summary.add("title", header_.title);
    summary.add("versions", std::vector<std::pair<std::string, std::string>>{{"breakwater", BREAKWATER_VERSION},
                                                                             {"abi", BREAKWATER_ABI_TAG}});
    summary.add("end_time", time_);
    summary.add("wall_seconds", wall_seconds());
    double                                      cpu_seconds = 0;
    std::vector<std::pair<std::string, double>> by_phase;
    for (unsigned int i = 0; i < n_phases; ++i)
      {
        const Phase phase = static_cast<Phase>(i);
        by_phase.emplace_back(phase_name(phase), context.cpu_seconds(phase));
        cpu_seconds += context.cpu_seconds(phase);
      }
    // The whole process: start and set-up, too. A resumed run knows the earlier ones by their phases.
    summary.add("cpu_seconds", std::max(cpu_seconds, cpu_time()));
    summary.add("cpu_seconds_by_phase", by_phase);
    summary.add("steps", context.steps);
    summary.add("cell_steps", context.cell_steps);
    const double solver_seconds = context.cpu_seconds(Phase::solver);
    summary.add("cell_steps_per_cpu_second",
                solver_seconds > 0 ? static_cast<double>(context.cell_steps) / solver_seconds : 0.);
    summary.add("n_remeshes", context.n_remeshes);
    summary.add("peak_memory_bytes", peak_memory_bytes());
    summary.add("effects_active", context.effects_active());
    summary.add("effects_skipped", context.effects_skipped());
    summary.add("largest relative mass drift [-]", monitor_.largest_mass_drift);
    summary.add("largest energy rise over 0.05 s [J]", monitor_.energy_rise.largest());
    if (monitor_.initial_potential_energy != 0)
      summary.add("largest energy rise over 0.05 s, relative to the initial potential energy [-]",
                  monitor_.energy_rise.largest() / std::abs(monitor_.initial_potential_energy));
    if (!coupler_.empty())
      {
        const InterfaceBalance &balance = coupler_.front().balance(0);
        summary.add("interface energy [J]", balance.energy);
        summary.add("largest interface velocity gap [m/s]", balance.largest_gap);
        summary.add("largest interface displacement drift [m]", balance.largest_drift);
        summary.add("largest interface displacement taken back [m]", balance.largest_taken_back);
        summary.add("momentum made by the interface [kg m/s]", norm(balance.momentum));
      }
    for (const auto &[name, value] : context.summary())
      summary.add(name, value);
    write_whole_file(context.output_directory() / "summary.json", summary.text());
    write_whole_file(context.output_directory() / "report.html",
                     report_html(header_.title, summary, context.output_directory()));
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Breakwater
