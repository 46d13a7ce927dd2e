#pragma once

#include <pfem_fluid/walls.h>
#include <unit/plugins/given_parameters.h>

namespace Breakwater
{
  /// The parameters of walls with one section, named Tank.
  class OneWall : public GivenParameters
  {
  public:
    explicit OneWall(const std::map<std::string, std::string> &values)
      : GivenParameters(values)
    {
    }
    explicit OneWall(const std::string &shape, const std::string &law = "free slip")
      : GivenParameters(std::map<std::string, std::string>{{"Shape", shape}, {"Law", law}})
    {
    }
    std::vector<std::string> section_titles() const override { return {"Tank"}; }
  };

  template <int dim>
  Walls<dim> walls_of(OneWall reader)
  {
    Walls<dim> walls;
    walls.declare_parameters(reader);
    walls.check_parameters(reader);
    return walls;
  }
} // namespace Breakwater
