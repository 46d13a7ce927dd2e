#include "interface_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace Breakwater
{
  template <int dim>
  InterfaceProblem<dim>::InterfaceProblem(std::vector<TiedPlace> places, const unsigned int direct_up_to)
    : places_(std::move(places))
    , direct_up_to_(direct_up_to)
  {
    std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>> places_of_node;
    bool                                                                       is_shared = false;
    for (unsigned int r = 0; r < places_.size(); ++r)
      for (const TiedPlace::Entry &entry : places_[r].entries)
        {
          std::vector<unsigned int> &places_here = places_of_node[{entry.domain, entry.node}];
          places_here.push_back(r);
          is_shared = is_shared || places_here.size() > 1;
        }
    if (!is_shared)
      return;
    neighbours_.resize(places_.size());
    for (const auto &[node, places_here] : places_of_node)
      for (const unsigned int r : places_here)
        neighbours_[r].insert(neighbours_[r].end(), places_here.begin(), places_here.end());
    for (std::vector<unsigned int> &neighbours : neighbours_)
      {
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
      }
  }


  template <int dim>
  double InterfaceProblem<dim>::entry(const TiedPlace &a, const TiedPlace &b, const int direction,
                                      const std::vector<const WetSurface<dim> *> &surfaces,
                                      const std::vector<double>                  &factor) const
  {
    double sum = 0;
    for (const TiedPlace::Entry &left : a.entries)
      for (const TiedPlace::Entry &right : b.entries)
        if (left.domain == right.domain && left.node == right.node)
          sum += left.weight * right.weight * factor[left.domain] *
                 surfaces[left.domain]->inverse_mass[left.node][direction];
    return sum;
  }


  // Divided by the largest factor: as long as the ratio of the steps stays, so does H.
  template <int dim>
  void InterfaceProblem<dim>::update_matrices(const std::vector<const WetSurface<dim> *> &surfaces,
                                              const std::vector<double>                  &factor)
  {
    std::vector<unsigned int> revision;
    bool                      is_same = revision_.size() == surfaces.size(), directions_differ = false;
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      {
        revision.push_back(surfaces[k]->revision);
        is_same = is_same && revision[k] == revision_[k] && factor[k] == relative_factor_[k];
      }
    if (is_same)
      return;
    revision_        = revision;
    relative_factor_ = factor;
    for (const TiedPlace &place : places_)
      for (const TiedPlace::Entry &e : place.entries)
        {
          const Vec<dim> &inverse_mass = surfaces[e.domain]->inverse_mass[e.node];
          for (int d = 1; d < dim; ++d)
            directions_differ = directions_differ || inverse_mass[d] != inverse_mass[0];
        }
    solvers_.clear();
    for (int d = 0; d < (directions_differ ? dim : 1); ++d)
      {
        std::vector<SparseSolver::Row> rows(places_.size());
        for (std::size_t r = 0; r < places_.size(); ++r)
          {
            for (const unsigned int s : neighbours_[r])
              rows[r].push_back({s, entry(places_[r], places_[s], d, surfaces, factor)});
            const auto diagonal = std::find_if(rows[r].begin(), rows[r].end(), [r](const SparseSolver::Entry &e) {
              return e.column == r;
            });
            if (diagonal->value == 0) // all is held: lambda = 0
              diagonal->value = 1;
          }
        solvers_.push_back(std::make_unique<SparseSolver>(rows, places_.size() <= direct_up_to_));
      }
  }


  template <int dim>
  typename InterfaceProblem<dim>::Vectors InterfaceProblem<dim>::solve(
    const std::vector<const WetSurface<dim> *> &surfaces, const std::vector<double> &factor, const Vectors &g)
  {
    Vectors lambda(places_.size());
    if (is_diagonal())
      {
        for (std::size_t r = 0; r < places_.size(); ++r)
          for (int d = 0; d < dim; ++d)
            {
              const double h = entry(places_[r], places_[r], d, surfaces, factor);
              lambda[r][d]   = h > 0 ? g[r][d] / h : 0.;
            }
        return lambda;
      }

    const double        largest = *std::max_element(factor.begin(), factor.end());
    std::vector<double> relative(factor), right_side(places_.size()), solution(places_.size());
    for (double &c : relative)
      {
        // To 44 bits: round-off in the steps must not change H, neither now nor after a restart.
        int exponent = 0;
        c            = std::frexp(c / largest, &exponent);
        c            = std::ldexp(std::round(std::ldexp(c, 44)), exponent - 44);
      }
    update_matrices(surfaces, relative);
    for (int d = 0; d < dim; ++d)
      {
        for (std::size_t r = 0; r < places_.size(); ++r)
          {
            const bool is_held = entry(places_[r], places_[r], d, surfaces, factor) == 0;
            right_side[r]      = is_held ? 0. : g[r][d] / largest;
            solution[r]        = 0;
          }
        n_iterations_ += solvers_[solvers_.size() == 1 ? 0 : d]->solve(right_side, solution);
        for (std::size_t r = 0; r < places_.size(); ++r)
          lambda[r][d] = solution[r];
      }
    return lambda;
  }


  template class InterfaceProblem<2>;
  template class InterfaceProblem<3>;
} // namespace Breakwater
