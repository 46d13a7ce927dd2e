#include "node_pairs.h"

#include "kernels.h"

#include <algorithm>

namespace Breakwater
{
  /// The corners of cells at each node: corner a of cell c as c (dim + 1) + a, those of node i from start[i] on.
  template <int dim>
  struct NodePairs<dim>::Corners
  {
    static constexpr unsigned int n_ahead = 32; // entries beyond the last, where passes look ahead
    std::vector<unsigned int>     start, corner;

    Corners(const std::vector<Cell> &cells, const std::size_t n_nodes)
      : start(n_nodes + 1, 0)
      , corner(cells.size() * (dim + 1) + n_ahead, 0)
    {
      for (const auto &cell : cells)
        for (const unsigned int i : cell)
          ++start[i + 1];
      for (std::size_t i = 0; i < n_nodes; ++i)
        start[i + 1] += start[i];
      std::vector<unsigned int> next(start.begin(), start.end() - 1);
      for (unsigned int c = 0; c < cells.size(); ++c)
        for (unsigned int a = 0; a <= dim; ++a)
          corner[next[cells[c][a]]++] = c * (dim + 1) + a;
    }
  };


  template <int dim>
  NodePairs<dim>::NodePairs(const FluidNodes<dim> &nodes, const std::vector<Cell> &cells)
    : start_(1, 0)
    , lower_start_(1, 0)
    , conductance_sum_(nodes.n, 0.)
  {
    if (cells.empty())
      {
        start_.resize(nodes.n + 1, 0);
        lower_start_.resize(nodes.n + 1, 0);
        return;
      }
    const Corners             corners(cells, nodes.n);
    std::vector<unsigned int> place_of(nodes.n, 0); // among all pairs, counted from 1
    std::vector<char>         exchanges(nodes.n);
    for (std::size_t i = 0; i < nodes.n; ++i)
      exchanges[i] = nodes.exchanges_mass(i);
    constexpr unsigned int n_expected = dim == 2 ? 8 : 16; // nodes around a node
    constexpr double       share      = 1. / (dim + 1);
    neighbor_.reserve(n_expected * nodes.n);
    length_.reserve(n_expected * nodes.n);
    lower_neighbor_.reserve(n_expected / 2 * nodes.n);
    conductance_.reserve(n_expected / 2 * nodes.n);

    std::vector<unsigned int> around; // nodes around that at work
    std::vector<Quad>         sum;    // see ElementPasses::pairs_around
    for (unsigned int k = 0; k < nodes.n; ++k)
      {
        const unsigned int first = neighbor_.size(), begin = corners.start[k], n_corners = corners.start[k + 1] - begin;
        if (around.size() < dim * n_corners)
          {
            around.resize(dim * n_corners);
            sum.resize(dim * n_corners);
          }
        Quad               own;
        const unsigned int n_around = element_passes<dim>().pairs_around(
          cells.front().data(), corners.corner.data() + begin, n_corners, nodes.xp.data(), exchanges.data(), first,
          place_of.data(), around.data(), sum.data(), &own);
        if (n_around > 0)
          {
            neighbor_.push_back(k);
            length_.push_back(norm(FluidNodes<dim>::vec(own)) * share);
          }
        for (unsigned int j = 0; j < n_around; ++j)
          {
            const unsigned int i = around[j];
            neighbor_.push_back(i);
            length_.push_back(norm(FluidNodes<dim>::vec(sum[j])) * share);
            if (i < k && exchanges[k] && exchanges[i])
              {
                lower_neighbor_.push_back(i);
                conductance_.push_back(sum[j][3]);
                conductance_sum_[i] += sum[j][3];
                conductance_sum_[k] += sum[j][3];
              }
          }
        start_.push_back(neighbor_.size());
        lower_start_.push_back(lower_neighbor_.size());
      }
  }


  template <int dim>
  std::vector<double> NodePairs<dim>::row_sums(const std::vector<double> &mass) const
  {
    std::vector<double> sums(mass.size(), 0.);
    for (std::size_t k = 0; k < mass.size(); ++k)
      {
        if (!(mass[k] > 0))
          continue;
        double column_sum = 0;
        for (unsigned int j = start_[k]; j < start_[k + 1]; ++j)
          column_sum += length_[j];
        for (unsigned int j = start_[k]; j < start_[k + 1]; ++j)
          sums[neighbor_[j]] += length_[j] * column_sum / mass[k];
      }
    return sums;
  }


  template <int dim>
  double NodePairs<dim>::exchange(const std::vector<double> &diagonal, const std::vector<double> &psi,
                                  std::vector<double> &image) const
  {
    // From the last node to the first: what higher nodes give to a node has come when its turn comes.
    double product = 0;
    std::fill(image.begin(), image.end(), 0.);
    for (std::size_t i = psi.size(); i-- > 0;)
      {
        const double own = psi[i];
        double       sum = image[i] + diagonal[i] * own;
        for (unsigned int j = lower_start_[i]; j < lower_start_[i + 1]; ++j)
          {
            const unsigned int k = lower_neighbor_[j];
            sum -= conductance_[j] * psi[k];
            image[k] -= conductance_[j] * own;
          }
        image[i] = sum;
        product += own * sum;
      }
    return product;
  }

  template class NodePairs<2>;
  template class NodePairs<3>;
} // namespace Breakwater
