#include "shaking_table.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/parameter_reader.h>

#include <cmath>

namespace Breakwater
{
  template <int dim>
  void ShakingTable<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Direction", direction_, "Line of the shaking, of any length: only its direction counts [-].");
    reader.add("Amplitude", amplitude_,
               "Largest acceleration A of what stands on the table, as seen from the table [m/s^2]; 0: a table file "
               "gives the acceleration.",
               Range::not_negative());
    reader.add("Frequency", frequency_, "Frequency f of the sine [Hz].", Range::positive());
    reader.add("Ramp time", ramp_time_, "Time T in which the sine grows smoothly from 0 to its amplitude [s].",
               Range::not_negative());
    reader.add("Table file", table_file_,
               "File with two columns, time [s] and acceleration [m/s^2], in place of the sine: linear in between, 0 "
               "outside. Its folder is that of the parameter file.");
  }


  template <int dim>
  void ShakingTable<dim>::check_parameters(ParameterReader &reader)
  {
    const double length = norm(direction_);
    if (!(length > 0))
      reader.fail("Direction", "must not be zero");
    unit_direction_ = (1 / length) * direction_;

    const bool has_table = !table_file_.empty();
    if (has_table && amplitude_ > 0)
      reader.fail("Amplitude", "give either \"Amplitude\" or \"Table file\", not both");
    if (has_table && ramp_time_ > 0)
      reader.fail("Ramp time", "a table file gives the whole acceleration: only the sine has a ramp");
    if (!has_table && !(amplitude_ > 0))
      reader.fail("Amplitude", "the shaking is missing: give \"Amplitude\" [m/s^2] or \"Table file\"");
    table_ = TimeTable();
    if (has_table)
      try
        {
          table_ = TimeTable(reader.file_path(table_file_).string());
        }
      catch (const InputError &error)
        {
          reader.fail("Table file", error.what());
        }
  }


  // a(t) = A r(t) sin(2 pi f t), r(t) = [1 - cos(pi t / T)] / 2 for t < T, else 1
  template <int dim>
  double ShakingTable<dim>::acceleration_at(const double time) const
  {
    if (!table_file_.empty())
      return table_.value(time);
    const double ramp = time < ramp_time_ ? 0.5 * (1 - std::cos(M_PI * time / ramp_time_)) : 1.;
    return amplitude_ * ramp * std::sin(2 * M_PI * frequency_ * time);
  }


  template <int dim>
  void ShakingTable<dim>::add_acceleration(const double           time, const std::vector<Vec<dim>> &,
                                           std::vector<Vec<dim>> &acceleration) const
  {
    const Vec<dim> now = acceleration_at(time) * unit_direction_;
    for (Vec<dim> &a : acceleration)
      a += now;
  }


  template class ShakingTable<2>;
  template class ShakingTable<3>;
} // namespace Breakwater
