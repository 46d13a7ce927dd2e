#pragma once

#include <breakwater/base/vec.h>

#include <memory>
#include <string>

namespace Breakwater
{
  /// Functions of place and time that a parameter file gives as text in the syntax of muParser, such as
  /// `9.81*sin(0.1*t), if(x < 0.5, -9.81, 0)`.
  ///
  /// Known names are x, y, z [m] (x, y in 2D), t [s] where time is allowed, pi, and muParser's operators and
  /// functions, except for random numbers: the same input must give the same bits.
  template <int dim>
  class Expression
  {
  public:
    enum class Variables
    {
      place,
      place_and_time
    };

    /// @param text n_components expressions, separated by commas outside of parentheses
    /// @throws InputError if their number differs, or one of them can't be evaluated
    Expression(const std::string &text, unsigned int n_components, Variables variables);
    ~Expression();
    Expression(const Expression &)            = delete;
    Expression &operator=(const Expression &) = delete;

    /// One component at a place [m] and time [s]; not finite where the expression is not, such as 1/x at 0.
    /// Not to be called from two threads at once.
    double value(const Vec<dim> &position, double time, unsigned int component = 0) const;

  private:
    class Parser; ///< hides deal.II
    std::unique_ptr<Parser> parser_;
  };
} // namespace Breakwater
