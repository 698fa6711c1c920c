// Rigid walls that are plates, prisms, cylinders and spheres: geometry by hand, then what mechanics tells.
#include <gtest/gtest.h>

#include <cmath>

#include "loads/walls/wall_shape.hpp"
#include "wall_scene.hpp"

using namespace courant;
using test::Pull;
using test::WallScene;

namespace {

using Kind = WallShape::Kind;

void expect_near(const WallShape& shape, const Vec& x, Real gap, const Vec& n) {
  const WallShape::Near near = shape.nearest(x);
  EXPECT_NEAR(near.gap, gap, 1e-14) << x.transpose();
  EXPECT_NEAR((near.n - n.normalized()).norm(), 0, 1e-14) << x.transpose() << " -> " << near.n.transpose();
}

const std::string ball = "*RIGIDWALL_GEOMETRIC_SPHERE\n0\n0.,0.,0.,0.,0.,0.,";
const std::string pole = "*RIGIDWALL_GEOMETRIC_CYLINDER\n0\n0.,0.,-1.,0.,0.,3.,";

}  // namespace

TEST(GeometricWall, NearestPlacesOfASphereAndACylinder) {
  expect_near({.kind = Kind::sphere, .tail = {1, 0, 0}, .radius = 2}, {1, 3, 4}, 3, {0, 3, 4});
  expect_near({.kind = Kind::sphere, .tail = {1, 0, 0}, .radius = 2}, {2, 0, 0}, -1, {1, 0, 0});
  WallShape rod{.kind = Kind::cylinder, .tail = {0, 0, -1}, .length = {0, 0, 4}, .radius = 2};
  expect_near(rod, {3, 4, 1}, 3, {3, 4, 0});
  expect_near(rod, {1, 0, 5}, 2, {0, 0, 1});
  expect_near(rod, {5, 0, 7}, 5, {3, 0, 4});
  expect_near(rod, {0, 5, -5}, 5, {0, 3, -4});
  expect_near(rod, {0, 1.5, 1}, -0.5, {0, 1, 0});
  expect_near(rod, {0, 1, 2.75}, -0.25, {0, 0, 1});
  expect_near(rod, {0, 1, -0.75}, -0.25, {0, 0, -1});
  rod.length[2] = 0;
  expect_near(rod, {3, 4, 100}, 3, {3, 4, 0});
  expect_near(rod, {0, 1, -100}, -1, {0, 1, 0});
}

TEST(GeometricWall, NearestPlacesOfAPrism) {
  WallShape prism{.kind = Kind::prism, .tail = {1, 1, 1}, .length = {2, 3, 4}};  // down to z = -3
  expect_near(prism, {2, 2, 3}, 2, {0, 0, 1});
  expect_near(prism, {0, 2, 0}, 1, {-1, 0, 0});
  expect_near(prism, {7, 7, 0}, 5, {4, 3, 0});
  expect_near(prism, {2, 2, -6}, 3, {0, 0, -1});
  expect_near(prism, {1.25, 2, 0}, -0.25, {-1, 0, 0});
  expect_near(prism, {2, 3.75, 0}, -0.25, {0, 1, 0});
  expect_near(prism, {2, 2, -2.75}, -0.25, {0, 0, -1});
  prism.length = {0, 3, 0};  // without ends along x, and down
  expect_near(prism, {-9, 2, -90}, -1, {0, -1, 0});
  expect_near(prism, {-9, 0, -90}, 1, {0, -1, 0});
}

TEST(GeometricWall, ASphereStopsWhatMeetsItAndNothingElse) {
  WallScene s(4);
  s.w.nodes.x.set(0, {-1.5, 0, 0}), s.w.nodes.v.set(0, {3, 0, 0});
  s.w.nodes.x.set(1, {-1.5, 1.001, 0}), s.w.nodes.v.set(1, {3, 0, 0});
  const Vec up = Vec(-0.6, 0.8, 0);  // it comes to this position of the sphere, obliquely
  s.w.nodes.x.set(2, up - 0.3 * Vec(1, 0, 0.5)), s.w.nodes.v.set(2, {1, 0, 0.5});
  s.w.particles.x.set(0, {0, 0, 1.1}), s.w.particles.v.set(0, {0, 0, -2});
  s.walls(ball + "0.0\n1.0\n");
  EXPECT_EQ(s.diagnostics.text().find("behind"), std::string::npos) << s.diagnostics.text();
  s.start();
  s.steps(1);
  while (s.cloud.clock.t < 0.25) s.steps(1);
  EXPECT_NEAR((s.w.nodes.x.vec(0) - Vec(-1, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(0).norm(), 0, 1e-14);
  EXPECT_NEAR((s.w.particles.x.vec(0) - Vec(0, 0, 1)).norm(), 0, 1e-14);
  EXPECT_NEAR((s.wall().impulse - Vec(2 * 3, 0, -2 * 2)).norm(), 0, 1e-13) << "so far two have hit it";
  EXPECT_NEAR(s.wall().dissipated, 0.5 * 2 * (9 + 4), 1e-13);
  while (s.cloud.clock.t < 0.31) s.steps(1);
  const Vec left = Vec(1, 0, 0.5) - Vec(1, 0, 0.5).dot(up) * up;  // the normal part is lost
  EXPECT_NEAR((s.w.nodes.v.vec(2) - left).norm(), 0, 0.02) << s.w.nodes.v.vec(2).transpose();
  EXPECT_GE(s.w.nodes.x.vec(2).norm(), 1 - 1e-14);
  while (s.cloud.clock.t < 1) s.steps(1);
  EXPECT_NEAR((s.w.nodes.v.vec(1) - Vec(3, 0, 0)).norm(), 0, 1e-15) << "it passes beside it";
  EXPECT_NEAR(s.w.energy.dissipated, s.wall().dissipated, 1e-15);
}

// A mass that slides down a cylinder without friction from rest at the angle a leaves it where
// cos = 2/3 cos a, with v^2 = 2 g R (cos a - cos).
TEST(GeometricWall, AMassLeavesACylinderAtTwoThirdsOfItsHeight) {
  WallScene s;
  const Real a = 0.2, g = 0.1;  // a few thousand steps
  s.place({std::sin(a), std::cos(a), 0}, {0, 0, 0});
  s.walls(pole + "0.0\n1.0,4.0\n");
  s.gravity({0, -g, 0});
  s.start();
  Real height = 0, speed = 0;
  for (int k = 0; k < 8000; ++k) {
    s.steps(1);
    if (s.wall().normal == 0) continue;
    height = s.w.nodes.x.vec(0)[1], speed = s.w.nodes.v.vec(0).norm();
    EXPECT_GE(s.w.nodes.x.vec(0).norm(), 1 - 1e-14);
  }
  EXPECT_NEAR(height, 2.0 / 3 * std::cos(a), 0.01);
  EXPECT_NEAR(speed * speed / (2 * g * (std::cos(a) - height)), 1, 0.01);
  EXPECT_LT(s.wall().dissipated, 0.005 * 4 * g) << "sliding loses next to nothing";
}

TEST(GeometricWall, FrictionOnACylinderHoldsUpToItsAngle) {
  for (const Real mu : {0.3, 0.34}) {  // tan(0.3217) = 1/3
    WallScene s;
    s.place(Vec(1, 3, 0).normalized(), {0, 0, 0});
    s.walls(pole + std::to_string(mu) + "\n1.0\n");
    s.gravity({0, -9.81, 0});
    s.start();
    s.steps(200);
    const Real slid = std::atan2(s.w.nodes.x.vec(0)[0], s.w.nodes.x.vec(0)[1]) - std::atan2(1, 3);
    if (mu > 1.0 / 3)
      EXPECT_NEAR(slid, 0, 1e-12);
    else
      EXPECT_GT(slid, 0.02);
  }
}

TEST(GeometricWall, APrismHoldsOnAllItsSides) {
  WallScene s(4);
  s.w.nodes.x.set(0, {0.5, 0.5, 0.5}), s.w.nodes.v.set(0, {0, 0, -1});
  s.w.nodes.x.set(1, {-0.5, 0.5, -0.5}), s.w.nodes.v.set(1, {1, 0, 0});
  s.w.nodes.x.set(2, {1.5, 0.5, 0.5}), s.w.nodes.v.set(2, {0, 0, -1});
  s.w.particles.x.set(0, {0.5, 0.5, -2.5}), s.w.particles.v.set(0, {0, 0, 1});
  s.walls("*RIGIDWALL_GEOMETRIC_PRISM\n0\n0.,0.,0.,0.,0.,1.\n1.,0.,0.,1.,1.,2.\n");
  s.start();
  while (s.cloud.clock.t < 0.8) s.steps(1);
  EXPECT_NEAR((s.w.nodes.x.vec(0) - Vec(0.5, 0.5, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((s.w.nodes.x.vec(1) - Vec(0, 0.5, -0.5)).norm(), 0, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(2)[2], -1, 1e-15);
  EXPECT_NEAR((s.w.particles.x.vec(0) - Vec(0.5, 0.5, -2)).norm(), 0, 1e-14);
}

// A massive plate at speed V: what rests before it goes on with V; the drive gives m V^2, half is lost.
TEST(GeometricWall, AMovingPlateTakesWithItWhatItMeets) {
  for (const bool displacement : {false, true}) {
    WallScene s;
    s.place({0.5, 0.05, 0.5}, {0, 0, 0});
    s.model.curves[4] =
        displacement ? Curve{4, {0, 0.1, 1.1}, {0, 0, 2}} : Curve{4, {0, 0.1, 0.1001, 9}, {0, 0, 2, 2}};
    s.walls("*RIGIDWALL_GEOMETRIC_FLAT_MOTION_DISPLAY\n0\n0.,0.,0.,0.,1.,0.\n0.,0.,1.,2.,2.\n" +
            std::string(displacement ? "4,1" : "4,0") + ",0.,3.,0.\n");
    s.start();
    while (s.cloud.clock.t < 0.09) s.steps(1);
    EXPECT_EQ(s.wall().displacement.norm(), 0);
    while (s.cloud.clock.t < 0.5) s.steps(1);
    for (const Points& p : s.sets()) {
      EXPECT_NEAR((p.v->vec(0) - Vec(0, 2, 0)).norm(), 0, 1e-12);
      EXPECT_NEAR(p.x->vec(0)[1], s.wall().displacement[1], 1e-12);
    }
    EXPECT_NEAR(s.wall().displacement[1], 2 * (s.cloud.clock.t - 0.1), 1e-3);
    EXPECT_NEAR(s.w.energy.external_work, 2 * 2 * 4, 1e-10);
    EXPECT_NEAR(s.w.energy.dissipated, 2 * 2 * 2, 1e-10);
    EXPECT_NEAR((s.wall().impulse - Vec(0, -2 * 2 * 2, 0)).norm(), 0, 1e-12);
  }
}

// A moving surface: the plate moves along itself; mu g accelerates what lies on it until it goes along.
TEST(GeometricWall, FrictionOfAMovingPlateDragsAlong) {
  WallScene s;
  s.place({0.5, 0, 0.5}, {0, 0, 0});
  s.model.curves[4] = Curve{4, {0, 9}, {1, 1}};
  s.walls("*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n0\n0.,0.,0.,0.,1.,0.,0.25\n\n4,0,1.,0.,0.\n");
  s.gravity({0, -8, 0});
  s.start();
  while (s.cloud.clock.t < 0.3) s.steps(1);
  EXPECT_NEAR(s.w.nodes.v.vec(0)[0], 0.25 * 8 * 0.3, 0.02);
  while (s.cloud.clock.t < 0.7) s.steps(1);
  EXPECT_NEAR((s.w.nodes.v.vec(0) - Vec(1, 0, 0)).norm(), 0, 1e-12);
  // two masses of 2: each takes m V^2 from the moving surface, and half of it is lost to sliding
  EXPECT_NEAR(s.w.energy.external_work, 2 * 2 * 1, 0.01);
  EXPECT_NEAR(s.w.energy.dissipated, 2 * 1, 0.01);
}

TEST(GeometricWall, TellsOfWhatStartsInside) {
  WallScene s;
  s.place({0.5, 0, 0}, {0, 0, 0});
  s.walls(ball + "0.0\n1.0\n");
  EXPECT_NE(s.diagnostics.text().find("2 points start inside of the wall, by up to 0.5"), std::string::npos)
      << s.diagnostics.text();
}
