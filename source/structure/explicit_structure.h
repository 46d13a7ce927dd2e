#pragma once

#include "cell_kernel.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/interfaces/explicit_domain.h>
#include <breakwater/interfaces/material.h>

#include <memory>
#include <string>
#include <vector>

namespace Breakwater
{
  /// A total-Lagrangian solid of hexahedra or quadrilaterals with lumped mass, advanced by velocity Verlet.
  ///
  /// M' a = F_int(u) + M g - alpha M v + link forces, M' = M less what is lent. The damping force takes v(n) + dt/2 a(n), as explicit codes do:
  /// with it the step stays explicit, and stable up to 2/omega (sqrt(1 + xi^2) - xi), xi = alpha / (2 omega)
  /// (Belytschko, Liu, Moran, Nonlinear Finite Elements, 2nd ed., section 6.2). Held nodes never move.
  template <int dim>
  class ExplicitStructure : public ExplicitDomain<dim>
  {
  public:
    ExplicitStructure();

    void declare_parameters(ParameterReader &reader) override;
    void check_parameters(ParameterReader &reader) override;

    void   setup(const std::string &name, const BodyForces<dim> &body_forces, RunContext &context) override;
    double stable_time_step() const override;
    void   advance_free(double time_step) override;
    void   add_link_force(const std::vector<Vec<dim>> &force, double time_step) override;
    void   end_step() override;

    const WetSurface<dim> &wet_surface() const override { return wet_surface_; }
    unsigned int           adopt_surface(const WetSurface<dim> &partner) override;
    bool                   can_adopt_surface() const override { return false; }
    void                   lend_mass(const std::vector<double> &mass) override;
    void                   correct_surface(const std::vector<Vec<dim>> &position) override;

    std::vector<Stop<dim>> stops(unsigned int node) const override;
    void                   set_stops(unsigned int node, const std::vector<Stop<dim>> &stops) override;

    DomainBalance<dim> balance() const override;
    void               add_history(Row &row) override;
    OutputMesh<dim>    output_mesh() const override;
    void               save(std::ostream &stream) const override;
    void               load(std::istream &stream) override;

  private:
    /// Shows visit() all that a checkpoint holds.
    template <class Structure, class Visitor>
    static void visit_state(Structure &structure, const Visitor &visit);

    /// What other bodies and stops gave: impulse and angular impulse about the reference point.
    struct Load
    {
      Vec<dim> impulse; ///< [N s]
      Vec<3>   moment;  ///< [N m s]
    };

    void update_free_acceleration(std::size_t node);
    void stop_at_planes(double time_step);
    void add_load(std::size_t node, const Vec<dim> &impulse);
    void make_wet_surface();
    void update_wet_surface();
    void update_wet_mass();
    void act(double duration);
    void compute_force();
    void add_body_forces();
    void bound_frequency();

    [[noreturn]] void fail_not_finite() const;

    PluginList<Material<dim>> material_;
    std::string               mesh_text_;
    std::string               mapping_text_; ///< empty: none
    unsigned int              degree_ = 2;
    std::vector<std::string>  clamp_names_;
    std::vector<std::string>  wet_names_       = {"all"};
    bool                      body_forces_act_ = true;
    double                    fraction_        = 0.9; ///< of the bound on the step
    double                    damping_         = 0;   ///< alpha [1/s]
    std::string               stops_text_;
    std::string               initial_velocity_text_;
    Vec<dim>                  reference_point_; ///< of the moments [m]

    BoxMesh<dim>              box_{};
    std::array<bool, 2 * dim> is_clamped_{}; ///< [boundary]
    std::array<bool, 2 * dim> is_wet_{};     ///< [boundary]

    std::string                      name_;
    const BodyForces<dim>           *body_forces_ = nullptr;
    RunContext                      *context_     = nullptr;
    SolidMesh<dim>                   mesh_;
    std::unique_ptr<CellKernel<dim>> kernel_;
    std::vector<double>              mass_;         ///< [kg]
    std::vector<double>              inertia_;      ///< the mass that is not lent [kg]
    std::vector<double>              inverse_mass_; ///< of the inertia [1/kg], 0 at held nodes
    WetSurface<dim>                  wet_surface_;
    std::vector<unsigned int>        wet_nodes_;  ///< [node of wet_surface_]
    std::vector<Vec<dim>>            link_force_; ///< in the present accelerations, [node of wet_surface_] [N]
    Load                             load_;       ///< since the last row of the history

    /// The scene's, then those of nodes that others share.
    std::vector<std::vector<Stop<dim>>> stop_lists_ = std::vector<std::vector<Stop<dim>>>(1);
    std::vector<unsigned int>           list_of_node_; ///< number in stop_lists_; empty if there are no stops

    double                time_             = 0;      ///< [s]
    double                time_step_        = 0;      ///< of the step that end_step() has not ended yet, else 0 [s]
    double                time_of_last_row_ = 0;      ///< of the history [s]
    std::vector<Vec<dim>> displacement_;              ///< [m]
    std::vector<Vec<dim>> velocity_;                  ///< [m/s]
    std::vector<Vec<dim>> acceleration_;              ///< [m/s^2], link forces included
    CellEigenvalues       eigenvalues_;               ///< of the cells, for the stable step
    double                largest_frequency_     = 0; ///< bound on it, with all of the mass [rad/s]
    double                largest_mass_ratio_    = 1; ///< mass over inertia of a node
    double                smallest_volume_ratio_ = 1; ///< of a cell at the last force evaluation

    std::vector<Vec<dim>> position_;          ///< work: current positions [m]
    std::vector<Vec<dim>> force_;             ///< work: internal force [N]
    std::vector<Vec<dim>> body_acceleration_; ///< [m/s^2]; computed once if the body forces are uniform
    bool                  body_acceleration_is_fixed_ = false;
  };
} // namespace Breakwater
