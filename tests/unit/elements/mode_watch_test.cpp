// What the hourglass modes of a brick would cost in its material.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/real.hpp"
#include "elements/solid/mode_watch.hpp"

using namespace courant;

namespace {

constexpr Real long_side = 3, width = 2, height = 0.5, young = 7;

std::array<Vec, 8> brick_corners() {
  std::array<Vec, 8> out;
  for (std::size_t c = 0; c < out.size(); ++c)
    out[c] = {c % 4 == 1 || c % 4 == 2 ? long_side : 0, c % 4 >= 2 ? width : 0, c >= 4 ? height : 0};
  return out;
}

SolidControl elastic(Real nu) {
  return {.E = young, .G = young / (2 * (1 + nu)), .plate_modulus = young / (1 - nu * nu), .nu = nu};
}

Real energy_between(const std::array<Vec, 8>& start, const std::array<Vec, 8>& now,
                    const SolidControl& material) {
  return bending_energy(start, second_gradient(start, now), material);
}

Matrix turned() {
  return (Eigen::AngleAxisd(0.7, Vec(1, 2, -1).normalized()) * Eigen::AngleAxisd(2.1, Vec::UnitY()))
      .toRotationMatrix();
}

}  // namespace

TEST(BendingEnergy, IsNoneOfRigidMotionAndHomogeneousDeformation) {
  const auto start = brick_corners();
  Matrix F;
  F << 1.3, 0.2, -0.1, 0.4, 0.8, 0.3, 0.05, -0.2, 1.1;
  auto now = start;
  for (Vec& x : now) x = turned() * F * x + Vec(5, -3, 2);
  EXPECT_NEAR(energy_between(start, now, elastic(0.3)), 0, 1e-25);
}

// Bending by a small curvature about y: E I k^2 L/2 of a beam; both ways: of a plate, D per area.
TEST(BendingEnergy, IsThatOfABentBeamAndPlate) {
  const Real k = 1e-4, nu = 0.3;
  const auto start = brick_corners();
  const Vec middle(long_side / 2, width / 2, height / 2);
  const auto bent = [&](Real kx, Real ky) {
    auto now = start;
    for (Vec& x : now) {
      const Vec r = x - middle;
      x += Vec(kx * r[0] * r[2], ky * r[1] * r[2], -0.5 * (kx * r[0] * r[0] + ky * r[1] * r[1]));
      x = turned() * x;
    }
    return now;
  };
  const Real inertia = width * std::pow(height, 3) / 12;
  EXPECT_NEAR(energy_between(start, bent(k, 0), elastic(0)), 0.5 * young * inertia * k * k * long_side,
              1e-6 * young * inertia * k * k * long_side);
  // a beam's own anticlastic curvature
  EXPECT_NEAR(energy_between(start, bent(k, -nu * k), elastic(nu)), 0.5 * young * inertia * k * k * long_side,
              1e-6 * young * inertia * k * k * long_side);
  const Real D = young * std::pow(height, 3) / (12 * (1 - nu * nu));
  EXPECT_NEAR(energy_between(start, bent(k, k), elastic(nu)), D * (1 + nu) * k * k * long_side * width,
              1e-6 * D * k * k * long_side * width);
}
