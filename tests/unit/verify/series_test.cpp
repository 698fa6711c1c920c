#include "verify/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace courant {
namespace {

Series sampled(Real from, Real to, int n, const std::function<Real(Real)>& f) {
  Series out;
  for (int i = 0; i <= n; ++i) {
    out.x.push_back(from + (to - from) * i / n);
    out.y.push_back(f(out.x.back()));
  }
  return out;
}

Real take(const Series& s, const char* what, std::optional<Real> at = {}) {
  return take_number(s, what, at).value.value_or(std::nan(""));
}

TEST(Series, SimpleTakes) {
  const Series s = sampled(0, 2, 4, [](Real t) { return 3 - 2 * t; });  // 3 2 1 0 -1
  EXPECT_EQ(take(s, "final"), -1);
  EXPECT_EQ(take(s, "mean"), 1);
  EXPECT_EQ(take(s, "min"), -1);
  EXPECT_EQ(take(s, "max"), 3);
  EXPECT_DOUBLE_EQ(take(s, "at", 0.75), 1.5);
  EXPECT_DOUBLE_EQ(take(s, "slope"), -2);
  EXPECT_EQ(take(s, "growth"), 1);
  EXPECT_FALSE(take_number(s, "at", 2.1).value);
  EXPECT_FALSE(take_number(s, "at", -0.1).value);
  EXPECT_EQ(take(s, "at", 2.000001), -1) << "a state may be written a little early";
  EXPECT_FALSE(take_number({}, "mean", {}).value);
  EXPECT_FALSE(take_number({{0}, {1}}, "slope", {}).value);
  EXPECT_FALSE(take_number({{0, 1}, {0, 1}}, "growth", {}).value);
}

TEST(Series, PeriodOfASine) {
  for (const Real cycles : {2.2, 3.0, 3.7, 10.4})
    for (const Real phase : {0.0, 1.0, 2.5, 4.0}) {
      const Series s =
          sampled(0, cycles * 1.3, 400, [&](Real t) { return 5 + std::sin(2 * pi * t / 1.3 + phase); });
      EXPECT_NEAR(take(s, "period"), 1.3, 2e-3 * 1.3) << cycles << " cycles, phase " << phase;
    }
}

TEST(Series, PeriodOverATrendWithDecayAndNoise) {
  std::mt19937 random(1);
  std::normal_distribution<Real> noise(0, 0.05);
  const auto f = [&](Real t) {
    return 2 + 0.3 * t + std::exp(-0.1 * t) * std::sin(2 * pi * t / 0.8 + 0.7) + noise(random);
  };
  EXPECT_NEAR(take(sampled(0, 5, 1000, f), "period"), 0.8, 0.01);
}

TEST(Series, NoPeriod) {
  EXPECT_FALSE(take_number(sampled(0, 1, 100, [](Real t) { return t; }), "period", {}).value);
  EXPECT_FALSE(take_number(sampled(0, 1, 100, [](Real) { return 1.0; }), "period", {}).value);
  const Series half = sampled(0, 1, 100, [](Real t) { return std::sin(pi * t); });
  EXPECT_FALSE(take_number(half, "period", {}).value);
}

TEST(Series, DecayOfPeaks) {
  const Series s = sampled(0, 6, 1200, [](Real t) { return std::exp(-0.4 * t) * std::cos(5 * t); });
  EXPECT_NEAR(take(s, "decay"), 0.4, 2e-3);
  // as of a kinetic energy: never negative, decays twice as fast
  const Series energy =
      sampled(0, 6, 1200, [](Real t) { return std::pow(std::exp(-0.4 * t) * std::cos(5 * t), 2); });
  EXPECT_NEAR(take(energy, "decay"), 0.8, 4e-3);
  const Series growing = sampled(0, 3, 600, [](Real t) { return std::exp(0.2 * t) * std::sin(9 * t); });
  EXPECT_NEAR(take(growing, "decay"), -0.2, 2e-3);
  EXPECT_FALSE(take_number(sampled(0, 1, 50, [](Real t) { return std::exp(-t); }), "decay", {}).value);
}

TEST(Series, Norms) {
  const std::vector<Real> d = {3, -4, 0, 0};
  EXPECT_DOUBLE_EQ(norm_of(d, "l1"), 7.0 / 4);
  EXPECT_DOUBLE_EQ(norm_of(d, "l2"), 2.5);
  EXPECT_DOUBLE_EQ(norm_of(d, "linf"), 4);
}

TEST(Series, WindowAndThinning) {
  const Series s = sampled(0, 1, 1000, [](Real t) { return t; });
  EXPECT_EQ(window(s, 0.25, 0.5).size(), 251u);
  const Series thin = thinned(s, 400);
  EXPECT_EQ(thin.size(), 400u);
  EXPECT_EQ(thin.x.front(), 0);
  EXPECT_EQ(thin.x.back(), 1);
  EXPECT_EQ(thinned(s, 2000).size(), 1001u);
}

TEST(Series, Slope) {
  EXPECT_DOUBLE_EQ(*slope_of({0, 1, 2}, {1, 3, 5}), 2);
  EXPECT_FALSE(slope_of({1, 1}, {0, 1}));
  EXPECT_FALSE(slope_of({1}, {1}));
}

}  // namespace
}  // namespace courant
