#pragma once

#include "fluid_shape.h"
#include "law_at_structures.h"
#include "mass_exchange.h"
#include "node_management.h"
#include "openings.h"
#include "shapes.h"
#include "size_field.h"
#include "walls.h"

#include <breakwater/base/expression.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/interfaces/equation_of_state.h>
#include <breakwater/interfaces/fluid_rheology.h>
#include <breakwater/interfaces/mesh_smoother.h>
#include <breakwater/interfaces/time_step_bound.h>

#include <memory>
#include <string>

namespace Breakwater
{
  /// The fluid at time 0.
  template <int dim>
  struct InitialState
  {
    std::string shape_text   = "";
    std::string lattice_text = "body centred";
    std::string pressure     = "hydrostatic"; ///< or "zero", or an expression
    std::string velocity     = dim == 2 ? "0, 0" : "0, 0, 0";
    Lattice     lattice;

    std::unique_ptr<FluidShape<dim>> shape;       ///< none: no fluid yet
    std::unique_ptr<Expression<dim>> pressure_at; ///< [Pa]; none: hydrostatic or zero
    std::unique_ptr<Expression<dim>> velocity_at; ///< [m/s]

    void declare(ParameterReader &reader);
    /// @param walls a box around all walls
    /// @param may_be_empty fluid comes in later: an empty shape is no mistake
    void check(ParameterReader &reader, const BoxShape<dim> &walls, bool may_be_empty);
  };

  /// What a parameter file says about the fluid: section "Fluid/Pfem".
  template <int dim>
  struct PfemParameters
  {
    std::string                    spacing_text = "0.01";
    SizeField<dim>                 size;           ///< of the spacing everywhere
    double                         spacing = 0.01; ///< the smallest [m]
    PluginList<EquationOfState>    equation_of_state;
    PluginList<FluidRheology>      rheology;
    PluginList<TimeStepBound<dim>> time_step_bound;
    PluginList<MeshSmoother<dim>>  mesh_smoothers;
    double                         smoothing_target  = 0.6;
    double                         fraction_of_bound = 0.9;
    std::string                    tension           = "none";
    std::string                    law_text          = "no slip"; ///< at structures
    std::string                    law_place;                     ///< where the file says it, for messages
    LawAtStructures                law_at_structures;
    InitialState<dim>              initial_state;
    Walls<dim>                     walls;
    Openings<dim>                  openings;

    double          alpha          = 1.05;
    double          alpha_of_fluid = 1.4;
    double          largest_strain = 0.2;
    double          strained_part  = 0;
    NodeLimits<dim> node_limits;
    double          softening                = 12.;
    double          softening_at_structures  = 4.;
    double          density_diffusion        = 0.5;
    double          diffusion_period         = 2.;
    double          filter_weight            = 0.4;
    unsigned int    filter_period            = 10;
    double          divergence_filter_weight = 1.5;
    double          cell_stiffness           = 1.;
    double          centroid_shift           = 0.1;
    unsigned int    correction_iterations    = 5;
    double          correction_weight        = 0.3;
    ExchangeControl exchange;
    double          largest_energy_gain    = 1.;
    double          largest_angular_change = 1.;
    double          largest_mach_number    = 1.;

    PfemParameters();
    void declare(ParameterReader &reader);
    void check(ParameterReader &reader);

  private:
    void check_spacing(ParameterReader &reader);
  };
} // namespace Breakwater
