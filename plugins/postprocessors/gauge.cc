#include "gauge.h"

#include <breakwater/base/parameter_reader.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <limits>

#include "domain_by_name.h"

namespace Breakwater
{
  namespace
  {
    struct Interval
    {
      double begin, end;
    };

    /// The part of the line p + s e inside a simplex, in s; end < begin if there is none. A point is inside where all
    /// barycentric coordinates 1 + (x - x_a) . grad l_a are >= 0, with V grad l_a = dV/dx_a.
    template <int dim>
    Interval clip(const Vec<dim> &p, const Vec<dim> &e, const Simplex<dim> &corners)
    {
      const double       volume = signed_volume(corners);
      const Simplex<dim> area   = area_vectors(corners);
      Interval           inside = {-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
      for (int a = 0; a <= dim; ++a)
        {
          const double value = volume + dot(area[a], p - corners[a]), slope = dot(area[a], e);
          if (slope > 0)
            inside.begin = std::max(inside.begin, -value / slope);
          else if (slope < 0)
            inside.end = std::min(inside.end, -value / slope);
          else if (value < 0)
            return {0., -1.};
        }
      return inside;
    }

    /// Length of the union: a wire that runs along a face is in two cells.
    double union_length(std::vector<Interval> intervals)
    {
      std::sort(intervals.begin(), intervals.end(), [](const Interval &a, const Interval &b) {
        return a.begin < b.begin;
      });
      double length = 0, end = -std::numeric_limits<double>::max();
      for (const Interval &interval : intervals)
        {
          length += std::max(0., interval.end - std::max(interval.begin, end));
          end = std::max(end, interval.end);
        }
      return length;
    }
  } // namespace


  template <int dim>
  void Gauge<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Domain", domain_name_, "Name of the fluid");
    reader.add("Place", place_, "A point of the wire [m]");
    reader.add("Direction", direction_, "Direction of the wire; its length does not matter");
    reader.add("Name", name_, "The column of history.csv is \"NAME height [m]\": the wet length of the wire");
  }


  template <int dim>
  void Gauge<dim>::check_parameters(ParameterReader &reader)
  {
    const double length = norm(direction_);
    if (!(length > 0))
      reader.fail("Direction", "needs a component that is not zero");
    direction_ *= 1 / length;
  }


  template <int dim>
  void Gauge<dim>::setup(const std::vector<std::pair<std::string, const ExplicitDomain<dim> *>> &domains)
  {
    domain_ = &domain_by_name(domains, domain_name_, "Gauge");
  }


  template <int dim>
  void Gauge<dim>::add_history(const double, Row &row)
  {
    const OutputMesh<dim> mesh = domain_->output_mesh();
    std::vector<Interval> wet;
    if (mesh.vertices_per_cell == dim + 1)
      for (std::size_t first = 0; first < mesh.cells.size(); first += dim + 1)
        {
          Simplex<dim> corners;
          for (int a = 0; a <= dim; ++a)
            corners[a] = mesh.position[mesh.cells[first + a]];
          const Interval inside = clip(place_, direction_, corners);
          if (inside.end > inside.begin)
            wet.push_back(inside);
        }
    row.emplace_back(name_ + " height [m]", union_length(std::move(wet)));
  }


  template class Gauge<2>;
  template class Gauge<3>;
} // namespace Breakwater
