#pragma once

#include <cmath>

namespace Breakwater
{
  /// How far a smoother may change the volume of a mesh, all in all.
  class VolumeBudget
  {
  public:
    /// @param largest change, either way [m^dim]
    explicit VolumeBudget(const double largest)
      : largest_(largest)
    {
    }

    /// True if the volume may change by so much more [m^dim].
    /// @param part of the budget that may be spent
    bool allows(const double change, const double part = 1) const
    {
      return std::abs(spent_ + change) <= part * largest_ || std::abs(spent_ + change) < std::abs(spent_);
    }

    void spend(const double change) { spent_ += change; }

  private:
    double largest_;
    double spent_ = 0; ///< signed
  };
} // namespace Breakwater
