#include "elastic_analogy_then_getme.h"

#include "peel.h"

#include <breakwater/base/parameter_reader.h>

namespace Breakwater
{
  template <int dim>
  void ElasticAnalogyThenGetme<dim>::declare_parameters(ParameterReader &reader)
  {
    elastic_.declare(reader);
    getme_.declare(reader);
    Peel<dim>::declare(reader, largest_peel_);
  }


  template <int dim>
  void ElasticAnalogyThenGetme<dim>::improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position,
                                             const SmoothingTask<dim> &task, SmoothingReport &report)
  {
    StarMesh<dim> work(mesh, position, task);
    Peel<dim>     peel(work, VolumeBudget(largest_peel_ * work.volume()));
    relax_elastically(work, elastic_);
    smooth_by_transformations(work, getme_);
    if (peel.worst_first())
      smooth_by_transformations(work, getme_);
    peel.finish(report);
    work.finish(report);
  }

  template class ElasticAnalogyThenGetme<2>;
  template class ElasticAnalogyThenGetme<3>;
} // namespace Breakwater
