// When slow passes run, and how long their kicks are.
#include "state/subcycle.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace courant {
namespace {

struct Taken {
  std::vector<int> outer;  ///< cycles
  Real kicked = 0;         ///< sum of the kicks of slow forces [T]
  Real end = 0;            ///< of the last interval that was planned, in its middle [T]
};

/// `dt`: of each cycle; `limit`: of slow passes.
template <class Dt>
Taken take(Subcycle& s, int cycles, const Dt& dt, Real limit, Real between = 1e9) {
  Taken out;
  Clock clock;
  for (; clock.cycle < cycles; ++clock.cycle) {
    const bool outer = s.begin(clock);
    EXPECT_EQ(outer, s.outer());
    clock.dt = dt(static_cast<int>(clock.cycle));
    if (outer) {
      s.chosen(clock, limit, between);
      out.outer.push_back(static_cast<int>(clock.cycle));
      out.kicked += s.weight() * clock.dt_mean();
      EXPECT_NEAR(s.slow().dt_mean(), s.weight() * clock.dt_mean(), 1e-12);
      out.end = clock.t + 0.5 * s.steps() * clock.dt;
    } else {
      EXPECT_LE(clock.dt, s.left());
    }
    s.end(clock);
    clock.t += clock.dt, clock.dt_old = clock.dt;
  }
  return out;
}
Real one(int) {
  return 1;
}

}  // namespace

// The first interval is one step, as no limit is known before.
TEST(Subcycle, TakesTheStepsThatTheLimitAllows) {
  Subcycle s(16);
  EXPECT_EQ(take(s, 20, one, 5.8).outer, (std::vector<int>{0, 1, 6, 11, 16}));
  Subcycle few(3);
  EXPECT_EQ(take(few, 12, one, 5.8).outer, (std::vector<int>{0, 1, 4, 7, 10}));
  Subcycle none(1);
  EXPECT_EQ(take(none, 4, one, 5.8).outer, (std::vector<int>{0, 1, 2, 3}));
  Subcycle springs(16);
  EXPECT_EQ(take(springs, 9, one, 5.8, 2.5).outer, (std::vector<int>{0, 1, 3, 5, 7}));
}

TEST(Subcycle, KicksReachTheMiddleOfTheInterval) {
  const auto growing = [](int cycle) { return cycle < 7 ? 1 : cycle < 30 ? 1 + 0.002 * (cycle - 7) : 0.6; };
  Subcycle s(16);
  const Taken taken = take(s, 60, growing, 5.8);
  EXPECT_GT(taken.outer.size(), 8u);
  EXPECT_LT(taken.outer.size(), 16u);
  EXPECT_NEAR(taken.kicked, taken.end, 1e-9);
}

TEST(Subcycle, IsThatOfEachStepWhereTheLimitIsShort) {
  Subcycle s(16);
  Clock clock;
  for (; clock.cycle < 5; ++clock.cycle) {
    EXPECT_TRUE(s.begin(clock));
    clock.dt = 1 + 0.01 * static_cast<Real>(clock.cycle);
    s.chosen(clock, 1.9, 1e9);
    EXPECT_TRUE(s.single());
    EXPECT_EQ(s.weight(), 1);
    EXPECT_EQ(s.slow().dt, clock.dt);
    EXPECT_EQ(s.slow().dt_old, clock.dt_old);
    s.end(clock);
    clock.t += clock.dt, clock.dt_old = clock.dt;
  }
}

// A limit that falls ends the plan, never below one step.
TEST(Subcycle, ShrinksWithTheLimit) {
  Subcycle s(16);
  Clock clock;
  clock.dt = 1;
  std::vector<int> outer;
  for (; clock.cycle < 20; ++clock.cycle) {
    if (s.begin(clock))
      outer.push_back(static_cast<int>(clock.cycle)), s.chosen(clock, clock.cycle < 6 ? 5.2 : 2.2, 1e9);
    s.end(clock);
    clock.t += clock.dt, clock.dt_old = clock.dt;
  }
  EXPECT_EQ(outer, (std::vector<int>{0, 1, 6, 8, 10, 12, 14, 16, 18}));
}

}  // namespace courant
