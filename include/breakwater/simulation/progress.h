#pragma once

#include <breakwater/base/run_context.h>

#include <chrono>
#include <string>

namespace Breakwater
{
  /// The live line on stderr: simulated time, step, what limits it, cell-steps/s and the time left. On a terminal
  /// the line is rewritten; elsewhere a line is added every few seconds.
  class Progress
  {
  public:
    /// @param start_time simulated time at which this process starts [s], not 0 in a resumed run
    Progress(double start_time, double end_time, unsigned long start_cell_steps);
    ~Progress();

    /// Shows the line if it is due.
    void update(double time, double time_step, const RunContext &context);

    /// Seconds since construction.
    double wall_seconds() const;

  private:
    using Clock = std::chrono::steady_clock;

    const double      start_time_;
    const double      end_time_;
    unsigned long     last_cell_steps_;
    bool              is_terminal_;
    Clock::time_point start_;
    Clock::time_point last_;
    bool              line_is_open_ = false;
  };
} // namespace Breakwater
