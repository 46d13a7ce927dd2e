#pragma once

#include "delaunay_mesh.h"
#include "fluid_nodes.h"
#include "gaps.h"
#include "interface_slip.h"
#include "kernels.h"
#include "node_pairs.h"
#include "pfem_parameters.h"
#include "structure_contact.h"

#include <breakwater/interfaces/explicit_domain.h>
#include <breakwater/mesh/quality_report.h>

#include <functional>
#include <string>
#include <vector>

namespace Breakwater
{
  /// A weakly compressible fluid whose mesh moves with it: the explicit particle finite element method (Meduri,
  /// Cremonesi and Perego, section 3) with one pressure per node.
  ///
  /// Unknowns at the nodes of a simplex mesh: position, velocity, mass, density, pressure. From the nodal volumes V_i,
  ///   rho_i = rho_b,i / J_i,   J_i = 1 + (V_i - V0_i) / Vhat_i,   p_i = p(rho_i),
  /// where rho_b and V0 date from the last remesh, and Vhat_i = V0_i except at the few nodes that would be too stiff
  /// for the step (they are softened, see set_references()). Numerics and measurements: doc/numerics.md.
  template <int dim>
  class PfemFluid : public ExplicitDomain<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    void   setup(const std::string &name, const BodyForces<dim> &body_forces, RunContext &context) override;
    double stable_time_step() const override;
    void   advance_free(double time_step) override;
    void   add_link_force(const std::vector<Vec<dim>> &force, double time_step) override;
    void   end_step() override;

    const WetSurface<dim> &wet_surface() const override { return adopted_.surface(); }
    unsigned int           adopt_surface(const WetSurface<dim> &partner) override;
    void                   lend_mass(const std::vector<double> &mass) override;
    bool                   can_adopt_surface() const override { return true; }
    void                   correct_surface(const std::vector<Vec<dim>> &position) override;

    DomainBalance<dim> balance() const override;
    void               add_history(Row &row) override;
    OutputMesh<dim>    output_mesh() const override;
    void               save(std::ostream &stream) const override;
    void               load(std::istream &stream) override;

  private:
    /// What a remesh did, for its row of remeshing.csv.
    struct RemeshRecord;

    /// Arrays of the velocity filter, kept: fresh memory costs as much as the loops over nodes.
    struct FilterBuffers
    {
      std::vector<double> node_density, inverse_mass;
      std::vector<Quad>   gradient, impulse;
    };

    /// When something that grows was measured, and when it will be again.
    class Watch
    {
    public:
      /// Counts calls; true when it is time to measure again.
      bool is_due() { return ++n_looks_ > n_looks_to_wait_; }

      /// Not again before it could be more than what is allowed if it grew four times as fast as it did, but soon all
      /// the same.
      void note(double value, double allowed);

      double value() const { return value_; } ///< when last measured

    private:
      double       value_           = 0; ///< when last measured
      unsigned int n_looks_         = 0; ///< calls of is_due() since then
      unsigned int n_looks_to_wait_ = 0;
    };

    // pfem_fluid.cc: one time step
    void              update_pressure();
    void              update_forces();
    void              accelerate(double time_step); ///< and the second half of the kick; 0: no kick [s]
    void              update_viscosity();
    void              update_body_acceleration();
    void              spend_contact_impulse(double time_step);
    void              add_interface_work();
    bool              is_diffusion_due(double time_step) const;
    void              diffuse_density();
    bool              is_filter_due();
    void              filter_velocity();
    void              refresh_surface();
    void              collect_interface_cells();
    double            largest_speed() const; ///< that is allowed [m/s]
    void              check_state() const;
    [[noreturn]] void fail_at_node(std::size_t node, double fastest) const;
    bool              is_strained();
    bool              may_gaps_close();
    /// Twice the limit is allowed in a part of the cells.
    template <class Count>
    bool is_too_much(double over_limit, const Count &n_cells_over) const;
    bool              needs_remeshing();

    // initial_nodes.cc
    void make_initial_state();
    void place_initial_nodes();
    void set_up_slip();
    void set_initial_velocity();
    void set_initial_pressure();

    // curved_walls.cc
    struct CurvedFacet
    {
      typename SimplexMesh<dim>::Facet nodes;
      Contacts                         faces; ///< of walls that all its nodes lie on
    };
    /// A volume between a facet and the wall, and its derivatives by the places of the facet's nodes.
    struct Cap
    {
      double                    volume = 0; ///< [m^dim]
      std::array<Vec<dim>, dim> gradient;   ///< [m^(dim - 1)]
    };
    void collect_curved_facets();
    void update_volumes();
    void add_cap_forces();

    Cap cap_of(const CurvedFacet &facet) const;

    // rim_facets.cc
    struct RimFacet
    {
      typename SimplexMesh<dim>::Cell  cell;
      typename SimplexMesh<dim>::Facet nodes;
      unsigned int                     opposite; ///< node of the cell
      Contacts                         faces;    ///< of walls that all its nodes lie on
    };
    void collect_rim_facets();
    void add_wedges();
    void add_wedge_forces();

    Cap wedge_of(const RimFacet &facet) const;

    // remeshing.cc
    void                  remesh();
    std::vector<Vec<dim>> interface_link_force() const;
    std::size_t           let_in();                            ///< new nodes at inflows; how many there are
    bool                  let_out(DomainBalance<dim> &before); ///< takes nodes in outflows away, from the balance too
    typename DelaunayMesh<dim>::Report triangulate(
      const std::function<bool(const typename SimplexMesh<dim>::Cell &)> &is_inside = {});
    void                classify_nodes();
    void                shift_to_centroids();
    void                find_slip_neighbours();
    void                correct_volumes(double energy, RemeshRecord &record);
    void                exchange(const NodePairs<dim> &pairs, RemeshRecord &record);
    void                sort_nodes();
    void                set_references(const NodePairs<dim> &pairs);
    std::vector<double> inertias() const;                        ///< of all nodes [kg]
    double              stiffest_volume(std::size_t node) const; ///< Vhat of a node that is not softened [m^dim]
    std::vector<double> softened_volumes(const NodePairs<dim> &pairs, const std::vector<double> &row_sums) const;
    void                set_cell_stiffness();
    void   update_time_step_bound(const std::vector<Vec<dim>> &position, const std::vector<double> &inertia,
                                  const std::vector<double> &row_sums);
    void   check_remesh(const RemeshRecord &record, const DomainBalance<dim> &before, const DomainBalance<dim> &after);
    double mesh_volume() const;
    double largest_body_acceleration() const; ///< at the last update [m/s^2]
    void   add_remeshing_row(const RemeshRecord &record, const DomainBalance<dim> &before,
                             const DomainBalance<dim> &after);

    // mesh_smoothing.cc
    void                     smooth_mesh(RemeshRecord &record);
    QualityReport            quality() const;
    std::vector<NodeFreedom> freedom_of_nodes(std::vector<Vec<dim>> &wall_normal);
    double                   spectral_bound_of_unsmoothed(); ///< [s]
    void                     move_to_smoothed(const std::vector<Vec<dim>> &position);

    DomainBalance<dim> node_balance(std::size_t node) const;

    /// Energy of the fluid less what openings, moving walls and the interface's link forces gave it [J].
    double own_energy(const DomainBalance<dim> &balance) const;

    PfemParameters<dim>    parameters_;
    std::string            name_;
    const BodyForces<dim> *body_forces_ = nullptr;
    RunContext            *context_     = nullptr;

    FluidNodes<dim>   nodes_;
    DelaunayMesh<dim> triangulation_;
    SimplexMesh<dim>  mesh_;
    SimplexMesh<dim>  unsmoothed_mesh_; ///< the same after the last remesh, as triangulated; empty without smoothers
    std::vector<CurvedFacet> curved_facets_; ///< of the mesh
    std::vector<RimFacet>    rim_facets_;    ///< facets of cells on walls, with a node of another body
    Gaps<dim>                gaps_;          ///< around the mesh
    AdoptedSurface<dim>      adopted_;
    InterfaceSlip<dim>       slip_; ///< along the adopted surfaces, if it is free
    ForceEffects             effects_;
    bool                     body_force_is_uniform_ = true;
    bool                     filters_velocity_      = true;
    bool                     is_sound_ = true;   ///< no node but the interface's is too fast after the last step
    std::vector<Vec<dim>>    body_acceleration_; ///< one for all nodes if uniform, else one per node [m/s^2]
    FilterBuffers            filter_buffers_;
    std::vector<double>      shear_rate_;          ///< of the cells of a fluid that is not Newtonian [1/s]
    std::vector<double>      cell_volume_at_rest_; ///< at the last remesh [m^dim]
    std::vector<double>      cell_viscosity_;      ///< of a fluid that is not Newtonian [Pa s]
    Vec<dim>                 slip_impulse_;    ///< that slip_ took from the interface nodes since the start [kg m/s]
    std::vector<Vec<dim>>    contact_impulse_; ///< of leaked nodes, to be given to the interface nodes [kg m/s]

    std::vector<unsigned int> interface_cells_; ///< cells of the mesh with interface nodes

    DomainBalance<dim> received_; ///< of all nodes that have come in, less those that have gone

    Watch         strain_watch_;
    Watch         gap_watch_;
    bool          gaps_asked_ = false; ///< for the remesh at hand
    double        time_                 = 0; ///< [s]
    double        bound_                = 0; ///< of the rule in use at the last remesh [s]
    double        sound_speed_at_bound_ = 0; ///< largest one then [m/s]
    double        largest_density_      = 0; ///< now
    double        last_time_step_       = 0; ///< [s]
    double        interface_work_       = 0; ///< of other bodies on the fluid at interface nodes since the start [J]
    double        energy_after_remesh_  = 0; ///< less the interface's work [J]
    double        diffusion_time_       = 0; ///< since the density was diffused [s]
    double        steps_since_filter_   = 0; ///< of the velocity, short ones in part [-]
    double        far_part_             = 1; ///< of the mass exchange, when it was last tried [-]
    double        volume_made_          = 0; ///< by remeshes since the start [m^dim]
    double        volume_lost_          = 0; ///< by remeshes since the start [m^dim]
    double        spectral_bound_       = 0; ///< Gershgorin's, at the last remesh [s]
    double        unsmoothed_bound_     = 0; ///< the same before smoothing, when it was last measured [s]
    unsigned int  n_softened_           = 0; ///< nodes, at the last remesh
    unsigned int  n_steps_to_check_     = 0; ///< until needs_remeshing() is asked again
    unsigned int  n_remeshes_           = 0;
    unsigned long n_wall_stops_         = 0; ///< nodes put back at walls
    unsigned long n_pushed_out_         = 0; ///< nodes put back out of a structure
  };
} // namespace Breakwater
