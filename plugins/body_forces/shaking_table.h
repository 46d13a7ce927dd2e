#pragma once

#include <breakwater/interfaces/body_force.h>

#include <string>

#include "time_table.h"

namespace Breakwater
{
  /// A table that shakes along one line, seen from the table: all that stands on it feels the acceleration a(t) e,
  /// which is opposite to the table's own acceleration.
  ///
  /// Sinusoidal, a(t) = A r(t) sin(2 pi f t) with r(t) = [1 - cos(pi t / T)] / 2 until the ramp time T, then 1; or
  /// from a file, linear between its times and 0 outside of them. No potential: the force changes with time.
  template <int dim>
  class ShakingTable : public BodyForce<dim>
  {
  public:
    ShakingTable() { direction_[0] = 1; }

    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    void   add_acceleration(double time, const std::vector<Vec<dim>> &position,
                            std::vector<Vec<dim>> &acceleration) const override;
    double potential(const Vec<dim> &) const override { return 0; }
    bool   is_uniform() const override { return false; }

  private:
    double acceleration_at(double time) const; ///< a(t) [m/s^2]

    Vec<dim>    direction_;     ///< as given
    double      amplitude_ = 0; ///< A [m/s^2]
    double      frequency_ = 1; ///< f [Hz]
    double      ramp_time_ = 0; ///< T [s]
    std::string table_file_;
    Vec<dim>    unit_direction_; ///< e
    TimeTable   table_;
  };
} // namespace Breakwater
