// Joints between rigid bodies, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "joint_decks.hpp"
#include "same_bits.hpp"

using namespace courant;
using test::do_nothing;
using test::GivenBody;
using test::height_energy;
using test::JointDeck;
using test::joints_of;
using test::kinetic;
using test::largest_gap;
using test::simulation_of;

namespace {

Matrix diagonal(Real x, Real y, Real z) {
  return Vec(x, y, z).asDiagonal();
}

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
Real complete_elliptic(Real k) {
  Real a = 1, b = std::sqrt(1 - k * k);
  for (int i = 0; i < 20; ++i) {
    const Real mean = 0.5 * (a + b);
    b = std::sqrt(a * b), a = mean;
  }
  return pi / (2 * a);
}

/// Runs to `end` and returns the largest deviation of kinetic and height energy at t^n from the first one.
Real largest_energy_error(Simulation& s, Real end, Real g, Real gap = 1e-12) {
  Real first = 0, worst = 0, before = kinetic(s);
  for (int k = 0; s.clock().t < end; ++k) {
    const Real height = height_energy(s, g);
    s.step(do_nothing);
    const Real energy = 0.5 * (before + kinetic(s)) + height;
    before = kinetic(s);
    if (k < 2) first = energy;  // the first half step has no step before it
    worst = std::max(worst, std::abs(energy - first));
    EXPECT_LT(largest_gap(s), gap) << s.clock().t;
    if (::testing::Test::HasFailure()) break;
  }
  return worst;
}

}  // namespace

// m 2 at d = 0.3 from the axis (along y), released at 1 rad from hanging down.
TEST(Joints, CompoundPendulumSwingsWithItsPeriod) {
  const Real m = 2, d = 0.3, g = 9.81, J = 0.05, start = 1;
  JointDeck deck;
  const int ground = deck.ground();
  const int body =
      deck.body({.x = d * Vec(std::sin(start), 0, -std::cos(start)), .m = m, .J = diagonal(0.04, J, 0.03)});
  deck.joint("REVOLUTE", ground, body, {Vec(0, 0, 0), Vec(0, 1, 0)});
  deck.gravity(g);
  const Real period = 4 * std::sqrt((J + m * d * d) / (m * g * d)) * complete_elliptic(std::sin(0.5 * start));
  auto s = simulation_of(deck.text(2 * period));
  const RigidBody& b = s->bodies()->bodies().back();
  std::vector<Real> zeros;
  Real first = 0, worst = 0, before = 0, last = b.x[0], pull = 0;
  for (int k = 0; s->clock().t < 1.9 * period; ++k) {
    const Real height = height_energy(*s, g), t = s->clock().t;
    s->step(do_nothing);
    const Real energy = 0.5 * (before + kinetic(*s)) + height;
    before = kinetic(*s);
    if (k == 1) first = energy;
    if (k > 0) worst = std::max(worst, std::abs(energy - first));
    if ((last > 0) != (b.x[0] > 0)) zeros.push_back(t + (s->clock().t - t) * last / (last - b.x[0]));
    last = b.x[0];
    std::vector<JointForce> forces;
    joints_of(*s).report_joints(forces);
    pull = std::max(pull, forces[0].force.norm());
    ASSERT_LT(largest_gap(*s), 1e-12);
  }
  EXPECT_LT(worst, 1e-3 * m * g * d * (1 - std::cos(start)));
  ASSERT_GE(zeros.size(), 3u);
  EXPECT_NEAR(zeros[2] - zeros[0], period, 1e-4 * period);
  // at the bottom: m g + m d omega^2, with omega from the height
  const Real rate2 = 2 * m * g * d * (1 - std::cos(start)) / (J + m * d * d);
  EXPECT_NEAR(pull, m * g + m * d * rate2, 1e-3 * pull);
}

TEST(Joints, DoublePendulumKeepsItsEnergy) {
  for (const char* kind : {"REVOLUTE", "SPHERICAL"}) {
    JointDeck deck;
    const int ground = deck.ground();
    const Matrix J = diagonal(0.01, 0.09, 0.09);
    const int one = deck.body({.x = {0.5, 0, 0}, .J = J}), two = deck.body({.x = {1.5, 0, 0}, .J = J});
    deck.joint("REVOLUTE", ground, one, {Vec(0, 0, 0), Vec(0, 1, 0)});
    const bool axis = std::string(kind) == "REVOLUTE";
    deck.joint(kind, one, two, axis ? std::vector<Vec>{{1, 0, 0}, {1, 1, 0}} : std::vector<Vec>{{1, 0, 0}});
    deck.gravity(9.81);
    auto s = simulation_of(deck.text(6));
    EXPECT_LT(largest_energy_error(*s, 6, 9.81), 1e-3 * 2 * 9.81) << kind;
    EXPECT_GT((s->bodies()->bodies()[2].x - Vec(1.5, 0, 0)).norm(), 0.1);
  }
}

// A driven crank moves a slider by a rod; three of the equations of its joints follow from the others.
TEST(Joints, SliderCrankFollowsTheClosedForm) {
  const Real r = 0.2, l = 0.7, rate = 20;
  JointDeck deck;
  const int ground = deck.ground();
  const Matrix J = diagonal(0.01, 0.01, 0.01);
  const int crank = deck.body({.J = J, .con1 = 7, .con2 = 6});
  const int rod = deck.body({.x = {r + 0.5 * l, 0, 0}, .J = J});
  const int slider = deck.body({.x = {r + l, 0, 0}, .J = J});
  const auto with_axis = [](const Vec& x) { return std::vector<Vec>{x, x + Vec(0, 0.1, 0)}; };
  deck.joint("REVOLUTE", ground, crank, with_axis({0, 0, 0}));
  deck.joint("REVOLUTE", crank, rod, with_axis({r, 0, 0}));
  deck.joint("REVOLUTE", rod, slider, with_axis({r + l, 0, 0}));
  deck.joint("TRANSLATIONAL", ground, slider, {Vec(r + l, 0, 0), Vec(r + l + 0.1, 0, 0), Vec(r + l, 0, 0.1)});
  deck.more = fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{:10}         6         0         7       1.0\n*DEFINE_CURVE\n"
      "         7\n0.0,0.0\n0.05,{}\n9.0,{}\n",
      crank, rate, rate);
  auto s = simulation_of(deck.text(0.6));
  const auto& bodies = s->bodies()->bodies();
  Real furthest = 10;
  while (s->clock().t < 0.6) {
    s->step(do_nothing);
    const Real t = s->clock().t, phi = t < 0.05 ? 0.5 * rate / 0.05 * t * t : rate * (t - 0.025);
    const Real x = r * std::cos(phi) + std::sqrt(l * l - r * r * std::sin(phi) * std::sin(phi));
    ASSERT_NEAR(bodies[3].x[0], x, 1e-6 * l) << t;
    ASSERT_NEAR(bodies[3].x[1], 0, 1e-11);
    ASSERT_NEAR(bodies[3].x[2], 0, 1e-11);
    ASSERT_LT(largest_gap(*s), 1e-11);
    furthest = std::min(furthest, bodies[3].x[0]);
  }
  EXPECT_NEAR(furthest, l - r, 1e-3) << "it went through the dead centre";
}

// Axes a little askew, as the digits of a deck leave them, would lock a four-bar linkage of rigid bodies: it
// swings all the same, and the summary states how far its joints open.
TEST(Joints, ALinkageWithAxesALittleAskewSwings) {
  const Real slight = 1e-6, g = 9.81;
  JointDeck deck;
  const int ground = deck.ground();
  const Matrix J = diagonal(0.01, 0.01, 0.01);
  const auto hinge = [&](int a, int b, const Vec& x, Real sign) {
    deck.joint("REVOLUTE", a, b, {x, x + Vec(sign * slight, 1, 2 * sign * slight)});
  };
  const int left = deck.body({.x = {0, 0, -0.5}, .J = J}), right = deck.body({.x = {1, 0, -0.5}, .J = J}),
            bar = deck.body({.x = {0.5, 0, -1}, .J = J, .v = {1, 0, 0}});
  hinge(ground, left, {0, 0, 0}, 1), hinge(ground, right, {1, 0, 0}, -1);
  hinge(left, bar, {0, 0, -1}, 1), hinge(right, bar, {1, 0, -1}, 1);
  deck.gravity(g);
  auto s = simulation_of(deck.text(4));
  const RigidBody& b = s->bodies()->bodies()[3];
  // a parallelogram: the bar swings without turning, half of the work of the two arms' weight at half its
  // height
  const Real energy = kinetic(*s), inertia = 1 + 2 * (0.25 + 0.01);
  EXPECT_NEAR(0.5 * inertia * b.v[0] * b.v[0], energy, 1e-9 * energy);
  const Real highest = energy / (2 * g);
  Real top = -2;
  while (s->clock().t < 4) {
    s->step(do_nothing);
    top = std::max(top, b.x[2]);
  }
  EXPECT_NEAR(top, -1 + highest, 1e-3 * highest);
  EXPECT_LT(largest_gap(*s), 10 * slight);
  EXPECT_GT(s->world().maxima["joint_gap"], 0);
}

// The same of what CON2 holds: the axis is not quite the one about which the body may turn.
TEST(Joints, AHingeALittleAskewToWhatIsHeldSwings) {
  JointDeck deck;
  const int ground = deck.ground();
  const int body = deck.body({.x = {1, 0, 0}, .J = diagonal(0.1, 0.1, 0.1), .con2 = 6});
  deck.joint("REVOLUTE", ground, body, {Vec(0, 0, 0), Vec(1e-6, 1, 1e-6)});
  deck.gravity(9.81);
  auto s = simulation_of(deck.text(2));
  Real lowest = 0;
  while (s->clock().t < 2) {
    s->step(do_nothing);
    lowest = std::min(lowest, s->bodies()->bodies().back().x[2]);
  }
  EXPECT_NEAR(lowest, -1, 1e-4);
}

// 50 rods, from straight and horizontal.
TEST(Joints, ChainOfFiftyLinksKeepsItsEnergy) {
  JointDeck deck;
  const int links = 50;
  const Real l = 1.0 / links, m = 0.1, g = 9.81;
  int last = deck.ground();
  for (int k = 0; k < links; ++k) {
    const Real J = m * l * l / 12;
    const int link = deck.body({.x = {(k + 0.5) * l, 0, 0}, .m = m, .J = diagonal(0.1 * J, J, J)});
    deck.joint("SPHERICAL", last, link, {Vec(k * l, 0, 0)});
    last = link;
  }
  deck.gravity(g);
  auto s = simulation_of(deck.text(0.5));
  EXPECT_LT(largest_energy_error(*s, 0.5, g), 1e-3 * links * m * g * 0.5);
  EXPECT_LT(s->bodies()->bodies().back().x[2], -0.5) << "it fell";
}

// A top whose axis is level goes round with m g d/(J_s omega_s).
TEST(Joints, GyroscopePrecesses) {
  const Real m = 1.5, d = 0.2, g = 9.81, across = 0.02, along = 0.01, spin = 150;
  const Real rate = m * g * d / (along * spin);
  JointDeck deck;
  const int ground = deck.ground();
  const int top = deck.body({.x = {d, 0, 0},
                             .m = m,
                             .J = diagonal(along, across, across),
                             .v = Vec(0, 0, rate).cross(Vec(d, 0, 0)),
                             .omega = {spin, 0, rate}});
  deck.joint("SPHERICAL", ground, top, {Vec(0, 0, 0)});
  deck.gravity(g);
  auto s = simulation_of(deck.text(1));
  const RigidBody& b = s->bodies()->bodies().back();
  while (s->clock().t < 1) {
    s->step(do_nothing);
    const Real angle = std::atan2(b.x[1], b.x[0]), expected = rate * s->clock().t;
    ASSERT_NEAR(std::remainder(angle - expected, 2 * pi), 0, 1e-3 * expected + 1e-6) << s->clock().t;
    ASSERT_NEAR(b.x[2], 0, 1e-3 * d);
  }
}

// Two free bodies with any joint: momentum to round-off, energy, what the joint leaves free.
TEST(Joints, EachKindKeepsMomentumAndEnergy) {
  const std::vector<Vec> pair{{0.5, 0.1, 0}, {0.5, 0.1, 0.3}}, three{pair[0], pair[1], {0.8, 0.1, 0}},
      cross{pair[0], pair[1], {0.9, 0.1, 0}};
  const struct {
    const char* kind;
    std::vector<Vec> places;
  } cases[] = {{"SPHERICAL", {pair[0]}}, {"REVOLUTE", pair},       {"CYLINDRICAL", pair}, {"PLANAR", pair},
               {"UNIVERSAL", cross},     {"TRANSLATIONAL", three}, {"LOCKING", three},    {"SCREW", three}};
  for (const auto& one : cases) {
    JointDeck deck;
    const int a =
        deck.body({.m = 2, .J = diagonal(0.2, 0.3, 0.25), .v = {0, 0.1, 0.2}, .omega = {0.3, -0.5, 1}});
    const int b = deck.body({.x = {1, 0, 0},
                             .m = 1,
                             .J = diagonal(0.1, 0.08, 0.12),
                             .v = {0.1, 0.5, 0.3},
                             .omega = {1, 2, -1.5}});
    deck.joint(one.kind, a, b, one.places, 0.05);
    auto s = simulation_of(deck.text(4));
    const auto& bodies = s->bodies()->bodies();
    const auto total = [&] {  // of v and L of the half step with positions of the step before: exact
      Vec p = Vec::Zero(), L = Vec::Zero();
      for (const RigidBody& body : bodies) {
        const Vec x = body.x - body.v * (s->clock().t > 0 ? s->clock().dt_old : 0);
        p += body.m * body.v, L += body.L + x.cross(body.m * body.v);
      }
      return std::pair(p, L);
    };
    const auto [p0, L0] = total();
    const Vec expected_p = 2 * Vec(0, 0.1, 0.2) + Vec(0.1, 0.5, 0.3);
    EXPECT_NEAR((p0 - expected_p).norm(), 0, 1e-13) << "the start keeps it, too";
    const Real start = kinetic(*s);
    Real worst = 0, before = start;
    while (s->clock().t < 4) {
      s->step(do_nothing);
      worst = std::max(worst, std::abs(0.5 * (before + kinetic(*s)) - start));
      before = kinetic(*s);
      ASSERT_LT(largest_gap(*s), 1e-12) << one.kind;
    }
    const auto [p, L] = total();
    EXPECT_NEAR((p - p0).norm(), 0, 1e-11) << one.kind;
    EXPECT_NEAR((L - L0).norm(), 0, 1e-11) << one.kind;
    EXPECT_LT(worst, 1e-3 * start) << one.kind;
  }
}

// A nut that does not turn, on a screw that is driven; the nodes of the two may be apart along the axis.
TEST(Joints, ScrewAdvancesByItsPitch) {
  for (const Real apart : {0.0, 0.3}) {
    JointDeck deck;
    const Matrix J = diagonal(0.01, 0.01, 0.01);
    const int screw = deck.body({.J = J, .con1 = 7, .con2 = 5});
    const int nut = deck.body({.x = {0.5, 0, 0}, .m = 3, .J = J, .con2 = 7});
    const Vec by(apart, 0, 0);
    std::vector<Vec> places;
    for (const Vec& x : {Vec(0.5, 0, 0), Vec(0.9, 0, 0), Vec(0.5, 0.2, 0)})
      places.push_back(x), places.push_back(x + by);
    deck.joint_at("SCREW", screw, nut, places, "0.04");
    deck.more = fmt::format(
        "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{:10}         5         0         7       1.0\n*DEFINE_CURVE\n"
        "         7\n0.0,0.0\n1.0,20.0\n",
        screw);
    auto s = simulation_of(deck.text(1));
    const RigidBody& b = s->bodies()->bodies().back();
    std::vector<JointForce> forces;
    while (s->clock().t < 0.99) {
      s->step(do_nothing);
      const Real t = s->clock().t;
      // right-handed: as the screw turns by +1 the nut turns by -1 as seen from it
      ASSERT_NEAR(b.x[0] - 0.5, -0.04 * 10 * t * t, 1e-9) << t;
    }
    joints_of(*s).report_joints(forces);
    EXPECT_NEAR(forces[0].force[0], -3 * 0.04 * 20, 1e-6);
    EXPECT_GT(std::abs(joints_of(*s).all()[0].turned), 9) << "it went round";
  }
}

TEST(Joints, TellWhatAnInconsistentStartLoses) {
  JointDeck deck;
  const int a = deck.body({}), b = deck.body({.x = {1, 0, 0}, .v = {0.4, 1.5, 0}});
  deck.joint("TRANSLATIONAL", a, b, {Vec(0.5, 0, 0), Vec(0.5, 1, 0), Vec(0.6, 0, 0)});
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text = deck.text(1)](const std::string&) { return text; };
  auto s = Simulation::build("test.k", options, diagnostics);
  ASSERT_NE(s, nullptr) << diagnostics.text();
  // along y both keep theirs but for turning together; along x they share the momentum: 0.04 of 1.205 lost,
  // and what turning takes
  EXPECT_NE(diagnostics.text().find("velocities at the start do not fit the joints"), std::string::npos)
      << diagnostics.text();
  const auto& bodies = s->bodies()->bodies();
  const Vec p = bodies[0].v + bodies[1].v;
  EXPECT_NEAR((p - Vec(0.4, 1.5, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(bodies[0].omega[2], bodies[1].omega[2], 1e-14);
}

TEST(Joints, GiveTheSameBits) {
  JointDeck deck;
  const int ground = deck.ground();
  const Matrix J = diagonal(0.01, 0.09, 0.08);
  const int one = deck.body({.x = {0.5, 0, 0}, .J = J}),
            two = deck.body({.x = {1.5, 0, 0}, .J = J, .omega = {1, 2, 3}});
  deck.joint("SPHERICAL", ground, one, {Vec(0, 0, 0)});
  deck.joint("SCREW", one, two, {Vec(1, 0, 0), Vec(2, 0, 0), Vec(1, 1, 0)}, 0.01);
  deck.gravity(9.81);
  test::expect_same_bits(deck.text(2), 900, 400);
}
