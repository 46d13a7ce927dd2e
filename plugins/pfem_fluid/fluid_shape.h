#pragma once

#include "regions.h"

#include <breakwater/base/parameter_reader.h>

#include <memory>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Where the fluid is at time 0: regions joined (+) and taken away (-), from left to right.
  template <int dim>
  class FluidShape
  {
  public:
    /// Reads `box(...) + sphere(...) - ...`; the words are in shape_documentation().
    /// @param walls a box around all walls, which a half space is cut to
    /// @param reader knows where files are
    /// @throws InputError without the name of the entry
    FluidShape(const std::string &text, const BoxShape<dim> &walls, const ParameterReader &reader);

    static std::string documentation();

    /// Distance to the surface [m], negative inside; exact only close to the surface.
    double distance(const Vec<dim> &x) const;

    /// A box around all of it.
    BoxShape<dim> extent() const;

    /// Places of the nodes, at least 0.4 h apart, those on the surface first.
    std::vector<Vec<dim>> place_nodes(const SizeField<dim> &size, const Lattice &lattice) const;

  private:
    struct Part
    {
      std::unique_ptr<Region<dim>> region;
      bool                         is_taken_away;
    };

    /// Whether a node may stand on the surface, which is that of several parts; whether one of a part's lattice, or of
    /// none, may stand inside.
    bool may_stand_on_surface(const Vec<dim> &x, double spacing) const;
    bool may_stand_inside(const Vec<dim> &x, double spacing, std::size_t part) const;

    /// Places to try for nodes inside where the spacing varies, in random order.
    std::vector<Vec<dim>> graded_darts(const SizeField<dim> &size, unsigned int seed) const;

    std::vector<Part> parts_;
  };
} // namespace Breakwater
