#include <breakwater/base/exceptions.h>
#include <breakwater/mesh/common_nodes.h>
#include <breakwater/simulation/domain_group.h>
#include <breakwater/simulation/ties.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace Breakwater
{
  namespace
  {
    template <int dim>
    double largest_distance_from_origin(const std::vector<Vec<dim>> &position)
    {
      double largest = 0;
      for (const Vec<dim> &x : position)
        largest = std::max(largest, norm(x));
      return largest;
    }
  } // namespace


  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>> joint_nodes(const std::vector<Vec<dim>> &a,
                                                                 const std::vector<Vec<dim>> &b)
  {
    return common_nodes(a, b, 1e-10 * std::max(largest_distance_from_origin(a), largest_distance_from_origin(b)));
  }


  template <int dim>
  void share_stops(const std::vector<DomainNode<dim>> &nodes)
  {
    const auto same = [](const Vec<dim> &a, const Vec<dim> &b) {
      return std::equal(a.c, a.c + dim, b.c);
    };
    std::vector<Stop<dim>> all;
    for (const DomainNode<dim> &node : nodes)
      for (const Stop<dim> &stop : node.domain->stops(node.node))
        if (std::none_of(all.begin(), all.end(), [&](const Stop<dim> &other) {
              return same(stop.place, other.place) && same(stop.normal, other.normal);
            }))
          all.push_back(stop);
    if (!all.empty())
      for (const DomainNode<dim> &node : nodes)
        node.domain->set_stops(node.node, all);
  }


  template <int dim>
  DomainGroup<dim>::DomainGroup(std::vector<Member> members, std::vector<Joint> joints, std::string ties_place)
    : members_(std::move(members))
    , joints_(std::move(joints))
    , ties_place_(std::move(ties_place))
  {
  }


  template <int dim>
  void DomainGroup<dim>::setup(const std::string &, const BodyForces<dim> &body_forces, RunContext &context)
  {
    context_ = &context;
    for (const Member &member : members_)
      member.domain->setup(member.name, body_forces, context);
    for (unsigned int m = 0; m < members_.size(); ++m)
      forces_.emplace_back(surface_of(m).position.size());
    join_nodes();
    check_joint_velocities();
    share_stops();
    balance_joints(0.);
    make_surface();
    if (!joints_.empty())
      context.note_effect("joints between structures (matching nodes, equal steps)", true);
  }


  // Nodes of joined members at one place become one.
  template <int dim>
  void DomainGroup<dim>::join_nodes()
  {
    for (unsigned int m = 0; m < members_.size(); ++m)
      {
        node_of_slot_.emplace_back();
        for (unsigned int i = 0; i < surface_of(m).position.size(); ++i)
          {
            node_of_slot_[m].push_back(nodes_.size());
            nodes_.push_back({{m, i}});
          }
      }
    for (unsigned int a = 0; a < members_.size(); ++a)
      for (unsigned int b = a + 1; b < members_.size(); ++b)
        {
          const bool are_joined = std::any_of(joints_.begin(), joints_.end(), [a, b](const Joint &joint) {
            return joint == Joint(a, b) || joint == Joint(b, a);
          });
          const auto pairs      = joint_nodes(surface_of(a).position, surface_of(b).position);
          if (are_joined && pairs.empty())
            fail_without_common_node(ties_place_, members_[a].name, members_[b].name);
          if (!are_joined && !pairs.empty() && members_[a].is_exposed && members_[b].is_exposed)
            throw InputError(ties_place_ + ": \"" + members_[a].name + "\" and \"" + members_[b].name + "\" touch at " +
                             std::to_string(pairs.size()) + " nodes but are not tied to each other; add \"" +
                             members_[a].name + " and " + members_[b].name +
                             "\", or leave a gap of more than the fluid's spacing");
          for (const auto &[i, j] : are_joined ? pairs : decltype(pairs)())
            {
              Node &node = nodes_[node_of_slot_[a][i]], &other = nodes_[node_of_slot_[b][j]];
              if (&node == &other)
                continue;
              node.insert(node.end(), other.begin(), other.end());
              other.clear();
              for (const Slot &slot : node)
                node_of_slot_[slot.member][slot.node] = &node - nodes_.data();
            }
        }
    for (unsigned int n = 0; n < nodes_.size(); ++n)
      if (nodes_[n].size() > 1)
        joined_.push_back(n);
  }


  template <int dim>
  void DomainGroup<dim>::check_joint_velocities() const
  {
    double speed = 0;
    for (unsigned int m = 0; m < members_.size(); ++m)
      for (const Vec<dim> &v : members_[m].domain->wet_surface().velocity)
        speed = std::max(speed, norm(v));
    for (const unsigned int n : joined_)
      for (const Slot &slot : nodes_[n])
        {
          const Slot    &first = nodes_[n].front();
          const Vec<dim> gap   = surface_of(slot).velocity[slot.node] - surface_of(first).velocity[first.node];
          if (norm(gap) > 1e-12 * speed)
            throw InputError(ties_place_ + ": \"" + members_[first.member].name + "\" and \"" +
                             members_[slot.member].name +
                             "\" are tied to each other, but at time 0 they move apart by " +
                             std::to_string(norm(gap)) + " m/s; give them one initial velocity where they touch");
        }
  }


  template <int dim>
  void DomainGroup<dim>::share_stops()
  {
    for (const unsigned int n : joined_)
      {
        std::vector<DomainNode<dim>> nodes;
        for (const Slot &slot : nodes_[n])
          nodes.push_back({members_[slot.member].domain, slot.node});
        Breakwater::share_stops(nodes);
      }
  }


  template <int dim>
  void DomainGroup<dim>::make_surface()
  {
    const unsigned int        none = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> number(nodes_.size(), none);
    // A facet of two members lies inside of a joint.
    std::map<std::set<unsigned int>, unsigned int> n_owners;
    const auto                                     nodes_of = [this](const unsigned int m, const auto &facet) {
      std::set<unsigned int> nodes;
      for (const unsigned int i : facet)
        nodes.insert(node_of_slot_[m][i]);
      return nodes;
    };
    for (unsigned int m = 0; m < members_.size(); ++m)
      for (const auto &facet : surface_of(m).facets)
        ++n_owners[nodes_of(m, facet)];
    for (unsigned int m = 0; m < members_.size(); ++m)
      for (auto facet : surface_of(m).facets)
        if (members_[m].is_exposed && n_owners[nodes_of(m, facet)] == 1)
          {
            for (unsigned int &i : facet)
              {
                const unsigned int node = node_of_slot_[m][i];
                if (number[node] == none)
                  {
                    number[node] = exposed_.size();
                    exposed_.push_back(node);
                  }
                i = number[node];
              }
            surface_.facets.push_back(facet);
            surface_.body_of_facet.push_back(m);
          }
    for (const Member &member : members_)
      surface_.bodies.push_back(member.name);
    start_surface();
  }


  template <int dim>
  void DomainGroup<dim>::keep_surface_nodes(const std::vector<unsigned int> &nodes)
  {
    std::vector<unsigned int> exposed;
    for (const unsigned int n : nodes)
      exposed.push_back(exposed_[n]);
    exposed_ = exposed;
    surface_.facets.clear();
    surface_.body_of_facet.clear();
    start_surface();
  }


  template <int dim>
  void DomainGroup<dim>::start_surface()
  {
    for (auto *field : {&surface_.position, &surface_.velocity, &surface_.acceleration, &surface_.inverse_mass})
      field->resize(exposed_.size());
    surface_.is_middle.clear();
    for (const unsigned int n : exposed_)
      surface_.is_middle.push_back(std::all_of(nodes_[n].begin(), nodes_[n].end(), [this](const Slot &slot) {
        const std::vector<char> &is_middle = surface_of(slot).is_middle;
        return !is_middle.empty() && is_middle[slot.node];
      }));
    update_surface();
    ++surface_.revision;
  }


  template <int dim>
  void DomainGroup<dim>::update_surface()
  {
    surface_.mass.assign(exposed_.size(), 0.);
    for (std::size_t w = 0; w < exposed_.size(); ++w)
      {
        const Node            &node  = nodes_[exposed_[w]];
        const WetSurface<dim> &first = surface_of(node[0]);
        surface_.position[w]         = first.position[node[0].node];
        surface_.velocity[w]         = first.velocity[node[0].node];
        surface_.acceleration[w]     = first.acceleration[node[0].node];
        surface_.inverse_mass[w]     = first.inverse_mass[node[0].node];
        for (const Slot &slot : node)
          surface_.mass[w] += surface_of(slot).mass[slot.node];
        for (std::size_t s = 1; s < node.size(); ++s)
          for (int d = 0; d < dim; ++d)
            {
              // 1 / (m + m'), and 0 where either is held
              const double a = surface_.inverse_mass[w][d], b = surface_of(node[s]).inverse_mass[node[s].node][d];
              surface_.inverse_mass[w][d] = a > 0 && b > 0 ? a * b / (a + b) : 0.;
            }
      }
  }


  template <int dim>
  double DomainGroup<dim>::stable_time_step() const
  {
    // Joined bodies have no higher frequency than the highest of any: K_k <= omega^2 M_k holds for the sums, too.
    double smallest = std::numeric_limits<double>::infinity();
    for (const Member &member : members_)
      smallest = std::min(smallest, member.domain->stable_time_step());
    return smallest;
  }


  template <int dim>
  void DomainGroup<dim>::advance_free(const double time_step)
  {
    for (const Member &member : members_)
      member.domain->advance_free(time_step);
    balance_joints(time_step);
    update_surface();
  }


  // Joined nodes get the acceleration sum(m a) / sum(m): f_k = m_k (a - a_k). A held one has no inertia that counts: it
  // takes the others' whole force, f = sum(m a).
  template <int dim>
  void DomainGroup<dim>::balance_joints(const double time_step)
  {
    if (joined_.empty())
      return;
    clear_forces();
    for (const unsigned int n : joined_)
      for (int d = 0; d < dim; ++d)
        {
          const Slot *holder = nullptr;
          double      mass = 0, force = 0;
          for (const Slot &slot : nodes_[n])
            {
              const double inverse_mass = surface_of(slot).inverse_mass[slot.node][d];
              if (!(inverse_mass > 0))
                holder = &slot;
              else
                {
                  mass += 1 / inverse_mass;
                  force += surface_of(slot).acceleration[slot.node][d] / inverse_mass;
                }
            }
          const double acceleration = holder == nullptr ? force / mass : 0.;
          for (const Slot &slot : nodes_[n])
            if (surface_of(slot).inverse_mass[slot.node][d] > 0)
              forces_[slot.member][slot.node][d] = (acceleration - surface_of(slot).acceleration[slot.node][d]) /
                                                   surface_of(slot).inverse_mass[slot.node][d];
          if (holder != nullptr)
            forces_[holder->member][holder->node][d] = force;
        }
    send_forces(time_step);
  }


  template <int dim>
  void DomainGroup<dim>::add_link_force(const std::vector<Vec<dim>> &force, const double time_step)
  {
    clear_forces();
    for (std::size_t w = 0; w < exposed_.size(); ++w)
      {
        const Node &node = nodes_[exposed_[w]];
        for (int d = 0; d < dim; ++d)
          {
            const auto inverse_mass = [&](const Slot &slot) {
              return surface_of(slot).inverse_mass[slot.node][d];
            };
            const auto holder = std::find_if(node.begin(), node.end(), [&](const Slot &slot) {
              return !(inverse_mass(slot) > 0);
            });
            if (holder != node.end())
              forces_[holder->member][holder->node][d] = force[w][d];
            else
              for (const Slot &slot : node)
                forces_[slot.member][slot.node][d] = force[w][d] * surface_.inverse_mass[w][d] / inverse_mass(slot);
          }
      }
    send_forces(time_step);
    update_surface();
  }


  template <int dim>
  void DomainGroup<dim>::clear_forces()
  {
    for (auto &forces : forces_)
      std::fill(forces.begin(), forces.end(), Vec<dim>());
  }


  template <int dim>
  void DomainGroup<dim>::send_forces(const double time_step)
  {
    for (unsigned int m = 0; m < members_.size(); ++m)
      if (!forces_[m].empty())
        members_[m].domain->add_link_force(forces_[m], time_step);
  }


  template <int dim>
  void DomainGroup<dim>::end_step()
  {
    for (const Member &member : members_)
      member.domain->end_step();
    double velocity_gap = 0, position_gap = 0;
    for (const unsigned int n : joined_)
      {
        const Slot            &first   = nodes_[n].front();
        const WetSurface<dim> &surface = surface_of(first);
        for (const Slot &slot : nodes_[n])
          {
            velocity_gap =
              std::max(velocity_gap, norm(surface_of(slot).velocity[slot.node] - surface.velocity[first.node]));
            position_gap =
              std::max(position_gap, norm(surface_of(slot).position[slot.node] - surface.position[first.node]));
          }
      }
    if (!joined_.empty())
      {
        context_->set_summary_max("largest velocity gap at joints [m/s]", velocity_gap);
        context_->set_summary_max("largest displacement drift at joints [m]", position_gap);
      }
  }


  template <int dim>
  unsigned int DomainGroup<dim>::adopt_surface(const WetSurface<dim> &)
  {
    throw std::logic_error("a group of bodies has surfaces of its own");
  }


  // Joined nodes lend in proportion to what they have; after that they must be given a common acceleration anew.
  template <int dim>
  void DomainGroup<dim>::lend_mass(const std::vector<double> &mass)
  {
    std::vector<std::vector<double>> masses;
    for (unsigned int m = 0; m < members_.size(); ++m)
      masses.emplace_back(surface_of(m).mass.size());
    for (std::size_t w = 0; w < exposed_.size(); ++w)
      for (const Slot &slot : nodes_[exposed_[w]])
        masses[slot.member][slot.node] = mass[w] * surface_of(slot).mass[slot.node] / surface_.mass[w];
    for (unsigned int m = 0; m < members_.size(); ++m)
      members_[m].domain->lend_mass(masses[m]);
    balance_joints(0.);
    update_surface();
    ++surface_.revision;
  }


  template <int dim>
  void DomainGroup<dim>::correct_surface(const std::vector<Vec<dim>> &position)
  {
    std::vector<std::vector<Vec<dim>>> positions;
    for (unsigned int m = 0; m < members_.size(); ++m)
      positions.push_back(surface_of(m).position);
    for (std::size_t w = 0; w < exposed_.size(); ++w)
      for (const Slot &slot : nodes_[exposed_[w]])
        positions[slot.member][slot.node] = position[w];
    for (unsigned int m = 0; m < members_.size(); ++m)
      members_[m].domain->correct_surface(positions[m]);
    update_surface();
  }


  template <int dim>
  std::vector<Stop<dim>> DomainGroup<dim>::stops(const unsigned int node) const
  {
    const Slot &first = nodes_[exposed_[node]].front();
    return members_[first.member].domain->stops(first.node);
  }


  template <int dim>
  void DomainGroup<dim>::set_stops(const unsigned int node, const std::vector<Stop<dim>> &stops)
  {
    for (const Slot &slot : nodes_[exposed_[node]])
      members_[slot.member].domain->set_stops(slot.node, stops);
  }


  template <int dim>
  DomainBalance<dim> DomainGroup<dim>::balance() const
  {
    DomainBalance<dim> sum;
    for (const Member &member : members_)
      sum += member.domain->balance();
    return sum;
  }


  template <int dim>
  void DomainGroup<dim>::add_history(Row &row)
  {
    for (const Member &member : members_)
      member.domain->add_history(row);
  }


  template <int dim>
  OutputMesh<dim> DomainGroup<dim>::output_mesh() const
  {
    return {};
  }


  template <int dim>
  void DomainGroup<dim>::save(std::ostream &stream) const
  {
    for (const Member &member : members_)
      member.domain->save(stream);
  }


  template <int dim>
  void DomainGroup<dim>::load(std::istream &stream)
  {
    for (const Member &member : members_)
      member.domain->load(stream);
    update_surface();
  }

  template void share_stops<2>(const std::vector<DomainNode<2>> &);
  template void share_stops<3>(const std::vector<DomainNode<3>> &);
  template class DomainGroup<2>;
  template class DomainGroup<3>;
  template std::vector<std::pair<unsigned int, unsigned int>> joint_nodes<2>(const std::vector<Vec<2>> &,
                                                                             const std::vector<Vec<2>> &);
  template std::vector<std::pair<unsigned int, unsigned int>> joint_nodes<3>(const std::vector<Vec<3>> &,
                                                                             const std::vector<Vec<3>> &);
} // namespace Breakwater
