#pragma once

#include <breakwater/interfaces/explicit_domain.h>

#include <memory>

namespace Breakwater
{
  /// A solid body of quadrilaterals or hexahedra of degree 1 or 2: total Lagrangian, lumped mass, explicit in time.
  /// Its parameters are the entries of one section below "Structures". MPI must be initialised before it is set up.
  template <int dim>
  std::unique_ptr<ExplicitDomain<dim>> make_structure();
} // namespace Breakwater
