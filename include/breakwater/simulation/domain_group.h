#pragma once

#include <breakwater/interfaces/explicit_domain.h>

#include <string>
#include <utility>
#include <vector>

namespace Breakwater
{
  /// Several bodies that make equal steps and look like one domain to a coupler; pairs of them may be joined.
  ///
  /// At a joint the nodes of two wet surfaces that stand at the same place move as one: after every free step they get
  /// the acceleration sum(m a) / sum(m) of all of them by link forces, which is the scheme of Gravouil and Combescure
  /// for equal steps with the multiplier eliminated. What another domain pushes at such a node is shared out by mass. A
  /// direction that one of them holds is held for all, and no one of them crosses a plane that stops another one.
  ///
  /// The group's wet surface consists of the wet nodes of its exposed members, joined ones once, and of their facets
  /// but for those inside a joint.
  template <int dim>
  class DomainGroup : public ExplicitDomain<dim>
  {
  public:
    struct Member
    {
      std::string          name;
      ExplicitDomain<dim> *domain;     ///< outlives the group
      bool                 is_exposed; ///< its wet surface belongs to that of the group
    };
    using Joint = std::pair<unsigned int, unsigned int>; ///< numbers of two members

    /// @param ties_place where the scene says what is joined, for messages about that
    DomainGroup(std::vector<Member> members, std::vector<Joint> joints, std::string ties_place);

    /// Sets up the members, each with its own name, and joins them.
    /// @throws InputError if two members that are to be joined have no node in common or move apart at time 0, or if
    /// two that touch are not joined
    void setup(const std::string &name, const BodyForces<dim> &body_forces, RunContext &context) override;

    double stable_time_step() const override;
    void   advance_free(double time_step) override;
    void   add_link_force(const std::vector<Vec<dim>> &force, double time_step) override;
    void   end_step() override;

    const WetSurface<dim> &wet_surface() const override { return surface_; }
    unsigned int           adopt_surface(const WetSurface<dim> &partner) override;
    void                   lend_mass(const std::vector<double> &mass) override;
    bool                   can_adopt_surface() const override { return false; }
    void                   correct_surface(const std::vector<Vec<dim>> &position) override;
    std::vector<Stop<dim>> stops(unsigned int node) const override;
    void                   set_stops(unsigned int node, const std::vector<Stop<dim>> &stops) override;

    /// Leaves only these nodes of the wet surface [number in wet_surface()], in this order, and no facets.
    void keep_surface_nodes(const std::vector<unsigned int> &nodes);

    /// Takes over the state of members that were loaded on their own.
    void refresh() { update_surface(); }

    DomainBalance<dim> balance() const override;
    void               add_history(Row &row) override;
    OutputMesh<dim>    output_mesh() const override; ///< none: the members have their own
    void               save(std::ostream &stream) const override;
    void               load(std::istream &stream) override;

  private:
    /// Node of a member's wet surface.
    struct Slot
    {
      unsigned int member, node;
      bool         operator==(const Slot &other) const { return member == other.member && node == other.node; }
    };
    using Node = std::vector<Slot>; ///< what moves as one; one slot where nothing is joined

    void join_nodes();
    void share_stops();
    void check_joint_velocities() const;
    void make_surface();
    void start_surface();
    void update_surface();
    void balance_joints(double time_step);
    void clear_forces();
    void send_forces(double time_step);

    const WetSurface<dim> &surface_of(const unsigned int member) const
    {
      return members_[member].domain->wet_surface();
    }
    const WetSurface<dim> &surface_of(const Slot &slot) const { return surface_of(slot.member); }

    std::vector<Member>                members_;
    std::vector<Joint>                 joints_;
    std::string                        ties_place_; ///< in the scene's file
    RunContext                        *context_ = nullptr;
    std::vector<Node>                  nodes_;        ///< of all members
    std::vector<std::vector<unsigned>> node_of_slot_; ///< [member][node of its wet surface]
    std::vector<unsigned int>          joined_;       ///< those of nodes_ with several slots
    std::vector<unsigned int>          exposed_;      ///< [node of surface_] number in nodes_
    WetSurface<dim>                    surface_;
    std::vector<std::vector<Vec<dim>>> forces_; ///< work: [member][node of its wet surface] [N]
  };

  /// Pairs of nodes (number in a, number in b) that move as one at a joint: they are closer than 1e-10 of the largest
  /// distance of any node from the origin.
  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>> joint_nodes(const std::vector<Vec<dim>> &a,
                                                                 const std::vector<Vec<dim>> &b);

  /// A node of a domain's wet surface.
  template <int dim>
  struct DomainNode
  {
    ExplicitDomain<dim> *domain;
    unsigned int         node;
  };

  /// Gives nodes that move as one the stops of all of them, in one order: the same bits for the same way.
  template <int dim>
  void share_stops(const std::vector<DomainNode<dim>> &nodes);
} // namespace Breakwater
