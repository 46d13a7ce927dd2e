#pragma once

#include <breakwater/interfaces/explicit_domain.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <utility>
#include <vector>

namespace Breakwater
{
  /// A test double of a domain: point masses on a line along x, joined by springs, one of them at the wet surface.
  /// y is held. Positions are the places at rest plus the displacements.
  class Chain : public ExplicitDomain<2>
  {
  public:
    struct Spring
    {
      unsigned int a, b;      ///< b = ground(): tied to its place at rest
      double       stiffness; ///< [N/m]
    };
    static constexpr unsigned int ground() { return std::numeric_limits<unsigned int>::max(); }

    Chain(std::vector<double> rest, std::vector<double> mass, std::vector<Spring> springs, const unsigned int tied,
          const double stable_step)
      : rest_(std::move(rest))
      , mass_(std::move(mass))
      , springs_(std::move(springs))
      , tied_(tied)
      , stable_step_(stable_step)
      , u_(rest_.size())
      , v_(rest_.size())
      , a_(rest_.size())
    {
      surface_.position.resize(1);
      surface_.velocity.resize(1);
      surface_.acceleration.resize(1);
      surface_.inverse_mass.resize(1);
      surface_.mass.resize(1);
    }

    std::vector<double> &displacement() { return u_; }
    std::vector<double> &velocity() { return v_; }
    std::vector<double> &mass() { return mass_; }
    void                 set_stable_time_step(const double stable_step) { stable_step_ = stable_step; }
    double               tied_displacement() const { return u_[tied_]; }
    unsigned int         n_ended_steps() const { return n_ended_steps_; }

    void setup(const std::string &, const BodyForces<2> &, RunContext &) override { setup(); }
    void setup()
    {
      a_ = free_acceleration();
      update_surface();
    }
    double stable_time_step() const override { return stable_step_; }
    void   advance_free(const double time_step) override
    {
      for (std::size_t i = 0; i < u_.size(); ++i)
        {
          u_[i] += time_step * (v_[i] + time_step / 2 * a_[i]);
          v_[i] += time_step / 2 * a_[i];
        }
      a_ = free_acceleration();
      for (std::size_t i = 0; i < u_.size(); ++i)
        v_[i] += time_step / 2 * a_[i];
      update_surface();
    }
    void add_link_force(const std::vector<Vec<2>> &force, const double time_step) override
    {
      a_[tied_] += force[0][0] / mass_[tied_];
      v_[tied_] += time_step / 2 * force[0][0] / mass_[tied_];
      update_surface();
    }
    void end_step() override { ++n_ended_steps_; }

    /// All springs get this many times as stiff, as a remesh changes a fluid's forces.
    void stiffen(const double factor)
    {
      const std::vector<double> before = free_acceleration();
      for (Spring &spring : springs_)
        spring.stiffness *= factor;
      const std::vector<double> after = free_acceleration();
      for (std::size_t i = 0; i < a_.size(); ++i)
        a_[i] += after[i] - before[i];
      update_surface();
    }
    const WetSurface<2> &wet_surface() const override { return surface_; }
    unsigned int         adopt_surface(const WetSurface<2> &partner) override
    {
      mass_[tied_] += partner.mass[0];
      setup();
      return 0;
    }
    bool can_adopt_surface() const override { return adopts_; }
    void lend_mass(const std::vector<double> &mass) override
    {
      mass_[tied_] -= mass[0];
      setup();
    }
    void set_adopts(const bool adopts) { adopts_ = adopts; }
    void correct_surface(const std::vector<Vec<2>> &position) override
    {
      rest_[tied_] = position[0][0] - u_[tied_];
      update_surface();
    }
    DomainBalance<2> balance() const override
    {
      DomainBalance<2> balance;
      for (std::size_t i = 0; i < u_.size(); ++i)
        {
          balance.kinetic_energy += 0.5 * mass_[i] * v_[i] * v_[i];
          balance.momentum[0] += mass_[i] * v_[i];
        }
      for (const Spring &spring : springs_)
        balance.strain_energy += 0.5 * spring.stiffness * stretch(spring) * stretch(spring);
      return balance;
    }
    double        energy() const { return balance().kinetic_energy + balance().strain_energy; }
    void          add_history(Row &) override {}
    OutputMesh<2> output_mesh() const override { return {}; }
    void          save(std::ostream &stream) const override
    {
      for (const std::vector<double> *field : {&u_, &v_, &a_})
        stream.write(reinterpret_cast<const char *>(field->data()), field->size() * sizeof(double));
    }
    void load(std::istream &stream) override
    {
      for (std::vector<double> *field : {&u_, &v_, &a_})
        stream.read(reinterpret_cast<char *>(field->data()), field->size() * sizeof(double));
      update_surface();
    }

  private:
    double stretch(const Spring &spring) const { return (spring.b == ground() ? 0. : u_[spring.b]) - u_[spring.a]; }
    std::vector<double> free_acceleration() const
    {
      std::vector<double> a(u_.size());
      for (const Spring &spring : springs_)
        {
          const double force = spring.stiffness * stretch(spring);
          a[spring.a] += force / mass_[spring.a];
          if (spring.b != ground())
            a[spring.b] -= force / mass_[spring.b];
        }
      return a;
    }
    void update_surface()
    {
      surface_.position[0]     = {{rest_[tied_] + u_[tied_], 0.}};
      surface_.velocity[0]     = {{v_[tied_], 0.}};
      surface_.acceleration[0] = {{a_[tied_], 0.}};
      surface_.inverse_mass[0] = {{1 / mass_[tied_], 0.}};
      surface_.mass[0]         = mass_[tied_];
    }

    std::vector<double> rest_, mass_;
    std::vector<Spring> springs_;
    unsigned int        tied_;
    double              stable_step_;
    bool                adopts_ = false;
    std::vector<double> u_, v_, a_;
    WetSurface<2>       surface_;
    unsigned int        n_ended_steps_ = 0;
  };

  /// One mass on a spring to the ground.
  inline Chain point_mass(const double mass, const double stiffness, const double time_step)
  {
    return Chain({0.}, {mass}, {{0, Chain::ground(), stiffness}}, 0, time_step);
  }

  /// A bar of n cells of unit section over [begin, end], lumped masses; its clamped node, at the end that is not tied,
  /// is left out: its neighbour has a spring to the ground.
  inline Chain bar(const double begin, const double end, const unsigned int n, const double density,
                   const double modulus, const bool tied_at_end, const double time_step)
  {
    const double               h = (end - begin) / n;
    std::vector<double>        rest, mass(n, density * h);
    std::vector<Chain::Spring> springs;
    for (unsigned int i = 0; i < n; ++i)
      rest.push_back(tied_at_end ? begin + (i + 1) * h : begin + i * h);
    for (unsigned int i = 0; i + 1 < n; ++i)
      springs.push_back({i, i + 1, modulus / h});
    springs.push_back({tied_at_end ? 0 : n - 1, Chain::ground(), modulus / h});
    mass[tied_at_end ? n - 1 : 0] = density * h / 2;
    return Chain(rest, mass, springs, tied_at_end ? n - 1 : 0, time_step);
  }
} // namespace Breakwater
