#include <breakwater/base/exceptions.h>
#include <breakwater/base/expression.h>
#include <breakwater/base/nearest_name.h>

#include <deal.II/base/function_parser.h>

#include <iostream>
#include <sstream>
#include <vector>

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

    /// The parts between commas outside of parentheses, trimmed.
    std::vector<std::string> components_of(const std::string &text)
    {
      std::vector<std::string> parts(1);
      int                      depth = 0;
      for (const char c : text)
        {
          depth += (c == '(') - (c == ')');
          if (c == ',' && depth == 0)
            parts.emplace_back();
          else
            parts.back() += c;
        }
      for (std::string &part : parts)
        part = trim(part);
      return parts;
    }
  } // namespace


  template <int dim>
  class Expression<dim>::Parser
  {
  public:
    Parser(const std::vector<std::string> &expressions, const bool knows_time)
      : function_(expressions.size())
      , knows_time_(knows_time)
    {
      const std::string names = std::string(dim == 2 ? "x,y" : "x,y,z") + (knows_time ? ",t" : "");
      function_.initialize(names, expressions, {{"pi", 3.14159265358979323846}}, knows_time);
    }

    double value(const Vec<dim> &position, const double time, const unsigned int component)
    {
      dealii::Point<dim> point;
      for (int d = 0; d < dim; ++d)
        point[d] = position[d];
      if (knows_time_)
        function_.set_time(time);
      return function_.value(point, component);
    }

  private:
    dealii::FunctionParser<dim> function_;
    bool                        knows_time_;
  };


  template <int dim>
  Expression<dim>::Expression(const std::string &text, const unsigned int n_components, const Variables variables)
  {
    const bool                     knows_time  = variables == Variables::place_and_time;
    const std::vector<std::string> expressions = components_of(text);
    if (expressions.size() != n_components)
      throw InputError(std::to_string(expressions.size()) + " expressions where " + std::to_string(n_components) +
                       (n_components == 1 ? " is" : " are") + " needed, separated by commas");

    // Each one alone, so that the message names it: an expression is compiled when it is first evaluated.
    for (const std::string &expression : expressions)
      {
        if (expression.find("rand") != std::string::npos)
          throw InputError("\"" + expression + "\" must not use random numbers: each run would differ");
        try
          {
            const SilentErrorStream silence;
            Parser({expression}, knows_time).value(Vec<dim>(), 0, 0);
          }
        catch (const dealii::ExceptionBase &error)
          {
            std::ostringstream reason;
            error.print_info(reason);
            throw InputError("\"" + expression + "\" is no expression in " + (dim == 2 ? "x, y" : "x, y, z") +
                             (knows_time ? ", t" : "") + " and pi: " + trim(reason.str()));
          }
      }
    parser_ = std::make_unique<Parser>(expressions, knows_time);
  }


  template <int dim>
  Expression<dim>::~Expression() = default;


  template <int dim>
  double Expression<dim>::value(const Vec<dim> &position, const double time, const unsigned int component) const
  {
    return parser_->value(position, time, component);
  }


  template class Expression<2>;
  template class Expression<3>;
} // namespace Breakwater
