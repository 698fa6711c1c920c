// *MAT_FRAZER_NASH_RUBBER_MODEL against derivatives of its energy along paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace frazer_nash_test {

using namespace courant;
using test::DrivenPoint;

namespace {

constexpr Real C100 = 1.2, C200 = 0.1, C300 = 0.03, C400 = 0.01, C110 = -0.02, C210 = 0.015, C010 = 0.4,
               C020 = 0.05, PR = 0.49;
const std::string cards =
    fmt::format("1,1.5,{},{},{},{},{}\n{},{},{},{}\n", PR, C100, C200, C300, C400, C110, C210, C010, C020);
constexpr Real G = C100 - C010 / 2, K = 2 * G * (1 + PR) / (3 * (1 - 2 * PR));
Real energy(const Vec& l) {
  const Vec E = 0.5 * (l.cwiseAbs2() - Vec::Ones());
  const Real x = E.sum(), y = E[0] * E[1] + E[1] * E[2] + E[2] * E[0], J = l.prod();
  const Real stiff = K - 2 * C200 - 2.0 / 3 * (C100 + C010);
  return C100 * x + C200 * x * x + C300 * x * x * x + C400 * x * x * x * x + C110 * x * y + C210 * x * x * y +
         C010 * y + C020 * y * y - C100 * std::log(J) + 0.5 * stiff * (J - 1) * (J - 1);
}
/// sigma_k = l_k dW/dl_k / J, by differences.
Real stress(const Vec& l, int k) {
  const Real h = 1e-5;
  Vec up = l, down = l;
  up[k] *= 1 + h, down[k] *= 1 - h;
  return (energy(up) - energy(down)) / (2 * h) / l.prod();
}
/// A point stretched by exact steps: of A = (1 - D/2)^-1 (1 + D/2).
struct Stretched : DrivenPoint {
  Stretched() : DrivenPoint(test::law_from_cards("MAT_FRAZER_NASH_RUBBER_MODEL", cards)) {}
  void to(const Vec& target) {
    constexpr int steps = 20;
    std::array<Real, 6> by{};
    for (int j = 0; j < 3; ++j) {
      const Real a = std::pow(target[j] / now[j], 1.0 / steps);
      by[static_cast<std::size_t>(j)] = 2 * (a - 1) / (a + 1);
    }
    for (int k = 0; k < steps; ++k) strain(by);
    now = target;
  }
  Vec now = Vec::Ones();
};

}  // namespace

// Uniaxial, biaxial, shear, hydrostatic, and back.
TEST(FrazerNash, StressIsTheSlopeOfItsEnergy) {
  Stretched point;
  EXPECT_NEAR(point.law->bulk_modulus(), K, 1e-12 * K);
  EXPECT_NEAR(point.law->shear_modulus(), G, 1e-12);
  for (const Vec& l : {Vec(1.7, 0.77, 0.77), Vec(0.6, 1.29, 1.29), Vec(1.4, 1.4, 0.52), Vec(1.5, 1, 0.67),
                       Vec(1.02, 1.02, 1.02), Vec(0.97, 0.97, 0.97), Vec(1, 1, 1)}) {
    point.to(l);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(point.stress[static_cast<std::size_t>(k)], stress(l, k),
                  1e-6 * (1 + std::abs(stress(l, k))))
          << l.transpose();
  }
}

// rho0 c^2 = l^2 d2W/dl2 of the stiffest axis, not below that at rest.
TEST(FrazerNash, WavesAreAsFastAsItsStiffnessSays) {
  Stretched point;
  for (const Vec& l : {Vec(1, 1, 1), Vec(2.2, 0.7, 0.66), Vec(1.6, 1.6, 0.4), Vec(0.5, 1.4, 1.42)}) {
    point.to(l);
    Real most = K + 4 * G / 3;
    for (int k = 0; k < 3; ++k) {
      const Real h = 1e-4;
      Vec up = l, down = l;
      up[k] += h, down[k] -= h;
      most = std::max(most, l[k] * l[k] * (energy(up) - 2 * energy(l) + energy(down)) / (h * h));
    }
    EXPECT_NEAR(1.5 * point.speed * point.speed, most, 1e-5 * most) << l.transpose();
  }
}

}  // namespace frazer_nash_test
