#include <breakwater/simulation/progress.h>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace Breakwater
{
  namespace
  {
    std::string duration_text(const double seconds)
    {
      char text[40];
      if (seconds < 100)
        std::snprintf(text, sizeof(text), "%.0f s", seconds);
      else if (seconds < 6000)
        std::snprintf(text, sizeof(text), "%.0f min", seconds / 60);
      else
        std::snprintf(text, sizeof(text), "%.1f h", seconds / 3600);
      return text;
    }
  } // namespace

  Progress::Progress(const double start_time, const double end_time, const unsigned long start_cell_steps)
    : start_time_(start_time)
    , end_time_(end_time)
    , last_cell_steps_(start_cell_steps)
    , is_terminal_(isatty(STDERR_FILENO) != 0)
    , start_(Clock::now())
    , last_(start_)
  {
  }

  Progress::~Progress()
  {
    if (line_is_open_)
      std::fputc('\n', stderr);
  }

  double Progress::wall_seconds() const
  {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  void Progress::update(const double time, const double time_step, const RunContext &context)
  {
    const Clock::time_point now      = Clock::now();
    const double            interval = std::chrono::duration<double>(now - last_).count();
    const bool              is_last  = time >= end_time_;
    if (interval < (is_terminal_ ? 0.2 : 5.) && !is_last)
      return;

    std::string line;
    char        text[160];
    std::snprintf(text, sizeof(text), "t = %.5f s of %g s | step %.2e s", time, end_time_, time_step);
    line += text;
    if (!context.step_limited_by.empty())
      line += " by " + context.step_limited_by;
    if (context.cell_steps > 0 && interval > 0)
      {
        std::snprintf(text, sizeof(text), " | %.1f M cell-steps/s",
                      1e-6 * static_cast<double>(context.cell_steps - last_cell_steps_) / interval);
        line += text;
      }
    const double done = (time - start_time_) / std::max(end_time_ - start_time_, 1e-300);
    if (is_last)
      line += " | done in " + duration_text(wall_seconds());
    else if (done > 0)
      line += " | " + duration_text(wall_seconds() * (1 - done) / done) + " left";

    if (is_terminal_)
      std::fprintf(stderr, "\r\033[K%s", line.c_str());
    else
      std::fprintf(stderr, "%s\n", line.c_str());
    std::fflush(stderr);
    line_is_open_    = is_terminal_;
    last_            = now;
    last_cell_steps_ = context.cell_steps;
  }
} // namespace Breakwater
