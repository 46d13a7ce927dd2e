#include "explicit_structure.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/base/expression.h>
#include <breakwater/structure/structure.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace Breakwater
{
  namespace
  {
    /// The frequency of a cell is computed anew once its strain has changed by this much. That changes
    /// the frequency of a St Venant-Kirchhoff solid by 1.5 times as much, well within the usual fraction of the bound.
    constexpr double tolerated_change_of_strain = 0.02;

    template <int dim>
    std::string place(const Vec<dim> &position)
    {
      std::ostringstream text;
      text << "(";
      for (int d = 0; d < dim; ++d)
        text << (d > 0 ? ", " : "") << position[d];
      text << ") m";
      return text.str();
    }

    /// The vectors that the expressions in `text` give at each place [m].
    template <int dim>
    std::vector<Vec<dim>> evaluate_vectors(const std::string &text, const std::vector<Vec<dim>> &nodes)
    {
      const Expression<dim> expression(text, dim, Expression<dim>::Variables::place);
      std::vector<Vec<dim>> result(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          {
            result[i][d] = expression.value(nodes[i], 0., d);
            if (!std::isfinite(result[i][d]))
              throw InputError("\"" + text + "\" has no finite value at every node");
          }
      return result;
    }
  } // namespace


  template <int dim>
  ExplicitStructure<dim>::ExplicitStructure()
    : material_("Model", "", "The law of the solid.", 1)
    , initial_velocity_text_(dim == 2 ? "0, 0" : "0, 0, 0")
  {
  }


  template <int dim>
  void ExplicitStructure<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Mesh", mesh_text_,
               dim == 2 ?
                 "box(x0, y0; x1, y1; nx, ny): two opposite corners [m] and the number of cells in each direction." :
                 "box(x0, y0, z0; x1, y1, z1; nx, ny, nz): two opposite corners [m] and the number of cells in each "
                 "direction.");
    reader.add("Mapping", mapping_text_,
               "Where the points of the box go [m], for bodies of other shapes: one expression for each component, "
               "separated by commas, in the coordinates x, y, z of the box [m] and pi; empty: the box itself. "
               "Boundaries keep their names, edges of cells are straight.");
    reader.add("Degree", degree_,
               "Polynomial degree of the cells. Degree 2 bends well with one cell across the thickness; its nodes in "
               "the middle of edges, faces and cells count for the wet surface as well.",
               1, 2);
    const std::string names = dim == 2 ? "left, right, bottom, top (at the smallest and largest x and y)" :
                                         "left, right, bottom, top, front, back (at the smallest and largest x, y, z)";
    reader.add("Clamp", clamp_names_, "Boundaries whose nodes are held, a list of " + names + ".");
    reader.add("Wet boundaries", wet_names_,
               "Boundaries that may be coupled to a fluid, a list of " + names +
                 "; \"all\" means all that are not clamped, \"none\" means none.");
    reader.add("Body forces act", body_forces_act_,
               "Whether the body forces of the scene, such as gravity, act on this structure too.");
    reader.add("Fraction of the bound", fraction_,
               "Time step as a fraction of the stable one, 2 over the largest frequency of the deformed cells [-].",
               Range{1e-6, 1.});
    reader.add("Damping", damping_, "Damping force per mass and velocity, alpha [1/s]; 0: none.",
               Range::not_negative());
    reader.add("Stops", stops_text_,
               "Planes that no node crosses, such as rigid walls and floors: a point [m] and the normal to the allowed "
               "side, " +
                 std::string(dim == 2 ? "x, y; nx, ny" : "x, y, z; nx, ny, nz") +
                 ", several of them separated by vertical bars. Contact is inelastic and without friction.");
    reader.add("Initial velocity", initial_velocity_text_,
               "Velocity at time 0 [m/s]: one expression for each component, separated by commas, in the undeformed "
               "coordinates x, y, z [m] and pi. Held nodes stay at rest.");
    reader.add<dim>("Reference point", reference_point_,
                    "Point that the moments on this structure in history.csv refer to [m].");
    SectionScope scope(reader, "Material");
    material_.declare_parameters(reader);
  }


  template <int dim>
  void ExplicitStructure<dim>::check_parameters(ParameterReader &reader)
  {
    const auto check = [&reader](const std::string &entry, const auto &digest) {
      try
        {
          digest();
        }
      catch (const InputError &error)
        {
          reader.fail(entry, error.what());
        }
    };

    check("Mesh", [&] {
      box_ = parse_box_mesh<dim>(mesh_text_);
    });
    check("Mapping", [&] {
      if (!mapping_text_.empty())
        evaluate_vectors<dim>(mapping_text_, {0.5 * (box_.lower + box_.upper)});
    });
    check("Clamp", [&] {
      is_clamped_ = parse_boundaries<dim>(clamp_names_);
    });
    check("Wet boundaries", [&] {
      if (wet_names_ == std::vector<std::string>{"all"})
        std::transform(is_clamped_.begin(), is_clamped_.end(), is_wet_.begin(), [](const bool c) {
          return !c;
        });
      else if (wet_names_ == std::vector<std::string>{"none"})
        is_wet_ = {};
      else
        is_wet_ = parse_boundaries<dim>(wet_names_);
    });
    check("Stops", [&] {
      stop_lists_ = {parse_stops<dim>(stops_text_)};
    });
    check("Initial velocity", [&] {
      evaluate_vectors<dim>(initial_velocity_text_, {0.5 * (box_.lower + box_.upper)});
    });

    SectionScope scope(reader, "Material");
    if (material_.empty())
      {
        std::string known;
        for (const std::string &name : reader.registry().names(Material<dim>::interface_name, dim))
          known += (known.empty() ? "" : ", ") + name;
        reader.fail("Model", "a structure needs a material; known are: " +
                               (known.empty() ? "none, name a library of materials in \"Plugin libraries\"" : known));
      }
    material_.check_parameters(reader);
  }


  template <int dim>
  void ExplicitStructure<dim>::setup(const std::string &name, const BodyForces<dim> &body_forces, RunContext &context)
  {
    PhaseTimer timer(context, Phase::structure);
    name_        = name;
    body_forces_ = &body_forces;
    context_     = &context;

    std::function<Vec<dim>(const Vec<dim> &)> place;
    if (!mapping_text_.empty())
      place = [this](const Vec<dim> &x) {
        return evaluate_vectors<dim>(mapping_text_, {x}).front();
      };
    mesh_         = make_solid_mesh<dim>(box_, degree_, place);
    kernel_       = make_cell_kernel<dim>(mesh_, material_.front());
    mass_         = kernel_->lumped_mass();
    inertia_      = mass_;
    inverse_mass_ = mass_;
    for (double &mass : inverse_mass_)
      mass = 1 / mass;
    for (const auto &facet : mesh_.facets)
      if (is_clamped_[facet.boundary])
        for (const unsigned int node : facet.nodes)
          inverse_mass_[node] = 0;

    const std::size_t n_nodes = mesh_.nodes.size();
    displacement_.assign(n_nodes, {});
    acceleration_.assign(n_nodes, {});
    force_.assign(n_nodes, {});
    position_ = mesh_.nodes;
    velocity_ = evaluate_vectors<dim>(initial_velocity_text_, mesh_.nodes);
    for (std::size_t i = 0; i < n_nodes; ++i)
      if (inverse_mass_[i] == 0)
        velocity_[i] = {};

    context.note_effect(name_ + ": body forces", body_forces_act_ && !body_forces.empty(),
                        body_forces.empty() ? "the scene has none" : "switched off by \"Body forces act\"");
    context.note_effect(name_ + ": damping", damping_ > 0, "\"Damping\" is 0");
    context.note_effect(name_ + ": stops", !stop_lists_[0].empty(),
                        "\"Stops\" names none; joined nodes feel those of other bodies");
    if (!stop_lists_[0].empty())
      list_of_node_.assign(n_nodes, 0);
    body_acceleration_is_fixed_ = std::all_of(body_forces.begin(), body_forces.end(), [](const auto &body_force) {
      return body_force->is_uniform();
    });
    body_acceleration_.assign(n_nodes, {});
    add_body_forces();
    compute_force();
    for (std::size_t i = 0; i < n_nodes; ++i)
      update_free_acceleration(i);

    eigenvalues_ = kernel_->start_eigenvalues();
    bound_frequency();
    make_wet_surface();
    if (context.step_limited_by.empty())
      context.step_limited_by = name_;
    context.set_summary(name_ + " nodes", n_nodes);
    context.set_summary(name_ + " cells", mesh_.n_cells());
  }


  template <int dim>
  void ExplicitStructure<dim>::bound_frequency()
  {
    largest_frequency_ = std::sqrt(kernel_->bound_eigenvalue(displacement_, eigenvalues_, tolerated_change_of_strain));
    if (!std::isfinite(largest_frequency_))
      fail_not_finite();
  }


  template <int dim>
  double ExplicitStructure<dim>::stable_time_step() const
  {
    // Inertia that is lent is missing in M' of K <= omega^2 M, and of the damping force, alpha M <= alpha r M'.
    const double frequency = std::sqrt(largest_mass_ratio_) * largest_frequency_;
    const double xi        = largest_mass_ratio_ * damping_ / (2 * frequency);
    return fraction_ * 2 / frequency * (std::sqrt(1 + xi * xi) - xi);
  }


  // Held nodes keep zero.
  template <int dim>
  void ExplicitStructure<dim>::update_free_acceleration(const std::size_t i)
  {
    if (inverse_mass_[i] > 0)
      acceleration_[i] =
        inverse_mass_[i] * force_[i] + mass_[i] / inertia_[i] * (body_acceleration_[i] - damping_ * velocity_[i]);
  }


  template <int dim>
  void ExplicitStructure<dim>::advance_free(const double time_step)
  {
    PhaseTimer        timer(*context_, Phase::structure);
    const std::size_t n_nodes = displacement_.size();
    act(0.5 * (time_step_ + time_step)); // with the rest of a step that no end_step() has ended
    std::fill(link_force_.begin(), link_force_.end(), Vec<dim>());
    time_step_ = time_step;
    for (std::size_t i = 0; i < n_nodes; ++i)
      velocity_[i] += (0.5 * time_step) * acceleration_[i];
    stop_at_planes(time_step);
    for (std::size_t i = 0; i < n_nodes; ++i)
      {
        displacement_[i] += time_step * velocity_[i];
        position_[i] = mesh_.nodes[i] + displacement_[i];
      }
    time_ += time_step;
    compute_force();
    if (!body_acceleration_is_fixed_)
      add_body_forces();

    double sum = 0;
    for (std::size_t i = 0; i < n_nodes; ++i)
      if (inverse_mass_[i] > 0)
        {
          update_free_acceleration(i);
          velocity_[i] += (0.5 * time_step) * acceleration_[i];
          for (int d = 0; d < dim; ++d)
            sum += velocity_[i][d];
        }
    if (!std::isfinite(sum))
      fail_not_finite();
    update_wet_surface();
  }


  // A node that would cross a plane in this step comes to lie on it: the impulse is that of a contact force at the end of
  // the step, as in forward increment multipliers (Carpenter, Taylor and Katona, 1991), lumped masses decoupling the nodes.
  template <int dim>
  void ExplicitStructure<dim>::stop_at_planes(const double time_step)
  {
    for (std::size_t i = 0; i < list_of_node_.size(); ++i)
      for (const Stop<dim> &stop : stop_lists_[list_of_node_[i]])
        {
          const double distance = std::max(0., dot(position_[i] - stop.place, stop.normal));
          const double excess   = -distance / time_step - dot(velocity_[i], stop.normal);
          if (!(excess > 0) || inverse_mass_[i] == 0)
            continue;
          velocity_[i] += excess * stop.normal;
          add_load(i, mass_[i] * excess * stop.normal); // of the whole body, as in act()
        }
  }


  template <int dim>
  std::vector<Stop<dim>> ExplicitStructure<dim>::stops(const unsigned int node) const
  {
    return list_of_node_.empty() ? std::vector<Stop<dim>>() : stop_lists_[list_of_node_[wet_nodes_[node]]];
  }


  template <int dim>
  void ExplicitStructure<dim>::set_stops(const unsigned int node, const std::vector<Stop<dim>> &stops)
  {
    if (list_of_node_.empty())
      list_of_node_.assign(mesh_.nodes.size(), 0);
    list_of_node_[wet_nodes_[node]] = stop_lists_.size();
    stop_lists_.push_back(stops);
  }


  template <int dim>
  void ExplicitStructure<dim>::compute_force()
  {
    std::fill(force_.begin(), force_.end(), Vec<dim>{});
    const auto worst = kernel_->add_internal_force(displacement_, force_);
    if (!(worst.smallest_volume_ratio > 0))
      {
        std::ostringstream message;
        message << name_ << ": cell " << worst.cell << " with its undeformed centre at "
                << place(mesh_.cell_centre(worst.cell)) << " has turned inside out at " << time_ << " s: its volume is "
                << worst.smallest_volume_ratio
                << " of the undeformed one. The load is too great for the material or for these cells; use smaller "
                   "cells, or a material that resists compression.";
        throw BreakdownError(message.str());
      }
    smallest_volume_ratio_ = worst.smallest_volume_ratio;
  }


  template <int dim>
  void ExplicitStructure<dim>::add_body_forces()
  {
    std::fill(body_acceleration_.begin(), body_acceleration_.end(), Vec<dim>{});
    if (body_forces_act_)
      for (const auto &body_force : *body_forces_)
        body_force->add_acceleration(time_, position_, body_acceleration_);
  }


  template <int dim>
  void ExplicitStructure<dim>::add_link_force(const std::vector<Vec<dim>> &force, const double time_step)
  {
    for (std::size_t w = 0; w < wet_nodes_.size(); ++w)
      {
        const Vec<dim> change = inverse_mass_[wet_nodes_[w]] * force[w];
        acceleration_[wet_nodes_[w]] += change;
        velocity_[wet_nodes_[w]] += (0.5 * time_step) * change;
        link_force_[w] += force[w];
      }
    update_wet_surface();
  }


  // The link forces also move the inertia that is lent: what others exert on the whole body is f + (M - M') a.
  // Each acts in the second half of the step that ends and in the first half of the next one.
  template <int dim>
  void ExplicitStructure<dim>::act(const double duration)
  {
    for (std::size_t w = 0; w < wet_nodes_.size(); ++w)
      {
        const unsigned int i = wet_nodes_[w];
        add_load(i, duration * (link_force_[w] + (mass_[i] - inertia_[i]) * acceleration_[i]));
      }
  }


  template <int dim>
  void ExplicitStructure<dim>::add_load(const std::size_t i, const Vec<dim> &impulse)
  {
    const Vec<dim> arm = position_[i] - reference_point_;
    load_.impulse += impulse;
    load_.moment[2] += arm[0] * impulse[1] - arm[1] * impulse[0];
    if constexpr (dim == 3)
      {
        load_.moment[0] += arm[1] * impulse[2] - arm[2] * impulse[1];
        load_.moment[1] += arm[2] * impulse[0] - arm[0] * impulse[2];
      }
  }


  template <int dim>
  void ExplicitStructure<dim>::end_step()
  {
    PhaseTimer timer(*context_, Phase::structure);
    act(0.5 * time_step_);
    time_step_ = 0;
    bound_frequency();
    context_->set_summary_max(name_ + " largest compression of a cell [-]", 1 - smallest_volume_ratio_);
  }


  template <int dim>
  void ExplicitStructure<dim>::fail_not_finite() const
  {
    std::size_t i = 0;
    while (i + 1 < velocity_.size() && std::isfinite(dot(velocity_[i], velocity_[i])))
      ++i;
    std::ostringstream message;
    message << name_ << ": the velocity of node " << i << ", undeformed at " << place(mesh_.nodes[i])
            << ", is not finite at " << time_
            << " s. The step may be unstable: use a smaller \"Fraction of the bound\".";
    throw BreakdownError(message.str());
  }


  template <int dim>
  void ExplicitStructure<dim>::make_wet_surface()
  {
    const unsigned int        none = -1;
    std::vector<unsigned int> wet_index(mesh_.nodes.size(), none);
    for (const auto &facet : mesh_.facets)
      if (is_wet_[facet.boundary])
        {
          wet_surface_.facets.push_back(facet.nodes);
          for (unsigned int &node : wet_surface_.facets.back())
            {
              if (wet_index[node] == none)
                {
                  wet_index[node] = wet_nodes_.size();
                  wet_nodes_.push_back(node);
                }
              node = wet_index[node];
            }
        }
    wet_surface_.bodies = {name_};
    wet_surface_.body_of_facet.assign(wet_surface_.facets.size(), 0);
    if (mesh_.degree == 2)
      {
        // Nodes of a cell stand in order, direction by direction: its corners are those with even numbers in each.
        std::vector<char> is_middle(mesh_.nodes.size(), 1);
        for (std::size_t k = 0; k < mesh_.cell_nodes.size(); ++k)
          {
            const unsigned int a = k % mesh_.nodes_per_cell();
            if (a % 3 != 1 && a / 3 % 3 != 1 && a / 9 != 1)
              is_middle[mesh_.cell_nodes[k]] = 0;
          }
        for (const unsigned int node : wet_nodes_)
          wet_surface_.is_middle.push_back(is_middle[node]);
      }
    wet_surface_.position.resize(wet_nodes_.size());
    wet_surface_.velocity.resize(wet_nodes_.size());
    wet_surface_.acceleration.resize(wet_nodes_.size());
    wet_surface_.inverse_mass.resize(wet_nodes_.size());
    wet_surface_.mass.resize(wet_nodes_.size());
    update_wet_mass();
    link_force_.assign(wet_nodes_.size(), {});
    update_wet_surface();
  }


  template <int dim>
  void ExplicitStructure<dim>::update_wet_surface()
  {
    for (std::size_t w = 0; w < wet_nodes_.size(); ++w)
      {
        wet_surface_.position[w]     = position_[wet_nodes_[w]];
        wet_surface_.velocity[w]     = velocity_[wet_nodes_[w]];
        wet_surface_.acceleration[w] = acceleration_[wet_nodes_[w]];
      }
  }


  template <int dim>
  void ExplicitStructure<dim>::update_wet_mass()
  {
    for (std::size_t w = 0; w < wet_nodes_.size(); ++w)
      {
        wet_surface_.mass[w] = inertia_[wet_nodes_[w]];
        for (int d = 0; d < dim; ++d)
          wet_surface_.inverse_mass[w][d] = inverse_mass_[wet_nodes_[w]];
      }
    ++wet_surface_.revision;
  }


  template <int dim>
  void ExplicitStructure<dim>::lend_mass(const std::vector<double> &mass)
  {
    for (std::size_t w = 0; w < wet_nodes_.size(); ++w)
      {
        const unsigned int i = wet_nodes_[w];
        inertia_[i] -= mass[w];
        if (!(inertia_[i] > 0))
          throw std::logic_error("a node lends more mass than it has");
        if (inverse_mass_[i] > 0)
          inverse_mass_[i] = 1 / inertia_[i];
        largest_mass_ratio_ = std::max(largest_mass_ratio_, mass_[i] / inertia_[i]);
        update_free_acceleration(i);
        link_force_[w] = {};
      }
    update_wet_mass();
    update_wet_surface();
  }


  template <int dim>
  unsigned int ExplicitStructure<dim>::adopt_surface(const WetSurface<dim> &)
  {
    throw InputError(name_ + ": a structure has a mesh of its own and can't take the surface of another domain");
  }

  template <int dim>
  void ExplicitStructure<dim>::correct_surface(const std::vector<Vec<dim>> &position)
  {
    for (std::size_t w = 0; w < wet_nodes_.size(); ++w)
      {
        const unsigned int i = wet_nodes_[w];
        displacement_[i] += position[w] - position_[i];
        position_[i] = position[w];
      }
    update_wet_surface();
  }


  template <int dim>
  std::unique_ptr<ExplicitDomain<dim>> make_structure()
  {
    return std::make_unique<ExplicitStructure<dim>>();
  }

  template class ExplicitStructure<2>;
  template class ExplicitStructure<3>;
  template std::unique_ptr<ExplicitDomain<2>> make_structure<2>();
  template std::unique_ptr<ExplicitDomain<3>> make_structure<3>();
} // namespace Breakwater
