#pragma once

#include "lattice.h"
#include "polygon.h"
#include "size_field.h"

#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// Places where nodes of a region may stand, by how much they matter.
  template <int dim>
  struct NodeCandidates
  {
    std::vector<Vec<dim>> given;    ///< nodes that a file or the user asks for
    std::vector<Vec<dim>> sharp;    ///< on corners and edges of the surface
    std::vector<Vec<dim>> smooth;   ///< elsewhere on the surface
    std::vector<Vec<dim>> interior; ///< of a lattice; none where the spacing varies
  };

  /// A part of space that fluid fills: box, sphere, ...
  template <int dim>
  class Region
  {
  public:
    virtual ~Region() = default;

    /// Distance to the surface [m], negative inside; need be exact only close to the surface.
    virtual double distance(const Vec<dim> &x) const = 0;

    /// A box around the region.
    virtual BoxShape<dim> extent() const = 0;

    /// True for a box along the axes.
    virtual bool is_box() const { return false; }

    /// Adds the places where the region's nodes may stand.
    virtual void add_nodes(const SizeField<dim> &size, const Lattice &lattice, NodeCandidates<dim> &nodes) const = 0;
  };


  /// A region with a surface that nodes stand on.
  template <int dim>
  class SurfaceRegion : public Region<dim>
  {
  public:
    /// Nodes on the surface, and a lattice over extent() if the spacing is uniform.
    void add_nodes(const SizeField<dim> &size, const Lattice &lattice, NodeCandidates<dim> &nodes) const override;

  protected:
    virtual void add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const = 0;
  };


  /// A box along the axes; with a uniform spacing its nodes are exactly those of fill_box().
  template <int dim>
  class BoxRegion : public SurfaceRegion<dim>
  {
  public:
    explicit BoxRegion(const BoxShape<dim> &box)
      : box_(box)
    {
    }
    double        distance(const Vec<dim> &x) const override;
    BoxShape<dim> extent() const override { return box_; }
    bool          is_box() const override { return true; }
    void add_nodes(const SizeField<dim> &size, const Lattice &lattice, NodeCandidates<dim> &nodes) const override;

  protected:
    void add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const override;

  private:
    BoxShape<dim> box_;
  };


  /// An ellipsoid along the axes, an ellipse in 2D. Its nodes stand so far outside of it that the polyhedron between
  /// them has its volume: by a^2 / (8 R) on a sphere of radius R with triangles of sides a, a^2 / (12 R) on a circle
  /// (mean height of the surface over its chords).
  template <int dim>
  class Ellipsoid : public SurfaceRegion<dim>
  {
  public:
    Ellipsoid(const Vec<dim> &center, const Vec<dim> &half_axes);
    double        distance(const Vec<dim> &x) const override;
    BoxShape<dim> extent() const override;

  protected:
    void add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const override;

  private:
    Vec<dim> center_, half_axes_;
  };


  /// A polygon in 2D, and in 3D one extruded along z. In 2D the lowest and highest z have no meaning.
  template <int dim>
  class Prism : public SurfaceRegion<dim>
  {
  public:
    Prism(const Polygon &polygon, const double lowest_z, const double highest_z)
      : polygon_(polygon)
      , z_{lowest_z, highest_z}
    {
    }
    double        distance(const Vec<dim> &x) const override;
    BoxShape<dim> extent() const override;

  protected:
    void add_surface(const SizeField<dim> &size, NodeCandidates<dim> &nodes) const override;

  private:
    Polygon polygon_;
    double  z_[2];
  };


  /// A cylinder with flat ends, from one place on its axis to another. Its mantle's nodes stand outside of it as those
  /// of an ellipsoid do, by a^2 / (16 r).
  class Cylinder : public SurfaceRegion<3>
  {
  public:
    Cylinder(const Vec<3> &start, const Vec<3> &end, double radius);
    double      distance(const Vec<3> &x) const override;
    BoxShape<3> extent() const override;

  protected:
    void add_surface(const SizeField<3> &size, NodeCandidates<3> &nodes) const override;

  private:
    Vec<3> start_, axis_, e1_, e2_; ///< three unit vectors
    double length_, radius_;
  };


  /// The part of a box on one side of a plane, in 3D; in 2D it is a polygon, see cut().
  class CutBox : public SurfaceRegion<3>
  {
  public:
    /// @param normal out of the region
    CutBox(const BoxShape<3> &box, const Vec<3> &point, const Vec<3> &normal);
    bool        empty() const { return faces_.empty(); }
    double      distance(const Vec<3> &x) const override;
    BoxShape<3> extent() const override;

  protected:
    void add_surface(const SizeField<3> &size, NodeCandidates<3> &nodes) const override;

  private:
    std::vector<Vec<3>>              points_, normals_; ///< of the planes around it
    std::vector<std::vector<Vec<3>>> faces_;            ///< their corners, in order
  };

  /// The corners of what is left of a convex polygon on one side of a plane. @param normal out of what is left
  template <int dim>
  std::vector<Vec<dim>> cut(const std::vector<Vec<dim>> &polygon, const Vec<dim> &point, const Vec<dim> &normal);
} // namespace Breakwater
