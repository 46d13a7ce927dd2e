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
  Peel<dim>::Peel(StarMesh<dim> &mesh, const VolumeBudget &budget)
    : mesh_(mesh)
    , budget_(budget)
  {
  }


  template <int dim>
  void Peel<dim>::declare(ParameterReader &reader, double &largest_part)
  {
    reader.add(
      "Largest peel", largest_part,
      "Slender cells of the free surface may be taken away, and its nodes moved off it, up to this part of the "
      "mesh's volume [-].",
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
  bool Peel<dim>::may_open(const Facet &facet) const
  {
    return has_surface_node<dim>(mesh_, facet) ||
           std::all_of(facet.begin(), facet.end(), [this](const unsigned int node) {
             return is_on_surface(mesh_.freedom(node));
           });
  }


  template <int dim>
  bool Peel<dim>::is_fixed(const Facet &facet) const
  {
    return std::all_of(facet.begin(), facet.end(), [this](const unsigned int node) {
      return mesh_.freedom(node) == NodeFreedom::fixed;
    });
  }


  template <int dim>
  bool Peel<dim>::may_bare_wall(const Facet &facet) const
  {
    return std::any_of(facet.begin(), facet.end(), [this](const unsigned int node) {
      return is_on_surface(mesh_.freedom(node));
    });
  }


  template <int dim>
  bool Peel<dim>::try_cell(const unsigned int c, const Limits &limits)
  {
    constexpr double largest_height = 0.35;
    const double     thickest_film  = limits.may_bare_walls ? 0.15 : 0.05;
    const auto       cell           = mesh_.cell(c);
    const bool       is_film        = height(c) <= thickest_film * mesh_.spacing();
    unsigned int     n_inner        = 0;
    for (const unsigned int node : cell)
      {
        n_inner += !mesh_.is_on_boundary(node);
        if (mesh_.star(node).size() < 2)
          return false;
      }
    if (n_inner > (limits.may_bare_walls && is_film ? 1 : 0) || height(c) > largest_height * mesh_.spacing() ||
        !budget_.allows(-signed_volume(mesh_.corners_of(c)), limits.part))
      return false;

    std::vector<Facet> opened, closed;
    sort_facets(c, opened, closed);
    const bool may_open_all = std::all_of(closed.begin(), closed.end(), [&](const Facet &facet) {
      return may_open(facet) || (is_film && !is_fixed(facet)) || (limits.may_bare_walls && may_bare_wall(facet));
    });
    if (closed.empty() || !may_open_all)
      return false;
    budget_.spend(-signed_volume(mesh_.corners_of(c)));
    take(c, opened, closed);
    return true;
  }


  template <int dim>
  bool Peel<dim>::free_nodes(const unsigned int c)
  {
    const auto cell    = mesh_.cell(c);
    const auto is_last = [this](const unsigned int node) {
      return mesh_.star(node).size() == 1;
    };
    for (const unsigned int node : cell)
      if (!mesh_.was_on_surface(node))
        return false;
    const unsigned int n_last = std::count_if(cell.begin(), cell.end(), is_last);
    const double       change = n_last == dim + 1 ? 0. : -signed_volume(mesh_.corners_of(c));
    if (n_last == 0 || !budget_.allows(change))
      return false;
    std::vector<Facet> opened, closed;
    sort_facets(c, opened, closed);
    budget_.spend(change);
    n_freed_ += n_last;
    take(c, opened, closed);
    return true;
  }


  template <int dim>
  void Peel<dim>::sort_facets(const unsigned int c, std::vector<Facet> &opened, std::vector<Facet> &closed) const
  {
    for (int a = 0; a <= dim; ++a)
      {
        Facet      facet    = outward_facet<dim>(mesh_.cell(c), a);
        const bool is_outer = is_exposed(c, facet);
        if (!is_outer)
          std::swap(facet[0], facet[1]);
        (is_outer ? closed : opened).push_back(rotated(facet));
      }
  }


  template <int dim>
  void Peel<dim>::take(const unsigned int c, const std::vector<Facet> &opened, const std::vector<Facet> &closed)
  {
    ++n_cells_;
    volume_ += signed_volume(mesh_.corners_of(c));
    for (const unsigned int node : mesh_.cell(c))
      if (!mesh_.is_on_boundary(node))
        mesh_.expose(node);
    mesh_.remove(c);
    opened_.insert(opened_.end(), opened.begin(), opened.end());
    closed_.insert(closed_.end(), closed.begin(), closed.end());
  }


  template <int dim>
  bool Peel<dim>::worst_first()
  {
    bool has_peeled = false;
    for (const unsigned int c : mesh_.bad_cells())
      has_peeled = try_cell(c, {}) || has_peeled;
    return has_peeled;
  }


  template <int dim>
  void Peel<dim>::finish(SmoothingReport &report)
  {
    report.n_peeled_cells = n_cells_;
    report.n_freed_nodes  = n_freed_;
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
