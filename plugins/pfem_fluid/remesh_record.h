#pragma once

#include "mass_exchange.h"
#include "node_management.h"
#include "pfem_fluid.h"

#include <breakwater/mesh/quality_report.h>

namespace Breakwater
{
  template <int dim>
  struct PfemFluid<dim>::RemeshRecord
  {
    QualityReport                      quality_before, quality_after; ///< smoothing between
    SmoothingReport                    smoothing;
    typename DelaunayMesh<dim>::Report triangulation;
    double                             correction_scale      = 0; ///< of the position correction, by the energy limiter
    double                             triangulation_seconds = 0;
    double                             transfer_seconds      = 0;
    unsigned int                       n_pushed_out          = 0;
    ExchangeReport                     exchange;
    double                             volume_made = 0;         ///< by the new mesh [m^dim]
    Vec<3>                             angular_momentum_change; ///< [kg m^2/s]
    NodeChanges                        node_changes;
  };
} // namespace Breakwater
