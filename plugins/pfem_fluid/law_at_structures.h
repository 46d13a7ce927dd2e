#pragma once

#include <breakwater/mesh/wet_surface.h>

#include <string>
#include <vector>

namespace Breakwater
{
  /// Whether the fluid slips along the surfaces of structures: one law for all, or one for each that is named.
  class LawAtStructures
  {
  public:
    static const char *documentation();

    LawAtStructures() = default;
    /// Reads `no slip`, `free slip`, or a list such as `Gate: free slip, Flap: no slip`. @throws InputError
    explicit LawAtStructures(const std::string &text);

    bool asks_for_slip() const;

    /// [facet of the surface] whether the fluid slips there.
    /// @throws InputError if none of the surface's bodies has a name that the list has
    template <int dim>
    std::vector<char> slips(const WetSurface<dim> &surface) const;

  private:
    struct Named
    {
      std::string body;
      bool        slips;
    };

    bool               others_slip_ = false;
    std::vector<Named> named_;
  };
} // namespace Breakwater
