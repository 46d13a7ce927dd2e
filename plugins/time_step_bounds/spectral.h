#pragma once

#include <breakwater/interfaces/time_step_bound.h>

#include <string>

namespace Breakwater
{
  /// The stable step of the nodal-pressure fluid from the largest frequency of its linearised operator M^-1 D^T W D.
  ///
  /// Undamped, central differences are stable for dt < 2 / omega_max; with a damping force taken at the half step
  /// (largest eigenvalue lambda of M^-1 C), for dt^2 omega^2 / 4 + dt lambda / 2 < 1.
  ///
  /// `gershgorin` bounds omega_max from above by row sums, at the cost of two passes over the cells: always safe, and
  /// at most 1.5 to 2.5 times too careful on Delaunay meshes. `power iteration` approaches the true omega_max from
  /// below, with a warm start from the last call; it costs two passes per iteration.
  template <int dim>
  class SpectralBound : public TimeStepBound<dim>
  {
  public:
    void   declare_parameters(ParameterReader &reader) override;
    double bound(const LinearizedFluid<dim> &fluid) override;

  private:
    double largest_frequency_squared(const LinearizedFluid<dim> &fluid);

    std::string           method_       = "gershgorin";
    unsigned int          n_iterations_ = 20;
    std::vector<Vec<dim>> vector_; ///< last eigenvector, for the warm start
  };
} // namespace Breakwater
