#pragma once

#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/run_context.h>
#include <breakwater/interfaces/coupler.h>
#include <breakwater/interfaces/explicit_domain.h>
#include <breakwater/interfaces/postprocessor.h>
#include <breakwater/simulation/domain_group.h>
#include <breakwater/simulation/energy_rise.h>
#include <breakwater/simulation/field_output.h>
#include <breakwater/simulation/probe.h>
#include <breakwater/simulation/progress.h>
#include <breakwater/simulation/ties.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace Breakwater
{
  /// The entries of a scene that must be known before any other: they tell what to load and in which dimension.
  struct SceneHeader : public Plugin
  {
    std::string              title;
    unsigned int             dimension = 3;
    double                   end_time  = 1.; ///< [s]
    std::vector<std::string> plugin_libraries;

    void declare_parameters(ParameterReader &reader) override;
  };

  /// Set by a signal handler: the run ends after the present step.
  extern volatile std::sig_atomic_t stop_is_requested;

  /// A scene: its bodies, what couples and measures them, and their way through time.
  template <int dim>
  class Simulation : public Plugin
  {
  public:
    struct Options
    {
      std::string           parameter_file;   ///< as named on the command line
      std::filesystem::path output_directory; ///< empty: as the scene says
      bool                  resume = false;
    };

    Simulation();
    ~Simulation() override;

    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    /// Builds all bodies and checks that they fit together, without output.
    void validate();

    /// Runs to the end time; true if it got there, false if it was interrupted.
    /// @param parameters the scene with all its entries, kept in the output directory
    /// @throws InputError, BreakdownError (after all output is closed)
    bool run(const Options &options, const std::string &parameters);

    /// The directory of results for these options.
    std::filesystem::path output_directory(const Options &options) const;

  private:
    struct Structure
    {
      std::string                          name;
      std::unique_ptr<ExplicitDomain<dim>> domain;
    };
    struct NamedDomain
    {
      std::string          name;
      ExplicitDomain<dim> *domain;
    };

    /// Measures of the whole run, taken at every history time.
    struct Monitor
    {
      double     initial_mass             = 0; ///< [kg]
      double     initial_potential_energy = 0; ///< [J]
      double     largest_mass_drift       = 0; ///< relative
      EnergyRise energy_rise{0.05};
    };

    void                     declare_structures(ParameterReader &reader);
    void                     declare_output(ParameterReader &reader);
    void                     check_bodies(ParameterReader &reader);
    void                     check_coupling(ParameterReader &reader);
    void                     check_probes(ParameterReader &reader) const;
    std::vector<std::string> structure_names() const;

    void set_up();
    void set_up_bodies();
    void set_up_fluid_and_structures();
    void set_up_tied_structures();
    void note_effects();

    DomainGroup<dim>      &make_group(const std::vector<std::string> &names, const std::string &partner);
    ExplicitDomain<dim>   &structure(const std::string &name) const;
    std::vector<TiedNames> ties() const;

    void start_output(const Options &options, const std::string &parameters);
    void set_up_or_resume(const Options &options);
    void advance_to_end();

    void   advance();
    double next_event() const;
    double wanted_step();
    double wall_seconds() const;

    void write_due_output(bool is_last);
    void write_history();
    void write_fields();
    void write_fields_at_breakdown();

    /// Shows visit() what a checkpoint holds: numbers, and parts that save and load themselves, with their names.
    template <class AnySimulation, class Visitor>
    static void visit_numbers(AnySimulation &simulation, const Visitor &visit);
    template <class AnySimulation, class Visitor>
    static void visit_parts(AnySimulation &simulation, const Visitor &visit);

    void write_due_checkpoint();
    void write_checkpoint();
    void load_checkpoint();

    void write_summary(const Options &options, const std::string &status, const std::string &message) const;

    // The scene
    SceneHeader                     header_;
    PluginList<BodyForce<dim>>      body_forces_;
    PluginList<ExplicitDomain<dim>> fluid_;
    std::vector<Structure>          structures_;
    PluginList<Coupler<dim>>        coupler_;
    std::vector<std::string>        tie_texts_;
    std::string                     ties_place_; ///< of their entry, for messages
    PluginList<Postprocessor<dim>>  postprocessors_;
    std::string                     directory_;
    double                          fields_every_  = 0.01;  ///< [s]
    double                          history_every_ = 0.001; ///< [s]
    unsigned int                    n_digits_      = 10;
    std::string                     probes_text_;
    double                          checkpoints_every_      = 0;   ///< simulated [s]
    double                          checkpoints_every_wall_ = 600; ///< [s]

    // The run
    std::unique_ptr<RunContext>                    context_;
    std::unique_ptr<FieldOutput>                   field_output_;
    std::unique_ptr<Progress>                      progress_;
    std::vector<NamedDomain>                       domains_; ///< the bodies
    std::vector<std::unique_ptr<DomainGroup<dim>>> groups_;
    std::vector<ExplicitDomain<dim> *> sides_; ///< bodies or groups: one that goes alone, or two that are coupled
    std::vector<Probe<dim>>            probes_;
    Monitor                            monitor_;
    double                             time_      = 0; ///< [s]
    double                             time_step_ = 0; ///< the last one [s]
    double        kept_step_   = 0; ///< coupled step that is taken while the bound changes little [s]
    unsigned long n_fields_    = 0; ///< outputs of fields so far
    unsigned long n_histories_ = 0;
    std::chrono::steady_clock::time_point start_;
    double                                earlier_wall_seconds_ = 0;  ///< of the run that was resumed
    double                                last_fields_time_     = -1; ///< [s]
    double                                last_history_time_    = -1; ///< [s]
    double                                last_checkpoint_time_ = 0;  ///< simulated [s]
    double                                last_checkpoint_wall_ = 0;  ///< [s]
  };
} // namespace Breakwater
