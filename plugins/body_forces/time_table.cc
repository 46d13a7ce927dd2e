#include "time_table.h"

#include <algorithm>

namespace Breakwater
{
  TimeTable::TimeTable(const std::string &file)
    : table_(read_timed_rows(file, 1, 1))
  {
  }


  // f(t) = f_k + (f_(k+1) - f_k) (t - t_k) / (t_(k+1) - t_k)
  double TimeTable::value(const double time) const
  {
    const std::vector<double> &times = table_.times;
    if (times.empty() || !(time >= times.front() && time <= times.back()))
      return 0;
    const std::size_t next = std::upper_bound(times.begin(), times.end() - 1, time) - times.begin();
    const double      part = (time - times[next - 1]) / (times[next] - times[next - 1]);
    return (1 - part) * table_.rows[next - 1][0] + part * table_.rows[next][0];
  }
} // namespace Breakwater
