#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/base/run_context.h>
#include <breakwater/interfaces/body_force.h>
#include <breakwater/mesh/output_mesh.h>
#include <breakwater/mesh/stop.h>
#include <breakwater/mesh/wet_surface.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Breakwater
{
  /// Mass, momentum and energies of a domain, at a time at which positions and velocities are known together.
  template <int dim>
  struct DomainBalance
  {
    double   mass = 0;             ///< [kg]
    Vec<dim> momentum;             ///< [kg m/s]
    double   kinetic_energy   = 0; ///< [J]
    double   potential_energy = 0; ///< of the body forces [J]
    double   internal_energy  = 0; ///< of compression of a fluid [J]
    double   strain_energy    = 0; ///< of a solid [J]

    // What has come in through openings since time 0, less what has gone: it is part of the sums above.
    double   received_mass = 0;   ///< [kg]
    Vec<dim> received_momentum;   ///< with the impulse of what drives it [kg m/s]
    double   received_energy = 0; ///< with the work of what drives it [J]

    double energy() const { return kinetic_energy + potential_energy + internal_energy + strain_energy; }

    DomainBalance &operator+=(const DomainBalance &other) { return add(other, 1); }
    DomainBalance &operator-=(const DomainBalance &other) { return add(other, -1); }

  private:
    DomainBalance &add(const DomainBalance &other, const double sign)
    {
      mass += sign * other.mass;
      momentum += other.momentum * sign;
      kinetic_energy += sign * other.kinetic_energy;
      potential_energy += sign * other.potential_energy;
      internal_energy += sign * other.internal_energy;
      strain_energy += sign * other.strain_energy;
      received_mass += sign * other.received_mass;
      received_momentum += other.received_momentum * sign;
      received_energy += sign * other.received_energy;
      return *this;
    }
  };

  /// A body that advances in time by explicit central differences: a fluid or a structure, a coupler can't tell.
  ///
  /// One step of length dt from t_n is the Newmark scheme with beta = 0, gamma = 1/2 (velocity Verlet):
  ///   x(n+1) = x(n) + dt v(n) + dt^2/2 a(n),   a(n+1) = M^-1 F(x(n+1)),   v(n+1) = v(n) + dt/2 [a(n) + a(n+1)],
  /// in two calls. advance_free() makes the *free* solution, without forces from other domains at the new time;
  /// add_link_force() adds those forces lambda: a += M^-1 lambda, v += dt/2 M^-1 lambda (the *link* solution of
  /// Gravouil and Combescure, 2001). end_step() lets the domain do what must stand between two steps.
  template <int dim>
  class ExplicitDomain : public Plugin
  {
  public:
    static constexpr const char *interface_name = "domain";
    static constexpr int         dimension      = dim;

    /// Builds the initial state at time 0. Called once, after the parameters were read.
    /// @param name the domain's name in messages and output; both references outlive the domain
    virtual void setup(const std::string &name, const BodyForces<dim> &body_forces, RunContext &context) = 0;

    /// The step [s] that is stable now, the domain's own safety fraction included.
    virtual double stable_time_step() const = 0;

    /// The free solution of a step. @throws BreakdownError
    virtual void advance_free(double time_step) = 0;

    /// Adds forces [N] at the nodes of the wet surface to the step just made by advance_free().
    /// With time_step = 0 they act in the first half of the next step only: a += M^-1 lambda, v stays. May be called
    /// several times per step, and with time_step = 0 before the first one.
    /// @pre one force per node of wet_surface(), time_step as in advance_free() or 0
    virtual void add_link_force(const std::vector<Vec<dim>> &force, double time_step) = 0;

    /// The step is complete, links included. The fluid remeshes here if it must: its own forces change and with them the
    /// accelerations of the wet surface, which keep the part of the link forces. @throws BreakdownError
    virtual void end_step() = 0;

    /// The nodes that may be tied to another domain; their positions, velocities and accelerations are current after
    /// each call that changes them, setup() included. Empty if the domain has none. end_step() keeps positions and
    /// velocities.
    virtual const WetSurface<dim> &wet_surface() const = 0;

    /// Makes the nodes of another body's wet surface this domain's own: same number, order and places, facets of that
    /// body, appended to what was adopted before. They carry partner.mass as inertia that came with them, besides what
    /// this domain has there; it has no weight here.
    /// @pre can_adopt_surface(); called before setup() of this domain and after that of the partner
    /// @return the number of the first of these nodes in wet_surface()
    virtual unsigned int adopt_surface(const WetSurface<dim> &partner) = 0;

    /// True if the domain takes a partner's surface for its own: a fluid does, a structure does not.
    virtual bool can_adopt_surface() const = 0;

    /// Gives inertia of the nodes of wet_surface() away, for good: `mass` [kg] less resists forces from now on, while
    /// weight, damping and balance() stay those of the whole. Whoever takes it moves with these nodes.
    /// @pre one mass per node, less than its wet_surface().mass
    virtual void lend_mass(const std::vector<double> &mass) = 0;

    /// Puts the nodes of the wet surface to places [m] from which they differ by what time stepping let drift apart.
    /// Where the surface is adopted, no force feels the move, so that it does no work: what a fluid gains or loses in
    /// volume leaves its pressure as it is. A solid remembers where its nodes were: its strain changes.
    /// @pre one place per node
    virtual void correct_surface(const std::vector<Vec<dim>> &position) = 0;

    /// The planes that a node of the wet surface can't cross, such as floors; none if the domain knows no stops.
    /// @pre a number in wet_surface()
    virtual std::vector<Stop<dim>> stops(unsigned int /*node*/) const { return {}; }

    /// Puts other planes in their place. Nodes that move as one must have the same ones. A domain without stops ignores it.
    /// @pre a number in wet_surface(), before the first step
    virtual void set_stops(unsigned int /*node*/, const std::vector<Stop<dim>> & /*stops*/) {}

    virtual DomainBalance<dim> balance() const = 0;

    /// Adds the domain's columns to a row of history.csv; some may be means over the time since the last call.
    virtual void add_history(Row &row) = 0;

    /// The mesh and fields for solution.pvd.
    virtual OutputMesh<dim> output_mesh() const = 0;

    /// Writes and reads the whole state in binary, so that a resumed run has the same bits.
    virtual void save(std::ostream &stream) const = 0;
    virtual void load(std::istream &stream)       = 0;
  };
} // namespace Breakwater
