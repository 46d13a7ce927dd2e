#pragma once

#include "tied_coupler.h"

namespace Breakwater
{
  /// Ties two domains without a multiplier, one after the other: the conventional serial staggered procedure (Farhat
  /// and Lesoinne, Two efficient staggered algorithms for the serial and parallel solution of three-dimensional
  /// nonlinear transient aeroelastic problems, Comput. Methods Appl. Mech. Engng 182 (2000) 499-515).
  ///
  /// The follower (the one that adopted the other's surface, otherwise the first one of the tie) moves with the velocity
  /// that the leader's last acceleration predicts; then the leader takes the follower's force, with the inertia of the
  /// follower's tied mass by the last acceleration: where that mass is larger than the leader's own, the scheme is
  /// unstable at any step. It is here as what the multiplier is compared with. Only the follower may have fine steps:
  /// the entry "Coarse domain" has no effect.
  template <int dim>
  class Staggered : public TiedCoupler<dim>
  {
  public:
    void   adopt_surfaces(const std::vector<ExplicitDomain<dim> *> &domains, const std::vector<Tie> &ties) override;
    double advance(double max_time_step) override;

  protected:
    std::string description() const override { return "staggered"; }
    bool        shares_mass() const override { return false; }
    void        choose_coarse_domains() override;

  private:
    using Base    = TiedCoupler<dim>;
    using Vectors = typename Base::Vectors;
    using Side    = typename Base::Side;
    using Start   = typename Base::Start;

    Side &follower() { return this->sides_[this->follower_]; }
    Side &leader() { return this->sides_[1 - this->follower_]; }

    Vectors leaders_value(const Vectors &field) const;
    Vectors reaction(const Vectors &acceleration) const;
    void    push_follower(const Vectors &change_of_acceleration, double time_step);
    void    set_acceleration(const Vectors &acceleration);
    void    set_velocity(const Vectors &velocity, double time_step);
    void    put_follower_on_leader();

    unsigned int follower_ = 0;
  };
} // namespace Breakwater
