#include "node_step.h"

#include <algorithm>
#include <cmath>

namespace Breakwater
{
  namespace
  {
    /// The length of a vector and the unit vector along it.
    template <int dim>
    double normalize(Vec<dim> &a)
    {
      const double length = norm(a);
      if (length > 0)
        a *= 1. / length;
      return length;
    }

    // r_in = det / P, with P the perimeter; a and b are the two other corners, (a, b, x) is positive.
    double radius_and_gradient(const std::array<Vec<2>, 2> &facet, const Vec<2> &x, Vec<2> &gradient)
    {
      const Vec<2> e   = facet[1] - facet[0];
      const Vec<2> n0  = {{-e[1], e[0]}};
      const double det = dot(n0, x - facet[0]);
      Vec<2>       a = x - facet[0], b = x - facet[1];
      const double perimeter = norm(e) + normalize(a) + normalize(b);
      const double r         = det / perimeter;
      gradient               = (n0 - r * (a + b)) * (1. / perimeter);
      return r;
    }

    // r_in = det / S, with S twice the surface; (a, b, c, x) is positive. With c_pq = (p - x) x (q - x) for the edges pq
    // of the opposite face, S = |n0| + sum |c_pq| and d|c_pq|/dx = (p - q) x c_pq / |c_pq|.
    double radius_and_gradient(const std::array<Vec<3>, 3> &facet, const Vec<3> &x, Vec<3> &gradient)
    {
      const Vec<3> n0  = cross(facet[1] - facet[0], facet[2] - facet[0]);
      const double det = dot(n0, x - facet[0]);
      double       sum = norm(n0);
      Vec<3>       slope;
      for (int k = 0; k < 3; ++k)
        {
          const Vec<3> &p = facet[k], &q = facet[(k + 1) % 3];
          Vec<3>        c = cross(p - x, q - x);
          sum += normalize(c);
          slope += cross(p - q, c);
        }
      const double r = det / sum;
      gradient       = (n0 - r * slope) * (1. / sum);
      return r;
    }

    /// The corners of a cell but one, in the order that makes the cell positive with that one last.
    template <int dim>
    std::array<Vec<dim>, dim> facet_seen_from(const std::vector<Vec<dim>>           &position,
                                              const typename SimplexMesh<dim>::Cell &cell, const unsigned int node)
    {
      auto facet = outward_facet<dim>(cell, std::find(cell.begin(), cell.end(), node) - cell.begin());
      if constexpr (dim == 3)
        std::swap(facet[1], facet[2]);
      std::array<Vec<dim>, dim> x;
      for (int a = 0; a < dim; ++a)
        x[a] = position[facet[a]];
      return x;
    }
  } // namespace


  template <int dim>
  NodeStep<dim>::NodeStep(StarMesh<dim> &mesh)
    : mesh_(mesh)
  {
  }


  template <int dim>
  bool NodeStep<dim>::improve(const unsigned int node, const double wanted, VolumeBudget *const budget)
  {
    constexpr unsigned int most_evaluations = 8;
    constexpr double       least_part = 0.075, least_gain = 1e-4;
    if (!slides(mesh_.freedom(node)) && mesh_.freedom(node) != NodeFreedom::free && budget == nullptr)
      return false;
    const typename StarMesh<dim>::Constraint constraint(mesh_, node, budget == nullptr);
    const bool                               is_on_boundary = mesh_.freedom(node) != NodeFreedom::free;
    if (is_on_boundary)
      mesh_.boundary_facets(node, facets_);
    normals_.clear();
    if (budget != nullptr)
      for (const auto &facet : facets_)
        normals_.push_back(mesh_.normal_of(facet, node, mesh_.position(node)));
    update_gradients(node, constraint);
    double         smallest = *std::min_element(r_.begin(), r_.end()), proximal = 0.12;
    bool           has_moved = false;
    const Vec<dim> start     = mesh_.position(node);
    const auto     fits      = [&](const Vec<dim> &x) { // the volume is affine in one node's place
      return mesh_.is_reachable(node, x) && (budget == nullptr || budget->allows(dot(constraint.area(), x - start)));
    };
    for (unsigned int k = 0; k < most_evaluations && smallest < wanted; ++k)
      {
        Vec<dim>     step;
        const double predicted = model_step(proximal, smallest, step);
        if (!(predicted > least_gain))
          break;
        const Vec<dim> x = mesh_.position(node) + mesh_.within_reach(node, step, budget == nullptr);
        if (fits(x) && evaluate(node, x, smallest + least_part * predicted) &&
            !(is_on_boundary && turns_facet(node, x, constraint, budget != nullptr)))
          {
            mesh_.move(node, x, new_r_);
            has_moved = true;
            update_gradients(node, constraint);
            smallest = *std::min_element(r_.begin(), r_.end());
            proximal *= 1.6;
            continue;
          }
        proximal *= 0.3;
      }
    if (has_moved && budget != nullptr)
      {
        const double change = dot(constraint.area(), mesh_.position(node) - start);
        budget->spend(change);
        lifted_volume_ += change;
        ++n_lifts_;
      }
    return has_moved;
  }


  template <int dim>
  bool NodeStep<dim>::turns_facet(const unsigned int node, const Vec<dim> &x,
                                  const typename StarMesh<dim>::Constraint &constraint, const bool is_lifted) const
  {
    if (!is_lifted)
      return !constraint.faces_outward(mesh_, facets_, x);
    for (std::size_t k = 0; k < facets_.size(); ++k)
      if (dot(mesh_.normal_of(facets_[k], node, x), normals_[k]) < 0)
        return true;
    return false;
  }


  template <int dim>
  bool NodeStep<dim>::evaluate(const unsigned int node, const Vec<dim> &x, const double least)
  {
    new_r_.clear();
    for (const unsigned int c : mesh_.star(node))
      {
        const auto  &cell    = mesh_.cell(c);
        Simplex<dim> corners = mesh_.corners_of(c);
        for (int a = 0; a <= dim; ++a)
          if (cell[a] == node)
            corners[a] = x;
        new_r_.push_back(mesh_.quality(corners));
        if (!(new_r_.back() > least))
          return false;
      }
    return true;
  }


  template <int dim>
  void NodeStep<dim>::update_gradients(const unsigned int node, const typename StarMesh<dim>::Constraint &constraint)
  {
    const double    unit = 1. / reference_insphere_radius<dim>(mesh_.spacing());
    const Vec<dim> &x    = mesh_.position(node);
    r_.clear();
    gradient_.clear();
    for (const unsigned int c : mesh_.star(node))
      {
        Vec<dim> gradient;
        r_.push_back(unit *
                     radius_and_gradient(facet_seen_from<dim>(mesh_.positions(), mesh_.cell(c), node), x, gradient));
        gradient_.push_back(constraint.allowed_part(gradient * (unit * mesh_.spacing())));
      }
  }


  template <int dim>
  double NodeStep<dim>::model_step(const double proximal, const double smallest, Vec<dim> &step) const
  {
    constexpr unsigned int n_iterations = 24;
    constexpr double       longest      = 0.25;

    const std::size_t first = std::min_element(r_.begin(), r_.end()) - r_.begin();
    Vec<dim>          sum   = gradient_[first]; // of l_i g_i
    double            mean  = r_[first];        // of l_i r_i
    for (unsigned int k = 0; k < n_iterations; ++k)
      {
        std::size_t best  = 0;
        double      least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < r_.size(); ++i)
          {
            const double slope = r_[i] + proximal * dot(gradient_[i], sum);
            if (slope < least)
              {
                least = slope;
                best  = i;
              }
          }
        const double   gap       = mean + proximal * dot(sum, sum) - least;
        const Vec<dim> direction = gradient_[best] - sum;
        const double   curvature = proximal * dot(direction, direction);
        if (!(gap > 1e-6) || !(curvature > 0))
          break;
        const double part = std::min(1., gap / curvature);
        sum += direction * part;
        mean += (r_[best] - mean) * part;
      }
    step                = sum * proximal;
    const double length = norm(step);
    if (length > longest)
      step *= longest / length;
    double model = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < r_.size(); ++i)
      model = std::min(model, r_[i] + dot(gradient_[i], step));
    step *= mesh_.spacing();
    return model - smallest;
  }

  template class NodeStep<2>;
  template class NodeStep<3>;
} // namespace Breakwater
