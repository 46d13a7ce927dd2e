#include "shape_text.h"

#include <breakwater/base/nearest_name.h>

#include <cmath>
#include <cstdlib>

namespace Breakwater
{
  ShapeText ShapeText::next(const std::string &text, std::size_t &cursor)
  {
    const std::size_t open = text.find('(', cursor), close = text.find(')', cursor);
    if (open == std::string::npos || close == std::string::npos || close < open)
      throw InputError(std::string("a shape is missing") +
                       (cursor == 0 ? "" : " behind \"" + trim(text.substr(0, cursor)) + "\""));
    const ShapeText shape = {trim(text.substr(cursor, open - cursor)), trim(text.substr(open + 1, close - open - 1))};
    cursor                = text.find_first_not_of(' ', close + 1);
    return shape;
  }


  std::vector<double> ShapeText::numbers() const
  {
    std::vector<double> result;
    const char         *cursor = inside.c_str();
    while (*cursor != '\0')
      {
        char *end = nullptr;
        result.push_back(std::strtod(cursor, &end));
        if (end == cursor || !std::isfinite(result.back()))
          fail("\"" + std::string(cursor) + "\" is no number");
        cursor = end;
        while (*cursor == ' ' || *cursor == ',' || *cursor == ';')
          ++cursor;
      }
    return result;
  }


  std::vector<double> ShapeText::numbers(const std::size_t n, const std::string &form) const
  {
    const std::vector<double> result = numbers();
    if (result.size() != n)
      fail(std::to_string(result.size()) + " numbers are given; expected " + word + form);
    return result;
  }


  void fail_unknown_word(const std::string &word, const std::vector<std::string> &known, const int dim)
  {
    std::string message = "there is no shape \"" + word + "\" in " + std::to_string(dim) + "D", possible;
    if (const std::string nearest = nearest_name(word, known); !nearest.empty())
      message += "; did you mean \"" + nearest + "\"?";
    for (const std::string &name : known)
      possible += (possible.empty() ? "" : ", ") + name;
    throw InputError(message + "; possible are " + possible);
  }
} // namespace Breakwater
