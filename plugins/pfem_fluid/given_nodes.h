#pragma once

#include "regions.h"

#include <string>

namespace Breakwater
{
  /// The nodes and cells of a gmsh file: triangles in 2D, tetrahedra in 3D. Only the outline of the cells counts; the
  /// fluid makes its own cells between the nodes.
  template <int dim>
  class MeshRegion : public Region<dim>
  {
  public:
    /// @throws InputError without the name of the entry
    explicit MeshRegion(const std::string &file);

    /// Only its sign is right: minus or plus infinity.
    double        distance(const Vec<dim> &x) const override;
    BoxShape<dim> extent() const override { return extent_; }
    void add_nodes(const SizeField<dim> &size, const Lattice &lattice, NodeCandidates<dim> &nodes) const override;

  private:
    void                make_grid();
    std::array<long, 3> grid_cell(const Vec<dim> &x) const;
    std::size_t         grid_index(const std::array<long, 3> &cell) const;

    std::vector<Vec<dim>>                          position_; ///< of the nodes that have cells [m]
    std::vector<std::array<unsigned int, dim + 1>> cells_;
    BoxShape<dim>                                  extent_;
    Vec<dim>                                       grid_step_;
    std::array<long, 3>                            n_grid_{{1, 1, 1}};
    std::vector<std::vector<unsigned int>>         grid_; ///< cells whose boxes touch a cell of the grid
  };

  /// Single nodes far from each other: n of them at random places in a box, on a lattice as wide as they need.
  template <int dim>
  class Spray : public Region<dim>
  {
  public:
    Spray(const BoxShape<dim> &box, unsigned int n)
      : box_(box)
      , n_(n)
    {
    }
    /// Plus infinity: no cell is inside.
    double        distance(const Vec<dim> &x) const override;
    BoxShape<dim> extent() const override { return box_; }
    void add_nodes(const SizeField<dim> &size, const Lattice &lattice, NodeCandidates<dim> &nodes) const override;

  private:
    BoxShape<dim> box_;
    unsigned int  n_;
  };
} // namespace Breakwater
