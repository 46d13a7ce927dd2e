#include "rigid_motion.h"

#include <breakwater/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace Breakwater
{
  template <int dim>
  Pose<dim>::Pose()
  {
    for (int d = 0; d < dim; ++d)
      rotation[d][d] = 1;
  }


  template <int dim>
  Vec<dim> Pose<dim>::rotated(const Vec<dim> &direction) const
  {
    Vec<dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = dot(rotation[d], direction);
    return result;
  }


  template <int dim>
  Vec<dim> Pose<dim>::rotated_back(const Vec<dim> &direction) const
  {
    Vec<dim> result;
    for (int d = 0; d < dim; ++d)
      result += rotation[d] * direction[d];
    return result;
  }


  MotionTable::MotionTable(const std::string &file, const unsigned int n_least, const unsigned int n_most)
    : table_(read_timed_rows(file, n_least, n_most))
  {
  }


  // Slope of the parabola through a point and its neighbours; 0 at both ends, where the motion rests.
  double MotionTable::slope(const std::size_t k, const unsigned int c) const
  {
    const auto &[times, rows] = table_;
    if (k == 0 || k + 1 == times.size())
      return 0;
    const double before = times[k] - times[k - 1], after = times[k + 1] - times[k];
    const double slope_before = (rows[k][c] - rows[k - 1][c]) / before;
    const double slope_after  = (rows[k + 1][c] - rows[k][c]) / after;
    return (after * slope_before + before * slope_after) / (before + after);
  }


  // Cubic Hermite interpolation
  double MotionTable::value(const double time, const unsigned int c) const
  {
    const auto &[times, rows] = table_;
    if (rows.empty() || c >= rows.front().size())
      return 0;
    if (time <= times.front())
      return rows.front()[c];
    if (time >= times.back())
      return rows.back()[c];
    const std::size_t k      = std::upper_bound(times.begin(), times.end(), time) - times.begin() - 1;
    const double      length = times[k + 1] - times[k], s = (time - times[k]) / length;
    return rows[k][c] + (rows[k + 1][c] - rows[k][c]) * s * s * (3 - 2 * s) +
           length * s * (1 - s) * ((1 - s) * slope(k, c) - s * slope(k + 1, c));
  }


  template <int dim>
  void RigidMotion<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add(
      "Translation", translation_text_,
      "How the wall moves, as expressions of the time t: `x(t); y(t); z(t)` [m], two of them in 2D. Empty: not.");
    reader.add("Rotation", rotation_text_, "Angle by which the wall is turned, an expression of t [rad]. Empty: none.");
    reader.add("Center", center_, "Center of the rotation, which moves with the translation [m].");
    if (dim == 3)
      reader.add("Axis", axis_, "Axis of the rotation, of any length.");
    reader.add("Motion table", table_file_,
               "File with lines `t, x, y, z` or `t, x, y, z, angle` [s, m, rad] (no z in 2D), in place of the "
               "expressions; smooth in between, at rest before and after. Its folder is that of the parameter file.");
  }


  template <int dim>
  std::unique_ptr<Expression<dim>> RigidMotion<dim>::parse(const ParameterReader &reader, const std::string &entry,
                                                           const std::string &text, const unsigned int n) const
  {
    std::string with_commas = text;
    std::replace(with_commas.begin(), with_commas.end(), ';', ',');
    if (std::regex_search(text, std::regex("\\b[xyz]\\b")))
      reader.fail(entry, "a rigid motion depends on the time t only, not on a place");
    std::unique_ptr<Expression<dim>> result;
    try
      {
        result = std::make_unique<Expression<dim>>(with_commas, n, Expression<dim>::Variables::place_and_time);
      }
    catch (const InputError &error)
      {
        reader.fail(entry, error.what());
      }
    for (unsigned int k = 0; k < n; ++k)
      if (!std::isfinite(result->value(Vec<dim>(), 0., k)))
        reader.fail(entry, "it is not finite at t = 0");
    return result;
  }


  template <int dim>
  void RigidMotion<dim>::check_parameters(ParameterReader &reader)
  {
    translation_ = translation_text_.empty() ? nullptr : parse(reader, "Translation", translation_text_, dim);
    rotation_    = rotation_text_.empty() ? nullptr : parse(reader, "Rotation", rotation_text_, 1);
    if (!(norm(axis_) > 0))
      reader.fail("Axis", "must not be zero");
    axis_ *= 1 / norm(axis_);
    table_ = MotionTable();
    if (table_file_.empty())
      return;
    if (translation_ || rotation_)
      reader.fail("Motion table", "give either a table or \"Translation\" and \"Rotation\", not both");
    try
      {
        table_ = MotionTable(reader.file_path(table_file_).string(), dim, dim + 1);
      }
    catch (const InputError &error)
      {
        reader.fail("Motion table", error.what());
      }
  }


  template <int dim>
  Pose<dim> RigidMotion<dim>::pose(const double given_time) const
  {
    const double time = std::max(0., given_time);
    Pose<dim>    result;
    result.center = result.place = center_;
    for (int d = 0; d < dim; ++d)
      result.place[d] += translation_ ? translation_->value(Vec<dim>(), time, d) : table_.value(time, d);

    const double angle = rotation_ ? rotation_->value(Vec<dim>(), time) : table_.value(time, dim);
    const double c = std::cos(angle), s = std::sin(angle);
    if constexpr (dim == 2)
      result.rotation = {{{{c, -s}}, {{s, c}}}};
    else // Rodrigues' formula
      for (int i = 0; i < 3; ++i)
        {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          result.rotation[i][i] = c + (1 - c) * axis_[i] * axis_[i];
          result.rotation[i][j] = (1 - c) * axis_[i] * axis_[j] - s * axis_[k];
          result.rotation[i][k] = (1 - c) * axis_[i] * axis_[k] + s * axis_[j];
        }
    return result;
  }

  template struct Pose<2>;
  template struct Pose<3>;
  template class RigidMotion<2>;
  template class RigidMotion<3>;
} // namespace Breakwater
