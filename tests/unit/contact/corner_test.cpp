// Which force a particle feels where several segments meet.
#include <gtest/gtest.h>

#include "scene.hpp"

using namespace courant;
using courant::test::Scene;

namespace {

constexpr Real r = 0.01;

Scene one_particle() {
  Scene s;
  s.x = {Vec(0, 0, 10)};
  return s;
}

// all tests use the stiffness of the particle: 0.1 rho c^2 dx
Real k_of(const Scene& s) {
  return 0.1 * s.rho * s.c * s.c * std::cbrt(s.m / s.rho);
}

TEST(Corner, ForceIsConstantOverUnmergedOverlappingPatches) {
  Scene s = one_particle();
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 5, 5);
  s.plate(Vec(0.1, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 3, 7);
  s.plate(Vec(0.05, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 4, 4);
  s.build();
  for (int i = 0; i <= 180; ++i) {
    const Vec f = s.force(Vec(0.01 + 0.001 * i, 0.043, 0.004));
    EXPECT_NEAR(f.z(), k_of(s) * 0.006, 1e-9 * k_of(s) * r) << i;
    EXPECT_NEAR(f.head(2).norm(), 0, 1e-9 * k_of(s) * r) << i;
  }
}

TEST(Corner, BothSidesPushAway) {
  Scene s = one_particle();
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 3, 3);
  s.build();
  EXPECT_NEAR(s.force(Vec(0.05, 0.05, -0.004)).z(), -k_of(s) * 0.006, 1e-9);
  EXPECT_EQ(s.force(Vec(0.05, 0.05, -0.011)).norm(), 0);
}

TEST(Corner, FreeEdgeIsRoundAndActsOnce) {
  Scene s = one_particle();
  s.plate(Vec(-0.1, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 4, 4);
  s.plate(Vec(-0.1, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
  s.build();
  for (int a = -80; a <= 80; a += 10) {
    const Vec n(std::cos(a * pi / 180), 0, std::sin(a * pi / 180));
    const Vec f = s.force(Vec(0, 0.043, 0) + 0.006 * n);
    EXPECT_NEAR((f - k_of(s) * 0.004 * n).norm(), 0, 1e-9) << a;
  }
}

TEST(Corner, PerpendicularWallsActFully) {
  Scene s = one_particle();
  const Vec a(0.1, 0, 0), b(0, 0.1, 0), c(0, 0, 0.1), o = Vec::Zero();
  s.plate(o, a, b, 4, 4);
  s.plate(o, b, c, 3, 3);
  s.plate(o, c, a, 5, 5);
  s.build();
  const Vec edge = s.force(Vec(0.004, 0.03, 0.007));
  EXPECT_NEAR((edge - k_of(s) * Vec(0.006, 0, 0.003)).norm(), 0, 1e-9);
  const Vec corner = s.force(Vec(0.004, 0.001, 0.007));
  EXPECT_NEAR((corner - k_of(s) * Vec(0.006, 0.009, 0.003)).norm(), 0, 1e-9);
}

// Two walls that meet along the y axis: the force is minus the gradient of the stored energy everywhere,
// never larger than needed to reach the nearest position at distance r, and changes by at most k times the
// path.
TEST(Corner, ForceIsContinuousAndConservativeAtAllAngles) {
  for (int degrees = 15; degrees <= 345; degrees += 15) {
    const Real angle = degrees * pi / 180;
    Scene s = one_particle();
    const Vec d1(1, 0, 0), d2(std::cos(angle), 0, std::sin(angle)), y(0, 0.1, 0);
    s.plate(Vec(0, -0.05, 0), 0.1 * d1, y, 6, 2);
    if (degrees != 180) s.plate(Vec(0, -0.05, 0), 0.1 * d2, y, 3, 2);
    if (degrees == 180) s.plate(Vec(-0.1, -0.05, 0), 0.1 * d1, y, 3, 2);
    s.build();
    // an arc around the corner, inside the fluid's side, and close to the corner
    const Real R = 0.7 * r;
    Vec last = Vec::Zero();
    Real last_energy = 0;
    const int n = 2000;
    int jumps = 0;
    Real work_error = 0;
    for (int k = 0; k <= n; ++k) {
      const Real t = angle * (0.02 + 0.96 * k / n);
      const Vec x(R * std::cos(t), 0.003, R * std::sin(t));
      const Vec f = s.force(x);
      const Real energy = s.contact->report().energy_stored;
      EXPECT_NEAR(f.y(), 0, 1e-9);
      if (k > 0) {
        const Vec way = R * angle * 0.96 / n * Vec(-std::sin(t), 0, std::cos(t));
        const Real work = 0.5 * (f + last).dot(way);
        work_error = std::max(work_error, std::abs(energy - last_energy + work));
        if ((f - last).norm() > 12 * k_of(s) * way.norm()) ++jumps;
      }
      last = f;
      last_energy = energy;
    }
    EXPECT_EQ(jumps, 0) << degrees << " degrees";
    EXPECT_LT(work_error, 1e-4 * k_of(s) * r * r) << degrees << " degrees";
  }
}

}  // namespace
