#pragma once

#include "sparse_solver.h"

#include <breakwater/mesh/wet_surface.h>

#include <memory>
#include <vector>

namespace Breakwater
{
  /// A place where domains are tied: the sum over the entries of weight times velocity is zero in each direction.
  struct TiedPlace
  {
    struct Entry
    {
      unsigned int domain, node; ///< node of that domain's wet surface
      double       weight;
    };
    std::vector<Entry> entries;
    unsigned int       tie; ///< to which the place belongs
  };

  /// The equations of the multipliers at all tied places, one per place and direction:
  ///   H lambda = g,   H_rs = sum over the domains' nodes of w_r w_s c / m,
  /// w the weights, m the node's mass, c a number of its domain such as half its time step. Where no two places share
  /// a node H is diagonal and nothing is solved; otherwise it is kept until its entries change.
  template <int dim>
  class InterfaceProblem
  {
  public:
    using Vectors = std::vector<Vec<dim>>;

    InterfaceProblem() = default;

    /// @param direct_up_to size up to which the equations are solved directly, beyond it by conjugate gradients
    explicit InterfaceProblem(std::vector<TiedPlace> places, unsigned int direct_up_to);

    const std::vector<TiedPlace> &places() const { return places_; }
    bool                          is_diagonal() const { return neighbours_.empty(); }

    /// lambda; zero in directions in which all nodes of a place are held.
    /// @param surfaces one per domain; @param factor c of each domain; @param g one vector per place
    Vectors solve(const std::vector<const WetSurface<dim> *> &surfaces, const std::vector<double> &factor,
                  const Vectors &g);

    unsigned int n_iterations() const { return n_iterations_; } ///< of the solver since the last call of reset
    void         reset_iterations() { n_iterations_ = 0; }

  private:
    double entry(const TiedPlace &a, const TiedPlace &b, int direction,
                 const std::vector<const WetSurface<dim> *> &surfaces, const std::vector<double> &factor) const;
    void   update_matrices(const std::vector<const WetSurface<dim> *> &surfaces, const std::vector<double> &factor);

    std::vector<TiedPlace>                 places_;
    std::vector<std::vector<unsigned int>> neighbours_; ///< places that share a node, itself too; empty if diagonal
    unsigned int                           direct_up_to_ = 0;

    // What the matrices were made from, each domain's factor over the largest one.
    std::vector<double>                        relative_factor_;
    std::vector<unsigned int>                  revision_;
    std::vector<std::unique_ptr<SparseSolver>> solvers_; ///< one for all directions if their masses are the same
    unsigned int                               n_iterations_ = 0;
  };
} // namespace Breakwater
