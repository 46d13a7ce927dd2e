#include "peel.h"

#include <breakwater/base/parameter_reader.h>

#include <algorithm>

namespace Breakwater
{
  namespace
  {
    /// The same facet, the same side up, with its lowest node first.
    template <class Facet>
    Facet rotated(Facet facet)
    {
      if (facet.size() > 2)
        std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
      return facet;
    }

    template <int dim, class Nodes>
    bool has_surface_node(const StarMesh<dim> &mesh, const Nodes &nodes)
    {
      return std::any_of(nodes.begin(), nodes.end(), [&mesh](const unsigned int node) {
        return mesh.freedom(node) == NodeFreedom::slides_on_surface;
      });
    }
  } // namespace


  template <int dim>
  Peel<dim>::Peel(StarMesh<dim> &mesh, const double largest_part)
    : mesh_(mesh)
  {
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.is_alive(c))
        allowed_volume_ += largest_part * signed_volume(mesh.corners_of(c));
  }


  template <int dim>
  void Peel<dim>::declare(ParameterReader &reader, double &largest_part)
  {
    reader.add("Largest peel", largest_part,
               "Slender cells of the free surface may be taken away up to this part of the mesh's volume [-].",
               {0., 0.01});
  }


  template <int dim>
  bool Peel<dim>::is_exposed(const unsigned int c, const Facet &facet) const
  {
    for (const unsigned int other : mesh_.star(facet[0]))
      {
        const auto &cell = mesh_.cell(other);
        const auto  has  = [&](const unsigned int node) {
          return std::find(cell.begin(), cell.end(), node) != cell.end();
        };
        if (other != c && std::all_of(facet.begin(), facet.end(), has))
          return false;
      }
    return true;
  }


  template <int dim>
  double Peel<dim>::height(const unsigned int c) const
  {
    double largest = 0; // area vector: facet's measure over dim
    for (const Vec<dim> &area : area_vectors(mesh_.corners_of(c)))
      largest = std::max(largest, norm(area));
    return largest > 0 ? signed_volume(mesh_.corners_of(c)) / largest : 0.;
  }


  // Between nodes on the line where surface and wall meet, the fluid draws back along the wall.
  template <int dim>
  bool Peel<dim>::may_open(const Facet &facet)
  {
    return has_surface_node<dim>(mesh_, facet) || std::all_of(facet.begin(), facet.end(), [&](const unsigned int node) {
             if (mesh_.freedom(node) != NodeFreedom::slides_on_line)
               return false;
             mesh_.boundary_facets(node, around_);
             return std::any_of(around_.begin(), around_.end(), [this](const Facet &other) {
               return has_surface_node<dim>(mesh_, other);
             });
           });
  }


  template <int dim>
  bool Peel<dim>::try_cell(const unsigned int c)
  {
    constexpr double largest_height = 0.35, thickest_film = 0.05;
    const auto       cell = mesh_.cell(c);
    for (const unsigned int node : cell)
      if (!mesh_.is_on_boundary(node) || mesh_.star(node).size() < 2)
        return false;
    const double volume = signed_volume(mesh_.corners_of(c));
    if (height(c) > largest_height * mesh_.spacing() || volume_ + volume > allowed_volume_)
      return false;

    // A film between a wall and a node of the surface that hardly stands off it.
    const bool is_film = height(c) <= thickest_film * mesh_.spacing() && has_surface_node<dim>(mesh_, cell) &&
                         std::none_of(cell.begin(), cell.end(), [this](const unsigned int node) {
                           return mesh_.freedom(node) == NodeFreedom::fixed;
                         });

    std::vector<Facet> opened, closed;
    for (int a = 0; a <= dim; ++a)
      {
        Facet facet = outward_facet<dim>(cell, a);
        if (!is_exposed(c, facet))
          {
            std::swap(facet[0], facet[1]);
            opened.push_back(rotated(facet));
            continue;
          }
        if (!may_open(facet) && !is_film)
          return false;
        closed.push_back(rotated(facet));
      }
    if (closed.empty())
      return false;
    mesh_.remove(c);
    opened_.insert(opened_.end(), opened.begin(), opened.end());
    closed_.insert(closed_.end(), closed.begin(), closed.end());
    ++n_cells_;
    volume_ += volume;
    return true;
  }


  template <int dim>
  bool Peel<dim>::worst_first()
  {
    bool has_peeled = false;
    for (const unsigned int c : mesh_.bad_cells())
      has_peeled = try_cell(c) || has_peeled;
    return has_peeled;
  }


  template <int dim>
  void Peel<dim>::finish(SmoothingReport &report)
  {
    report.n_peeled_cells = n_cells_;
    report.peeled_volume  = volume_;
    if (n_cells_ == 0)
      return;
    std::vector<Facet> all = opened_, result;
    for (const Facet &facet : mesh_.mesh().boundary)
      all.push_back(rotated(facet));
    std::sort(all.begin(), all.end());
    std::sort(closed_.begin(), closed_.end());
    std::set_difference(all.begin(), all.end(), closed_.begin(), closed_.end(), std::back_inserter(result));
    mesh_.mesh().boundary = result;
  }

  template class Peel<2>;
  template class Peel<3>;
} // namespace Breakwater
