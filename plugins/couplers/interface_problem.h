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
  ///
  /// Nodes of one place only make a diagonal D of H, the nodes k that places share the rest, H = D + W A W^T with A the
  /// diagonal of c / m. Where these are fewer than the places, their equations are solved instead (Woodbury's formula):
  ///   (A^-1 + W^T D^-1 W) y = W^T D^-1 g,   lambda = D^-1 (g - W y).
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
    /// A node of several places.
    struct SharedNode
    {
      unsigned int              domain, node;
      std::vector<unsigned int> neighbours; ///< numbers of the shared nodes at its places, its own too
    };
    /// A shared node at a place.
    struct Share
    {
      unsigned int number; ///< in shared_nodes_
      double       weight;
    };
    /// What is kept of the equations of one direction, c taken relative to the largest one.
    struct Equations
    {
      std::vector<double> own_compliance; ///< [place] D
      std::vector<char>   is_held; ///< of what the equations are: places with all of their nodes, or shared nodes
      std::unique_ptr<SparseSolver> solver; ///< of lambda, or of y
    };
    using Rows = std::vector<SparseSolver::Row>;

    /// c / m of the nodes, in one direction.
    struct Compliance
    {
      const std::vector<const WetSurface<dim> *> &surfaces;
      const std::vector<double>                  &factor;
      int                                         direction;

      double operator()(const unsigned int domain, const unsigned int node) const
      {
        return factor[domain] * surfaces[domain]->inverse_mass[node][direction];
      }
    };

    double    entry(const TiedPlace &a, const TiedPlace &b, const Compliance &compliance) const;
    double    own_compliance(unsigned int place, const Compliance &compliance) const;
    void      update(const std::vector<const WetSurface<dim> *> &surfaces, const std::vector<double> &factor);
    Equations equations(const Compliance &compliance) const;
    Rows      rows_of_places(const Compliance &compliance) const;
    Rows      rows_of_shared_nodes(const std::vector<double> &own_compliance, const Compliance &compliance) const;
    std::vector<double> solve_for_places(const Equations &equations, std::vector<double> g);
    std::vector<double> solve_for_shared_nodes(const Equations &equations, std::vector<double> g);

    std::vector<TiedPlace>                 places_;
    std::vector<std::vector<unsigned int>> neighbours_; ///< places that share a node, itself too; empty if diagonal
    std::vector<SharedNode>                shared_nodes_;
    std::vector<std::vector<Share>>        shares_; ///< [place]
    unsigned int                           direct_up_to_ = 0;

    // What the equations were made from, each domain's factor over the largest one.
    std::vector<double>       relative_factor_;
    std::vector<unsigned int> revision_;
    std::vector<Equations>    equations_;            ///< one for all directions if their masses are the same
    bool                      is_condensed_ = false; ///< they are those of the shared nodes
    unsigned int              n_iterations_ = 0;
  };
} // namespace Breakwater
