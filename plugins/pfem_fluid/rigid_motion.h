#pragma once

#include <breakwater/base/expression.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/timed_rows.h>
#include <breakwater/base/vec.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Where a rigid body is: x = place + R (x0 - center), of a point that was at x0 before the motion.
  template <int dim>
  struct Pose
  {
    Vec<dim>                  center, place; ///< of the rotation, before and now [m]
    std::array<Vec<dim>, dim> rotation;      ///< rows of R

    Pose();
    Vec<dim> rotated(const Vec<dim> &direction) const;      ///< R n
    Vec<dim> rotated_back(const Vec<dim> &direction) const; ///< R^T n
    Vec<dim> to_world(const Vec<dim> &x0) const { return place + rotated(x0 - center); }
    Vec<dim> to_body(const Vec<dim> &x) const { return center + rotated_back(x - place); }
  };

  /// Columns of numbers at increasing times, read from a file; between them a cubic whose slope is continuous, before
  /// the first and after the last time constant.
  class MotionTable
  {
  public:
    MotionTable() = default;
    /// As read_timed_rows(). @throws InputError
    MotionTable(const std::string &file, unsigned int n_least, unsigned int n_most);

    bool   empty() const { return table_.times.empty(); }
    double value(double time, unsigned int column) const; ///< 0 where the file has no such column

  private:
    double slope(std::size_t row, unsigned int column) const;

    TimedRows table_;
  };

  /// The motion of a wall as a law of time: a translation [m] and a rotation [rad], by expressions or by a table.
  template <int dim>
  class RigidMotion
  {
  public:
    void declare_parameters(ParameterReader &reader);
    /// @throws InputError
    void check_parameters(ParameterReader &reader);

    bool is_static() const { return !translation_ && !rotation_ && table_.empty(); }

    /// @param time [s]; before 0 nothing has moved yet
    Pose<dim> pose(double time) const;

  private:
    std::unique_ptr<Expression<dim>> parse(const ParameterReader &reader, const std::string &entry,
                                           const std::string &text, unsigned int n_components) const;

    std::string                      translation_text_, rotation_text_, table_file_;
    Vec<dim>                         center_;
    Vec<3>                           axis_{{0, 0, 1}}; ///< unit length after check_parameters()
    std::unique_ptr<Expression<dim>> translation_, rotation_;
    MotionTable                      table_;
  };
} // namespace Breakwater
