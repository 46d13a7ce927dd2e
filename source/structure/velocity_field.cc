#include "velocity_field.h"

#include <breakwater/base/exceptions.h>

#include <deal.II/base/function_parser.h>

#include <cmath>
#include <iostream>

namespace Breakwater
{
  namespace
  {
    /// deal.II prints what muParser says on std::cerr before it throws; the exception is enough.
    class SilentErrorStream
    {
    public:
      SilentErrorStream()
        : buffer_(std::cerr.rdbuf(nullptr))
      {
      }
      ~SilentErrorStream()
      {
        std::cerr.rdbuf(buffer_);
        std::cerr.clear();
      }
      SilentErrorStream(const SilentErrorStream &)            = delete;
      SilentErrorStream &operator=(const SilentErrorStream &) = delete;

    private:
      std::streambuf *buffer_;
    };
  } // namespace


  template <int dim>
  std::vector<Vec<dim>> evaluate_expressions(const std::vector<std::string> &expressions,
                                             const std::vector<Vec<dim>>    &position)
  {
    if (expressions.size() != dim)
      throw InputError(std::to_string(expressions.size()) + " expressions where " + std::to_string(dim) +
                       " are needed, one for each component");
    std::vector<Vec<dim>> values(position.size());
    for (int component = 0; component < dim; ++component)
      try
        {
          const SilentErrorStream     silence;
          dealii::FunctionParser<dim> parser;
          parser.initialize(dim == 2 ? "x,y" : "x,y,z", expressions[component], {{"pi", 3.14159265358979323846}});
          for (std::size_t i = 0; i < position.size(); ++i)
            {
              dealii::Point<dim> point;
              for (int d = 0; d < dim; ++d)
                point[d] = position[i][d];
              values[i][component] = parser.value(point);
              if (!std::isfinite(values[i][component]))
                throw InputError("\"" + expressions[component] + "\" has no finite value at every node");
            }
        }
      catch (const dealii::ExceptionBase &)
        {
          throw InputError("\"" + expressions[component] + "\" is no expression in " + (dim == 2 ? "x, y" : "x, y, z") +
                           " and pi");
        }
    return values;
  }

  template std::vector<Vec<2>> evaluate_expressions(const std::vector<std::string> &, const std::vector<Vec<2>> &);
  template std::vector<Vec<3>> evaluate_expressions(const std::vector<std::string> &, const std::vector<Vec<3>> &);
} // namespace Breakwater
