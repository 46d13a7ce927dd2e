#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Breakwater
{
  /// The parts of a run whose CPU time is reported apart.
  enum class Phase
  {
    solver,
    remeshing,
    smoothing,
    coupling,
    structure,
    output
  };
  constexpr unsigned int n_phases = 6;
  const char            *phase_name(Phase phase);

  /// Named numbers of one row, in the order of the columns: the unit stands in the name, "time [s]".
  using Row = std::vector<std::pair<std::string, double>>;

  /// A CSV file that is whole after every row. The first row fixes the columns.
  class CsvTable
  {
  public:
    /// @param append go on with an existing file of these columns (a resumed run)
    /// @param n_digits significant ones of each number
    explicit CsvTable(const std::filesystem::path &file, bool append = false, unsigned int n_digits = 10);

    /// @pre same names in the same order as in the first row.
    void add_row(const Row &row);

  private:
    std::ofstream            stream_;
    std::vector<std::string> columns_;
    bool                     append_;
    unsigned int             n_digits_;
  };

  /// What every part of a run may write to: counters, CPU time by phase, tables and notes. Owned by the simulation,
  /// handed to the domains and couplers at set-up.
  class RunContext
  {
  public:
    /// @param output_directory must exist
    explicit RunContext(std::filesystem::path output_directory, bool resumed = false);
    ~RunContext();

    const std::filesystem::path &output_directory() const { return output_directory_; }

    /// The table `name`.csv in the output directory; made at the first call.
    CsvTable &table(const std::string &name);

    /// A physical effect and whether this run computes it, with the reason where it does not; for summary.json.
    void note_effect(const std::string &effect, bool active, const std::string &reason = "");

    /// A number for summary.json: the last value given to a name stands.
    void set_summary(const std::string &name, double value) { summary_[name] = value; }
    /// Keeps the largest value given to a name.
    void set_summary_max(const std::string &name, double value);

    const std::map<std::string, double> &summary() const { return summary_; }
    const std::vector<std::string>      &effects_active() const { return effects_active_; }
    const std::vector<std::string>      &effects_skipped() const { return effects_skipped_; }

    double cpu_seconds(Phase phase) const { return cpu_seconds_[static_cast<unsigned int>(phase)]; }

    /// Writes and reads the counters, CPU times and numbers for the summary, for a run that is resumed.
    /// @pre no PhaseTimer runs at load()
    void save(std::ostream &stream) const;
    void load(std::istream &stream);

    /// What limits the step at present, for the progress line: "fluid (spectral)".
    std::string step_limited_by;

    unsigned int n_digits = 10; ///< significant digits in the tables that are made from now on

    unsigned long cell_steps = 0; ///< of fluid solvers: cells times steps
    unsigned long steps      = 0; ///< of the domain with the smallest step
    unsigned long n_remeshes = 0;

  private:
    friend class PhaseTimer;

    std::filesystem::path                            output_directory_;
    bool                                             resumed_;
    std::map<std::string, std::unique_ptr<CsvTable>> tables_;
    std::map<std::string, double>                    summary_;
    std::vector<std::string>                         effects_active_;
    std::vector<std::string>                         effects_skipped_;
    double                                           cpu_seconds_[n_phases] = {};
    class PhaseTimer                                *running_               = nullptr;
  };

  /// Adds the CPU time of its scope to a phase. Timers nest: the inner phase's time is not counted in the outer one.
  class PhaseTimer
  {
  public:
    PhaseTimer(RunContext &context, Phase phase);
    ~PhaseTimer();
    PhaseTimer(const PhaseTimer &)            = delete;
    PhaseTimer &operator=(const PhaseTimer &) = delete;

    /// CPU seconds of this timer's scope so far, inner phases left out.
    double seconds() const;

  private:
    RunContext &context_;
    Phase       phase_;
    PhaseTimer *outer_;
    double      start_;
    double      inner_seconds_ = 0;
  };

  /// CPU seconds of this process.
  double cpu_time();
} // namespace Breakwater
