#include "expression_force.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_reader.h>

#include <cmath>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    template <int dim>
    [[noreturn]] void throw_not_finite(const std::string &entry, const std::string &text, const Vec<dim> &place,
                                       const std::string &when)
    {
      std::ostringstream message;
      message << "The " << entry << " of the body force \"Expression\", \"" << text << "\", has no finite value at (";
      for (int d = 0; d < dim; ++d)
        message << (d == 0 ? "" : ", ") << place[d];
      message << ") m" << when << ".";
      throw BreakdownError(message.str());
    }
  } // namespace


  template <int dim>
  void ExpressionForce<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Acceleration", acceleration_text_,
               "Acceleration [m/s^2], one expression per dimension in x, y, z [m], t [s] and pi (syntax of muParser), "
               "separated by commas.");
    reader.add("Potential", potential_text_,
               "Potential energy of a unit mass [J/kg], an expression in x, y, z [m] and pi of which the acceleration "
               "is minus the gradient; empty: the force counts in no energy.");
  }


  template <int dim>
  void ExpressionForce<dim>::check_parameters(ParameterReader &reader)
  {
    using Variables = typename Expression<dim>::Variables;
    if (acceleration_text_.empty())
      reader.fail("Acceleration",
                  "the force is missing: give " + std::to_string(dim) + " expressions [m/s^2], separated by commas");
    const auto parse = [&](const char *entry, const std::string &text, const unsigned int n, const Variables variables,
                           std::unique_ptr<Expression<dim>> &expression) {
      try
        {
          expression = std::make_unique<Expression<dim>>(text, n, variables);
        }
      catch (const InputError &error)
        {
          reader.fail(entry, error.what());
        }
    };
    parse("Acceleration", acceleration_text_, dim, Variables::place_and_time, acceleration_);
    potential_.reset();
    if (!potential_text_.empty())
      parse("Potential", potential_text_, 1, Variables::place, potential_);
  }


  template <int dim>
  void ExpressionForce<dim>::add_acceleration(const double time, const std::vector<Vec<dim>> &position,
                                              std::vector<Vec<dim>> &acceleration) const
  {
    for (std::size_t i = 0; i < position.size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double value = acceleration_->value(position[i], time, d);
          if (!std::isfinite(value))
            throw_not_finite("acceleration", acceleration_text_, position[i],
                             " and " + std::to_string(time) + " s, component " + std::to_string(d + 1));
          acceleration[i][d] += value;
        }
  }


  template <int dim>
  double ExpressionForce<dim>::potential(const Vec<dim> &position) const
  {
    if (!potential_)
      return 0;
    const double value = potential_->value(position, 0);
    if (!std::isfinite(value))
      throw_not_finite("potential", potential_text_, position, "");
    return value;
  }


  template class ExpressionForce<2>;
  template class ExpressionForce<3>;
} // namespace Breakwater
