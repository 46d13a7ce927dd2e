#include "structure_contact.h"

#include "nearest_place.h"

#include <breakwater/mesh/area_vector.h>

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  template <int dim>
  unsigned int AdoptedSurface<dim>::append(const WetSurface<dim> &body)
  {
    const auto add = [](auto &values, const auto &more) {
      values.insert(values.end(), more.begin(), more.end());
    };
    const unsigned int first       = n_nodes();
    const std::size_t  first_piece = pieces_.size();
    const unsigned int first_body  = surface_.bodies.size();
    add(surface_.bodies, body.bodies);
    for (const unsigned int number : body.body_of_facet)
      surface_.body_of_facet.push_back(first_body + number);
    add(surface_.position, body.position);
    add(surface_.velocity, body.velocity);
    add(surface_.acceleration, body.acceleration);
    add(surface_.inverse_mass, body.inverse_mass);
    add(surface_.mass, body.mass);
    for (auto facet : body.facets)
      {
        for (unsigned int &i : facet)
          i += first;
        surface_.facets.push_back(facet);
        if constexpr (dim == 2)
          pieces_.push_back(facet);
        else
          {
            pieces_.push_back({facet[0], facet[1], facet[2]});
            pieces_.push_back({facet[0], facet[2], facet[3]});
          }
      }
    end_of_body_.push_back(n_nodes());
    pieces_of_node_.resize(n_nodes());
    for (std::size_t f = first_piece; f < pieces_.size(); ++f)
      for (const unsigned int i : pieces_[f])
        pieces_of_node_[i].push_back(f);
    ++surface_.revision;
    update_normals();
    return first;
  }


  template <int dim>
  void AdoptedSurface<dim>::update_normals()
  {
    normals_.resize(pieces_.size());
    centers_.resize(pieces_.size());
    radii_.resize(pieces_.size());
    for (std::size_t f = 0; f < pieces_.size(); ++f)
      {
        const auto    &x      = surface_.position;
        const Vec<dim> normal = area_vector<dim>(x, pieces_[f]);
        Vec<dim>       center;
        for (const unsigned int i : pieces_[f])
          center += x[i] * (1. / dim);
        normals_[f] = normal * (1. / norm(normal));
        centers_[f] = center;
        radii_[f]   = 0;
        for (const unsigned int i : pieces_[f])
          radii_[f] = std::max(radii_[f], norm(x[i] - center));
      }
  }


  template <int dim>
  bool AdoptedSurface<dim>::accepts(const Cell &cell, const FluidNodes<dim> &nodes) const
  {
    // A bent surface is not flat between its nodes: allow them to see each other past a small angle.
    constexpr double sine_between_interface_nodes = 0.25;
    constexpr double sine_to_fluid_nodes          = 0.1;
    for (const unsigned int i : cell)
      if (i < nodes.n_interface)
        for (const unsigned int j : cell)
          if (j != i)
            {
              const Vec<dim> d = nodes.position(j) - nodes.position(i);
              const double   allowed =
                -(j < nodes.n_interface ? sine_between_interface_nodes : sine_to_fluid_nodes) * norm(d);
              if (std::none_of(pieces_of_node_[i].begin(), pieces_of_node_[i].end(), [&](const unsigned int f) {
                    return dot(normals_[f], d) >= allowed;
                  }))
                return false;
            }
    return true;
  }


  template <int dim>
  bool AdoptedSurface<dim>::has_facet_of(const std::array<unsigned int, dim> &nodes) const
  {
    constexpr unsigned int pieces_per_facet = dim == 2 ? 1 : 2;
    const auto            &pieces           = pieces_of_node_[nodes[0]];
    return std::any_of(pieces.begin(), pieces.end(), [&](const unsigned int piece) {
      const auto &facet = surface_.facets[piece / pieces_per_facet];
      return std::all_of(nodes.begin(), nodes.end(), [&facet](const unsigned int node) {
        return std::find(facet.begin(), facet.end(), node) != facet.end();
      });
    });
  }


  template <int dim>
  bool AdoptedSurface<dim>::nearest(const Vec<dim> &x, const double largest_distance, Foot &foot) const
  {
    double   best  = largest_distance;
    bool     found = false;
    Vec<dim> normal_sum;
    for (std::size_t f = 0; f < pieces_.size(); ++f)
      {
        const Vec<dim> to_center = x - centers_[f];
        const double   reach     = best * (1 + 1e-9) + radii_[f];
        if (dot(to_center, to_center) > reach * reach)
          continue;
        Vec<dim> corner[dim], place;
        double   weights[dim];
        for (int k = 0; k < dim; ++k)
          corner[k] = surface_.position[pieces_[f][k]];
        nearest_weights<dim>(corner, x, weights);
        for (int k = 0; k < dim; ++k)
          place += corner[k] * weights[k];
        const double distance = norm(x - place);
        if (distance > best * (1 + 1e-9))
          continue;
        // At an edge or corner several pieces are equally near: their mean normal tells the side.
        if (found && distance > best * (1 - 1e-9))
          normal_sum += normals_[f];
        else
          normal_sum = normals_[f];
        found         = true;
        best          = std::min(best, distance);
        foot.place    = place;
        foot.distance = distance;
        for (int k = 0; k < dim; ++k)
          {
            foot.nodes[k]   = pieces_[f][k];
            foot.weights[k] = weights[k];
          }
      }
    if (!found || !(norm(normal_sum) > 0))
      return false;
    foot.normal = normal_sum * (1. / norm(normal_sum));
    if (dot(foot.normal, x - foot.place) < 0)
      foot.distance = -foot.distance;
    return true;
  }


  template <int dim>
  double AdoptedSurface<dim>::signed_distance(const Vec<dim> &x, const double largest_distance) const
  {
    Foot foot;
    return nearest(x, largest_distance, foot) ? foot.distance : largest_distance;
  }


  template <int dim>
  unsigned int AdoptedSurface<dim>::push_out(FluidNodes<dim> &nodes, const double largest_depth, const double clearance,
                                             std::vector<Vec<dim>> &impulse) const
  {
    if (empty())
      return 0;
    std::vector<std::array<Vec<dim>, 2>> boxes;
    for (unsigned int body = 0, i = 0; body < end_of_body_.size(); ++body)
      {
        boxes.push_back({surface_.position[i], surface_.position[i]});
        for (; i < end_of_body_[body]; ++i)
          for (int d = 0; d < dim; ++d)
            {
              boxes[body][0][d] = std::min(boxes[body][0][d], surface_.position[i][d] - clearance);
              boxes[body][1][d] = std::max(boxes[body][1][d], surface_.position[i][d] + clearance);
            }
      }

    unsigned int n_pushed = 0;
    for (std::size_t i = nodes.n_interface; i < nodes.n; ++i)
      {
        if (nodes.is_driven(i))
          continue;
        const Vec<dim> x         = nodes.position(i);
        const bool     is_inside = std::any_of(boxes.begin(), boxes.end(), [&x](const auto &box) {
          bool inside = true;
          for (int d = 0; d < dim; ++d)
            inside = inside && x[d] >= box[0][d] && x[d] <= box[1][d];
          return inside;
        });
        Foot           foot;
        if (!is_inside || !nearest(x, largest_depth, foot) || !(foot.distance < clearance))
          continue;
        for (int d = 0; d < dim; ++d)
          nodes.xp[i][d] = foot.place[d] + clearance * foot.normal[d];
        if (foot.distance >= 0)
          continue;
        ++n_pushed;
        Vec<dim> relative = nodes.velocity(i);
        for (int k = 0; k < dim; ++k)
          relative -= surface_.velocity[foot.nodes[k]] * foot.weights[k];
        const double inward = std::min(0., dot(relative, foot.normal));
        for (int d = 0; d < dim; ++d)
          nodes.v[i][d] -= inward * foot.normal[d];
        for (int k = 0; k < dim; ++k)
          impulse[foot.nodes[k]] += foot.normal * (nodes.mass[i] * inward * foot.weights[k]);
      }
    return n_pushed;
  }

  template class AdoptedSurface<2>;
  template class AdoptedSurface<3>;
} // namespace Breakwater
