#pragma once

#include <breakwater/base/plugin.h>

#include <cstddef>

namespace Breakwater
{
  /// Stress of a solid as a function of its deformation gradient, per unit of undeformed volume.
  template <int dim>
  class Material : public Plugin
  {
  public:
    static constexpr const char *interface_name = "material";
    static constexpr int         dimension      = dim;

    /// Density of the undeformed solid [kg/m^3].
    virtual double density() const = 0;

    /// First Piola-Kirchhoff stress P [Pa] at n points from the displacement gradient H = F - 1.
    /// Both are arrays [n][dim][dim], row by row; in 2D, plane strain.
    virtual void first_piola_stress(const double *displacement_gradient, double *stress, std::size_t n) const = 0;

    /// Strain energy per undeformed volume [J/m^3] at a displacement gradient [dim][dim].
    virtual double strain_energy(const double *displacement_gradient) const = 0;

    /// Speed of dilational waves in the undeformed solid [m/s].
    virtual double wave_speed() const = 0;
  };
} // namespace Breakwater
