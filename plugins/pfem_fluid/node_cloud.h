#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace Breakwater
{
  /// A growing set of places that tells whether a place is far enough from all of them. The places are sorted into
  /// grids, one for each power of two between the smallest and the largest distance that is asked for.
  template <int dim>
  class NodeCloud
  {
  public:
    /// @param smallest, largest distances that is_free() will be asked about [m]
    NodeCloud(const double smallest, const double largest)
      : smallest_(smallest)
      , grids_(static_cast<std::size_t>(std::ceil(std::log2(largest / smallest) - 1e-9)) + 1)
    {
    }

    void add(const Vec<dim> &x)
    {
      for (std::size_t level = 0; level < grids_.size(); ++level)
        grids_[level][key(cell(x, level))].push_back(places_.size());
      places_.push_back(x);
    }

    /// True if no place of the cloud is closer to x than this distance [m].
    bool is_free(const Vec<dim> &x, const double distance) const
    {
      std::size_t level = 0;
      while (level + 1 < grids_.size() && std::ldexp(smallest_, level) < distance)
        ++level;
      const auto                  center = cell(x, level);
      std::array<std::int64_t, 3> place  = center;
      for (place[2] = center[2] - (dim == 3); place[2] <= center[2] + (dim == 3); ++place[2])
        for (place[1] = center[1] - 1; place[1] <= center[1] + 1; ++place[1])
          for (place[0] = center[0] - 1; place[0] <= center[0] + 1; ++place[0])
            {
              const auto found = grids_[level].find(key(place));
              if (found != grids_[level].end())
                for (const std::size_t i : found->second)
                  if (norm(places_[i] - x) < distance)
                    return false;
            }
      return true;
    }

    const std::vector<Vec<dim>> &places() const { return places_; }

  private:
    std::array<std::int64_t, 3> cell(const Vec<dim> &x, const std::size_t level) const
    {
      std::array<std::int64_t, 3> result{};
      for (int d = 0; d < dim; ++d)
        result[d] = static_cast<std::int64_t>(std::floor(x[d] / std::ldexp(smallest_, level)));
      return result;
    }

    /// 21 bits for each coordinate.
    static std::uint64_t key(const std::array<std::int64_t, 3> &cell)
    {
      std::uint64_t result = 0;
      for (const std::int64_t c : cell)
        result = result << 21 | (static_cast<std::uint64_t>(c) & 0x1fffff);
      return result;
    }

    double                                                                   smallest_;
    std::vector<std::unordered_map<std::uint64_t, std::vector<std::size_t>>> grids_; ///< cells of smallest 2^level
    std::vector<Vec<dim>>                                                    places_;
  };
} // namespace Breakwater
