#include <couplers/gravouil_combescure.h>
#include <couplers/prakash_hjelmstad.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "coupled_pair.h"

using namespace Breakwater;

namespace
{
  /// A free chain of masses that is stretched at the start. At every third step its springs change if it remeshes.
  class Remeshing : public Chain
  {
  public:
    Remeshing(const double place, const double mass, const double stable_step, const bool remeshes)
      : Chain({place, place + 1, place + 2}, {mass, mass, mass}, {{0, 1, 1.}, {1, 2, 1.}}, place < 0 ? 2 : 0,
              stable_step)
      , remeshes_(remeshes)
    {
      displacement() = {0.1, 0., 0.};
      velocity()     = {0.2, 0., 0.};
      if (place >= 0)
        for (std::vector<double> *field : {&displacement(), &velocity()})
          std::reverse(field->begin(), field->end());
    }
    void end_step() override
    {
      Chain::end_step();
      if (remeshes_ && n_ended_steps() % 3 == 0)
        stiffen(n_ended_steps() % 2 == 0 ? 1.2 : 1 / 1.2);
    }

  private:
    bool remeshes_;
  };

  /// Largest change of the momentum of two free chains that are tied, relative to what they have at the start.
  template <class Coupling>
  double lost_momentum(const unsigned int m, const bool first_is_coarse, const bool remeshes)
  {
    const double step = 0.2;
    Remeshing    first(-2, 1, first_is_coarse ? step : step / m, remeshes),
      second(0, 0.5, first_is_coarse ? step / m : step, remeshes);
    Coupling   coupling;
    RunContext context(std::filesystem::temp_directory_path());
    GivenParameters::read(coupling,
                          {{"Substeps", std::to_string(m)}, {"Coarse domain", first_is_coarse ? "first" : "second"}});
    first.setup();
    second.setup();
    coupling.adopt_surfaces({&first, &second}, {{"pair", 0, 1}});
    coupling.setup(context);
    const auto momentum = [&]() {
      return first.balance().momentum[0] + second.balance().momentum[0];
    };
    const double start   = momentum();
    double       largest = 0;
    for (unsigned int i = 0; i < 300; ++i)
      {
        coupling.advance(1.);
        largest = std::max(largest, std::abs(momentum() / start - 1));
        if (m == 1) // otherwise the multiplier would alternate from the first remesh on
          {
            EXPECT_NEAR(first.wet_surface().acceleration[0][0], second.wet_surface().acceleration[0][0], 1e-10);
          }
      }
    EXPECT_LT(coupling.balance(0).largest_gap, 1e-11);
    return largest;
  }


  // A remesh changes a domain's forces between two steps: both sides must take the change alike.
  TEST(Conservation, RemeshesLoseNoMomentumAtEqualSteps)
  {
    EXPECT_LT(lost_momentum<GravouilCombescure<2>>(1, true, true), 1e-12);
    EXPECT_LT(lost_momentum<PrakashHjelmstad<2>>(1, true, true), 1e-12);
  }


  // With Gravouil-Combescure the coarse side gets the last multiplier of a step, the fine one all of them: what is lost
  // is bounded and of the order of the coarse step.
  TEST(Conservation, MomentumAtUnequalSteps)
  {
    for (const unsigned int m : {2u, 5u, 20u})
      for (const bool first_is_coarse : {true, false})
        {
          const double gravouil = lost_momentum<GravouilCombescure<2>>(m, first_is_coarse, false),
                       prakash  = lost_momentum<PrakashHjelmstad<2>>(m, first_is_coarse, false);
          std::printf("%s coarse, m = %2u: momentum lost %.1e by Gravouil-Combescure, %.1e by Prakash-Hjelmstad\n",
                      first_is_coarse ? "first " : "second", m, gravouil, prakash);
          EXPECT_LT(prakash, 1e-12);
          EXPECT_LT(gravouil, 0.05);
          EXPECT_GT(gravouil, 1e-12); // if this fails, the manual is wrong
        }
  }
} // namespace
