// Influences of the rate in the loops of each instruction set, against the functions of the C library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/instruction_set.hpp"
#include "laws/strength/rate_factor.hpp"

using namespace courant;

namespace {

/// Plastic strains and rates over many sizes, and 0.
YieldPoints many_points() {
  YieldPoints out;
  out.count = block_size;
  for (Index i = 0; i < out.count; ++i) {
    out.plastic[i] = i == 0 ? 0 : 1e-9 * std::pow(1.4, i);
    out.rate[i] = i == 1 ? 0 : 1e-12 * std::pow(2.2, i);
    out.stress[i] = 3 + 0.01 * i, out.by_strain[i] = 0.5 + 0.1 * i, out.by_rate[i] = 0;
  }
  return out;
}
void expect_near(Real found, Real expected, Index i) {
  EXPECT_NEAR(found, expected, 1e-14 * std::abs(expected)) << i;
}

}  // namespace

TEST(RateFactor, LoopsAgreeWithTheLibrary) {
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    const RateLoops loops = rate_loops();
    const YieldPoints before = many_points();
    YieldPoints scaled = before, added = before, logarithmic = before, power = before, hardening = before,
                power_law = before;
    const Real C = 40, P = 5, rate0 = 1e-4, K = 2, e0 = 1e-3, n = 0.3;
    loops.scale({C, P}, scaled);
    loops.add({C, P}, 7, added);
    loops.logarithmic(rate0, 0.02, 0.003, logarithmic);
    loops.power_of_rate(rate0, 0.02, power);
    loops.power_hardening({3, 2, n, 3.5}, hardening);
    loops.power_law(K, e0, n, power_law);
    Real logarithm[block_size];
    loops.logarithm(before.count, before.rate, logarithm);
    for (Index i = 0; i < before.count; ++i) {
      const Real rate = before.rate[i], e = before.plastic[i], stress = before.stress[i];
      const Real u = std::pow(rate / C, 1 / P), slope = rate > 0 ? u / (P * rate) : 0;
      expect_near(scaled.stress[i], stress * (1 + u), i);
      expect_near(scaled.by_strain[i], before.by_strain[i] * (1 + u), i);
      expect_near(scaled.by_rate[i], stress * slope, i);
      expect_near(added.stress[i], stress + 7 * u, i);
      expect_near(added.by_strain[i], before.by_strain[i], i);
      expect_near(added.by_rate[i], 7 * slope, i);
      const bool counts = rate > rate0;
      const Real x = counts ? std::log(rate / rate0) : 0;
      expect_near(logarithmic.stress[i], stress * (1 + 0.02 * x + 0.003 * x * x), i);
      expect_near(logarithmic.by_rate[i], counts ? stress * (0.02 + 0.006 * x) / rate : 0, i);
      expect_near(power.stress[i], stress * std::exp(0.02 * x), i);
      expect_near(power.by_rate[i], counts ? stress * 0.02 * std::exp(0.02 * x) / rate : 0, i);
      const Real grown = 3 + 2 * std::pow(e, n);
      expect_near(hardening.stress[i], std::min(grown, 3.5), i);
      expect_near(hardening.by_strain[i], grown < 3.5 && e > 0 ? 2 * n * std::pow(e, n - 1) : 0, i);
      expect_near(power_law.stress[i], K * std::pow(e0 + e, n), i);
      expect_near(power_law.by_strain[i], n * K * std::pow(e0 + e, n - 1), i);
      if (rate > 0) expect_near(logarithm[i], std::log(rate), i);
    }
    EXPECT_LT(logarithm[1], -600);
  }
  use_instruction_set(instruction_sets().back());
}

// What is no number stays none, so that a run with it ends.
TEST(RateFactor, NothingComesOfNaN) {
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    const RateLoops loops = rate_loops();
    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    YieldPoints points = many_points();
    std::fill_n(points.rate, points.count, nan), std::fill_n(points.plastic, points.count, nan);
    loops.scale({40, 5}, points);
    Real logarithm[block_size];
    loops.logarithm(points.count, points.rate, logarithm);
    YieldPoints power = many_points();
    std::fill_n(power.plastic, power.count, nan);
    loops.power_law(2, 1e-3, 0.3, power);
    for (Index i = 0; i < points.count; ++i) {
      EXPECT_TRUE(std::isnan(points.stress[i])) << i;
      EXPECT_TRUE(std::isnan(logarithm[i])) << i;
      EXPECT_TRUE(std::isnan(power.stress[i])) << i;
    }
  }
  use_instruction_set(instruction_sets().back());
}
