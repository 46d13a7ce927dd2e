#pragma once

#include "fluid_nodes.h"

#include <breakwater/mesh/simplex_mesh.h>
#include <breakwater/mesh/wet_surface.h>

#include <vector>

namespace Breakwater
{
  /// The surfaces of other bodies that the fluid has taken for its own: the first nodes of the fluid, and the facets
  /// between them. It decides which Delaunay cells may be fluid next to it and puts leaked nodes back.
  template <int dim>
  class AdoptedSurface
  {
  public:
    using Cell = typename SimplexMesh<dim>::Cell;

    AdoptedSurface() = default;
    explicit AdoptedSurface(const WetSurface<dim> &body) { append(body); }

    /// Adds the surface of one more body. @return the number of its first node
    unsigned int append(const WetSurface<dim> &body);

    bool        empty() const { return surface_.facets.empty(); }
    std::size_t n_nodes() const { return surface_.position.size(); }

    /// The nodes as the coupler sees them.
    WetSurface<dim>       &surface() { return surface_; }
    const WetSurface<dim> &surface() const { return surface_; }

    /// Normals from the current positions. Call before accepts() and push_out().
    void update_normals();

    /// False for a cell that reaches through the body: every node of the cell must lie in front of one of the facets
    /// around each interface node of the cell.
    bool accepts(const Cell &cell, const FluidNodes<dim> &nodes) const;

    /// True if a facet of the surfaces has all these nodes.
    bool has_facet_of(const std::array<unsigned int, dim> &nodes) const;

    /// Puts fluid nodes that have come inside the body, or closer to it than `clearance` [m], to that distance, and
    /// takes the normal velocity into it of those that were inside. That momentum is added to `impulse` [kg m/s] at
    /// the interface nodes.
    /// @param largest_depth inside the body up to which a node is found [m]
    /// @return how many nodes were inside
    unsigned int push_out(FluidNodes<dim> &nodes, double largest_depth, double clearance,
                          std::vector<Vec<dim>> &impulse) const;

    /// Signed distance [m] of a place to the surface, negative inside the body, as long as it is at most
    /// `largest_distance`, which is returned where the surface is farther.
    double signed_distance(const Vec<dim> &x, double largest_distance) const;

  private:
    /// The place of the surface nearest to x.
    struct Foot
    {
      double       distance = 0; ///< signed [m]
      Vec<dim>     place, normal;
      unsigned int nodes[dim]   = {};
      double       weights[dim] = {};
    };
    bool nearest(const Vec<dim> &x, double largest_distance, Foot &foot) const;

    WetSurface<dim>           surface_;
    std::vector<unsigned int> end_of_body_; ///< number of the node behind the last one of each body
    /// Facets cut into simplices: segments in 2D, two triangles per quadrilateral in 3D.
    std::vector<std::array<unsigned int, dim>> pieces_;
    std::vector<Vec<dim>>                      normals_; ///< of the pieces, out of the body, unit length
    std::vector<Vec<dim>>                      centers_;
    std::vector<double>                        radii_;
    std::vector<std::vector<unsigned int>>     pieces_of_node_;
  };
} // namespace Breakwater
