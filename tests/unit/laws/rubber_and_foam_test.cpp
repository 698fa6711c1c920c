// Rubbers, foams and materials that relax, along paths whose stress is known in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "law_from_cards.hpp"

using namespace courant;

namespace {

using test::law_from_cards;

/// One point that a law works on.
struct Specimen {
  explicit Specimen(std::shared_ptr<StrengthLaw> of) : law(std::move(of)) {
    std::size_t numbers = 0;
    for (const HistoryVariable& h : law->history()) numbers += static_cast<std::size_t>(h.components);
    history.assign(numbers, 0);
  }
  /// Rates of the tensor for `dt`.
  void strain(std::array<Real, 6> rate, Real dt = 1) {
    std::vector<Real*> kept;
    for (Real& h : history) kept.push_back(&h);
    PointBlock block;
    block.count = 1, block.dt = dt, block.sound_speed = &c, block.history = kept;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    if (in_plane)
      law->update_in_plane_stress(block, &rate_zz);
    else
      law->update(block);
  }
  /// From stretches to others, in one step whose exponential is (1 + x/2)/(1 - x/2).
  void stretch(const Vec& by) {
    std::array<Real, 6> rate{};
    for (int k = 0; k < 3; ++k) rate[static_cast<std::size_t>(k)] = 2 * (by[k] - 1) / (by[k] + 1);
    strain(rate);
  }
  std::shared_ptr<StrengthLaw> law;
  std::vector<Real> history;
  std::array<Real, 6> stress{};
  Real c = 0, rate_zz = 0;
  bool in_plane = false;
};

std::shared_ptr<StrengthLaw> relaxing(Real beta) {
  return law_from_cards("MAT_VISCOELASTIC", fmt::format("1,1000.0,50.0,3.0,1.0,{}\n", beta));
}
std::shared_ptr<StrengthLaw> spring_foam(const std::string& more = "") {
  return law_from_cards("MAT_LOW_DENSITY_FOAM",
                        "1,50.0,10.0,5" + more + "\n*DEFINE_CURVE\n5\n0.0,0.0\n0.1,1.0\n0.6,1.5\n0.8,4.0\n");
}

}  // namespace

// A step of shear that is held: 2 G(t) of it, in however many steps.
TEST(MatViscoelastic, RelaxesAsItsModulusDoes) {
  for (const int steps : {1, 10, 1000}) {
    Specimen p(relaxing(0.7));
    p.strain({0, 0, 0, 1e9, 0, 0}, 1e-12);
    EXPECT_NEAR(p.stress[3], 2 * 3.0 * 1e-3, 1e-12);
    for (int k = 0; k < steps; ++k) p.strain({}, 2.0 / steps);
    EXPECT_NEAR(p.stress[3], 2 * (1 + 2 * std::exp(-1.4)) * 1e-3, 1e-12);
  }
}

// At a steady rate: 2 (GI t + (G0 - GI)(1 - exp(-BETA t))/BETA) of it; the volume stays elastic.
TEST(MatViscoelastic, IsExactAtASteadyRate) {
  for (const int steps : {1, 7}) {
    Specimen p(relaxing(0.7));
    for (int k = 0; k < steps; ++k) p.strain({0.3, 0, 0, 0.1, 0, 0}, 2.0 / steps);
    const Real grown = 2 * (2 + 2 * (1 - std::exp(-1.4)) / 0.7);
    EXPECT_NEAR(p.stress[3], 0.1 * grown, 1e-12);
    EXPECT_NEAR(p.stress[0], 50 * 0.6 + 0.2 * grown, 1e-11);
    EXPECT_NEAR(p.stress[1], 50 * 0.6 - 0.1 * grown, 1e-11);
  }
}

// Pulled with free sides these have l^-nu, and sigma = G (l^(1 + 2 nu) - 1/l).
TEST(MatBlatzKoRubber, StretchesAsInClosedForm) {
  constexpr Real nu = 0.463, G = 3;
  for (const Real l : {0.4, 0.9, 1.3, 4.0}) {
    Specimen p(law_from_cards("MAT_BLATZ-KO_RUBBER", "1,1000.0,3.0\n"));
    const Real side = std::pow(l, -nu);
    p.stretch(Vec(std::sqrt(l), std::sqrt(side), std::sqrt(side)));
    p.stretch(Vec(std::sqrt(l), std::sqrt(side), std::sqrt(side)));
    EXPECT_NEAR(p.stress[0], G * (std::pow(l, 1 + 2 * nu) - 1 / l), 1e-11);
    EXPECT_NEAR(p.stress[1], 0, 1e-11);
  }
}

// The slope of the stress is that of the waves that the law tells, along the axis that is stiffest.
TEST(MatBlatzKoRubber, WavesAreNoFasterThanItSays) {
  for (const Vec& l : {Vec(1.4, 1, 1), Vec(0.7, 1, 1), Vec(0.8, 0.9, 1.3)})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Specimen p(law_from_cards("MAT_BLATZ-KO_RUBBER", "1,1000.0,3.0\n"));
      p.stretch(l);
      const Real before = p.stress[axis], e = 1e-6, c = p.c;
      std::array<Real, 6> more{};
      more[axis] = e;
      p.strain(more);
      EXPECT_GT(1000 / l.prod() * c * c * (1 + 1e-4), (p.stress[axis] - before) / e) << axis;
    }
}

// Nominal stress is the curve's, in any direction, and each direction is for itself.
TEST(MatLowDensityFoam, FollowsItsCurve) {
  const Real strains[] = {0.05, 0.3, 0.7}, stresses[] = {0.5, 1.2, 2.75};
  for (int k = 0; k < 3; ++k) {
    Specimen p(spring_foam());
    for (int n = 1; n <= 10; ++n)
      p.stretch(Vec((1 - strains[k] * n / 10) / (1 - strains[k] * (n - 1) / 10), 1, 1));
    EXPECT_NEAR(p.stress[0], -stresses[k], 1e-12);
    EXPECT_NEAR(p.stress[1], 0, 1e-12);
    p.stretch(Vec(1, 1.2, 0.5));
    EXPECT_NEAR(p.stress[0], -stresses[k] / 0.6, 1e-12);
    EXPECT_NEAR(p.stress[1], 10 * 0.2 / (0.5 * (1 - strains[k])), 1e-11);
  }
}

// HU 0.1, SHAPE 2: half way back, W of loading to 0.6 is 0.05 + 0.5 (1 + 1.5)/2 = 0.675, to 0.3 it is 0.27.
TEST(MatLowDensityFoam, LosesEnergyWhereItComesBack) {
  Specimen p(spring_foam(",,0.1\n2.0"));
  p.stretch(Vec(0.4, 1, 1));
  EXPECT_NEAR(p.stress[0], -1.5, 1e-12);
  p.stretch(Vec(0.7 / 0.4, 1, 1));
  const Real keeps = 1 - 0.9 * (1 - std::pow(0.27 / 0.675, 2));
  EXPECT_NEAR(p.stress[0], -1.2 * keeps, 1e-12);
  p.stretch(Vec(0.4 / 0.7, 1, 1));  // up to where it was the same way
  EXPECT_NEAR(p.stress[0], -1.5, 1e-12);
  p.stretch(Vec(0.3 / 0.4, 1, 1));
  EXPECT_NEAR(p.stress[0], -2.75, 1e-12);
}

// Where it turns back the stress falls more steeply than it rose.
TEST(MatLowDensityFoam, WavesAreNoFasterThanItSaysAlsoOnTheWayBack) {
  for (const Real l : {0.95, 0.6, 0.35}) {
    Specimen p(spring_foam(",,0.05\n4.0"));
    p.stretch(Vec(l, 1, 1));
    const Real before = p.stress[0], c = p.c, e = 1e-7;
    p.strain({e, 0, 0, 0, 0, 0});
    const Real slope = (p.stress[0] - before) / e;
    EXPECT_GT(50 / l * c * c * (1 + 1e-4), slope) << l;
    EXPECT_LT(50 / l * c * c, 3 * slope) << l;
  }
}

TEST(MatLowDensityFoam, TearsOrFlowsAtItsTension) {
  for (const int fail : {0, 1}) {
    Specimen p(spring_foam(fmt::format(",1.0\n,{}", fail)));
    p.stretch(Vec(1.05, 1, 1));
    EXPECT_NEAR(p.stress[0], 0.5, 1e-12);
    p.stretch(Vec(1.2, 1, 1));
    EXPECT_NEAR(p.stress[0], fail ? 0 : 1, 1e-12);
  }
}

// Crushed along its curve, back with E to the tension it bears, and again to where it was left.
TEST(MatCrushableFoam, IsCrushedAndSpringsBack) {
  Specimen p(law_from_cards("MAT_CRUSHABLE_FOAM",
                            "1,50.0,100.0,0.0,5,0.2\n*DEFINE_CURVE\n5\n0.0,1.0\n0.5,2.0\n0.9,9.0\n"));
  const int steps = 500;
  for (int k = 1; k <= steps; ++k) {
    p.strain({std::log(0.4) / steps, 0, 0, 0, 0, 0});
    const Real crushed = 1 - std::pow(0.4, static_cast<Real>(k) / steps);
    if (k > 10)
      EXPECT_NEAR(p.stress[0], crushed < 0.5 ? -1 - 2 * crushed : -2 - 17.5 * (crushed - 0.5), 1e-11);
    EXPECT_EQ(p.stress[1], 0);
  }
  const Real left = p.stress[0];
  p.strain({0.01, 0, 0, 0, 0, 0});
  EXPECT_NEAR(p.stress[0], left + 1, 1e-12);
  p.strain({0.1, 0, 0, 0, 0, 0});
  EXPECT_NEAR(p.stress[0], 0.2, 1e-12);
  p.strain({-0.002, 0, 0, 0, 0, 0});
  EXPECT_NEAR(p.stress[0], 0, 1e-12);
}

// A sheet drawn the same way along both axes thins by twice the strain, elastic volume aside.
TEST(MatModifiedPiecewiseLinearPlasticity, FailsWhereItIsThinOrLong) {
  const auto sheet = [](const std::string& limits, Real fail) {
    return law_from_cards("MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY",
                          fmt::format("1,7800.0,200.0,0.3,0.2,0.0,{}\n0.0,0.0,0,0,0,{}\n\n\n", fail, limits));
  };
  for (const auto& [limits, fail, at] : {std::tuple{"0.4,0.0", 0.0, 0.2}, std::tuple{"0.0,0.15", 0.0, 0.15},
                                         std::tuple{"0.9,0.9", 0.2, 0.1}}) {
    Specimen p(sheet(limits, fail));
    p.in_plane = true;
    ASSERT_EQ(p.law->failure_limit(), 1);
    Real drawn = 0;
    while (p.history.back() < 1 && drawn < 1) {
      p.strain({1e-4, 1e-4, 0, 0, 0, 0});
      drawn += 1e-4;
    }
    EXPECT_NEAR(drawn, at, 1e-3) << limits;
  }
  // without limits, what fails is the plastic strain itself
  EXPECT_EQ(sheet("0.0,0.0", 0.2)->failure_variable(), "plastic_strain");
}
