#pragma once

#include <deque>
#include <iosfwd>
#include <utility>

namespace Breakwater
{
  /// The largest rise of an energy within any window of time of a given length: largest E(t2) - E(t1) with
  /// t1 < t2 <= t1 + window, from samples. A stable scheme dissipates; a rise tells of energy that was made.
  class EnergyRise
  {
  public:
    /// @param window [s]
    explicit EnergyRise(const double window)
      : window_(window)
    {
    }

    /// A sample [J] at a time [s] not before the last one.
    void add(double time, double energy);

    /// [J], 0 before two samples
    double largest() const { return largest_; }

    void save(std::ostream &stream) const;
    void load(std::istream &stream);

  private:
    double                                window_;
    double                                largest_ = 0;
    std::deque<std::pair<double, double>> lows_; ///< (time, energy) in the window, energies ascending
  };
} // namespace Breakwater
