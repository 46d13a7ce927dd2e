#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/base/vec.h>

#include <memory>
#include <vector>

namespace Breakwater
{
  /// An acceleration that acts on every mass in the scene, fluid and structure alike: gravity, a shaking table, ...
  template <int dim>
  class BodyForce : public Plugin
  {
  public:
    static constexpr const char *interface_name = "body force";
    static constexpr int         dimension      = dim;

    /// Adds the acceleration [m/s^2] at each position [m] and time [s] to `acceleration`.
    /// @pre both have the same size
    virtual void add_acceleration(double time, const std::vector<Vec<dim>> &position,
                                  std::vector<Vec<dim>> &acceleration) const = 0;

    /// Potential energy of a unit mass [J/kg] at a place; 0 where the force has no potential.
    virtual double potential(const Vec<dim> &position) const = 0;

    /// True if the acceleration is the same everywhere and always; then add_acceleration() at one place tells it.
    virtual bool is_uniform() const = 0;
  };

  template <int dim>
  using BodyForces = std::vector<std::unique_ptr<BodyForce<dim>>>;
} // namespace Breakwater
