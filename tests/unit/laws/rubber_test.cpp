// *MAT_077 against closed forms of incompressible rubber, which rubber of PR near 1/2 comes to.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "law_from_cards.hpp"

using namespace courant;

namespace {

/// A point that is stretched along x, y, z at once, in steps.
struct Stretched {
  explicit Stretched(const std::string& keyword, const std::string& cards)
      : law(test::law_from_cards(keyword, cards)) {}
  /// ln of the stretches to come to.
  void to(const Vec& target, int steps) {
    const Vec more = (target - logarithm) / steps;
    for (int k = 0; k < steps; ++k) {
      Real rate[6] = {more[0], more[1], more[2], 0, 0, 0};
      std::vector<Real*> kept;
      for (Real& h : history) kept.push_back(&h);
      PointBlock block;
      block.count = 1, block.dt = 1, block.sound_speed = &c, block.history = kept;
      for (std::size_t n = 0; n < 6; ++n) block.rate[n] = &rate[n], block.stress[n] = &stress[n];
      law->update(block);
    }
    logarithm = target;
  }
  std::shared_ptr<StrengthLaw> law;
  std::vector<Real> history = std::vector<Real>(6, 0);
  Vec logarithm = Vec::Zero();
  Real stress[6] = {}, c = 0;
};

constexpr Real nearly = 0.49995;
// Treloar's rubber by three terms of Ogden (1972), MPa
const std::string treloar = fmt::format("1,1.0,{}\n0.63,0.0012,-0.01\n1.3,5.0,-2.0\n", nearly);
Real by_ogden(Real l, Real other) {
  Real sum = 0;
  for (const auto& [mu, alpha] : {std::pair(0.63, 1.3), {0.0012, 5.0}, {-0.01, -2.0}})
    sum += mu * (std::pow(l, alpha) - std::pow(other, alpha));
  return sum;
}
const std::string yeoh = fmt::format("1,1.0,{}\n0.5,0.1,0.02,-0.01,0.003,0.001\n", nearly);
/// sigma_1 - sigma_3 = 2 (l1^2 - l3^2) (W1 + l2^2 W2), without change of volume.
Real by_invariants(Real l1, Real l2) {
  const Real l3 = 1 / (l1 * l2);
  const Real x = l1 * l1 + l2 * l2 + l3 * l3 - 3, y = 1 / (l1 * l1) + 1 / (l2 * l2) + 1 / (l3 * l3) - 3;
  const Real W1 = 0.5 + 0.02 * y - 2 * 0.01 * x + 3 * 0.001 * x * x, W2 = 0.1 + 0.02 * x + 2 * 0.003 * y;
  return 2 * (l1 * l1 - l3 * l3) * (W1 + l2 * l2 * W2);
}

}  // namespace

TEST(Rubber, UniaxialAndBiaxialTensionAndPureShear) {
  for (const Real l : {0.6, 0.9, 1.1, 1.5, 2.5, 4.0}) {
    const Real e = std::log(l);
    const auto check = [&](const Vec& target, Real ogden, Real invariants, int k, int from) {
      Stretched o("MAT_OGDEN_RUBBER", treloar), h("MAT_HYPERELASTIC_RUBBER", yeoh);
      o.to(target, 4000), h.to(target, 4000);
      EXPECT_NEAR(o.stress[k] - o.stress[from], ogden, 1e-5 * std::abs(ogden)) << l;
      EXPECT_NEAR(h.stress[k] - h.stress[from], invariants, 1e-5 * std::abs(invariants)) << l;
    };
    const Real thin = 1 / std::sqrt(l), flat = 1 / (l * l);
    check(Vec(e, -e / 2, -e / 2), by_ogden(l, thin), by_invariants(l, thin), 0, 2);  // uniaxial
    check(Vec(e, e, -2 * e), by_ogden(l, flat), by_invariants(l, l), 1, 2);          // biaxial
    check(Vec(e, 0, -e), by_ogden(l, 1 / l), by_invariants(l, 1), 0, 2);             // pure shear
  }
}

// p = -K (1 - 1/J), K = 2 G (1 + nu)/(3 (1 - 2 nu)), and no more where all stretches are alike.
TEST(Rubber, PressureOfAChangeOfVolume) {
  const Real G = 0.5 * (0.63 * 1.3 + 0.0012 * 5 + 0.01 * 2), K = 2 * G * 1.4 / (3 * 0.2);
  Stretched p("MAT_OGDEN_RUBBER", "1,1.0,0.4\n0.63,0.0012,-0.01\n1.3,5.0,-2.0\n");
  EXPECT_NEAR(p.law->bulk_modulus(), K, 1e-12);
  EXPECT_NEAR(p.law->shear_modulus(), G, 1e-12);
  for (const Real e : {-0.1, 0.2}) {
    p.to(Vec(e, e, e), 1000);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(p.stress[k], K * (1 - std::exp(-3 * e)), 1e-6);
  }
}

// rho0 c^2 is the largest of l_i^2 d2W/dl_i^2, l_i the stretches: with dW/dlx = sx, as the area across stays,
// and dW/dly = lx sy.
TEST(Rubber, SoundSpeedIsThatOfItsStiffness) {
  for (const auto& [keyword, cards] :
       {std::pair("MAT_OGDEN_RUBBER", std::string("1,2.0,0.45\n0.63,0.0012,-0.01\n1.3,5.0,-2.0\n")),
        {"MAT_HYPERELASTIC_RUBBER", std::string("1,2.0,0.45\n0.5,0.1,0.02,-0.01,0.003,0.001\n")}})
    for (const Real l : {1.0, 1.3, 2.0}) {
      const Real d = 1e-4;
      const auto at = [&, &keyword = keyword, &cards = cards](Real x, Real y) {
        Stretched p(keyword, cards);
        p.to(Vec(std::log(x), std::log(y), 0), 4000);
        return std::array{p.stress[0] * y, p.stress[1] * x, p.c};
      };
      const Real along_x = l * l * (at(l + d, 1)[0] - at(l - d, 1)[0]) / (2 * d),
                 along_y = (at(l, 1 + d)[1] - at(l, 1 - d)[1]) / (2 * d), c = at(l, 1)[2];
      EXPECT_NEAR(2 * c * c / std::max(along_x, along_y), 1, 1e-4) << keyword << " " << l;
    }
}
