#pragma once

#include <breakwater/interfaces/body_force.h>

namespace Breakwater
{
  /// The same constant acceleration g everywhere; potential -g . x.
  template <int dim>
  class Gravity : public BodyForce<dim>
  {
  public:
    Gravity() { acceleration_[1] = -9.81; }

    void declare_parameters(ParameterReader &reader) override;

    void   add_acceleration(double time, const std::vector<Vec<dim>> &position,
                            std::vector<Vec<dim>> &acceleration) const override;
    double potential(const Vec<dim> &position) const override { return -dot(acceleration_, position); }
    bool   is_uniform() const override { return true; }

  private:
    Vec<dim> acceleration_; ///< g [m/s^2]
  };
} // namespace Breakwater
