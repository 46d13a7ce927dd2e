#include <breakwater/mesh/common_nodes.h>

#include <algorithm>
#include <numeric>

namespace Breakwater
{
  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>> common_nodes(const std::vector<Vec<dim>> &a,
                                                                  const std::vector<Vec<dim>> &b,
                                                                  const double                 tolerance)
  {
    std::vector<unsigned int> by_x(b.size());
    std::iota(by_x.begin(), by_x.end(), 0u);
    std::sort(by_x.begin(), by_x.end(), [&b](const unsigned int i, const unsigned int j) {
      return b[i][0] < b[j][0];
    });
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    for (unsigned int i = 0; i < a.size(); ++i)
      {
        auto candidate =
          std::lower_bound(by_x.begin(), by_x.end(), a[i][0] - tolerance, [&b](const unsigned int j, const double x) {
            return b[j][0] < x;
          });
        for (; candidate != by_x.end() && b[*candidate][0] <= a[i][0] + tolerance; ++candidate)
          if (norm(a[i] - b[*candidate]) <= tolerance)
            pairs.emplace_back(i, *candidate);
      }
    return pairs;
  }

  template std::vector<std::pair<unsigned int, unsigned int>> common_nodes<2>(const std::vector<Vec<2>> &,
                                                                              const std::vector<Vec<2>> &, double);
  template std::vector<std::pair<unsigned int, unsigned int>> common_nodes<3>(const std::vector<Vec<3>> &,
                                                                              const std::vector<Vec<3>> &, double);
} // namespace Breakwater
