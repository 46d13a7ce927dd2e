#include <breakwater/base/exceptions.h>
#include <breakwater/base/timed_rows.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    /// All numbers of a line; false if there is something else.
    bool read_numbers(std::string line, std::vector<double> &values)
    {
      line.erase(std::min(line.find('#'), line.size()));
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      for (double value; words >> value;)
        values.push_back(value);
      words.clear();
      std::string rest;
      return !(words >> rest) && std::all_of(values.begin(), values.end(), [](const double v) {
        return std::isfinite(v);
      });
    }
  } // namespace


  TimedRows read_timed_rows(const std::string &file, const unsigned int n_least, const unsigned int n_most)
  {
    std::ifstream stream(file);
    if (!stream)
      throw InputError("can't read the file \"" + file + "\"");
    const std::string wanted = std::to_string(n_least) + (n_most > n_least ? " or " + std::to_string(n_most) : "") +
                               (n_most == 1 ? " number" : " numbers");
    TimedRows    table;
    unsigned int number = 0;
    for (std::string line; std::getline(stream, line);)
      {
        const std::string   place = file + ":" + std::to_string(++number) + ": ";
        std::vector<double> values;
        const bool          is_right = read_numbers(line, values);
        if (is_right && values.empty())
          continue;
        const std::size_t n = is_right ? values.size() - 1 : 0;
        if (!is_right || n < n_least || n > n_most || (!table.rows.empty() && n != table.rows.back().size()))
          throw InputError(place + "wanted the time and " + wanted +
                           ", as in all lines, separated by blanks or commas; headings start with #");
        if (!table.times.empty() && !(values.front() > table.times.back()))
          throw InputError(place + "the times must increase, but " + std::to_string(values.front()) + " s follows " +
                           std::to_string(table.times.back()) + " s");
        table.times.push_back(values.front());
        table.rows.emplace_back(values.begin() + 1, values.end());
      }
    if (table.times.size() < 2)
      throw InputError("the table \"" + file + "\" needs two lines or more, it has " +
                       std::to_string(table.times.size()));
    return table;
  }
} // namespace Breakwater
