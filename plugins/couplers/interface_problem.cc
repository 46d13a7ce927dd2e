#include "interface_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace Breakwater
{
  namespace
  {
    void sort_and_make_unique(std::vector<unsigned int> &numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }
  } // namespace


  template <int dim>
  InterfaceProblem<dim>::InterfaceProblem(std::vector<TiedPlace> places, const unsigned int direct_up_to)
    : places_(std::move(places))
    , direct_up_to_(direct_up_to)
  {
    std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>> places_of_node;
    for (unsigned int r = 0; r < places_.size(); ++r)
      for (const TiedPlace::Entry &entry : places_[r].entries)
        places_of_node[{entry.domain, entry.node}].push_back(r);
    shares_.resize(places_.size());
    for (const auto &[node, places_here] : places_of_node)
      if (places_here.size() > 1)
        {
          for (const unsigned int r : places_here)
            for (const TiedPlace::Entry &entry : places_[r].entries)
              if (entry.domain == node.first && entry.node == node.second)
                shares_[r].push_back({static_cast<unsigned int>(shared_nodes_.size()), entry.weight});
          shared_nodes_.push_back({node.first, node.second, {}});
        }
    if (shared_nodes_.empty())
      return;
    neighbours_.resize(places_.size());
    for (const auto &[node, places_here] : places_of_node)
      for (const unsigned int r : places_here)
        neighbours_[r].insert(neighbours_[r].end(), places_here.begin(), places_here.end());
    for (const std::vector<Share> &shares : shares_)
      for (const Share &a : shares)
        for (const Share &b : shares)
          shared_nodes_[a.number].neighbours.push_back(b.number);
    for (std::vector<unsigned int> &neighbours : neighbours_)
      sort_and_make_unique(neighbours);
    for (SharedNode &shared : shared_nodes_)
      sort_and_make_unique(shared.neighbours);
  }


  template <int dim>
  double InterfaceProblem<dim>::entry(const TiedPlace &a, const TiedPlace &b, const Compliance &compliance) const
  {
    double sum = 0;
    for (const TiedPlace::Entry &left : a.entries)
      for (const TiedPlace::Entry &right : b.entries)
        if (left.domain == right.domain && left.node == right.node)
          sum += left.weight * right.weight * compliance(left.domain, left.node);
    return sum;
  }


  // Divided by the largest factor: as long as the ratio of the steps stays, so do the equations.
  template <int dim>
  void InterfaceProblem<dim>::update(const std::vector<const WetSurface<dim> *> &surfaces,
                                     const std::vector<double>                  &factor)
  {
    std::vector<unsigned int> revision;
    for (const WetSurface<dim> *surface : surfaces)
      revision.push_back(surface->revision);
    if (revision == revision_ && factor == relative_factor_)
      return;
    revision_              = revision;
    relative_factor_       = factor;
    bool directions_differ = false;
    for (const TiedPlace &place : places_)
      for (const TiedPlace::Entry &e : place.entries)
        {
          const Vec<dim> &inverse_mass = surfaces[e.domain]->inverse_mass[e.node];
          for (int d = 1; d < dim; ++d)
            directions_differ = directions_differ || inverse_mass[d] != inverse_mass[0];
        }
    // Every place needs a node of its own that is not held.
    is_condensed_ = shared_nodes_.size() < places_.size();
    for (std::size_t r = 0; r < places_.size() && is_condensed_; ++r)
      for (int d = 0; d < dim; ++d)
        is_condensed_ = is_condensed_ && own_compliance(r, {surfaces, factor, d}) > 0;
    equations_.clear();
    for (int d = 0; d < (directions_differ ? dim : 1); ++d)
      equations_.push_back(equations({surfaces, factor, d}));
  }


  template <int dim>
  double InterfaceProblem<dim>::own_compliance(const unsigned int place, const Compliance &compliance) const
  {
    double sum = 0;
    for (const TiedPlace::Entry &e : places_[place].entries)
      if (std::none_of(shares_[place].begin(), shares_[place].end(), [&](const Share &share) {
            return shared_nodes_[share.number].domain == e.domain && shared_nodes_[share.number].node == e.node;
          }))
        sum += e.weight * e.weight * compliance(e.domain, e.node);
    return sum;
  }


  template <int dim>
  typename InterfaceProblem<dim>::Equations InterfaceProblem<dim>::equations(const Compliance &compliance) const
  {
    Equations result;
    for (unsigned int r = 0; r < places_.size(); ++r)
      {
        result.own_compliance.push_back(own_compliance(r, compliance));
        if (!is_condensed_)
          result.is_held.push_back(entry(places_[r], places_[r], compliance) == 0);
      }
    if (is_condensed_)
      for (const SharedNode &node : shared_nodes_)
        result.is_held.push_back(compliance(node.domain, node.node) == 0);
    const Rows rows =
      is_condensed_ ? rows_of_shared_nodes(result.own_compliance, compliance) : rows_of_places(compliance);
    result.solver = std::make_unique<SparseSolver>(rows, rows.size() <= direct_up_to_);
    return result;
  }


  // H
  template <int dim>
  typename InterfaceProblem<dim>::Rows InterfaceProblem<dim>::rows_of_places(const Compliance &compliance) const
  {
    Rows rows(places_.size());
    for (std::size_t r = 0; r < places_.size(); ++r)
      for (const unsigned int s : neighbours_[r])
        {
          const double value = entry(places_[r], places_[s], compliance);
          rows[r].push_back({s, s == r && value == 0 ? 1. : value}); // all is held: lambda = 0
        }
    return rows;
  }


  // A^-1 + W^T D^-1 W. A held node has y = 0.
  template <int dim>
  typename InterfaceProblem<dim>::Rows InterfaceProblem<dim>::rows_of_shared_nodes(
    const std::vector<double> &own_compliance, const Compliance &compliance) const
  {
    Rows                rows(shared_nodes_.size());
    std::vector<double> c;
    for (const SharedNode &node : shared_nodes_)
      c.push_back(compliance(node.domain, node.node));
    for (unsigned int k = 0; k < rows.size(); ++k)
      for (const unsigned int l : shared_nodes_[k].neighbours)
        rows[k].push_back({l, k != l ? 0. : c[k] > 0 ? 1 / c[k] : 1.});
    for (std::size_t r = 0; r < places_.size(); ++r)
      for (const Share &a : shares_[r])
        for (const Share &b : shares_[r])
          if (c[a.number] > 0 && c[b.number] > 0)
            {
              SparseSolver::Row &row = rows[a.number];
              std::lower_bound(row.begin(), row.end(), b.number,
                               [](const SparseSolver::Entry &e, const unsigned int l) {
                                 return e.column < l;
                               })
                ->value += a.weight * b.weight / own_compliance[r];
            }
    return rows;
  }


  template <int dim>
  std::vector<double> InterfaceProblem<dim>::solve_for_places(const Equations &equations, std::vector<double> g)
  {
    for (std::size_t r = 0; r < g.size(); ++r)
      if (equations.is_held[r])
        g[r] = 0;
    std::vector<double> lambda(g.size());
    n_iterations_ += equations.solver->solve(g, lambda);
    return lambda;
  }


  template <int dim>
  std::vector<double> InterfaceProblem<dim>::solve_for_shared_nodes(const Equations &equations, std::vector<double> g)
  {
    std::vector<double> right_side(shared_nodes_.size()), y(shared_nodes_.size());
    for (std::size_t r = 0; r < g.size(); ++r)
      for (const Share &share : shares_[r])
        if (!equations.is_held[share.number])
          right_side[share.number] += share.weight * g[r] / equations.own_compliance[r];
    n_iterations_ += equations.solver->solve(right_side, y);
    for (std::size_t r = 0; r < g.size(); ++r)
      {
        for (const Share &share : shares_[r])
          g[r] -= share.weight * y[share.number];
        g[r] /= equations.own_compliance[r];
      }
    return g;
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
              const double h = entry(places_[r], places_[r], {surfaces, factor, d});
              lambda[r][d]   = h > 0 ? g[r][d] / h : 0.;
            }
        return lambda;
      }

    const double        largest = *std::max_element(factor.begin(), factor.end());
    std::vector<double> relative(factor), right_side(places_.size());
    for (double &c : relative)
      {
        // To 44 bits: round-off in the steps must not change the equations, neither now nor after a restart.
        int exponent = 0;
        c            = std::frexp(c / largest, &exponent);
        c            = std::ldexp(std::round(std::ldexp(c, 44)), exponent - 44);
      }
    update(surfaces, relative);
    for (int d = 0; d < dim; ++d)
      {
        for (std::size_t r = 0; r < places_.size(); ++r)
          right_side[r] = g[r][d] / largest;
        const Equations          &equations = equations_[equations_.size() == 1 ? 0 : d];
        const std::vector<double> solution =
          is_condensed_ ? solve_for_shared_nodes(equations, right_side) : solve_for_places(equations, right_side);
        for (std::size_t r = 0; r < places_.size(); ++r)
          lambda[r][d] = solution[r];
      }
    return lambda;
  }


  template class InterfaceProblem<2>;
  template class InterfaceProblem<3>;
} // namespace Breakwater
