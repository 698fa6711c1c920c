#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "time/steady_step.hpp"

using namespace courant;

namespace {

/// A mass on a spring of frequency 1 and steps of 1.8 whose limit swings by 1 % with twice that frequency, as
/// by strain of a neighbour; v^2 + x^2 (1 - dt^2/4), v in the middle of both half steps, after n steps over
/// that at first.
Real energy_after(int n, const std::function<Real(Real)>& step_of) {
  const Real turn = 2 * std::acos(1 - 0.5 * 1.8 * 1.8);
  Real x = 0, v = 1, dt = step_of(1.8), energy = 0;
  for (int k = 0; k < n; ++k) {
    x += dt * v;
    const Real next = step_of(1.8 * (1 + 0.01 * std::sin(turn * k))), before = v;
    v -= 0.5 * (dt + next) * x, dt = next;
    energy = std::pow(0.5 * (before + v), 2) + x * x * (1 - 0.25 * dt * dt);
  }
  return energy;
}

}  // namespace

TEST(SteadyStep, DoesNotPump) {
  EXPECT_GT(energy_after(300, [](Real allowed) { return allowed; }), 3);
  SteadyStep steady;
  EXPECT_NEAR(energy_after(100'000, [&](Real allowed) { return steady.next(allowed); }), 1, 0.2);
}

TEST(SteadyStep, FallsAtOnceAndSomewhatBelow) {
  SteadyStep steady;
  EXPECT_EQ(steady.next(1), 1);
  EXPECT_EQ(steady.next(1.1), 1);
  EXPECT_NEAR(steady.next(1 - 1e-6), 1 - 5e-6, 1e-10);  // what hardly swings costs hardly anything
  EXPECT_NEAR(steady.next(0.5), 0.495, 1e-12);
  EXPECT_NEAR(steady.next(0.496), 0.495, 1e-12);
}

TEST(SteadyStep, GrowsSlowlyToTheLeastOfAWhile) {
  SteadyStep steady;
  steady.next(1), steady.next(0.5);
  Real last = 0.495;
  int first = 0, k = 0;
  for (; k < 5000; ++k) {
    const Real dt = steady.next(k % 50 == 0 ? 0.9 : 1);
    EXPECT_GE(dt, last);
    EXPECT_LE(dt, last * 1.002000001);
    if (first == 0 && dt > last) first = k;
    last = dt;
  }
  EXPECT_GE(first, 190);
  EXPECT_NEAR(last, 0.891, 1e-12);
  EXPECT_TRUE(std::isnan(steady.next(std::nan(""))));
}

TEST(SteadyStep, TakesOthersAsTheyComeWhereTheyAreFarBelow) {
  SteadyStep steady;
  for (int k = 0; k < 5; ++k)
    EXPECT_EQ(steady.next(1, k % 2 == 0 ? 0.3 : 0.4, "fluid").dt, k % 2 == 0 ? 0.3 : 0.4);
  SteadyStep near;
  near.next(1, 1, "element");
  EXPECT_NEAR(near.next(1, 0.8, "fluid").dt, 0.792, 1e-12);
  const TimeLimit::Limit held = near.next(1, 1, "element");
  EXPECT_NEAR(held.dt, 0.792, 1e-12);
  EXPECT_EQ(held.who, "fluid, in a step before");
}

TEST(SteadyStep, GrowsSlowlyToOthersWhenNothingRingsAnyMore) {
  constexpr Real none = std::numeric_limits<Real>::infinity();
  SteadyStep steady;
  EXPECT_EQ(steady.next(none, 1, "body").dt, 1);
  Real last = steady.next(0.5, 1, "contact").dt;
  EXPECT_EQ(last, 0.5);
  for (int k = 0; k < 199; ++k) EXPECT_EQ(steady.next(none, k % 2 == 0 ? 1 : 0.9, "body").dt, last);
  while (last < 0.87) {
    const TimeLimit::Limit now = steady.next(none, 0.9, "body");
    EXPECT_LE(now.dt, last * 1.002000001);
    EXPECT_GE(now.dt, last);
    EXPECT_EQ(now.who, "contact, in a step before");
    last = now.dt;
  }
  for (int k = 0; k < 20; ++k) last = steady.next(none, 0.9, "body").dt;
  EXPECT_EQ(last, 0.9);
  EXPECT_EQ(steady.next(none, 0.3, "body").dt, 0.3);
  EXPECT_EQ(steady.next(none, 0.9, "body").dt, 0.9);
}
