#pragma once

#include "contacts.h"
#include "rigid_motion.h"
#include "shapes.h"
#include "size_field.h"
#include "wall_surface.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/run_context.h>
#include <breakwater/mesh/quality.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace Breakwater
{
  /// The rigid walls of a scene, fixed or moving, each with the law that holds for a node in contact with it.
  ///
  /// A wall is unilateral: it stops a node that crosses it (an inelastic impact), holds it as long as the acceleration
  /// against the wall's presses it on, and lets it go when that points away. Its *faces* are planes of infinite extent,
  /// or the patches of a surface (WallSurface). What walls take from the fluid is added up per wall.
  ///
  /// Velocities of moving walls are differences of their places over the fluid's time steps, so that a node at rest
  /// on a wall follows it exactly, whatever the law of motion.
  template <int dim>
  class Walls
  {
  public:
    void declare_parameters(ParameterReader &reader);
    /// Makes the faces from what was read. @throws InputError
    void check_parameters(ParameterReader &reader);
    /// To be called before all that follows. @param spacing of the nodes [m]
    void set_spacing(double spacing) { spacing_ = spacing; }

    /// A box around all walls of finite size, without a kind if there are none.
    const BoxShape<dim> &extent() const { return extent_; }

    std::size_t n_faces() const { return faces_.size(); }
    bool        any_moves() const;
    bool        any_has_surface() const { return !surfaces_.empty(); }

    // --- time ---

    /// Moves the walls to a time [s], a step [s] after the last one. From here to finish_step(), the velocity of a
    /// wall is its mean over the step.
    void move(double time, double step);
    void finish_step() { in_step_ = false; }

    /// True if the surface of a moving wall has travelled a distance [m] since note_remesh().
    bool has_travelled(double distance) const;
    void note_remesh();

    // --- nodes ---

    /// Fits the nodes of the initial state to walls other than fixed planes along the axes: those in solids or close to
    /// a wall are replaced by nodes on the wall, where is_fluid() allows them and no other is near; edges first.
    std::vector<Vec<dim>> fit(const std::vector<Vec<dim>> &nodes, const SizeField<dim> &size,
                              const std::function<bool(const Vec<dim> &)> &is_fluid) const;

    /// Faces that a place lies on, within a tolerance [m].
    Contacts faces_at(const Vec<dim> &x, double tolerance) const;

    /// Puts a node that has crossed walls on its way from x_old back onto them, takes the velocity into them away and
    /// adds those contacts. Contacts with surfaces that the node has left, sideways, are dropped.
    /// @param mass of the node [kg], 0 if the walls feel nothing
    /// @return whether a contact was added
    bool stop(const Vec<dim> &x_old, double *x, double *v, double mass, Contacts &contacts)
    {
      return !is_in_front_of_all(x) && stop_at_faces(x_old, x, v, mass, contacts);
    }

    /// Takes from a node in contact what the walls take: acceleration into them (or, without slip, all of it against
    /// them).
    /// @param slip_rate k of the friction -k u on walls with Navier slip, u the velocity along them [1/s]
    /// @param may_release whether a wall that the acceleration points away from lets go; else it pulls
    void constrain(const double *x, double *a, double *v, double mass, double slip_rate, bool may_release,
                   Contacts &contacts);

    /// Takes the components of a vector that contacts do not let pass (both senses).
    void mask(const double *x, double *vector, const Contacts &contacts) const;

    /// The same for an impulse [kg m/s], which the walls take.
    void mask_impulse(const double *x, double *impulse, const Contacts &contacts);

    /// The unit normal of a face, into the fluid, at a place on it. @return false if the place is beside a bent face
    bool normal_at(Contacts::Face face, const Vec<dim> &x, Vec<dim> &normal) const
    {
      return normal_at(faces_[face], x, normal);
    }

    // --- cells ---

    /// True if an edge of the cell passes through a surface.
    bool separate(const Simplex<dim> &cell) const;
    /// True if no piece of a surface is within a distance [m] of x: no cell smaller than that can be separated.
    bool are_far(const Vec<dim> &x, double distance) const;
    /// True if a cell whose nodes all lie on these faces is no fluid.
    bool flatten(const Contacts &shared, const Simplex<dim> &cell) const;
    /// True if a facet whose nodes all lie on these faces lies on the wall.
    bool close(const Contacts &shared, const std::array<Vec<dim>, dim> &facet) const;
    /// Distance of x to a face, positive in the fluid, and the normal there.
    /// @return false if the face is bent and farther away than `reach` [m]
    bool distance_to(Contacts::Face face, const Vec<dim> &x, double reach, double &distance, Vec<dim> &normal) const;
    /// Distance of x to the first of the faces that is bent, positive in the fluid, and the normal there.
    /// @return false if none is, or it is farther away than `reach` [m]
    bool distance_to_curved(const Contacts &faces, const Vec<dim> &x, double reach, double &distance,
                            Vec<dim> &normal) const;
    /// True if one of the faces is bent.
    bool is_curved(const Contacts &faces) const;
    /// Area over slip length of a facet that such a face closes [m^(dim - 2)]; 0 where no wall has Navier slip.
    double slip_conductance(const Contacts &shared, const std::array<Vec<dim>, dim> &facet) const;
    bool   any_has_navier_slip() const;

    // --- forces ---

    /// push() and constrain() are about to be called for all nodes anew.
    void begin_forces();
    /// A force [N] at a place on the wall of the first of these faces.
    void push(const Contacts &faces, const Vec<dim> &x, const Vec<dim> &force);
    /// The forces of the last constrain() act for a time [s].
    void act(double duration);
    /// Adds the mean forces and moments since the last call, at a time [s].
    void add_history(double time, Row &row);
    /// Work of the walls on the fluid since the start [J].
    double work() const;

    void save(std::ostream &stream) const;
    void load(std::istream &stream);

  private:
    enum class Law
    {
      free_slip,
      no_slip,
      navier_slip
    };

    /// A force with its moment and power; or, over time, impulse, angular impulse and work.
    struct Load
    {
      Vec<dim> force;     ///< on the wall [N]
      Vec<3>   moment;    ///< on the wall, about its reference point [N m]
      double   power = 0; ///< of the wall on the fluid [W]

      void add(const Load &other, double factor);
    };

    /// What a wall is at a time, for checkpoints.
    struct State
    {
      Pose<dim> before, now, after, at_remesh; ///< a step ago, now, in a step, at the last remesh
      Load      load, total, total_at_row;
    };

    struct Wall
    {
      std::string      name;
      std::string      shape = "", side = "inside", law_text = "free slip";
      double           slip_length = 0; ///< [m]
      Vec<dim>         reference_point; ///< of the moments [m]
      RigidMotion<dim> motion;
      Law              law       = Law::free_slip;
      bool             is_moving = false;
      State            state;
    };

    struct Face
    {
      unsigned int wall;
      int          surface;   ///< -1: a plane
      unsigned int patch;     ///< of the surface
      int          direction; ///< coordinate that is constant on a plane along the axes
      double       sign;      ///< of the normal in that direction
      double       place;     ///< [m]
      Vec<dim>     point;     ///< of the plane, before the motion [m]
      Vec<dim>     normal;    ///< of the plane, before the motion
    };

    struct Surface
    {
      unsigned int     wall;
      unsigned int     first_face;
      WallSurface<dim> shape;
    };

    /// Puts fixed planes along the axes first, then other planes, then surfaces.
    void number_faces(const std::vector<Face> &planes);
    /// True if there are no walls but fixed planes along the axes, and the place is in front of or on all of them: most
    /// nodes of most scenes need no closer look.
    bool is_in_front_of_all(const double *x) const
    {
      bool is_between = true;
      for (int d = 0; d < dim; ++d)
        is_between = is_between && x[d] >= lower_plane_[d] && x[d] <= upper_plane_[d];
      return is_between;
    }
    void find_room();
    /// Nodes rest on surfaces at this distance, so that it is clear on which side they are [m].
    double clearance() const { return 1e-6 * spacing_; }
    bool   is_in_solid(const Vec<dim> &x) const;
    /// The place of a wall other than a fixed plane along the axes that is nearest to x.
    bool nearest_place(const Vec<dim> &x, double reach, Vec<dim> &place) const;
    /// A place on surfaces, moved off them by a distance; side +1 or -1: where the normal of two-sided ones points, or
    /// the other one.
    Vec<dim> off_surfaces(const Vec<dim> &x, double side, double distance) const;
    double   plane_distance(const Face &face, const Vec<dim> &body_place) const;
    double   distance_now(const Face &plane, const Vec<dim> &x) const;

    Vec<dim> velocity_at(const Wall &wall, const Vec<dim> &x) const;
    Vec<dim> acceleration_at(const Wall &wall, const Vec<dim> &x) const;
    bool     normal_at(const Face &face, const Vec<dim> &x, Vec<dim> &normal) const;
    Load     load_of(const Wall &wall, const Vec<dim> &x, const Vec<dim> &force) const;

    bool stop_at_faces(const Vec<dim> &x_old, double *x, double *v, double mass, Contacts &contacts);
    void stop_at_plane(unsigned int face, double *x, double *v, double mass, Contacts &contacts);
    void stop_at_surface(const Surface &surface, const Vec<dim> &x_old, double *x, double *v, double mass,
                         Contacts &contacts);
    void take_velocity(const Face &face, const Vec<dim> &normal, const Vec<dim> &x, double *v, double mass);
    void constrain_along_axes(const double *x, double *a, double *v, double mass, bool may_release, Contacts &contacts);
    void constrain_generally(const double *x, double *a, double *v, double mass, bool may_release, Contacts &contacts);
    void rub(const double *x, double *a, const double *v, double mass, double slip_rate, const Contacts &contacts);

    /// Calls take(wall, component) for each part of a vector that contacts do not let pass, and takes it away.
    template <class Take>
    void project(const double *x, double *vector, const Contacts &contacts, const Take &take) const;

    std::vector<Wall>    walls_;
    std::vector<Face>    faces_;
    unsigned int         n_aligned_ = 0; ///< the first faces: fixed planes along the axes
    unsigned int         n_planes_  = 0; ///< all planes; the patches of surfaces follow
    std::vector<Surface> surfaces_;
    Vec<dim>             lower_plane_, upper_plane_; ///< see is_in_front_of_all() [m]
    BoxShape<dim>        extent_;
    double               spacing_          = 0; ///< of the nodes [m]
    double               step_             = 0; ///< last one [s]
    double               time_of_last_row_ = 0; ///< [s]
    bool                 in_step_          = false;
  };
} // namespace Breakwater
