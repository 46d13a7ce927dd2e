#pragma once

#include "fluid_nodes.h"
#include "fluid_shape.h"

#include <breakwater/base/expression.h>
#include <breakwater/base/parameter_reader.h>
#include <breakwater/base/run_context.h>

#include <memory>
#include <string>
#include <vector>

namespace Breakwater
{
  /// An opening through which fluid comes in, as a plug that moves at a given speed.
  ///
  /// The plug is made of layers of nodes, one spacing apart; together the nodes of a layer have the mass
  /// rho A h of the fluid between two layers. With L the way of the plug since it started, layer k is made at the first
  /// remesh at which L >= (k + 1/2) h, at its exact place L - (k + 1/2) h behind the opening: the mass that has come in
  /// differs from rho A L by half a layer at most. A node is driven at the plug's speed, whatever forces act on it,
  /// until it is two spacings from the opening.
  template <int dim>
  class Inflow
  {
  public:
    explicit Inflow(std::string name)
      : name_(std::move(name))
    {
    }
    void declare_parameters(ParameterReader &reader);
    void check_parameters(ParameterReader &reader);
    /// Puts the nodes of a layer. @param density of the fluid at rest [kg/m^3]
    void set_up(const SizeField<dim> &size, double density);

    const std::string &name() const { return name_; }
    double             mass() const { return mass_; } ///< that has come in [kg]
    bool               is_open(const double time) const { return time >= from_ && time < until_; }

    /// Velocity of the plug [m/s]. @throws BreakdownError if it is negative or not finite
    Vec<dim> velocity(double time) const;

    /// Moves the plug on by one step. @return its mean velocity in the step [m/s]
    Vec<dim> advance(double time, double time_step);

    bool layer_is_due() const { return way_ >= (n_layers_ + 0.5) * layer_distance_; }

    /// Makes the next layer behind all other nodes. @pre layer_is_due()
    void add_layer(FluidNodes<dim> &nodes, double time, std::uint8_t number);

    bool has_released(const Vec<dim> &x) const { return dot(x - center_, normal_) > 2 * layer_distance_; }

    /// Calls visit() with every number that a checkpoint must keep.
    template <class Self, class Visitor>
    static void visit_state(Self &self, const Visitor &visit)
    {
      visit(self.way_);
      visit(self.n_layers_);
      visit(self.mass_);
    }

  private:
    void put_pattern(const SizeField<dim> &size);
    void share_area();

    std::string name_;
    std::string opening_ = "", speed_text_ = "", flow_rate_text_ = "";
    Vec<dim>    normal_;
    double      from_ = 0, until_ = 1e9; ///< [s]

    std::unique_ptr<Expression<dim>> speed_;      ///< or the flow rate, of time
    std::vector<Vec<dim>>            corners_;    ///< of a segment or rectangle; center of a disc
    double                           radius_ = 0; ///< of a disc [m]
    double                           area_   = 0; ///< [m^(dim-1)]
    Vec<dim>                         center_;

    std::vector<Vec<dim>> pattern_;   ///< places of the nodes in the opening [m]
    std::vector<char>     is_rim_;    ///< of them
    std::vector<double>   node_mass_; ///< [kg]
    double                density_ = 0, layer_distance_ = 0;

    double        way_      = 0; ///< L [m]
    unsigned long n_layers_ = 0;
    double        mass_     = 0; ///< [kg]
  };


  /// A region in which nodes are taken away at the next remesh.
  template <int dim>
  class Outflow
  {
  public:
    explicit Outflow(std::string name)
      : name_(std::move(name))
    {
    }
    void declare_parameters(ParameterReader &reader);
    void check_parameters(ParameterReader &reader, const BoxShape<dim> &walls);

    const std::string &name() const { return name_; }
    double             mass() const { return mass_; } ///< that has gone [kg]
    bool               contains(const Vec<dim> &x) const { return shape_->distance(x) < 0; }
    void               count(const double mass) { mass_ += mass; }

    template <class Self, class Visitor>
    static void visit_state(Self &self, const Visitor &visit)
    {
      visit(self.mass_);
    }

  private:
    std::string                      name_;
    std::string                      shape_text_ = "";
    std::unique_ptr<FluidShape<dim>> shape_;
    double                           mass_ = 0;
  };


  /// The openings of a scene.
  template <int dim>
  class Openings
  {
  public:
    void declare_parameters(ParameterReader &reader);
    /// @param walls a box around all walls
    void check_parameters(ParameterReader &reader, const BoxShape<dim> &walls);
    void set_up(const SizeField<dim> &size, double density);

    bool empty() const { return inflows_.empty() && outflows_.empty(); }
    bool has_inflows() const { return !inflows_.empty(); }

    /// Before the nodes of a step move: gives driven nodes the velocity that takes them along with their plug, and no
    /// acceleration. Both calls give the driven nodes' impulses to `received`.
    void start_step(FluidNodes<dim> &nodes, double time, double time_step);
    /// After the step: the velocity of the plug at its end.
    void finish_step(FluidNodes<dim> &nodes, double time);

    /// True if a remesh is due because a layer must be made.
    bool needs_remeshing() const;

    /// Makes the layers that are due and lets go of nodes that have left the opening behind. @return number of new nodes
    std::size_t add_layers(FluidNodes<dim> &nodes, double time);

    /// Which nodes are in an outflow; counts their mass. Empty if none is.
    std::vector<char> take_leaving(const FluidNodes<dim> &nodes);

    /// Finds the driven nodes again after nodes have got new numbers.
    void find_driven(const FluidNodes<dim> &nodes);

    void add_history(Row &row) const;
    template <class Self, class Visitor>
    static void visit_state(Self &self, const Visitor &visit)
    {
      for (auto &inflow : self.inflows_)
        Inflow<dim>::visit_state(inflow, visit);
      for (auto &outflow : self.outflows_)
        Outflow<dim>::visit_state(outflow, visit);
      visit(self.driving_impulse_);
      visit(self.driving_work_);
    }

    /// Momentum [kg m/s] and energy [J] that driving nodes has given to the fluid since the start.
    const Vec<dim> &driving_impulse() const { return driving_impulse_; }
    double          driving_work() const { return driving_work_; }

  private:
    void set_velocity(FluidNodes<dim> &nodes, unsigned int node, const Vec<dim> &before, const Vec<dim> &kick,
                      const Vec<dim> &drift, const Vec<dim> &after);

    std::vector<Inflow<dim>>  inflows_;
    std::vector<Outflow<dim>> outflows_;
    std::vector<unsigned int> driven_; ///< nodes
    std::vector<Vec<dim>>     drift_;  ///< velocity with which each plug moves in this step [m/s]
    Vec<dim>                  driving_impulse_;
    double                    driving_work_ = 0;
  };
} // namespace Breakwater
