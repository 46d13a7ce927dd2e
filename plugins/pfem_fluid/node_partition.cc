#include "node_partition.h"

#include <algorithm>
#include <numeric>

namespace Breakwater
{
  namespace
  {
    using Iterator = std::vector<unsigned int>::iterator;

    template <int dim>
    int longest_extent(const std::vector<Vec<dim>> &position, const Iterator begin, const Iterator end)
    {
      Vec<dim> lower = position[*begin], upper = lower;
      for (auto i = begin; i != end; ++i)
        for (int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], position[*i][d]);
            upper[d] = std::max(upper[d], position[*i][d]);
          }
      const Vec<dim> extent  = upper - lower;
      int            longest = 0;
      for (int d = 1; d < dim; ++d)
        if (extent[d] > extent[longest])
          longest = d;
      return longest;
    }

    /// Gives the nodes [begin, end) to the ranks [first, first + n_ranks).
    template <int dim>
    void bisect(const std::vector<Vec<dim>> &position, const Iterator begin, const Iterator end,
                const unsigned int first, const unsigned int n_ranks, std::vector<unsigned int> &owner)
    {
      if (begin == end)
        return;
      if (n_ranks == 1)
        {
          for (auto i = begin; i != end; ++i)
            owner[*i] = first;
          return;
        }
      const unsigned int n_left = n_ranks / 2;
      const auto         middle = begin + (end - begin) * n_left / n_ranks;
      const int          d      = longest_extent(position, begin, end);
      std::nth_element(begin, middle, end, [&](const unsigned int a, const unsigned int b) {
        return position[a][d] < position[b][d] || (position[a][d] == position[b][d] && a < b);
      });
      bisect(position, begin, middle, first, n_left, owner);
      bisect(position, middle, end, first + n_left, n_ranks - n_left, owner);
    }
  } // namespace


  template <int dim>
  std::vector<unsigned int> owners_by_bisection(const std::vector<Vec<dim>> &position, const unsigned int n_ranks)
  {
    std::vector<unsigned int> numbers(position.size()), owner(position.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    bisect(position, numbers.begin(), numbers.end(), 0, n_ranks, owner);
    return owner;
  }


  template <int dim>
  std::vector<RankPart<dim>> partition(const std::vector<typename SimplexMesh<dim>::Cell> &cells,
                                       const std::vector<unsigned int> &owner, const unsigned int n_ranks)
  {
    std::vector<RankPart<dim>> parts(n_ranks);
    std::vector<unsigned int>  local(owner.size()); // of its owner first, then of the part at hand
    for (unsigned int i = 0; i < owner.size(); ++i)
      {
        RankPart<dim> &part = parts[owner[i]];
        local[i]            = part.n_owned++;
        part.nodes.push_back(i);
      }
    const std::vector<unsigned int> local_at_owner = local;

    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        RankPart<dim>            &part = parts[rank];
        std::vector<unsigned int> ghosts;
        for (const auto &cell : cells)
          if (std::any_of(cell.begin(), cell.end(), [&](const unsigned int i) {
                return owner[i] == rank;
              }))
            {
              part.cells.push_back(cell);
              for (const unsigned int i : cell)
                if (owner[i] != rank)
                  ghosts.push_back(i);
            }
        std::sort(ghosts.begin(), ghosts.end(), [&](const unsigned int a, const unsigned int b) {
          return owner[a] < owner[b] || (owner[a] == owner[b] && a < b);
        });
        ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());

        for (std::size_t i = 0; i < part.n_owned; ++i)
          local[part.nodes[i]] = i;
        for (const unsigned int i : ghosts)
          {
            if (part.neighbors.empty() || part.neighbors.back().rank != owner[i])
              part.neighbors.push_back({owner[i], {}, {}});
            local[i] = part.nodes.size();
            part.neighbors.back().received.push_back(local[i]);
            part.nodes.push_back(i);
          }
        for (auto &cell : part.cells)
          for (unsigned int &i : cell)
            i = local[i];
      }

    // A rank that receives from another one also sends to it: they share cells.
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      for (auto &neighbor : parts[rank].neighbors)
        for (const auto &back : parts[neighbor.rank].neighbors)
          if (back.rank == rank)
            for (const unsigned int i : back.received)
              neighbor.sent.push_back(local_at_owner[parts[neighbor.rank].nodes[i]]);
    return parts;
  }

  template std::vector<unsigned int> owners_by_bisection<2>(const std::vector<Vec<2>> &, unsigned int);
  template std::vector<unsigned int> owners_by_bisection<3>(const std::vector<Vec<3>> &, unsigned int);
  template std::vector<RankPart<2>>  partition<2>(const std::vector<SimplexMesh<2>::Cell> &,
                                                 const std::vector<unsigned int> &, unsigned int);
  template std::vector<RankPart<3>>  partition<3>(const std::vector<SimplexMesh<3>::Cell> &,
                                                 const std::vector<unsigned int> &, unsigned int);
} // namespace Breakwater
