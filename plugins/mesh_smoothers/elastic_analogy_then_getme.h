#pragma once

#include "elastic_analogy.h"
#include "getme.h"

namespace Breakwater
{
  /// The combination of the paper: the elastic analogy, then GETMe for what is still bad.
  ///
  /// Neither can help slender cells whose nodes all lie on the free surface, as these nodes only slide: such cells are
  /// taken away (Peel), and GETMe looks at what was beside them again.
  template <int dim>
  class ElasticAnalogyThenGetme : public MeshSmoother<dim>
  {
  public:
    void declare_parameters(ParameterReader &reader) override;

  protected:
    void improve(SimplexMesh<dim> &mesh, std::vector<Vec<dim>> &position, const SmoothingTask<dim> &task,
                 SmoothingReport &report) override;

  private:
    ElasticControl elastic_;
    GetmeControl   getme_;
    double         largest_peel_ = 1e-4;
  };
} // namespace Breakwater
