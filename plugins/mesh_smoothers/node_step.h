#pragma once

#include "star_mesh.h"
#include "volume_budget.h"

#include <vector>

namespace Breakwater
{
  /// Moves one node so that the smallest r of the cells around it grows.
  ///
  /// A proximal bundle step (Lemarechal; Freitag, Jones and Plassmann 1999 for the use on meshes): with r_i and the
  /// gradients g_i of the cells of the star in the node's place, the step d maximizes min_i (r_i + g_i . d) -
  /// |d|^2 / (2 D). Its dual, min over l >= 0, sum l_i = 1, of sum l_i r_i + D/2 |sum l_i g_i|^2, is solved by the
  /// Frank-Wolfe algorithm with exact line search; d = D sum l_i g_i. D grows where the model is good and shrinks where
  /// it is not. Nodes that slide go along the projected gradients, orthogonally to their area vector, and turn no facet
  /// of the boundary over. lift() lets go of that.
  template <int dim>
  class NodeStep
  {
  public:
    explicit NodeStep(StarMesh<dim> &mesh);

    /// Moves the node until the smallest r of its star is `wanted` or no step helps. @return whether it moved
    bool improve(unsigned int node, double wanted) { return improve(node, wanted, nullptr); }

    /// The same for a node of the free surface, off it as well, within what the budget has left.
    bool lift(unsigned int node, double wanted, VolumeBudget &budget)
    {
      return mesh_.is_at_surface(node) && improve(node, wanted, &budget);
    }

    /// How often lift() has moved a node, and the volume that this has added [m^dim].
    unsigned int n_lifts() const { return n_lifts_; }
    double       lifted_volume() const { return lifted_volume_; }

  private:
    bool improve(unsigned int node, double wanted, VolumeBudget *budget);
    /// True if a facet of the boundary is turned over with the node at x: against the area vector or, when lifted,
    /// against what it was.
    bool turns_facet(unsigned int node, const Vec<dim> &x, const typename StarMesh<dim>::Constraint &constraint,
                     bool is_lifted) const;

    /// r of the cells of the star with the node at x. @return false as soon as one is not larger than `least`
    bool evaluate(unsigned int node, const Vec<dim> &x, double least);
    void update_gradients(unsigned int node, const typename StarMesh<dim>::Constraint &constraint);
    /// The step for a proximal parameter, at most a quarter of the spacing. @return what the model says it gains
    double model_step(double proximal, double smallest, Vec<dim> &step) const;

    StarMesh<dim>                                &mesh_;
    std::vector<double>                           r_, new_r_;
    std::vector<Vec<dim>>                         gradient_; ///< of r by the node's place in units of the spacing [-]
    std::vector<typename SimplexMesh<dim>::Facet> facets_;
    std::vector<Vec<dim>>                         normals_; ///< of these facets before the moves
    unsigned int                                  n_lifts_       = 0;
    double                                        lifted_volume_ = 0;
  };
} // namespace Breakwater
