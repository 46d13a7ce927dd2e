#include "pfem_parameters.h"

#include <algorithm>
#include <functional>

namespace Breakwater
{
  namespace
  {
    /// Runs what reads an entry, and says where the entry stands if that throws an InputError.
    void read_entry(const ParameterReader &reader, const std::string &entry, const std::function<void()> &read)
    {
      try
        {
          read();
        }
      catch (const InputError &error)
        {
          reader.fail(entry, error.what());
        }
    }
  } // namespace


  template <int dim>
  void InitialState<dim>::declare(ParameterReader &reader)
  {
    SectionScope scope(reader, "Initial state");
    reader.add("Shape", shape_text, FluidShape<dim>::documentation());
    reader.add("Pressure", pressure,
               "`hydrostatic`: of a fluid at rest under a uniform body force, zero at the highest place of each body "
               "of fluid that touches no other; `zero`; or an expression of x, y, z [m] and pi [Pa].");
    reader.add(
      "Velocity", velocity,
      "Velocity at time 0 [m/s]: a number or an expression of x, y, z [m] and pi for each component, separated "
      "by commas.");
    reader.add("Lattice", lattice_text,
               "How the nodes are put where the spacing is uniform. A cubic lattice makes many slivers.",
               {"body centred", "cubic"});
    reader.add("Jitter", lattice.jitter,
               "Random displacement of the lattice's nodes, as a fraction of the spacing [-].", {0., 0.3});
    reader.add("Seed", lattice.seed, "Start of the random numbers for the nodes.");
  }


  template <int dim>
  void InitialState<dim>::check(ParameterReader &reader, const BoxShape<dim> &walls, const bool may_be_empty)
  {
    SectionScope scope(reader, "Initial state");
    lattice.body_centred = lattice_text == "body centred";
    shape.reset();
    if (!shape_text.empty() || !may_be_empty)
      read_entry(reader, "Shape", [&]() {
        shape = std::make_unique<FluidShape<dim>>(shape_text, walls, reader);
      });
    const auto place = Expression<dim>::Variables::place;
    read_entry(reader, "Velocity", [&]() {
      velocity_at = std::make_unique<Expression<dim>>(velocity, dim, place);
    });
    pressure_at.reset();
    if (pressure != "hydrostatic" && pressure != "zero")
      read_entry(reader, "Pressure", [&]() {
        pressure_at = std::make_unique<Expression<dim>>(pressure, 1, place);
      });
  }


  template <int dim>
  PfemParameters<dim>::PfemParameters()
    : equation_of_state("Equation of state", "tait", "Pressure as a function of density.", 1)
    , rheology("Rheology", "newtonian", "Viscous stress as a function of the rate of deformation.", 1)
    , time_step_bound("Time step bound", "spectral", "Rule for the largest stable step.", 1)
    , mesh_smoothers("Mesh smoothers", "",
                     "Smoothers that improve each new mesh, in this order. None is needed with the spectral bound.")
  {
  }


  template <int dim>
  void PfemParameters<dim>::declare(ParameterReader &reader)
  {
    reader.add("Spacing", spacing_text,
               "Distance h of the nodes [m]: h^dim is the space of one node. A number, or an expression of x, y, z [m] "
               "and pi; where it is steeper than 0.3 it is made smaller.");
    equation_of_state.declare_parameters(reader);
    rheology.declare_parameters(reader);
    time_step_bound.declare_parameters(reader);
    reader.add("Fraction of the bound", fraction_of_bound,
               "The time step as a fraction of the bound [-]. More than 1 is unstable with a sharp bound.", {1e-6, 2.});
    mesh_smoothers.declare_parameters(reader);
    reader.add("Smoothing target", smoothing_target,
               "Insphere radius that mesh smoothers shall give the worst cell, in units of the regular cell's [-].",
               {0., 1.});
    reader.add("Tension", tension,
               "Whether the pressure may fall below zero: `none` for violent flow, `allowed` for calm flow in which "
               "suction matters; walls that the fluid has touched then hold it.",
               {"none", "allowed"});
    reader.add("Law at structures", law_text, LawAtStructures::documentation());
    initial_state.declare(reader);
    walls.declare_parameters(reader);
    openings.declare_parameters(reader);
    {
      SectionScope scope(reader, "Remeshing");
      reader.add("Alpha", alpha,
                 "Cells with a circumradius up to alpha times the spacing are fluid [-]: how early gaps close.",
                 {0.9, 2.});
      reader.add("Alpha of fluid", alpha_of_fluid,
                 "The same for cells that were fluid before the remesh [-]: how late fluid tears.", {1., 3.});
      reader.add("Smallest distance", node_limits.smallest_distance,
                 "Neighbouring nodes that come closer than this times the spacing are merged [-]; 0: none.", {0., 0.6});
      reader.add("Longest edge", node_limits.longest_edge,
                 "An edge longer than this times the spacing gets a node in its middle [-]; 0: none.", {0., 4.});
      reader.add("Largest strain", largest_strain,
                 "Remesh when a node has moved against its cell by this fraction of the spacing [-].", {0.01, 0.5});
      reader.add("Strained part", strained_part,
                 "Part of the cells in which it may be up to twice as much, and cells of gaps twice as closed [-]: "
                 "splashes strain a few cells always.",
                 {0., 1.});
    }
    {
      SectionScope scope(reader, "Stabilization");
      reader.add("Density diffusion", density_diffusion,
                 "Coefficient xi of the diffusion xi c h of density, blind to hydrostatic gradients [-]; 0: none.",
                 {0., 1.});
      reader.add("Density diffusion period", diffusion_period,
                 "Longest time from one use of the diffusion to the next, in units of the spacing over the speed of "
                 "sound [-], and at most 1 / xi; 0: it is used at each step.",
                 {0., 2.});
      reader.add("Velocity filter", filter_weight,
                 "Part of the velocity's deviation from a locally linear field that is taken away [-]; 0: none.",
                 {0., 0.5});
      reader.add("Divergence filter", divergence_filter_weight,
                 "Weight with which the filter takes away what deviates from the mean divergence around a cell [-]; "
                 "0: none.",
                 {0., 2.});
      reader.add("Cell stiffness", cell_stiffness,
                 "Stiffness of each cell against a change of its own volume since the last remesh, in units of the "
                 "hydrostatic pressure over one spacing [-]; 0: none. Without it water at rest stirs itself.",
                 {0., 1000.});
      reader.add("Velocity filter period", filter_period,
                 "Steps from one use of the filter to the next. One in which sound goes less than 0.4 spacings counts "
                 "in part.",
                 1);
      reader.add("Softening", softening,
                 "Upper limit G on h^2/c^2 times the squared nodal frequency: the few stiffer nodes, light ones at "
                 "the surface, get softer, so that c dt = 2 h / sqrt(G) is always stable [-].",
                 Range::positive());
      reader.add("Softening at structures", softening_at_structures,
                 "How many times softer a node may get for the sake of light nodes of a structure beside it [-]; where "
                 "that is not enough the step gets shorter.",
                 {1., 1e6});
    }
    {
      SectionScope scope(reader, "Limits");
      reader.add("Largest Mach number", largest_mach_number,
                 "The run stops when a node moves faster than this times the speed of sound at rest [-]: the fluid is "
                 "no longer weakly compressible, or the step was unstable.",
                 Range::positive());
      reader.add(
        "Largest energy gain at a remesh", largest_energy_gain,
        "The run stops when a remesh makes more than this times the kinetic energy, or that of a thousandth of "
        "the speed of sound if it is larger [-].",
        Range::positive());
      reader.add("Largest angular momentum change at a remesh", largest_angular_change,
                 "The run stops when a remesh changes the angular momentum by more than this times that of a ring with "
                 "the fluid's mass, radius of gyration and kinetic energy [-].",
                 Range::positive());
    }
    {
      SectionScope scope(reader, "Volume conservation");
      reader.add("Correction iterations", correction_iterations,
                 "Conjugate gradient iterations of the position correction at a remesh; 0: no correction.");
      reader.add("Correction weight", correction_weight, "Part of the missing volume corrected at a remesh [-].",
                 {0., 1.});
      reader.add("Exchange iterations", exchange.n_iterations,
                 "Conjugate gradient iterations of the mass exchange at a remesh, at most; 0: no exchange.");
      reader.add("Exchange reach", exchange.reach, "Excess mass spreads over the square root of this many nodes [-].",
                 Range::positive());
      reader.add("Far exchange reach", exchange.far_reach,
                 "In calm flow it spreads over the square root of this many nodes [-]; 0: no farther than above.",
                 {0., 1e6});
      reader.add("Exchange tolerance", exchange.tolerance,
                 "Relative rms of the nodes' excess mass at which the iterations end [-].", Range::positive());
      reader.add("Centroid shift", centroid_shift,
                 "Part of the way to its patch's centroid that an interior node is moved at a remesh [-].", {0., 0.5});
    }
  }


  template <int dim>
  void PfemParameters<dim>::check(ParameterReader &reader)
  {
    if (equation_of_state.empty())
      reader.fail("Equation of state", "a fluid needs one");
    if (rheology.empty())
      reader.fail("Rheology", "a fluid needs one; `inviscid` is the simplest");
    if (time_step_bound.empty())
      reader.fail("Time step bound", "a fluid needs one");
    law_place = reader.where("Law at structures");
    read_entry(reader, "Law at structures", [&]() {
      law_at_structures = LawAtStructures(law_text);
    });
    equation_of_state.check_parameters(reader);
    rheology.check_parameters(reader);
    time_step_bound.check_parameters(reader);
    mesh_smoothers.check_parameters(reader);
    walls.check_parameters(reader);
    openings.check_parameters(reader, walls.extent());
    initial_state.check(reader, walls.extent(), openings.has_inflows());
    check_spacing(reader);
    walls.set_spacing(spacing);
    if (walls.any_has_navier_slip() && !(rheology.front().is_viscous() && rheology.front().is_newtonian()))
      reader.fail("Rheology", "a wall has Law = navier slip, whose traction needs one viscosity: take newtonian");
  }


  template <int dim>
  void PfemParameters<dim>::check_spacing(ParameterReader &reader)
  {
    const BoxShape<dim> fluid = initial_state.shape ? initial_state.shape->extent() : walls.extent();
    if (fluid.kind.empty())
      reader.fail("Initial state", "a scene without fluid at time 0 needs walls");
    BoxShape<dim> scene = fluid;
    if (!walls.extent().kind.empty())
      for (int d = 0; d < dim; ++d)
        {
          scene.lower[d] = std::min(fluid.lower[d], walls.extent().lower[d]);
          scene.upper[d] = std::max(fluid.upper[d], walls.extent().upper[d]);
        }
    read_entry(reader, "Spacing", [&]() {
      size = SizeField<dim>(spacing_text, scene.lower, scene.upper);
    });
    spacing = size.smallest();
    SectionScope scope(reader, "Initial state");
    for (int d = 0; d < dim; ++d)
      if (fluid.upper[d] - fluid.lower[d] < spacing)
        reader.fail("Shape", "the shape is thinner than the spacing of " + std::to_string(spacing) + " m");
  }

  template struct InitialState<2>;
  template struct InitialState<3>;
  template struct PfemParameters<2>;
  template struct PfemParameters<3>;
} // namespace Breakwater
