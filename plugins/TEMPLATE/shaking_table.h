#pragma once

#include <breakwater/interfaces/body_force.h>

namespace Breakwater
{
  /// A table that shakes along one line, seen from the table: everything on it feels the acceleration A sin(2 pi f t).
  template <int dim>
  class ShakingTable : public BodyForce<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;

    void add_acceleration(double time, const std::vector<Vec<dim>> &position,
                          std::vector<Vec<dim>> &acceleration) const override;

    /// None: the force changes with time.
    double potential(const Vec<dim> &) const override { return 0; }

    /// The same everywhere, but not always.
    bool is_uniform() const override { return false; }

  private:
    Vec<dim> amplitude_; ///< A [m/s^2]
    double   frequency_ = 1; ///< f [1/s]
  };
} // namespace Breakwater
