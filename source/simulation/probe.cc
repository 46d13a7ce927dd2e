#include <breakwater/base/exceptions.h>
#include <breakwater/base/nearest_name.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/simulation/probe.h>

#include <algorithm>
#include <sstream>

namespace Breakwater
{
  namespace
  {
    /// The positions of an output mesh without its displacements.
    template <int dim>
    std::vector<Vec<dim>> undeformed_positions(const OutputMesh<dim> &mesh)
    {
      std::vector<Vec<dim>> positions = mesh.position;
      for (const auto &field : mesh.fields)
        if (field.name == "displacement" && field.n_components == dim)
          for (std::size_t i = 0; i < positions.size(); ++i)
            for (int d = 0; d < dim; ++d)
              positions[i][d] -= field.values[i * dim + d];
      return positions;
    }

    template <int dim>
    unsigned int nearest_node(const std::vector<Vec<dim>> &positions, const Vec<dim> &point)
    {
      const auto nearer = [&point](const Vec<dim> &a, const Vec<dim> &b) {
        return norm(a - point) < norm(b - point);
      };
      return std::min_element(positions.begin(), positions.end(), nearer) - positions.begin();
    }

    template <int dim>
    double longest_edge_at(const unsigned int node, const std::vector<unsigned int> &cells,
                           const unsigned int vertices_per_cell, const std::vector<Vec<dim>> &positions)
    {
      double longest = 0;
      for (std::size_t first = 0; first < cells.size(); first += vertices_per_cell)
        {
          const auto begin = cells.begin() + first, end = begin + vertices_per_cell;
          const auto here = std::find(begin, end, node);
          if (here == end)
            continue;
          // In deal.II's order, neighbours along an edge differ in one bit; any two vertices of a simplex are.
          const unsigned int v = here - begin;
          for (unsigned int w = 0; w < vertices_per_cell; ++w)
            if (vertices_per_cell == dim + 1 || ((v ^ w) & ((v ^ w) - 1)) == 0)
              longest = std::max(longest, norm(positions[begin[w]] - positions[node]));
        }
      return longest;
    }

    template <int dim>
    std::string point_text(const Vec<dim> &point)
    {
      std::ostringstream text;
      text.precision(8);
      for (int d = 0; d < dim; ++d)
        text << (d == 0 ? "(" : ", ") << point[d];
      return text.str() + ")";
    }
  } // namespace

  std::vector<ProbePlace> parse_probes(const std::string &text)
  {
    std::vector<ProbePlace> probes;
    std::istringstream      stream(text);
    for (std::string part; std::getline(stream, part, ';');)
      {
        part = trim(part);
        if (part.empty())
          continue;
        const std::size_t colon = part.find(':'), open = part.find('(');
        if (colon == std::string::npos || open == std::string::npos || open < colon || part.back() != ')')
          throw InputError("can't read the probe \"" + part + "\"; the form is NAME: STRUCTURE(x, y, z), several of " +
                           "them separated by semicolons");
        ProbePlace probe{trim(part.substr(0, colon)), trim(part.substr(colon + 1, open - colon - 1)), {}};
        for (const std::string &number : split_list(part.substr(open + 1, part.size() - open - 2)))
          {
            char *end = nullptr;
            probe.point.push_back(std::strtod(number.c_str(), &end));
            if (*end != '\0')
              throw InputError("\"" + number + "\" in the probe \"" + part + "\" is no number");
          }
        probes.push_back(probe);
      }
    return probes;
  }

  template <int dim>
  Probe<dim>::Probe(const ProbePlace &place, const ExplicitDomain<dim> &domain)
    : name_(place.name)
    , domain_(&domain)
  {
    if (place.point.size() != dim)
      throw InputError("the point of the probe \"" + name_ + "\" needs " + std::to_string(dim) + " coordinates");
    Vec<dim> point;
    std::copy(place.point.begin(), place.point.end(), point.c);

    const OutputMesh<dim>       mesh      = domain.output_mesh();
    const std::vector<Vec<dim>> positions = undeformed_positions(mesh);
    node_                                 = nearest_node(positions, point);
    undeformed_                           = positions[node_];
    const double distance                 = norm(undeformed_ - point);
    const double allowed                  = 0.1 * longest_edge_at(node_, mesh.cells, mesh.vertices_per_cell, positions);
    if (distance > allowed)
      {
        std::ostringstream text;
        text << "the probe \"" << name_ << "\" is " << distance << " m away from the nearest node of \"" << place.domain
             << "\", at " << point_text(undeformed_) << "; allowed is a tenth of the mesh size there, " << allowed
             << " m. Name that node's place";
        throw InputError(text.str());
      }

    // Read the node from the wet surface if it is there.
    const std::vector<Vec<dim>> &surface = domain.wet_surface().position;
    if (!surface.empty())
      {
        const unsigned int candidate = nearest_node(surface, mesh.position[node_]);
        if (norm(surface[candidate] - mesh.position[node_]) <= 1e-9 * allowed)
          {
            is_on_surface_ = true;
            node_          = candidate;
          }
      }
  }

  template <int dim>
  void Probe<dim>::add_history(Row &row) const
  {
    const Vec<dim> position =
      is_on_surface_ ? domain_->wet_surface().position[node_] : domain_->output_mesh().position[node_];
    for (int d = 0; d < dim; ++d)
      row.emplace_back(name_ + " displacement " + "xyz"[d] + " [m]", position[d] - undeformed_[d]);
  }

  template class Probe<2>;
  template class Probe<3>;
} // namespace Breakwater
