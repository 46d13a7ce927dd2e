#include "openings.h"

#include "alpha_shape.h"
#include "delaunay_mesh.h"
#include "shape_text.h"
#include "surface_sampling.h"

#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace Breakwater
{
  template <int dim>
  void Inflow<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Opening", opening_,
               dim == 2 ?
                 "Where fluid comes in: `segment(x, y; X, Y)` [m]." :
                 "Where fluid comes in: `disc(x, y, z; r)`, or `rectangle(x, y, z; x, y, z; x, y, z)`: a corner "
                 "and the two next to it [m].");
    reader.add("Normal", normal_, "Direction in which it flows, at a right angle to the opening; of any length [-].");
    reader.add("Speed", speed_text_, "Speed of the inflow, an expression of t [m/s]. Give it or the flow rate.");
    reader.add("Flow rate", flow_rate_text_,
               dim == 2 ? "Flow through the opening per metre of depth, an expression of t [m^2/s]." :
                          "Flow through the opening, an expression of t [m^3/s].");
    reader.add("From", from_, "Time at which the flow starts [s].", Range::not_negative());
    reader.add("Until", until_, "Time at which it ends [s].", Range::positive());
  }


  template <int dim>
  void Inflow<dim>::check_parameters(ParameterReader &reader)
  {
    if (!(norm(normal_) > 0))
      reader.fail("Normal", "the direction of the flow is missing");
    normal_ *= 1 / norm(normal_);
    try
      {
        std::size_t     cursor = 0;
        const ShapeText text   = ShapeText::next(opening_, cursor);
        const char     *word   = dim == 2 ? "segment" : "rectangle";
        if (text.word == word)
          {
            const auto values = text.numbers(dim * dim, dim == 2 ? "(x, y; X, Y)" : "(x, y, z; x, y, z; x, y, z)");
            corners_.clear();
            for (int corner = 0; corner < dim; ++corner)
              corners_.push_back(vec<dim>(values, corner * dim));
            area_ = 1;
            for (int side = 1; side < dim; ++side)
              {
                const Vec<dim> edge = corners_[side] - corners_[0];
                area_ *= norm(edge);
                if (!(norm(edge) > 0) || std::abs(dot(edge, normal_)) > 1e-6 * norm(edge))
                  text.fail("it has no extent, or the normal is not at a right angle to it");
              }
            if constexpr (dim == 3)
              {
                const Vec<3> u = corners_[1] - corners_[0], v = corners_[2] - corners_[0];
                area_    = norm(cross(u, v));
                center_  = corners_[0] + (u + v) * 0.5;
                corners_ = {corners_[0], corners_[1], corners_[1] + v, corners_[2]};
              }
            else
              center_ = (corners_[0] + corners_[1]) * 0.5;
          }
        else if (dim == 3 && text.word == "disc")
          {
            const auto values = text.numbers(4, "(x, y, z; r)");
            radius_           = values[3];
            if (!(radius_ > 0))
              text.fail("the radius must be positive");
            center_ = vec<dim>(values, 0);
            area_   = 3.14159265358979323846 * radius_ * radius_;
          }
        else
          fail_unknown_word(
            text.word, dim == 2 ? std::vector<std::string>{"segment"} : std::vector<std::string>{"disc", "rectangle"},
            dim);
      }
    catch (const InputError &error)
      {
        reader.fail("Opening", error.what());
      }
    const bool        has_speed = !speed_text_.empty();
    const std::string entry     = has_speed ? "Speed" : "Flow rate";
    if (has_speed == !flow_rate_text_.empty())
      reader.fail("Speed", "give either the speed or the flow rate of the inflow");
    try
      {
        speed_ = std::make_unique<Expression<dim>>(has_speed ? speed_text_ : flow_rate_text_, 1,
                                                   Expression<dim>::Variables::place_and_time);
      }
    catch (const InputError &error)
      {
        reader.fail(entry, error.what());
      }
    if (!(from_ < until_))
      reader.fail("Until", "the flow must end after it has started");
    try
      {
        (void)velocity(from_);
      }
    catch (const BreakdownError &error)
      {
        reader.fail(entry, error.what());
      }
  }


  template <int dim>
  void Inflow<dim>::set_up(const SizeField<dim> &size, const double density)
  {
    density_        = density;
    layer_distance_ = size(center_);
    put_pattern(size);
    share_area();
  }


  template <int dim>
  void Inflow<dim>::put_pattern(const SizeField<dim> &size)
  {
    std::vector<Vec<dim>> rim, inside;
    if constexpr (dim == 2)
      {
        inside = sample_open_curve(segment(corners_[0], corners_[1]), size);
        rim    = {inside.front(), inside.back()};
        inside.erase(inside.begin());
        inside.pop_back();
      }
    else if (corners_.empty())
      {
        Vec<3> e1, e2;
        make_frame(normal_, e1, e2);
        sample_disc(center_, e1, e2, radius_, size, rim, inside);
      }
    else
      {
        sample_polygon(corners_, size, rim, inside);
        // Corners belong to two edges.
        std::vector<Vec<dim>> single;
        for (const Vec<dim> &x : rim)
          if (std::none_of(single.begin(), single.end(), [&](const Vec<dim> &y) {
                return norm(x - y) < 0.1 * layer_distance_;
              }))
            single.push_back(x);
        rim = single;
      }
    pattern_ = rim;
    pattern_.insert(pattern_.end(), inside.begin(), inside.end());
    is_rim_.assign(pattern_.size(), false);
    std::fill_n(is_rim_.begin(), rim.size(), true);
  }


  template <int dim>
  void Inflow<dim>::share_area()
  {
    std::vector<double> share(pattern_.size(), 0.);
    if constexpr (dim == 2)
      {
        std::fill(share.begin(), share.end(), 1.);
        share[0] = share[1] = 0.5; // the ends
      }
    else
      {
        Vec<3> e1, e2;
        make_frame(normal_, e1, e2);
        std::vector<Vec<2>> plane;
        for (const Vec<3> &x : pattern_)
          plane.push_back({{dot(x - center_, e1), dot(x - center_, e2)}});
        DelaunayMesh<2> triangulation;
        triangulation.rebuild(plane);
        const auto mesh = alpha_shape<2>(triangulation, 10 * layer_distance_, [](const auto &) {
          return true;
        });
        for (const auto &cell : mesh.cells)
          for (const unsigned int i : cell)
            share[i] += signed_volume(corners<2>(plane, cell)) / 3;
      }
    double sum = 0;
    for (const double s : share)
      sum += s;
    node_mass_.clear();
    for (const double s : share)
      node_mass_.push_back(density_ * area_ * layer_distance_ * s / sum);
  }


  template <int dim>
  Vec<dim> Inflow<dim>::velocity(const double time) const
  {
    double speed = speed_->value(center_, time);
    if (speed_text_.empty())
      speed /= area_;
    if (!(speed >= 0 && std::isfinite(speed)))
      throw BreakdownError("The speed of the inflow \"" + name_ + "\" is " + std::to_string(speed) +
                           " m/s at t = " + std::to_string(time) + " s; it must be finite and not negative.");
    return normal_ * speed;
  }


  template <int dim>
  Vec<dim> Inflow<dim>::advance(const double time, const double time_step)
  {
    const double start = std::max(time, from_), end = std::min(time + time_step, until_);
    if (!(start < end))
      return {};
    const Vec<dim> moved = velocity(0.5 * (start + end)) * (end - start);
    way_ += norm(moved);
    return moved * (1 / time_step);
  }


  template <int dim>
  void Inflow<dim>::add_layer(FluidNodes<dim> &nodes, const double time, const std::uint8_t number)
  {
    // The density of the nodes in front, so that a layer under pressure makes no gap in it.
    const auto density_near = [&](const Vec<dim> &x) {
      double density = density_, nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = nodes.n_interface; i < nodes.n; ++i)
        if (nodes.inflow[i] == number && norm(nodes.position(i) - x) < nearest)
          {
            nearest = norm(nodes.position(i) - x);
            density = nodes.density[i];
          }
      return density;
    };
    // A perfect stack of layers would be full of slivers.
    std::mt19937 random(n_layers_ + 1);
    const auto   noise = [&]() {
      return 0.15 * layer_distance_ * (2. * random() / std::mt19937::max() - 1.);
    };

    const double        behind = way_ - (n_layers_ + 0.5) * layer_distance_;
    std::vector<double> density;
    for (const Vec<dim> &x : pattern_)
      density.push_back(density_near(x));
    std::size_t i = nodes.n;
    nodes.resize(nodes.n + pattern_.size());
    for (std::size_t k = 0; k < pattern_.size(); ++k, ++i)
      {
        Vec<dim> x = pattern_[k] + normal_ * behind;
        if (!is_rim_[k])
          {
            Vec<dim> move;
            for (int d = 0; d < dim; ++d)
              move[d] = noise();
            x += move - normal_ * dot(move, normal_);
          }
        const Vec<dim> v = velocity(std::min(time, until_));
        for (int d = 0; d < dim; ++d)
          {
            nodes.xp[i][d] = x[d];
            nodes.v[i][d]  = v[d];
          }
        nodes.mass[i]         = node_mass_[k];
        nodes.base_density[i] = nodes.density[i] = density[k];
        nodes.inflow[i]                          = number;
        mass_ += node_mass_[k];
      }
    ++n_layers_;
  }


  template <int dim>
  void Outflow<dim>::declare_parameters(ParameterReader &reader)
  {
    reader.add("Shape", shape_text_,
               "Where fluid leaves the scene: nodes that are in it at a remesh are taken away; shapes as for the "
               "initial state.");
  }


  template <int dim>
  void Outflow<dim>::check_parameters(ParameterReader &reader, const BoxShape<dim> &walls)
  {
    try
      {
        shape_ = std::make_unique<FluidShape<dim>>(shape_text_, walls, reader);
      }
    catch (const InputError &error)
      {
        reader.fail("Shape", error.what());
      }
  }


  namespace
  {
    /// Calls visit(opening) in the section of each opening; makes those that the file names first.
    template <class Opening, class Visitor>
    void visit_sections(ParameterReader &reader, const std::string &section, std::vector<Opening> &openings,
                        const Visitor &visit)
    {
      SectionScope scope(reader, section);
      for (const std::string &title : reader.section_titles())
        if (std::none_of(openings.begin(), openings.end(), [&](const Opening &opening) {
              return opening.name() == title;
            }))
          openings.emplace_back(title);
      for (Opening &opening : openings)
        {
          SectionScope opening_scope(reader, opening.name());
          visit(opening);
        }
    }
  } // namespace


  template <int dim>
  void Openings<dim>::declare_parameters(ParameterReader &reader)
  {
    const auto declare = [&](auto &opening) {
      opening.declare_parameters(reader);
    };
    visit_sections(reader, "Inflows", inflows_, declare);
    visit_sections(reader, "Outflows", outflows_, declare);
  }


  template <int dim>
  void Openings<dim>::check_parameters(ParameterReader &reader, const BoxShape<dim> &walls)
  {
    visit_sections(reader, "Inflows", inflows_, [&](Inflow<dim> &inflow) {
      inflow.check_parameters(reader);
    });
    visit_sections(reader, "Outflows", outflows_, [&](Outflow<dim> &outflow) {
      outflow.check_parameters(reader, walls);
    });
    if (inflows_.size() > std::numeric_limits<std::uint8_t>::max())
      throw InputError("The fluid has " + std::to_string(inflows_.size()) + " inflows; at most 255 are possible.");
  }


  template <int dim>
  void Openings<dim>::set_up(const SizeField<dim> &size, const double density)
  {
    for (Inflow<dim> &inflow : inflows_)
      inflow.set_up(size, density);
    drift_.resize(inflows_.size());
  }


  template <int dim>
  void Openings<dim>::set_velocity(FluidNodes<dim> &nodes, const unsigned int i, const Vec<dim> &before,
                                   const Vec<dim> &kick, const Vec<dim> &drift, const Vec<dim> &after)
  {
    // The node would get the velocity before + kick, and its forces do the work m kick . drift.
    const double m = nodes.mass[i];
    driving_impulse_ += (after - before - kick) * m;
    driving_work_ += 0.5 * m * (dot(after, after) - dot(before, before)) - m * dot(kick, drift);
    std::copy_n(after.c, dim, nodes.v[i].c);
  }


  template <int dim>
  void Openings<dim>::start_step(FluidNodes<dim> &nodes, const double time, const double time_step)
  {
    for (std::size_t k = 0; k < inflows_.size(); ++k)
      drift_[k] = inflows_[k].advance(time, time_step);
    const auto is_let_go = [&](const unsigned int i) {
      if (inflows_[nodes.inflow[i] - 1].is_open(time))
        return false;
      nodes.inflow[i] = 0;
      return true;
    };
    driven_.erase(std::remove_if(driven_.begin(), driven_.end(), is_let_go), driven_.end());
    for (const unsigned int i : driven_)
      {
        const Vec<dim> &drift = drift_[nodes.inflow[i] - 1];
        set_velocity(nodes, i, nodes.velocity(i), FluidNodes<dim>::vec(nodes.a[i]) * (0.5 * time_step), drift, drift);
        nodes.a[i] = Quad();
      }
  }


  template <int dim>
  void Openings<dim>::finish_step(FluidNodes<dim> &nodes, const double time)
  {
    for (const unsigned int i : driven_)
      {
        const auto      number = nodes.inflow[i] - 1;
        const Vec<dim> &drift  = drift_[number];
        set_velocity(nodes, i, drift, nodes.velocity(i) - drift, drift, inflows_[number].velocity(time));
      }
  }


  template <int dim>
  bool Openings<dim>::needs_remeshing() const
  {
    return std::any_of(inflows_.begin(), inflows_.end(), [](const Inflow<dim> &inflow) {
      return inflow.layer_is_due();
    });
  }


  template <int dim>
  std::size_t Openings<dim>::add_layers(FluidNodes<dim> &nodes, const double time)
  {
    for (const unsigned int i : driven_)
      if (inflows_[nodes.inflow[i] - 1].has_released(nodes.position(i)))
        nodes.inflow[i] = 0;
    const std::size_t n_before = nodes.n;
    for (std::size_t k = 0; k < inflows_.size(); ++k)
      while (inflows_[k].layer_is_due())
        inflows_[k].add_layer(nodes, time, k + 1);
    return nodes.n - n_before;
  }


  template <int dim>
  std::vector<char> Openings<dim>::take_leaving(const FluidNodes<dim> &nodes)
  {
    std::vector<char> leaves;
    for (Outflow<dim> &outflow : outflows_)
      for (std::size_t i = nodes.n_interface; i < nodes.n; ++i)
        if (nodes.inflow[i] == 0 && (leaves.empty() || !leaves[i]) && outflow.contains(nodes.position(i)))
          {
            leaves.resize(nodes.n, 0);
            leaves[i] = 1;
            outflow.count(nodes.mass[i]);
          }
    return leaves;
  }


  template <int dim>
  void Openings<dim>::find_driven(const FluidNodes<dim> &nodes)
  {
    driven_.clear();
    for (std::size_t i = nodes.n_interface; i < nodes.n; ++i)
      if (nodes.inflow[i] != 0)
        driven_.push_back(i);
  }


  template <int dim>
  void Openings<dim>::add_history(Row &row) const
  {
    for (const Inflow<dim> &inflow : inflows_)
      row.emplace_back("mass through " + inflow.name() + " [kg]", inflow.mass());
    for (const Outflow<dim> &outflow : outflows_)
      row.emplace_back("mass through " + outflow.name() + " [kg]", outflow.mass());
  }

  template class Inflow<2>;
  template class Inflow<3>;
  template class Openings<2>;
  template class Openings<3>;
} // namespace Breakwater
