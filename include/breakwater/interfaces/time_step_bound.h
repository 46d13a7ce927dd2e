#pragma once

#include <breakwater/base/plugin.h>
#include <breakwater/mesh/simplex_mesh.h>

#include <vector>

namespace Breakwater
{
  /// The linearised fluid at one instant, as a bound on the stable step sees it.
  ///
  /// Small displacements u of the nodes obey M u'' = -D^T W D u, with nodal volumes V_i, D = dV/dx,
  /// W = diag(rho c^2 / Vhat) and, with viscosity, a damping force.
  template <int dim>
  struct LinearizedFluid
  {
    const SimplexMesh<dim>      &mesh;
    const std::vector<Vec<dim>> &position;  ///< [m]
    const std::vector<double>   &mass;      ///< [kg], mass that moves with the node; > 0 where a cell touches the node
    const std::vector<double>   &stiffness; ///< W_i [Pa/m^dim]
    const std::vector<double>   &sound_speed;          ///< at the nodes [m/s]
    const std::vector<double>   &row_sums;             ///< b_i of NodePairs::row_sums() [m^(2 dim - 2) / kg]
    double                       viscosity;            ///< largest one [Pa s], 0: none
    double                       least_viscous_volume; ///< cell volumes below count as this in viscous forces [m^dim]
  };

  /// A rule for the largest stable step of the fluid.
  template <int dim>
  class TimeStepBound : public Plugin
  {
  public:
    static constexpr const char *interface_name = "time step bound";
    static constexpr int         dimension      = dim;

    /// The bound [s], without any safety fraction; infinite for a mesh without cells.
    virtual double bound(const LinearizedFluid<dim> &fluid) = 0;
  };
} // namespace Breakwater
