#pragma once

#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/vec.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace Breakwater
{
  /// A box with its sides along the axes, as a parameter file writes it: `kind(x, y, z; X, Y, Z)`.
  template <int dim>
  struct BoxShape
  {
    std::string kind;         ///< the word before the bracket
    Vec<dim>    lower, upper; ///< corners [m]

    bool contains(const Vec<dim> &x) const
    {
      for (int d = 0; d < dim; ++d)
        if (x[d] < lower[d] || x[d] > upper[d])
          return false;
      return true;
    }
  };

  /// Reads a box from the text of an entry; what is wrong with it is reported through ParameterReader::fail().
  /// @param kinds words that may stand before the bracket
  template <int dim>
  BoxShape<dim> parse_box(const std::string &text, const ParameterReader &reader, const std::string &entry,
                          const std::vector<std::string> &kinds)
  {
    const std::string coordinates = dim == 2 ? "(x, y; X, Y)" : "(x, y, z; X, Y, Z)";
    std::string       allowed;
    for (const std::string &kind : kinds)
      allowed += (allowed.empty() ? "" : " or ") + kind + coordinates;
    const auto wrong = [&](const std::string &what) {
      reader.fail(entry, what + "; expected " + allowed);
    };

    const std::size_t open = text.find('('), close = text.rfind(')');
    if (open == std::string::npos || close == std::string::npos || close < open)
      wrong("no shape is given");

    BoxShape<dim> shape;
    for (const std::string &kind : kinds)
      if (text.substr(0, open) == kind || text.substr(0, open) == kind + " ")
        shape.kind = kind;
    if (shape.kind.empty())
      wrong("unknown shape '" + text.substr(0, open) + "'");

    std::vector<double> numbers;
    const std::string   inside = text.substr(open + 1, close - open - 1);
    const char         *cursor = inside.c_str();
    while (*cursor != '\0')
      {
        char *end = nullptr;
        numbers.push_back(std::strtod(cursor, &end));
        if (end == cursor)
          wrong("'" + inside + "' is not a list of numbers");
        cursor = end;
        while (*cursor == ' ' || *cursor == ',' || *cursor == ';')
          ++cursor;
      }
    if (numbers.size() != 2 * dim)
      wrong(std::to_string(numbers.size()) + " numbers are given");
    for (int d = 0; d < dim; ++d)
      {
        shape.lower[d] = numbers[d];
        shape.upper[d] = numbers[dim + d];
        if (!(shape.lower[d] < shape.upper[d]))
          wrong("the second corner must be larger than the first in every coordinate");
      }
    return shape;
  }
} // namespace Breakwater
