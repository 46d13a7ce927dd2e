#pragma once

#include <breakwater/base/expression.h>
#include <breakwater/interfaces/body_force.h>

#include <memory>
#include <string>

namespace Breakwater
{
  /// An acceleration that the parameter file gives as expressions of place and time.
  ///
  /// Its potential is an expression of the place; without one, the force's work is in no energy of the balance.
  /// That the acceleration is minus the gradient of the potential is the user's word.
  template <int dim>
  class ExpressionForce : public BodyForce<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    /// @throws BreakdownError where an expression has no finite value
    void   add_acceleration(double time, const std::vector<Vec<dim>> &position,
                            std::vector<Vec<dim>> &acceleration) const override;
    double potential(const Vec<dim> &position) const override;
    bool   is_uniform() const override { return false; }

  private:
    std::string                      acceleration_text_; ///< [m/s^2]
    std::string                      potential_text_;    ///< [J/kg]
    std::unique_ptr<Expression<dim>> acceleration_;
    std::unique_ptr<Expression<dim>> potential_; ///< none: 0
  };
} // namespace Breakwater
