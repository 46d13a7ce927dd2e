#pragma once

#include <breakwater/mesh/wet_surface.h>

#include <array>
#include <vector>

namespace Breakwater
{
  /// Nodes on the facets of an owner's surface, which move with it: x = sum of weight times x of the owner's nodes. The
  /// weights of a node sum up to one, so that forces keep their sum, and their moment too. Some are negative on elements
  /// of degree 2.
  template <int dim>
  struct ResampledSurface
  {
    struct Weight
    {
      unsigned int node; ///< of the owner
      double       weight;
    };

    WetSurface<dim>                  surface; ///< masses are left to share_mass(), accelerations are the owner's
    std::vector<std::vector<Weight>> weights; ///< [node]
  };

  /// The owner's nodes themselves.
  template <int dim>
  ResampledSurface<dim> copy_of_surface(const WetSurface<dim> &owner);

  /// Nodes of another spacing [m], finer or coarser. The surface falls into patches at edges where its normal turns by
  /// more than 30 degrees, and where one body ends; these edges stay. Each patch is a grid of facets and becomes a grid of about that spacing,
  /// even in the numbers of the owner's facets. On elements of degree 2 (`is_middle`) nodes lie on the curved surface.
  /// @throws InputError if a patch is not a grid
  template <int dim>
  ResampledSurface<dim> resample_surface(const WetSurface<dim> &owner, double spacing);

  /// Shares the owner's mass [kg]: `carried` is what each node carries of it, `lent` what each of the owner's nodes
  /// gives, with lent_k = sum over i of weight_ik carried_i, so that momentum is the same. A node of the owner gives at
  /// most `share` of its mass, and exactly that where the nodes are copies. On elements of degree 2 it may get a little
  /// instead; what is carried is always positive.
  template <int dim>
  void share_mass(const WetSurface<dim> &owner, const ResampledSurface<dim> &resampled, double share,
                  std::vector<double> &carried, std::vector<double> &lent);

  /// How much of an owner's mass may move apart from the rest of it [-]: a bound of the largest eigenvalue of
  /// M^-1 (L - W^T mu W), M the owner's masses before it lends, L the lent ones, mu those carried and W the weights.
  /// L - W^T mu W is what is lent and does not move along with a motion of the owner's nodes: 0 for copies, L for a motion
  /// that the nodes do not see. At most the largest L / M, as W^T mu W is positive; at most the largest row sum (Gershgorin).
  template <int dim>
  double part_that_moves_apart(const WetSurface<dim> &owner, const ResampledSurface<dim> &resampled,
                               const std::vector<double> &carried, const std::vector<double> &lent);

  /// Length of the diagonal of the box around places [m].
  template <int dim>
  double extent(const std::vector<Vec<dim>> &position);
} // namespace Breakwater
