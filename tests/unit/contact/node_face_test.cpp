// Where a node is over a bilinear face, and what one touch does, against brute force and hand calculation.
#include <gtest/gtest.h>

#include <random>

#include "touch_scene.hpp"

using namespace courant;

namespace {

Vec on_quad(const FaceCorners& x, Real s, Real t) {
  return 0.25 * ((1 - s) * (1 - t) * x[0] + (1 + s) * (1 - t) * x[1] + (1 + s) * (1 + t) * x[2] +
                 (1 - s) * (1 + t) * x[3]);
}

FaceCorners random_quad(std::mt19937& random) {
  std::uniform_real_distribution<Real> some(-0.25, 0.25);
  FaceCorners x{Vec(-1, -1, 0), Vec(1, -1, 0), Vec(1, 1, 0), Vec(-1, 1, 0)};
  for (Vec& corner : x) corner += Vec(some(random), some(random), some(random));
  return x;
}

}  // namespace

TEST(NodeFace, TheFootIsTheNearestPoint) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> some(-1.5, 1.5);
  for (int k = 0; k < 200; ++k) {
    const FaceCorners x = random_quad(random);
    const Vec y(some(random), some(random), 0.3 * some(random));
    const Projection p = project(x, 4, y);
    Real least = 1e9;
    for (int i = -200; i <= 200; ++i)
      for (int j = -200; j <= 200; ++j)
        least = std::min(least, (y - on_quad(x, i / 200.0, j / 200.0)).norm());
    EXPECT_NEAR((y - p.q).norm(), least, p.inside ? 1e-3 : 0.03) << k;
    Vec q = Vec::Zero();
    for (std::size_t e = 0; e < 4; ++e) q += p.N[e] * x[e];
    EXPECT_NEAR((q - p.q).norm(), 0, 1e-12);
    EXPECT_NEAR(p.N[0] + p.N[1] + p.N[2] + p.N[3], 1, 1e-12);
    if (p.inside) EXPECT_NEAR((y - p.q).cross(p.n).norm(), 0, 1e-9) << "along the normal";
  }
}

TEST(NodeFace, TrianglesHaveLinearShapes) {
  const FaceCorners x{Vec(0, 0, 0), Vec(2, 0, 0), Vec(0, 1, 0), Vec(0, 1, 0)};
  const Projection p = project(x, 3, Vec(0.5, 0.25, 0.3));
  EXPECT_TRUE(p.inside);
  EXPECT_NEAR((p.q - Vec(0.5, 0.25, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(p.N[0], 0.5, 1e-14);
  EXPECT_NEAR(p.N[1], 0.25, 1e-14);
  EXPECT_NEAR(p.N[2], 0.25, 1e-14);
  EXPECT_NEAR((p.n - Vec(0, 0, 1)).norm(), 0, 1e-14);
  EXPECT_FALSE(project(x, 3, Vec(2, 1, 0)).over);
  EXPECT_NEAR((project(x, 3, Vec(2, 1, 0)).q - Vec(1.6, 0.2, 0)).norm(), 0, 1e-14);
}

// Beyond an edge a face goes on as its mean plane: what sums up to the position does so there, too, and a
// motion of the corners turns the plane as it turns the diagonals.
TEST(NodeFace, GoesOnBeyondItsEdgesAsAPlane) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> some(-2.5, 2.5);
  int beyond = 0;
  for (int k = 0; k < 200; ++k) {
    FaceCorners x = random_quad(random);
    const int corners = k % 2 ? 4 : 3;
    if (corners == 3) x[3] = x[2];
    const Vec y(some(random), some(random), 0.2 * some(random));
    Projection p;
    const Vec aside = project_beyond(x, corners, y, p);
    Vec q = Vec::Zero();
    for (std::size_t e = 0; e < 4; ++e) q += p.N[e] * x[e];
    EXPECT_NEAR((q - p.q).norm(), 0, 1e-12);
    EXPECT_NEAR(p.N[0] + p.N[1] + p.N[2] + p.N[3], 1, 1e-12);
    if (!(aside.norm() > 0)) continue;
    ++beyond;
    EXPECT_NEAR((y - p.q).cross(p.n).norm(), 0, 1e-12) << "along the normal";
    EXPECT_NEAR(aside.dot(p.n), 0, 1e-12);
    const Projection rim = project_on_rim(x, corners, y);
    EXPECT_NEAR((p.q - rim.q - aside).norm(), 0, 1e-12);
    // the distance from the plane changes with each corner as its N tell
    const Real d = p.n.dot(y - p.q);
    for (std::size_t e = 0; e < static_cast<std::size_t>(corners); ++e) {
      constexpr Real step = 1e-6;
      FaceCorners moved = x;
      moved[e] += step * p.n;
      Vec foot = Vec::Zero();  // of the rim, which goes with its corners
      for (std::size_t c = 0; c < 4; ++c) foot += rim.N[c] * moved[c];
      const Vec n = corners == 3 ? (moved[1] - moved[0]).cross(moved[2] - moved[0])
                                 : (moved[2] - moved[0]).cross(moved[3] - moved[1]);
      EXPECT_NEAR((n.normalized().dot(y - foot) - d) / step, -p.N[e], 1e-4) << k;
    }
  }
  EXPECT_GT(beyond, 50);
}

/// Outside leapfrog keeps v^2, inside v^2 + omega^2 d_n d_n+1: by how much the second differs from the first
/// where a force f on a unit mass, at the depth d, lies at the surface. `v`: into it before. [L2/T2]
Real change_of_sums(Real f, Real d, Real v, Real dt, Real k) {
  const Real after = v - f * dt;
  return v > 0 ? after * after + k * d * (d + after * dt) - v * v
               : v * v + k * d * (d - v * dt) - after * after;
}

// k = SLSFAC min(25, 100) = 2.5; depth 0.004: on the node upwards, on the corners by their shape functions.
// 0.004 of the 0.005 of the step are behind the surface: 0.9 of the spring's force, but for what it slows.
TEST(NodeContactTouch, PushesTheNodeAndTheCorners) {
  TouchScene scene;
  scene.held = false;
  scene.build();
  scene.step(0);
  EXPECT_EQ(scene.force_on(4).norm(), 0) << "in front";
  scene.step(0.005);
  const Real force = scene.force_on(4)[2];
  EXPECT_NEAR(force, 0.9 * 2.5 * 0.004, 1e-5 * force);
  EXPECT_NEAR((scene.force_on(4) - Vec(0, 0, force)).norm(), 0, 1e-15);
  const Real N[4] = {0.25 * 0.5 * 0.8, 0.25 * 1.5 * 0.8, 0.25 * 1.5 * 1.2, 0.25 * 0.5 * 1.2};
  for (Index n = 0; n < 4; ++n)
    EXPECT_NEAR((scene.force_on(n) + Vec(0, 0, N[n] * force)).norm(), 0, 1e-15) << n;
  Real mobility = 1;
  for (const Real one : N) mobility += one * one / 2;
  EXPECT_NEAR(change_of_sums(force * mobility, 0.004, 1, 0.005, 2.5 * mobility), 0, 1e-15);
  EXPECT_NEAR(scene.contact->report().energy_stored, 0.5 * 2.5 * 0.004 * 0.004, 1e-18);
  // omega^2 <= 2.5 max(1 * 2/1, N (2)/2), of which elements leave 1 - 0.81
  EXPECT_NEAR(scene.contact->limit(scene.world, scene.clock).dt, 2 / std::sqrt(5 / 0.19), 1e-12);
  scene.step(0.005);  // 0.009 deep
  EXPECT_NEAR(scene.force_on(4)[2], 2.5 * 0.009, 1e-15) << "a step inside";
}

// Two thirds of a step after the last sample: five sixths of the force, where the spring adds but little.
TEST(NodeContactTouch, PushesLessInTheLastStep) {
  TouchScene scene;
  scene.build();
  scene.step(0);
  scene.step(0.002);
  for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, Vec(0, 0, 1));
  scene.step(0.0006);
  const Real depth = 0.0004, force = scene.force_on(4)[2];
  EXPECT_NEAR(force, 0.5 * (1 + depth / 0.0006) * 2.5 * depth, 1e-6 * force);
  EXPECT_NEAR(change_of_sums(force, depth, -1, 0.0006, 2.5), 0, 1e-15);
}

// Before anything touches, the step may lead to nine tenths of the path to the surface less one as short as
// springs there ask for, or be that short.
TEST(NodeContactTouch, AllowsAStepUpToTheSurface) {
  TouchScene scene;
  scene.law.soft = 1, scene.law.dtstif = 1e-5;  // SOFSCL 0.1: omega^2 = 0.05/dtstif^2, 0.9/omega = 4e-5
  scene.build();
  scene.step(0);
  EXPECT_EQ(scene.force_on(4).norm(), 0);
  const Real of_springs = 2e-5 * std::sqrt(0.19 / 0.05);
  EXPECT_NEAR(scene.contact->limit(scene.world, scene.clock).dt, 0.0009 - of_springs, 1e-12);
  scene.step(0.00099);
  EXPECT_NEAR(scene.contact->limit(scene.world, scene.clock).dt, of_springs, 1e-12);
  for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, Vec(0, 0, 1));
  scene.step(0.00001);
  EXPECT_EQ(scene.contact->limit(scene.world, scene.clock).dt, std::numeric_limits<Real>::infinity());
}

// TSSFAC is the part of a stable step that elements take, of which the rest is left to contact; and no more
// of a step over its springs than that.
TEST(NodeContactTouch, TakesStepsByTssfac) {
  for (const auto& [tssfac, omega_dt] :
       {std::pair(0.95, 2 * std::sqrt(1 - 0.95 * 0.95)), {0.5, 0.5}, {0.1, 0.1}}) {
    TouchScene scene;
    scene.law.tssfac = tssfac;
    scene.build();
    scene.step(0), scene.step(0.005);
    EXPECT_NEAR(scene.contact->limit(scene.world, scene.clock).dt, omega_dt / std::sqrt(2.5), 1e-12)
        << tssfac;
  }
}

// A node that starts behind the face, as that of the far side of the same body, is never in touch with it.
TEST(NodeContactTouch, IsWithWhoCameFromInFront) {
  TouchScene scene;
  scene.at = Vec(0.5, 0.2, -0.4), scene.depth = 0.5;
  scene.build();
  for (int k = 0; k < 5; ++k) scene.step(0.01);
  EXPECT_EQ(scene.force_on(4).norm(), 0);
}

// mu = 0.5: the spring of friction grows by k slip to mu k depth, not further. Slip 0.001 a step, depth
// 0.004.
TEST(NodeContactTouch, FrictionIsASpringUpToItsLimit) {
  TouchScene scene;
  scene.law.fs = scene.law.fd = 0.5;
  scene.build();
  scene.step(0);
  scene.step(0.005);
  for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, Vec(0.1, 0, 0));
  for (const Real expected : {0.001, 0.002, 0.002, 0.002}) {
    scene.step(0.01);
    EXPECT_NEAR((scene.force_on(4) - 2.5 * Vec(-expected, 0, 0.004)).norm(), 0, 1e-14);
  }
}

TEST(NodeContactTouch, GivesUpWhoIsThroughAndTellsIt) {
  TouchScene scene;
  scene.build();
  scene.step(0);
  scene.step(0.002);
  scene.step(1.99);
  EXPECT_GT(scene.force_on(4)[2], 0);
  scene.step(0.02);
  EXPECT_EQ(scene.force_on(4).norm(), 0);
  EXPECT_EQ(scene.world.counters.at("leaked_nodes"), 1);
}

// SOFT 1: at least SOFSCL m/(2 dt^2), of the lightest of node and corners (held ones do not count).
TEST(NodeContactTouch, SoftOneFollowsTheStep) {
  TouchScene scene;
  scene.law.soft = 1, scene.law.dtstif = 0.01, scene.law.sofscl = 0.2;
  scene.build();
  scene.step(0);
  scene.step(0.005);
  const Real k = 0.2 * 0.5 * 1 / 1e-4;
  EXPECT_NEAR(change_of_sums(scene.force_on(4)[2], 0.004, 1, 0.005, k), 0, 1e-12);
}
