#pragma once

#include <breakwater/base/vec.h>

#include <array>
#include <string>
#include <vector>

namespace Breakwater
{
  /// On which side of a surface the fluid may be.
  enum class FluidSide
  {
    inside,
    outside,
    both
  };

  /// A surface of flat pieces (segments in 2D, triangles in 3D) at rest: the shape of a wall, in its own frame.
  ///
  /// Pieces that meet at less than 30 degrees form one *patch*: a face that a node may rest on and slide along. With
  /// fluid on one side the surface must be closed, and the normals point into the fluid.
  template <int dim>
  class WallSurface
  {
  public:
    using Piece = std::array<Vec<dim>, dim>; ///< corners [m]

    struct Foot
    {
      double       distance = 0; ///< not negative [m]
      Vec<dim>     place;        ///< of the surface, nearest to what was asked
      Vec<dim>     normal;       ///< of the piece there
      unsigned int patch = 0;
    };

    /// A piece that a path goes through.
    struct Crossing
    {
      Vec<dim>     place, normal; ///< normal towards where the path came from
      unsigned int patch = 0;
    };

    /// @throws InputError if there is no piece, or fluid on one side of a surface that is not closed
    WallSurface(const std::vector<Piece> &pieces, FluidSide side);

    const std::vector<Piece> &pieces() const { return pieces_; }
    FluidSide                 side() const { return side_; }
    unsigned int              n_patches() const { return is_flat_.size(); }
    bool                      is_flat(const unsigned int patch) const { return is_flat_[patch]; }

    /// Of a flat patch, towards x if there is fluid on both sides.
    Vec<dim> flat_normal(const unsigned int patch, const Vec<dim> &x) const
    {
      const Vec<dim> &normal = normal_[first_piece_[patch]];
      const bool      behind = side_ == FluidSide::both && dot(normal, x - pieces_[first_piece_[patch]][0]) < 0;
      return behind ? -1. * normal : normal;
    }

    /// The corners of a box around the surface [m].
    std::vector<Vec<dim>> bounding_box() const;

    /// Places on the edges between patches (corners in 2D), their ends included, at most a distance apart [m].
    std::vector<Vec<dim>> places_on_edges(double distance) const;

    /// Places on a patch, evenly on each of its pieces, at most a distance apart along their edges [m].
    std::vector<Vec<dim>> places_on_patch(unsigned int patch, double distance) const;

    /// The place nearest to x of one patch, or of all for patch = n_patches(). @return false if beyond `reach` [m]
    bool nearest(const Vec<dim> &x, double reach, unsigned int patch, Foot &foot) const;

    /// Patches within a distance [m] of x, in increasing order.
    std::vector<unsigned int> patches_near(const Vec<dim> &x, double reach) const;

    /// The first piece on the path from a to b. Surfaces with fluid on one side stop only what leaves the fluid.
    bool first_crossing(const Vec<dim> &a, const Vec<dim> &b, Crossing &crossing) const;

    /// True if the line from a to b passes through the surface and can't belong to the fluid. Lines that graze a
    /// surface with fluid on one side, as chords of a curved one do, may.
    bool separates(const Vec<dim> &a, const Vec<dim> &b) const;

    /// True if x is where the fluid can't be, by the winding number: costs a loop over all pieces.
    bool is_in_solid(const Vec<dim> &x) const;

    /// Quick and rough: false only if no piece is within `reach` [m] of the box around a and b.
    bool may_reach(const Vec<dim> &a, const Vec<dim> &b, double reach) const;

  private:
    struct Topology;
    void   orient(Topology &topology);
    void   join_patches(const Topology &topology);
    void   make_grid();
    double winding(const Vec<dim> &x, const std::vector<unsigned int> &pieces) const;

    bool nearest_within(const Vec<dim> &x, double reach, unsigned int patch, Foot &foot) const;

    /// Calls visit(piece) for the pieces near the box from lower to upper, some of them several times.
    /// @return false as soon as visit does
    template <class Visitor>
    bool visit_near(const Vec<dim> &lower, const Vec<dim> &upper, const Visitor &visit) const;

    std::vector<Piece>        pieces_;
    std::vector<Vec<dim>>     normal_;
    std::vector<unsigned int> patch_;       ///< of the pieces
    std::vector<unsigned int> first_piece_; ///< of the patches
    std::vector<char>         is_flat_;
    FluidSide                 side_;

    /// Between patches: corners in 2D, edges with two ends in 3D.
    std::vector<std::array<Vec<dim>, dim - 1>> edges_;

    // Grid of boxes, each with the pieces in it.
    Vec<dim>                  lower_, upper_, box_size_;
    std::array<int, 3>        n_boxes_{1, 1, 1};
    std::vector<unsigned int> box_start_, box_pieces_;
  };
} // namespace Breakwater
