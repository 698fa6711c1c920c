// What touches sees the other side move: damping and friction are of relative velocities, bodies answer to
// all that pushes them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "contact/nodes/penalty.hpp"
#include "scene.hpp"
#include "touch_scene.hpp"

using namespace courant;

namespace relative_motion_test {
namespace {

struct Forces {
  Vec particle;
  std::vector<Vec> corner;
};
/// One particle 0.004 deep over a plate of 1 x 1, after two steps of 1e-4 at rest; `wall`: velocity by
/// position.
template <class Wall>
Forces forces(const Vec& v, const Wall& wall) {
  test::Scene scene;
  scene.held = false, scene.law.vdc = 20, scene.law.fs = 0.3, scene.law.fd = 0.3;
  scene.plate(Vec::Zero(), Vec(1, 0, 0), Vec(0, 1, 0));
  scene.x = {Vec(0.3, 0.2, 0.5 * scene.thickness - 0.004)}, scene.v = {v};
  scene.build();
  for (Index n = 0; n < 4; ++n) scene.world.nodes.v.set(n, wall(scene.world.nodes.x.vec(n)));
  scene.clock.dt = scene.clock.dt_old = 1e-4;
  for (int k = 0; k < 2; ++k) {
    scene.clear(), scene.clear_walls();
    test::run(*scene.contact, scene.world, scene.clock);
  }
  scene.gather(*scene.contact);
  Forces out{scene.world.particles.f.vec(0), {}};
  for (Index n = 0; n < 4; ++n) out.corner.push_back(scene.world.nodes.f.vec(n));
  return out;
}

}  // namespace

// Of a wall whose corners move differently, the velocity under the particle counts.
TEST(RelativeMotion, ParticlesFeelTheVelocityOfTheWallWhereTheyAre) {
  const Vec v(0.02, -0.01, -0.3);
  const auto at_rest = [](const Vec&) { return Vec(Vec::Zero()); };
  const Forces expected = forces(v, at_rest);
  EXPECT_GT(expected.particle.head<2>().norm(), 1e-3 * expected.particle[2]) << "friction";
  EXPECT_GT(expected.particle[2], forces(Vec::Zero(), at_rest).particle[2] * 1.01) << "damping";
  const auto moves = [](const Vec& x) { return Vec(0.5 + x[0], 0.7 - 2 * x[1], 0.4 + 3 * x[0] - x[1]); };
  const Forces found = forces(v + moves(Vec(0.3, 0.2, 0)), moves);
  EXPECT_NEAR((found.particle - expected.particle).norm(), 0, 1e-9 * expected.particle.norm());
  Vec sum = found.particle, moment = Vec(0.3, 0.2, 0).cross(found.particle);
  const Vec corner[4] = {Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(0, 1, 0)};
  for (std::size_t n = 0; n < 4; ++n) sum += found.corner[n], moment += corner[n].cross(found.corner[n]);
  EXPECT_NEAR(sum.norm(), 0, 1e-9 * expected.particle.norm());
  EXPECT_NEAR(moment.norm(), 0, 1e-9 * expected.particle.norm()) << "they share the force as levers do";
}

// Two nodes push a face of a body: in the last step before they leave, the force is that of the spring of
// both on the body, which they push down, with the moment of both about the point.
TEST(RelativeMotion, BodiesAnswerToAllThatTouchThem) {
  TouchScene scene;
  scene.held = false, scene.at = Vec(-0.5, -0.2, 0.001);
  scene.bodies.of_node = {0, 0, 0, 0, -1, -1, -1, -1};
  scene.bodies.give = [](Index, const Vec&, const Vec&) { return 0.25; };
  scene.bodies.change = [](Index, const Vec&, const Clock&) { return Vec(Vec::Zero()); };
  struct Asked {
    Vec q, impulse, moment;
  };
  std::vector<Asked> asked;
  constexpr Real per_mass = 4000, per_inertia = 3000;  // so light that the spring matters within a step
  scene.bodies.answer_alone = [&](Index, const Vec& q, const Vec& impulse, const Vec& moment) {
    asked.push_back({q, impulse, moment});
    return Vec(per_mass * impulse + (per_inertia * (moment + q.cross(impulse))).cross(q));
  };
  scene.change = [](ContactSides& sides) {
    for (ContactNode node = sides.nodes[0]; const Index n : {5}) node.node = n, sides.nodes.push_back(node);
  };
  scene.build();
  scene.step(0), scene.step(0.005);
  for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, Vec(0, 0, 1));
  scene.step(0.002);  // 0.002 deep, and out within the next
  asked.clear();
  scene.step(0.0012);
  const Vec point[2] = {scene.world.nodes.x.vec(4), scene.world.nodes.x.vec(5)};
  const Real k = 2.5, depth = 0.0008;
  std::vector<Asked> of_both;
  for (const Asked& one : asked)
    if (one.impulse.norm() > 1.5 * k) of_both.push_back(one);
  ASSERT_EQ(of_both.size(), 2u);
  for (const Asked& one : of_both) {
    EXPECT_NEAR((one.impulse - Vec(0, 0, -2 * k)).norm(), 0, 1e-12) << "they push the body down";
    // as the points were a step ago: along z they have moved by a millimetre, which has no moment
    const Vec moment = (point[0] + point[1] - 2 * one.q).cross(Vec(0, 0, -k));
    EXPECT_NEAR((one.moment - moment).norm(), 0, 1e-12);
  }
  for (const Index n : {4, 5}) {
    const Vec& q = scene.world.nodes.x.vec(n);
    const Vec moment = (point[0] + point[1] - 2 * q).cross(Vec(0, 0, -k)) + q.cross(Vec(0, 0, -2 * k));
    const Real of_body = -(per_mass * Vec(0, 0, -2 * k) + (per_inertia * moment).cross(q))[2], of_node = k;
    const Real part = part_of_step(depth, 1, 0.0012, of_node + of_body);
    EXPECT_NEAR(part * k * depth, scene.force_on(n)[2], 1e-12) << n;
    EXPECT_GT(std::abs(part - part_of_step(depth, 1, 0.0012, of_node)), 1e-4) << "the body counts";
  }
}

}  // namespace relative_motion_test
