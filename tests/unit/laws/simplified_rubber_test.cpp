// *MAT_181 by the curve of a uniaxial test of Ogden's rubber is Ogden's rubber, however it is strained.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "law_from_cards.hpp"

using namespace courant;

namespace {

constexpr std::array<std::array<Real, 2>, 3> terms = {{{0.63, 1.3}, {0.0012, 5.0}, {-0.01, -2.0}}};

std::string uniaxial_curve() {
  std::string out = "*DEFINE_CURVE\n5\n";
  for (int k = -400; k <= 1000; ++k) {
    const Real l = 1 + 0.002 * k;
    Real s = 0;
    for (const auto& [mu, alpha] : terms) s += mu * (std::pow(l, alpha) - std::pow(l, -alpha / 2)) / l;
    out += fmt::format("{},{:.12e}\n", 0.002 * k, s);
  }
  return out;
}

struct RubberPoint {
  std::shared_ptr<StrengthLaw> law;
  std::vector<Real> history = std::vector<Real>(6, 0);
  Real stress[6] = {}, c = 0;
  void strain(const std::array<Real, 6>& rate) {
    std::vector<Real*> kept;
    for (Real& number : history) kept.push_back(&number);
    PointBlock block;
    block.count = 1, block.dt = 1, block.sound_speed = &c, block.history = kept;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    law->update(block);
  }
};

}  // namespace

TEST(SimplifiedRubber, ByTheCurveOfOgdensIsOgdensRubber) {
  Real G = 0;
  for (const auto& [mu, alpha] : terms) G += mu * alpha / 2;
  const Real nu = 0.45, K = 2 * G * (1 + nu) / (3 * (1 - 2 * nu));
  RubberPoint tabulated{test::law_from_cards(
      "MAT_SIMPLIFIED_RUBBER/FOAM", fmt::format("1,1.0,{:.12e}\n1.0,1.0,1.0,5\n", K) + uniaxial_curve())};
  RubberPoint ogden{
      test::law_from_cards("MAT_OGDEN_RUBBER", "1,1.0,0.45\n0.63,0.0012,-0.01\n1.3,5.0,-2.0\n")};
  EXPECT_NEAR(tabulated.law->shear_modulus(), G, 0.003 * G);
  const std::array<Real, 6> paths[] = {{0.02, -0.01, -0.009, 0, 0, 0},   // uniaxial
                                       {0.012, 0.012, -0.022, 0, 0, 0},  // biaxial
                                       {0, 0, 0, 0.02, 0.01, -0.005},    // shear
                                       {-0.015, -0.002, 0.013, 0.004, 0, 0.01}};
  for (const auto& path : paths) {
    for (RubberPoint* point : {&tabulated, &ogden})
      std::fill(point->history.begin(), point->history.end(), 0);
    for (int n = 0; n < 30; ++n) {
      tabulated.strain(path), ogden.strain(path);
      Real size = 0;
      for (const Real s : ogden.stress) size = std::max(size, std::abs(s));
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(tabulated.stress[k], ogden.stress[k], 0.003 * size) << n << k;
      EXPECT_NEAR(tabulated.c, ogden.c, 0.01 * ogden.c) << n;
    }
  }
}
