#include <breakwater/mesh/quality.h>
#include <breakwater/mesh/quality_report.h>

#include <algorithm>
#include <numeric>

namespace Breakwater
{
  namespace
  {
    /// Order statistics of numbers: they are put into bins first, so that each is found among a few.
    class Quantiles
    {
    public:
      /// @param values that must stay until this is gone; at least one
      explicit Quantiles(const std::vector<double> &values)
        : values_(values)
        , bin_(values.size())
        , end_(n_bins, 0)
      {
        const auto [least, largest] = std::minmax_element(values.begin(), values.end());
        const double scale          = *largest > *least ? (n_bins - 1) / (*largest - *least) : 0.;
        for (std::size_t i = 0; i < values.size(); ++i)
          ++end_[bin_[i] = static_cast<unsigned short>((values[i] - *least) * scale)];
        std::partial_sum(end_.begin(), end_.end(), end_.begin());
      }

      double operator()(const double fraction) const
      {
        const auto          rank = static_cast<std::size_t>(fraction * (values_.size() - 1));
        const auto          bin  = std::upper_bound(end_.begin(), end_.end(), rank) - end_.begin();
        std::vector<double> same_bin;
        for (std::size_t i = 0; i < values_.size(); ++i)
          if (bin_[i] == bin)
            same_bin.push_back(values_[i]);
        const auto place = same_bin.begin() + (rank - (bin == 0 ? 0 : end_[bin - 1]));
        std::nth_element(same_bin.begin(), place, same_bin.end());
        return *place;
      }

    private:
      static constexpr unsigned int n_bins = 1024;

      const std::vector<double>  &values_;
      std::vector<unsigned short> bin_; ///< of each value
      std::vector<std::size_t>    end_; ///< number of values up to the end of each bin
    };
  } // namespace


  template <int dim>
  QualityReport quality_report(const std::vector<double> &radii, const double spacing)
  {
    QualityReport report;
    if (radii.empty())
      return report;
    const double    unit = 1. / reference_insphere_radius<dim>(spacing);
    const Quantiles quantile(radii);
    report.median          = quantile(0.5) * unit;
    report.hundredth       = quantile(0.01) * unit;
    report.thousandth      = quantile(0.001) * unit;
    report.smallest_radius = quantile(0.);
    report.smallest        = report.smallest_radius * unit;
    return report;
  }


  template <int dim>
  QualityReport mesh_quality(const SimplexMesh<dim> &mesh, const std::vector<Vec<dim>> &position, const double spacing)
  {
    std::vector<double> radii;
    radii.reserve(mesh.cells.size());
    for (const auto &cell : mesh.cells)
      radii.push_back(insphere_radius(corners(position, cell)));
    return quality_report<dim>(radii, spacing);
  }

  template QualityReport quality_report<2>(const std::vector<double> &, double);
  template QualityReport quality_report<3>(const std::vector<double> &, double);
  template QualityReport mesh_quality<2>(const SimplexMesh<2> &, const std::vector<Vec<2>> &, double);
  template QualityReport mesh_quality<3>(const SimplexMesh<3> &, const std::vector<Vec<3>> &, double);
} // namespace Breakwater
