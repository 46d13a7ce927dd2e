#include "time_table.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace Breakwater
{
  TimeTable::TimeTable(const std::string &file)
  {
    std::ifstream stream(file);
    if (!stream)
      throw InputError("can't read the file \"" + file + "\", looked for from where the program was started");

    unsigned int number = 0;
    for (std::string line; std::getline(stream, line);)
      {
        ++number;
        const std::string place = file + ":" + std::to_string(number) + ": ";
        line.erase(std::min(line.find('#'), line.size()));
        if (line.find_first_not_of(" \t\r") == std::string::npos)
          continue;
        // One comma may stand between the two numbers.
        const std::size_t comma = line.find(',');
        if (comma != std::string::npos)
          line[comma] = ' ';
        std::istringstream words(line);
        double             time = 0, value = 0;
        std::string        rest;
        if (!(words >> time >> value) || words >> rest)
          throw InputError(place + "wanted two numbers, time and value, separated by blanks or a comma; "
                                   "a line of headings must start with #");
        if (!std::isfinite(time) || !std::isfinite(value))
          throw InputError(place + "the numbers must be finite");
        if (!times_.empty() && !(time > times_.back()))
          throw InputError(place + "the times must increase, but " + std::to_string(time) + " s follows " +
                           std::to_string(times_.back()) + " s");
        times_.push_back(time);
        values_.push_back(value);
      }
    if (times_.size() < 2)
      throw InputError("the table \"" + file + "\" needs two lines or more, it has " + std::to_string(times_.size()));
  }


  // f(t) = f_k + (f_(k+1) - f_k) (t - t_k) / (t_(k+1) - t_k)
  double TimeTable::value(const double time) const
  {
    if (times_.empty() || !(time >= times_.front() && time <= times_.back()))
      return 0;
    const std::size_t next = std::upper_bound(times_.begin(), times_.end() - 1, time) - times_.begin();
    const double      part = (time - times_[next - 1]) / (times_[next] - times_[next - 1]);
    return (1 - part) * values_[next - 1] + part * values_[next];
  }
} // namespace Breakwater
