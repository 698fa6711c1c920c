// Plane stress of laws of strength, by trial steps and in closed form, against return along the plane.
#include <gtest/gtest.h>

#include <cmath>

#include "base/instruction_set.hpp"
#include "law_from_cards.hpp"
#include "laws/strength/strength.hpp"
#include "parallel/parallel.hpp"

using namespace courant;

namespace {

/// A block of points with numbers of their own.
struct SheetPoints {
  static constexpr Index count = block_size;
  Real rate[6][count] = {}, stress[6][count] = {}, history[8][count] = {}, speed[count], rate_zz[count];
  std::vector<Real*> kept;

  /// `generic`: by trial steps, whatever the law knows.
  void step(const StrengthLaw& law, Real dt, bool generic) {
    std::fill(rate[2], rate[2] + count, 1e3);  // must not be looked at
    if (generic)
      law.StrengthLaw::update_in_plane_stress(block_of(law, dt), rate_zz);
    else
      law.update_in_plane_stress(block_of(law, dt), rate_zz);
  }
  void step_in_space(const StrengthLaw& law, Real dt) { law.update(block_of(law, dt)); }
  PointBlock block_of(const StrengthLaw& law, Real dt) {
    PointBlock block;
    block.count = count, block.dt = dt, block.sound_speed = speed;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = rate[k], block.stress[k] = stress[k];
    std::size_t numbers = 0;
    for (const HistoryVariable& h : law.history()) numbers += static_cast<std::size_t>(h.components);
    kept.clear();
    for (std::size_t k = 0; k < numbers; ++k) kept.push_back(history[k]);
    block.history = kept;
    return block;
  }
  void fill_rates(Real size) {
    for (int k = 0; k < 6; ++k)
      for (Index i = 0; i < count; ++i)
        rate[k][i] = size * (0.05 + (i % 4) / 3.0) * std::sin(1.0 + 3 * k + 0.37 * i);
  }
};

Real mises(const SheetPoints& p, Index i) {
  const auto& s = p.stress;
  return std::sqrt(s[0][i] * s[0][i] - s[0][i] * s[1][i] + s[1][i] * s[1][i] +
                   3 * (s[3][i] * s[3][i] + s[4][i] * s[4][i] + s[5][i] * s[5][i]));
}

/// Return along the plane (Simo & Taylor 1986) by halving: with a = (xx + yy)/sqrt(2), b = (yy - xx)/sqrt(2)
/// of the trial stress and multiplier m, a/(1 + E m/(3 (1 - nu))), b and all shear over 1 + 2 G m.
struct Returned {
  Real xx, yy, xy, yz, zx, plastic;
};
Returned returned(const SheetPoints& trial, Index i, Real E, Real nu, Real yield, Real hardening) {
  const Real G = E / (2 * (1 + nu));
  const auto& s = trial.stress;
  const auto at = [&](Real m) {
    const Real f = 1 / (1 + E * m / (3 * (1 - nu))), g = 1 / (1 + 2 * G * m);
    const Real a = f * (s[0][i] + s[1][i]), b = g * (s[1][i] - s[0][i]);
    return Returned{0.5 * (a - b), 0.5 * (a + b), g * s[3][i], g * s[4][i], g * s[5][i], 0};
  };
  const auto q = [](const Returned& r) {
    return std::sqrt(r.xx * r.xx - r.xx * r.yy + r.yy * r.yy + 3 * (r.xy * r.xy + r.yz * r.yz + r.zx * r.zx));
  };
  Real low = 0, high = 100 / E;
  if (q(at(0)) <= yield) high = 0;
  for (int k = 0; k < 200; ++k) {
    const Real m = 0.5 * (low + high), e = 2.0 / 3 * m * q(at(m));
    (q(at(m)) > yield + hardening * e ? low : high) = m;
  }
  Returned out = at(high);
  out.plastic = 2.0 / 3 * high * q(out);
  return out;
}

}  // namespace

TEST(PlaneStress, TrialStepsGiveWhatTheClosedFormGives) {
  const auto law = test::law_from_cards("MAT_ELASTIC", "1,2.0,2.5,0.3\n");
  SheetPoints a, b;
  for (SheetPoints* p : {&a, &b}) {
    p->fill_rates(0.1);
    p->step(*law, 0.5, p == &a), p->step(*law, 0.25, p == &a);
  }
  for (Index i = 0; i < SheetPoints::count; ++i) {
    EXPECT_NEAR(a.rate_zz[i], -0.3 / 0.7 * (a.rate[0][i] + a.rate[1][i]), 1e-10);
    EXPECT_NEAR(b.rate_zz[i], -0.3 / 0.7 * (b.rate[0][i] + b.rate[1][i]), 1e-15);
    EXPECT_NEAR(b.stress[0][i], 0.75 * 2.5 / 0.91 * (b.rate[0][i] + 0.3 * b.rate[1][i]), 1e-14);
    EXPECT_NEAR(b.stress[3][i], 0.75 * 2.5 / 1.3 * b.rate[3][i], 1e-14);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(a.stress[k][i], b.stress[k][i], 1e-10) << k;
    EXPECT_EQ(a.stress[2][i], 0);
    EXPECT_EQ(b.stress[2][i], 0);
  }
}

// History counts once, however many trials there were.
TEST(PlaneStress, PlasticPointsReturnAlongThePlane) {
  const Real E = 2.5, nu = 0.3, Ep = E * 0.5 / (E - 0.5);
  const auto law = test::law_from_cards("MAT_PLASTIC_KINEMATIC", "1,2.0,2.5,0.3,0.2,0.5,1.0\n");
  const auto elastic = test::law_from_cards("MAT_ELASTIC", "1,2.0,2.5,0.3\n");
  for (const bool generic : {false, true}) {
    SheetPoints p, trial;
    p.fill_rates(0.2), trial.fill_rates(0.2);
    p.step(*law, 1, generic), trial.step(*elastic, 1, false);
    int plastic = 0;
    for (Index i = 0; i < SheetPoints::count; ++i) {
      const Returned r = returned(trial, i, E, nu, 0.2, Ep);
      plastic += r.plastic > 0;
      EXPECT_NEAR(p.history[0][i], r.plastic, 1e-9) << i;
      EXPECT_NEAR(p.stress[0][i], r.xx, 1e-9);
      EXPECT_NEAR(p.stress[1][i], r.yy, 1e-9);
      EXPECT_NEAR(p.stress[3][i], r.xy, 1e-9);
      EXPECT_NEAR(p.stress[4][i], r.yz, 1e-9);
      EXPECT_NEAR(p.stress[5][i], r.zx, 1e-9);
      EXPECT_EQ(p.stress[2][i], 0);
      // volume changes elastically: D zz = tr(stress)/(3 K) - D xx - D yy
      const Real K = E / (3 * (1 - 2 * nu));
      EXPECT_NEAR(p.rate_zz[i], (r.xx + r.yy) / (3 * K) - p.rate[0][i] - p.rate[1][i], 1e-8) << i;
    }
    EXPECT_GT(plastic, 10);
    EXPECT_LT(plastic, SheetPoints::count);
  }
}

// Any law of the registry: on its yield surface the trials leave no stress across the plane, and a second
// step back and forth goes on from the history of the first.
TEST(PlaneStress, KinematicHardeningWithRatesHasNoStressAcross) {
  const auto law =
      test::law_from_cards("MAT_PLASTIC_KINEMATIC", "1,2.0,2.5,0.3,0.2,0.5,0.4\n10.0,4.0,0.0,1\n");
  SheetPoints p;
  p.fill_rates(4);
  Real before[SheetPoints::count];
  for (int k = 0; k < 4; ++k) {
    std::copy_n(p.history[0], SheetPoints::count, before);
    p.step(*law, 1, true);
    for (Index i = 0; i < SheetPoints::count; ++i) {
      EXPECT_EQ(p.stress[2][i], 0);
      EXPECT_TRUE(std::isfinite(mises(p, i)));
      EXPECT_GE(p.history[0][i], before[i]);
      if (k == 3) {
        EXPECT_GT(p.history[0][i], before[i]) << i;
      }
    }
  }
}

// Curves with bends, one that falls, a power law: what trial steps find, the multiplier finds, too, in loops
// of each instruction set.
TEST(PlaneStress, TheMultiplierGivesWhatTrialStepsGive) {
  const std::pair<const char*, const char*> laws[] = {
      {"MAT_PIECEWISE_LINEAR_PLASTICITY", "1,2.0,2.5,0.3,0.2,0.5\n"},
      {"MAT_PIECEWISE_LINEAR_PLASTICITY", "1,2.0,2.5,0.3\n\n0.0,0.02,0.05,0.2,0.4\n0.2,0.3,0.31,0.6,0.6\n"},
      {"MAT_PIECEWISE_LINEAR_PLASTICITY", "1,2.0,2.5,0.3\n\n0.0,0.05,0.5,1.0\n0.2,0.25,0.15,0.15\n"},
      {"MAT_POWER_LAW_PLASTICITY", "1,2.0,2.5,0.3,0.5,0.3\n0.15\n"}};
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    for (const auto& [name, cards] : laws) {
      const auto law = test::law_from_cards(name, cards);
      SheetPoints a, b;
      for (SheetPoints* p : {&a, &b}) {
        p->fill_rates(0.3);
        for (const Real dt : {0.4, 0.2, 0.6}) p->step(*law, dt, p == &a);
      }
      int plastic = 0;
      for (Index i = 0; i < SheetPoints::count; ++i) {
        plastic += b.history[0][i] > 0;
        EXPECT_NEAR(a.history[0][i], b.history[0][i], 1e-9) << name << " " << i;
        EXPECT_NEAR(a.rate_zz[i], b.rate_zz[i], 1e-8) << name << " " << i;
        for (int k = 0; k < 6; ++k) EXPECT_NEAR(a.stress[k][i], b.stress[k][i], 1e-9) << name << k;
      }
      EXPECT_GT(plastic, 10);
    }
  }
  use_instruction_set(instruction_sets().back());
}

// The plane against space: with the rate zz that the plane leaves, the law in space answers with the same
// stress and none across. Every influence of the rate, with and without back stress, curves with bends, a
// small power of plastic strain; steps from 1e-4 of the yield strain to tens of it.
TEST(PlaneStress, RatesGiveTheStressOfSpace) {
  const std::string curve = "*DEFINE_CURVE\n1\n0.0,0.25\n0.01,0.3\n0.1,0.36\n1.0,0.5\n";
  const std::string factor = "*DEFINE_CURVE\n2\n0.0,1.0\n0.01,1.2\n0.1,1.5\n10.0,2.0\n";
  const std::string table =
      "*DEFINE_CURVE\n3\n0.0,0.4\n1.0,0.6\n*DEFINE_TABLE_2D\n4\n0.01,1\n1.0,3\n*DEFINE_TABLE_2D\n5\n-4.0,"
      "1\n0.0,3\n";
  const std::string soft = "*DEFINE_CURVE\n6\n0.0,0.25\n0.02,0.3\n0.5,0.2\n1.0,0.2\n",
                    elastic = "1,7.85e-6,207.0,0.3,";
  const char *multilinear = "MAT_PIECEWISE_LINEAR_PLASTICITY", *kinematic = "MAT_PLASTIC_KINEMATIC";
  const char *power = "MAT_POWER_LAW_PLASTICITY", *johnson_cook = "MAT_SIMPLIFIED_JOHNSON_COOK";
  const std::pair<const char*, std::string> laws[] = {
      {multilinear, elastic + "0.251,0.5\n0.04,5.0\n"},
      {multilinear, elastic + "0.251,0.5\n0.04,5.0,,,-1\n"},
      {multilinear, elastic + "0.251,0.5\n0.04,5.0,,,1\n"},
      {multilinear, elastic + "\n0.04,5.0,1,,1\n\n\n" + curve},
      {multilinear, elastic + "\n0.04,5.0,6,,1\n\n\n" + soft},
      {multilinear, elastic + "\n,,1,2,0\n\n\n" + curve + factor},
      {multilinear, elastic + "\n,,1,2,1\n\n\n" + curve + factor},
      {multilinear, elastic + "\n,,4,,0\n\n\n" + curve + table},
      {multilinear, elastic + "\n,,4,,1\n\n\n" + curve + table},
      {multilinear, elastic + "\n,,5,,1\n\n\n" + curve + table},
      {kinematic, elastic + "0.251,5.5,0.3\n"},
      {kinematic, elastic + "0.251,5.5,0.3\n0.04,5.0,,0\n"},
      {kinematic, elastic + "0.251,5.5,0.3\n0.04,5.0,,1\n"},
      {power, elastic + "0.6,0.2,0.04,5.0\n"},
      {power, elastic + "0.6,0.2,0.04,5.0\n0.3,1\n"},
      {johnson_cook, elastic + "0\n0.25,0.3,0.3,0.02,,,,0.001\n"},
      {johnson_cook, elastic + "1\n0.25,0.3,0.3,0.02,,,,0.001\n"},
      {johnson_cook, elastic + "1\n0.25,0.3,0.3,0.02,,0.35,0.38,0.001\n"}};
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    for (const auto& [name, cards] : laws) {
      const auto law = test::law_from_cards(name, cards);
      SheetPoints plane;
      int plastic = 0;
      Real most_apart = 0;
      for (int n = 0; n < 120; ++n) {
        const Real size = std::pow(10.0, -3 + n % 5), turn = 0.1 * (n / 5);
        for (int k = 0; k < 6; ++k)
          for (Index i = 0; i < SheetPoints::count; ++i)
            plane.rate[k][i] = size * (0.01 + (i % 4) / 3.0) * std::sin(1.0 + 3 * k + 0.37 * i + turn);
        SheetPoints space = plane;
        plane.step(*law, 2e-3, false);
        std::copy_n(plane.rate_zz, SheetPoints::count, space.rate[2]);
        space.step_in_space(*law, 2e-3);
        Real largest = 0;
        for (Index i = 0; i < SheetPoints::count; ++i) largest = std::max(largest, mises(plane, i));
        for (Index i = 0; i < SheetPoints::count; ++i) {
          plastic += plane.history[0][i] > 0;
          for (int k = 0; k < 6; ++k)
            most_apart = std::max(most_apart, std::abs(plane.stress[k][i] - space.stress[k][i]) / largest);
          most_apart = std::max(most_apart, std::abs(plane.history[0][i] - space.history[0][i]));
        }
      }
      EXPECT_GT(plastic, 1000) << name << cards;
      EXPECT_LT(most_apart, 1e-7) << name << cards;
    }
  }
  use_instruction_set(instruction_sets().back());
}
