#pragma once

#include <breakwater/base/exceptions.h>
#include <breakwater/base/vec.h>

#include <algorithm>
#include <string>
#include <vector>

namespace Breakwater
{
  /// One shape as a parameter file writes it, `word(inside)`.
  struct ShapeText
  {
    std::string word, inside;

    /// Reads the shape that starts at `cursor` and moves the cursor behind it and the blanks that follow.
    /// @throws InputError if there is none
    static ShapeText next(const std::string &text, std::size_t &cursor);

    [[noreturn]] void fail(const std::string &message) const
    {
      throw InputError("in " + word + "(" + inside + "): " + message);
    }

    /// What stands between the brackets: numbers, separated by commas or semicolons.
    std::vector<double> numbers() const;

    /// A fixed number of them. @param form what is expected, for the message
    std::vector<double> numbers(std::size_t n, const std::string &form) const;
  };

  /// dim of the numbers as a place.
  template <int dim>
  Vec<dim> vec(const std::vector<double> &numbers, const std::size_t first)
  {
    Vec<dim> result;
    std::copy_n(numbers.begin() + first, dim, result.c);
    return result;
  }

  /// Complains about a word that is none of the known ones. @throws InputError
  [[noreturn]] void fail_unknown_word(const std::string &word, const std::vector<std::string> &known, int dim);
} // namespace Breakwater
