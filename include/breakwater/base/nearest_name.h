#pragma once

#include <string>
#include <vector>

namespace Breakwater
{
  std::string lower_case(std::string text);

  /// The text without white space at its ends.
  std::string trim(const std::string &text);

  /// Least number of letters to insert, delete, replace or swap with their neighbour that turns one text into the
  /// other; upper and lower case do not matter (optimal string alignment).
  unsigned int edit_distance(const std::string &a, const std::string &b);

  /// The known name nearest to `name`; empty if none is similar: more than a third of the letters differ.
  std::string nearest_name(const std::string &name, const std::vector<std::string> &known);

  /// The end of a message about an unknown name: `; did you mean "Tait"? Allowed here: Linear, Tait`.
  std::string suggestion(const std::string &name, const std::vector<std::string> &known);
} // namespace Breakwater
