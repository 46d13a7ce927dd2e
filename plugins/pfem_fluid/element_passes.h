#pragma once

#include <cstddef>

namespace Breakwater
{
  /// Four doubles of one node, one load of a vector register. Components that 2D does not need are zero.
  struct alignas(32) Quad
  {
    double c[4] = {};

    double       &operator[](const std::size_t d) { return c[d]; }
    const double &operator[](const std::size_t d) const { return c[d]; }
  };

  /// What the force pass computes besides pressure: chosen once per scene, compiled apart, so that an effect which is
  /// not in the scene costs nothing.
  struct ForceEffects
  {
    bool          viscous              = false;
    bool          density_diffusion    = false;
    double        viscosity            = 0;       ///< of all cells [Pa s]
    const double *cell_viscosity       = nullptr; ///< of each cell [Pa s], where it is not the same
    double        least_viscous_volume = 0; ///< cells smaller than this count as this big in viscous forces [m^dim]
    double        cell_stiffness       = 0; ///< of the cells' own pressure against a change of their volume [Pa]
    double        least_cell_volume    = 0; ///< cells smaller than this count as this big in their own pressure [m^dim]
    const double *cell_volume_at_rest  = nullptr; ///< at which the cells' own pressure is zero [m^dim]
  };

  /// Weights of the velocity filter, see filter_impulses() in kernels.h.
  struct FilterWeights
  {
    double deviation  = 0; ///< of what deviates from a locally linear velocity [-]
    double divergence = 0; ///< of what deviates from the mean divergence around [-]
  };

  /// The loops over cells, compiled once per instruction set (element_passes.cc, stress_passes.cc, filter_pass.cc,
  /// mesh_passes.cc). Cells are arrays [cell][dim + 1].
  struct ElementPasses
  {
    void (*volumes)(const unsigned int *cells, std::size_t n_cells, const Quad *xp, double *volume);
    /// By [viscous][density diffusion].
    void (*forces[2][2])(const unsigned int *cells, std::size_t n_cells, const ForceEffects &effects, const Quad *xp,
                         const Quad *v, const Quad *density_slope, Quad *force);
    /// Shear rates sqrt(2 D:D) of the cells [1/s], D the rate of deformation; small volumes count as in the forces.
    void (*shear_rates)(const unsigned int *cells, std::size_t n_cells, double least_volume, const Quad *xp,
                        const Quad *v, double *shear_rate);
    /// Adds to gradient [node][dim rows] the integrals of grad v_d: sum over cells of V_c grad v_d / (dim + 1).
    void (*velocity_gradients)(const unsigned int *cells, std::size_t n_cells, const Quad *xp, const Quad *v,
                               Quad *gradient);
    /// Adds the impulses of the velocity filter, see filter_impulses() in kernels.h.
    void (*filter_impulses)(const unsigned int *cells, std::size_t n_cells, const FilterWeights &weights,
                            const Quad *xp, const Quad *v, const Quad *gradient, const double *node_density,
                            const double *inverse_mass, Quad *impulse);
    /// First half of the mass exchange: `request` [cell][corner] is what each corner would get,
    /// -weight (psi_a - mean psi) over the corners that take part (`active` 1, else 0); `given` and `taken` add up what
    /// nodes give and get.
    void (*exchange_requests)(const unsigned int *cells, std::size_t n_cells, const double *cell_weight,
                              const double *psi, const double *active, Quad *request, double *given, double *taken);
    /// Second half: moves the requested mass, scaled by the least `part` of the cell's donors. The velocity that goes
    /// with it is (1 + t) / 2 of the donor's and (1 - t) / 2 of the receiver's, t the largest `turnover` of the cell's
    /// corners, at most 1. `v` has 1 in its fourth component; `received` gets momentum, and mass in the fourth.
    void (*exchange_transfers)(const unsigned int *cells, std::size_t n_cells, const Quad *request, const double *part,
                               const double *turnover, const Quad *v, Quad *received);
    /// Sums over the cells that a node shares with each of its neighbours; see NodePairs.
    /// @param corners of the cells at the node: corner a of cell c as c (dim + 1) + a
    /// @param active nodes count for the mass exchange
    /// @param place_of of all nodes; those greater than `first` are the neighbours that are known already
    /// @param around the neighbours found, each `place_of` - first - 1 of them; room for dim n_corners
    /// @param sum for each neighbour, of A_k, and in the fourth component of |V_c| / (2 (dim + 1) n_c); room as well
    /// @param own the same over all cells of the node
    /// @return number of neighbours
    /// @pre 24 more entries can be read behind the last corner, each of a valid cell
    unsigned int (*pairs_around)(const unsigned int *cells, const unsigned int *corners, std::size_t n_corners,
                                 const Quad *x, const char *active, unsigned int first, unsigned int *place_of,
                                 unsigned int *around, Quad *sum, Quad *own);
    /// Adds to `change` the first-order changes of the nodes' volumes by displacements u [m]:
    /// sum over cells of sum_a A_a . u_a / (dim + 1) [m^dim].
    void (*volume_changes)(const unsigned int *cells, std::size_t n_cells, const Quad *xp, const Quad *u,
                           double *change);
    /// Signed volumes of the cells [m^dim].
    void (*cell_volumes)(const unsigned int *cells, std::size_t n_cells, const Quad *xp, double *volume);
    /// Insphere radii of the cells [m], signed as their volumes.
    void (*insphere_radii)(const unsigned int *cells, std::size_t n_cells, const Quad *xp, double *radius);
    /// Squares of the lengths of each cell's shortest and longest edge [m^2].
    void (*edge_squares)(const unsigned int *cells, std::size_t n_cells, const Quad *xp, double *shortest,
                         double *longest);
    double (*largest_relative_displacement)(const unsigned int *cells, std::size_t n_cells, const Quad *x,
                                            const Quad *x0);
  };

  namespace Baseline
  {
    template <int dim>
    ElementPasses element_passes();
  }
  namespace Avx2
  {
    template <int dim>
    ElementPasses element_passes();
  }
} // namespace Breakwater
