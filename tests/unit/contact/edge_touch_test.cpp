// Two edges that touch, by hand: shares, stiffness, damping, friction, energies, what is reported.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/edges/edge_contact.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace edge_touch_test {
namespace {

constexpr Real r = 0.05, k = 4;  // of the softer edge, times 0.1

/// Edge a along x above edge b, at a third of a and at 0.6 of b, or side by side over 0.8 of the length 1 of
/// both.
struct EdgeScene {
  World world;
  Clock clock;
  NodeContactLaw law;
  std::shared_ptr<EdgeContact> contact;
  bool parallel = false, held = false;
  std::array<unsigned, 2> sides{1, 2};
  Real gap = 0.001;
  Vec v{0, 0, -1};

  void build() {
    Nodes& nodes = world.nodes;
    nodes.fields.resize(4);
    const Real z = 2 * r + gap;
    const Vec a0 = parallel ? Vec(0.2, 0, z) : Vec(-0.3, 0, z), along(1, 0, 0);
    const Vec b0 = parallel ? Vec(0, 0, 0) : Vec(0, -0.6, 0), of_b = parallel ? along : Vec(0, 1, 0);
    const Vec x[4] = {a0, a0 + along, b0, b0 + of_b};
    for (Index n = 0; n < 4; ++n) {
      nodes.x.set(n, x[n]), nodes.id[n] = n + 1, nodes.m[n] = 1 + 0.5 * static_cast<Real>(n);
      nodes.held[n] = held && n > 1;
      nodes.v.set(n, n < 2 ? v : Vec(Vec::Zero()));
    }
    std::vector<ContactEdge> edges(2);
    edges[0].node = {0, 1}, edges[1].node = {2, 3};
    edges[0].k = 90, edges[1].k = 40, edges[0].area = 0.3, edges[1].area = 0.2;
    for (std::size_t e = 0; e < 2; ++e) edges[e].r = r, edges[e].sides = sides[e], edges[e].always = true;
    contact = std::make_shared<EdgeContact>(law, edges, WallBodies{}, nullptr, 1, world);
  }
  void step(Real dt) {
    clock.dt = clock.dt_old = dt;
    for (Index n = 0; n < 4; ++n) world.nodes.x.add(n, dt * world.nodes.v.vec(n));
    contact->start(world, clock);
    for (Index begin = 0; begin < 2; begin += block_size) contact->block(world, clock, begin, 2);
    contact->finish(world, clock);
  }
  /// 0.004 deep, then on at `v`.
  void come(const Vec& on) {
    step(0), step(0.005);
    for (Index n : {0, 1}) world.nodes.v.set(n, on);
    step(1e-4);
  }
  Vec force_on(Index n) const {
    Vec f = Vec::Zero();
    contact->add_force_on(n, f);
    return f;
  }
  Vec on_a() const { return force_on(0) + force_on(1); }
  EnergyLedger recorded() {
    EnergyLedger out;
    contact->record(world, clock, out);
    return out;
  }
  EnergyLedger sampled() const {
    EnergyLedger out;
    contact->sample(world, clock, out);
    return out;
  }
};

}  // namespace

// 0.1 of the softer edge times the depth, by shares of the position where they touch; SURFA gets what its
// edge gets, whichever comes first.
TEST(EdgeTouch, ForcesAreInBalanceAndOfTheSofterEdge) {
  for (const bool turned : {false, true}) {
    EdgeScene s;
    if (turned) s.sides = {2, 1};
    s.build();
    s.come(Vec::Zero());
    const Real F = k * 0.004, share[4] = {0.7, 0.3, -0.4, -0.6};
    Vec sum = Vec::Zero(), moment = Vec::Zero();
    for (Index n = 0; n < 4; ++n) {
      EXPECT_NEAR((s.force_on(n) - Vec(0, 0, share[n] * F)).norm(), 0, 1e-14) << n;
      sum += s.force_on(n), moment += s.world.nodes.x.vec(n).cross(s.force_on(n));
    }
    EXPECT_NEAR(sum.norm() + moment.norm(), 0, 1e-14);
    EXPECT_NEAR(s.contact->report().on_surfa[2], turned ? -F : F, 1e-14);
    EXPECT_NEAR(s.contact->report().energy_stored, 0.5 * k * 0.004 * 0.004, 1e-16);
    EXPECT_NEAR(s.sampled().contact, 0.5 * k * 0.004 * 0.004, 1e-16);
  }
}

// What is nearer than both radii from the start gives no force, but what comes on top of that.
TEST(EdgeTouch, DepthOfTheStartGivesNoForce) {
  EdgeScene s;
  s.gap = -0.003, s.v = Vec::Zero();
  s.build();
  s.step(0), s.step(1e-4);
  EXPECT_EQ(s.on_a(), Vec::Zero());
  for (Index n : {0, 1}) s.world.nodes.v.set(n, Vec(0, 0, -0.1));
  s.step(0.01);
  EXPECT_NEAR(s.on_a()[2], k * 0.001, 1e-14);
  EXPECT_NEAR(s.sampled().contact, 0.5 * k * 1e-6, 1e-16);
}

TEST(EdgeTouch, DampingIsNeverTension) {
  EdgeScene s;
  s.law.vdc = 100;
  s.build();
  s.come(Vec(0, 0, 1));
  EXPECT_EQ(s.on_a()[2], 0);
}

// Damping and friction with forces on the nodes: their work is that of the mean velocities of the step to
// come, in the ledger and in what the contact reports; what springs of friction hold is not lost yet.
TEST(EdgeTouch, WorkIsOfTheMeanVelocitiesOfBothEdges) {
  for (const bool driven : {false, true})
    for (const Real vdc : {0.0, 10.0}) {
      EdgeScene s;
      s.law.fs = s.law.fd = 0.5, s.law.vdc = vdc;
      s.build();
      if (driven) shared_fields::prescribed_motion.add(s.world.nodes.fields)[0] = 1;
      s.come(Vec(0.1, 0.05, -0.01));
      for (int n = 0; n < 8; ++n) s.step(0.02);
      Nodes& nodes = s.world.nodes;
      const Vec f[4] = {Vec(1, -1, 2), Vec(-2, 0, 1), Vec(3, 1, 0), Vec(0, 2, -1)};
      nodes.v.set(3, Vec(-0.03, 0, 0.02));
      s.step(1e-9);
      for (Index n = 0; n < 4; ++n) nodes.f.set(n, f[n]);
      s.clock.dt = 0.01, s.clock.dt_old = 0.02;
      const Real dt = s.clock.dt_mean();
      // shares of where they touch now
      const Real at = (nodes.x.vec(2)[0] - nodes.x.vec(0)[0]), on = -nodes.x.vec(2)[1] + nodes.x.vec(0)[1];
      const Vec xb = nodes.x.vec(3) - nodes.x.vec(2);
      const Real t = on / xb[1];
      const Real share[4] = {1 - (at + t * xb[0]), at + t * xb[0], -(1 - t), -t};
      Vec v = Vec::Zero();
      for (Index n = 0; n < 4; ++n)
        v += share[n] * (nodes.v.vec(n) + (driven && n == 0 ? 0 : 0.5 * dt / nodes.m[n]) * f[n]);
      const Vec force = s.on_a();
      const Vec normal = Vec::UnitZ();
      const Real depth = std::sqrt(2 * s.sampled().contact / k), damping = force.dot(normal) - k * depth;
      if (vdc > 0) EXPECT_GT(std::abs(damping), 1e-4);
      const Vec friction = force - force.dot(normal) * normal;
      if (vdc == 0) EXPECT_NEAR(friction.norm(), 0.5 * force.dot(normal), 1e-9) << "it slides";
      const InterfaceForce before = s.contact->report();
      const EnergyLedger lost = s.recorded();
      const InterfaceForce after = s.contact->report();
      const Real of_friction = -friction.dot(v) * dt, of_damping = -damping * normal.dot(v) * dt;
      // the edges are a little askew by now, 1e-3 of the normal
      EXPECT_NEAR(after.energy_friction - before.energy_friction, of_friction, 3e-3 * std::abs(of_friction));
      EXPECT_NEAR(after.energy_damping - before.energy_damping, of_damping,
                  3e-3 * (std::abs(of_friction) + std::abs(of_damping)));
      EXPECT_NEAR(
          lost.dissipated,
          after.energy_friction - before.energy_friction + after.energy_damping - before.energy_damping,
          1e-15);
      EXPECT_NEAR(lost.throughput, std::abs(lost.dissipated), 1e-15);
    }
}

// Side by side two touches have half of the length that both share each: together the stiffness of that part,
// and a stress VC on the smaller area times the part.
TEST(EdgeTouch, SideBySideTheyTouchAlongWhatTheyShare) {
  EdgeScene s;
  s.parallel = true, s.held = true;
  s.build();
  s.come(Vec::Zero());
  EXPECT_NEAR(s.on_a()[2], 0.8 * k * 0.004, 1e-12);
  EXPECT_NEAR(s.sampled().contact, 0.8 * 0.5 * k * 0.004 * 0.004, 1e-14);
  Vec moment = Vec::Zero();
  for (Index n = 0; n < 4; ++n) moment += s.world.nodes.x.vec(n).cross(s.force_on(n));
  EXPECT_NEAR(moment.norm(), 0, 1e-14);
  EdgeScene slides;
  slides.parallel = true, slides.held = true;
  slides.law.fs = slides.law.fd = 0.9, slides.law.vc = 0.01;
  slides.build();
  slides.come(Vec(0, 0.1, 0));
  for (int n = 0; n < 5; ++n) slides.step(0.01);
  const Vec n =
      (slides.world.nodes.x.vec(0) - slides.world.nodes.x.vec(2)).cwiseProduct(Vec(0, 1, 1)).normalized();
  const Vec force = slides.on_a();
  EXPECT_NEAR((force - force.dot(n) * n).norm(), 0.01 * 0.8 * 0.2, 1e-12);
}

}  // namespace edge_touch_test
