// Rigid walls with friction that differs by direction, against integrated paths.
#include <cmath>

#include "wall_scene.hpp"

using namespace courant;
using test::WallScene;

namespace {

/// A floor at y = 0 with friction a along (1, 0, 1)/sqrt(2).
std::string floor_with(const std::string& coefficients, const std::string& direction = "0,0,1.0,0.0,1.0") {
  return "*RIGIDWALL_PLANAR_ORTHO\n0\n0.,0.,0.,0.,1.,0.\n" + coefficients + "\n" + direction + "\n";
}

/// A slide with -g (mu_a v_a, mu_b v_b)/|v|, by Runge-Kutta; mu at a speed.
struct Slide {
  Vec x = Vec::Zero(), v;
  template <class Mu>
  void go(Real g, Real t, const Mu& mu) {
    const Vec a = Vec(1, 0, 1).normalized(), b = Vec(0, 1, 0).cross(a);
    const auto slope = [&](const Vec& at) -> Vec {
      const Real speed = at.norm();
      if (speed == 0) return Vec::Zero();
      const auto [ma, mb] = mu(speed);
      return -g / speed * (ma * at.dot(a) * a + mb * at.dot(b) * b);
    };
    constexpr int steps = 20000;
    const Real h = t / steps;
    for (int k = 0; k < steps; ++k) {
      const Vec k1 = slope(v), k2 = slope(v + h / 2 * k1), k3 = slope(v + h / 2 * k2), k4 = slope(v + h * k3);
      x += h * v + h * h / 6 * (k1 + k2 + k3);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
};

}  // namespace

TEST(OrthoWall, BlocksSlideAlongBentPaths) {
  const Real g = 9.81;
  for (const bool decays : {false, true}) {
    WallScene s;
    s.place({0, 0, 0}, {3, 0, 0.2});
    s.walls(floor_with(decays ? "0.5,0.8,0.1,0.2,0.4,0.7" : "0.1,0.4,0.1,0.4"));
    s.gravity({0, -g, 0});
    s.start();
    s.steps(200);
    EXPECT_TRUE(s.diagnostics.ok()) << s.diagnostics.text();
    Slide slide{.v = Vec(3, 0, 0.2)};
    slide.go(g, s.cloud.clock.t, [&](Real speed) {
      return decays ? std::pair(0.1 + 0.4 * std::exp(-0.4 * speed), 0.2 + 0.6 * std::exp(-0.7 * speed))
                    : std::pair(0.1, 0.4);
    });
    const Real way = slide.x.norm(), across = std::abs(slide.x[2] / slide.x[0] - 0.2 / 3);
    EXPECT_GT(across, 0.03);  // five times what it may err: the path is bent
    for (const Points& p : s.sets()) EXPECT_LT((p.x->vec(0) - slide.x).norm(), 0.006 * way) << decays;
    s.steps(1);  // the ledger is at the start of the step
    EXPECT_NEAR((s.kinetic + s.w.energy.dissipated) / 18.08, 1, 0.02)
        << decays;  // two masses of 2, v^2 = 9.04
    EXPECT_NEAR(s.wall().normal, 4 * g, 1e-9);
  }
}

// Loads along the floor are held within the ellipse (T_a/mu_a)^2 + (T_b/mu_b)^2 = N^2, also along a and b.
TEST(OrthoWall, HoldsLoadsWithinAnEllipse) {
  const Real mu_a = 0.2, mu_b = 0.6, g = 10;
  const Vec a = Vec(1, 0, 1).normalized(), b = Vec(0, 1, 0).cross(a);
  for (const Real angle : {0.0, 0.4, 1.0, pi / 2})
    for (const Real times : {0.98, 1.02}) {
      const Real c = std::cos(angle), d = std::sin(angle);
      const Real most = g / std::hypot(c / mu_a, d / mu_b);
      WallScene s;
      s.place({0, 0, 0}, {0, 0, 0});
      s.walls(floor_with("0.2,0.6,0.2,0.6"));
      s.gravity(Vec(0, -g, 0) + times * most * (c * a + d * b));
      s.start();
      s.steps(50);
      const Real way = points_of(s.w.nodes).x->vec(0).norm();
      if (times < 1) {
        EXPECT_LT(way, 1e-12) << angle;
      } else {
        EXPECT_GT(way, 1e-4) << angle;
      }
    }
}

// With the same coefficients it is the friction of FRIC.
TEST(OrthoWall, IsCoulombsWhereBothAreTheSame) {
  std::array<Vec, 2> end;
  for (const bool ortho : {false, true}) {
    WallScene s;
    s.place({0, 0, 0}, {3, 0, 1});
    s.walls(ortho ? floor_with("0.3,0.3,0.3,0.3") : "*RIGIDWALL_PLANAR\n0\n0.,0.,0.,0.,1.,0.,0.3\n");
    s.gravity({0, -9.81, 0});
    s.start();
    s.steps(150);
    end[ortho] = s.w.nodes.x.vec(0);
  }
  EXPECT_LT((end[0] - end[1]).norm(), 1e-12 * end[0].norm());
}

// A support that holds x leaves a slide along z: with a along (1, 0, 2), 0.8 mu_a + 0.2 mu_b.
TEST(OrthoWall, PushesAlongTheAxesThatSupportsLeaveFree) {
  const Real g = 9.81;
  WallScene s;
  s.place({0, 0, 0}, {0, 0, 2});
  s.model.nodes[1].fixed = {true, false, false};
  s.walls(floor_with("0.1,0.3,0.1,0.3", "0,0,1.0,0.0,2.0"));
  s.gravity({0, -g, 0});
  s.w.passes.add(make_fixed_points(s.model, points_of(s.w.nodes), s.w));
  s.start();
  s.steps(100);
  const Real t = s.cloud.clock.t;
  ASSERT_LT(0.14 * g * t, 2);
  EXPECT_EQ(s.w.nodes.x.vec(0)[0], 0);
  EXPECT_NEAR(s.w.nodes.x.vec(0)[2], 2 * t - 0.07 * g * t * t, 0.01);
}

// d from one node to the other, which carries it round.
TEST(OrthoWall, DirectionsMayGoWithNodes) {
  WallScene s(4);
  s.place({0, 0, 0}, {1, 0, 0});
  s.w.nodes.follow[1] = 1, s.w.nodes.follow[2] = 1;
  s.w.nodes.x.set(1, {5, 0, 0}), s.w.nodes.x.set(2, {6, 3, 0});
  s.model.nodes[2].x = {5, 0, 0}, s.model.nodes[3].x = {6, 3, 0};
  s.walls(floor_with("0.0,0.5,0.0,0.5", "12,13"));
  s.gravity({0, -10, 0});
  s.start();
  s.steps(40);
  EXPECT_TRUE(s.diagnostics.ok()) << s.diagnostics.text();
  EXPECT_NEAR(s.w.nodes.v.vec(0)[0], 1, 1e-12);  // along a, without friction
  s.w.nodes.x.set(2, {5, 0, 4});
  const Real before = s.cloud.clock.t;
  s.steps(10);
  EXPECT_NEAR(s.w.nodes.v.vec(0)[0], 1 - 5 * (s.cloud.clock.t - before), 0.02);  // now along b
}

TEST(OrthoWall, IsRefusedByName) {
  const auto faults = [](const std::string& cards) {
    WallScene s;
    s.walls(cards);
    return s.diagnostics.text();
  };
  EXPECT_NE(faults(floor_with("0.1,0.1,0.1,0.1", "0,0,0.0,1.0,0.0")).find("has no length along the wall"),
            std::string::npos);
  EXPECT_NE(faults(floor_with("0.1,0.1,0.1,0.1", "77,12")).find("node 77 does not exist"), std::string::npos);
  EXPECT_NE(faults(floor_with("0.1,0.1,0.1,0.1", "1,12")).find("node 1 carries a particle"),
            std::string::npos);
  EXPECT_NE(faults("*RIGIDWALL_PLANAR_ORTHO\n0\n0.,0.,0.,0.,1.,0.,0.3\n0.1,0.1,0.1,0.1\n0,0,1.0\n")
                .find("is given with the friction of _ORTHO"),
            std::string::npos);
}
