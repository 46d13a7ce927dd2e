#pragma once

#include "shapes.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/vec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Breakwater
{
  /// The rigid walls of a scene: planes, each with the law that holds for a node in contact with it.
  ///
  /// A wall is unilateral: it stops a node that crosses it (an inelastic impact), holds it as long as the
  /// acceleration presses it on, and lets it go when the acceleration points away. A plane counts on all its
  /// infinite extent.
  template <int dim>
  class Walls
  {
  public:
    struct Plane
    {
      std::string name;
      int         direction; ///< coordinate that is constant
      double      sign;      ///< +1: the fluid is at larger coordinates
      double      place;     ///< [m]
      bool        no_slip;
    };

    /// One bit per plane.
    using Contacts = std::uint32_t;

    void declare_parameters(ParameterReader &reader);
    /// Makes the planes from what was read. @throws InputError
    void check_parameters(ParameterReader &reader);

    const std::vector<Plane> &planes() const { return planes_; }

    /// A box around all walls, without a kind if there are none.
    const BoxShape<dim> &extent() const { return extent_; }

    /// Planes that a place lies on, within a tolerance [m].
    Contacts planes_at(const Vec<dim> &x, double tolerance) const;

    /// Puts a node that has crossed walls back onto them, takes the velocity into them away and adds those contacts.
    void stop(double *x, double *v, Contacts &contacts) const;

    /// Takes from a node in contact what the walls take: acceleration into them (or, without slip, all of it).
    /// A wall that the acceleration points away from is released.
    void constrain(double *acceleration, double *v, Contacts &contacts) const;

    /// Takes the components of a vector that contacts do not let pass (both senses).
    void mask(double *vector, Contacts contacts) const;

  private:
    struct Box
    {
      std::string name;
      std::string shape = "";
      std::string law   = "free slip";
    };
    std::vector<Box>   boxes_;
    std::vector<Plane> planes_;
    BoxShape<dim>      extent_;
  };
} // namespace Breakwater
