// Motors, gears, racks and pulleys between rigid bodies, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "joint_decks.hpp"
#include "same_bits.hpp"

using namespace courant;
using test::do_nothing;
using test::JointDeck;
using test::joints_of;
using test::largest_gap;
using test::simulation_of;

namespace {

Matrix about(Real axis, Real across) {
  return Vec(across, across, axis).asDiagonal();
}

/// How far a body has turned about z, next to `near`.
Real turn_z(const RigidBody& b, Real near) {
  const Matrix R = b.q.toRotationMatrix();
  return near + std::remainder(std::atan2(R(1, 0), R(0, 0)) - near, 2 * pi);
}

JointForce force_of(const Simulation& s, std::size_t joint) {
  std::vector<JointForce> out;
  joints_of(s).report_joints(out);
  return out[joint];
}

/// The share of the energy that came from nowhere.
Real energy_error(Simulation& s) {
  sample_energy(s.world(), s.clock());
  return std::abs(s.world().energy.residual()) / s.world().energy.throughput;
}

/// Momentum, and angular momentum of v and L of the half step with positions of the step before: exact.
std::pair<Vec, Vec> momenta(Simulation& s) {
  Vec p = Vec::Zero(), L = Vec::Zero();
  for (const RigidBody& b : s.bodies()->bodies()) {
    if (b.fixed()) continue;
    const Vec x = b.x - b.v * (s.clock().t > 0 ? s.clock().dt_old : 0);
    p += b.m * b.v, L += b.L + x.cross(b.m * b.v);
  }
  return {p, L};
}

const Vec z(0, 0, 0.1);

/// Two wheels about z through (0, 0, 0) and (0.7, 0, 0) on `carrier`, whose first one a motor drives by the
/// curve 7 of the rate; the joint between them is joint 4.
struct Wheels {
  JointDeck deck;
  int carrier = 0, first = 0, second = 0;
  static constexpr Real J1 = 0.03, J2 = 0.2, m1 = 2, m2 = 3;

  explicit Wheels(bool held) {
    carrier = held ? deck.ground() : deck.body({.x = {0.3, 0.1, 0}, .m = 4, .J = about(0.5, 0.4)});
    first = deck.body({.m = m1, .J = about(J1, 0.02)});
    second = deck.body({.x = {0.7, 0, 0}, .m = m2, .J = about(J2, 0.15)});
    deck.joint("REVOLUTE", carrier, first, {Vec(0, 0, 0), z});
    deck.joint("REVOLUTE", carrier, second, {Vec(0.7, 0, 0), Vec(0.7, 0, 0) + z});
    deck.motor("ROTATIONAL", carrier, first, {0, 0, 0}, z, 7, 0);
    deck.curve(7, "0.0,0.0\n10.0,100.0\n");
  }
};

}  // namespace

// A flywheel that a motor turns on a free base: both turn as their inertias let them, the moment is that of
// the relative acceleration, and the energy comes from the motor. All kinds of curves.
TEST(Motors, TurnAFlywheelOnAFreeBase) {
  const Real J1 = 0.5, J2 = 0.2, alpha = 12, end = 1;
  std::string way;
  for (int k = 0; k <= 400; ++k)
    way += fmt::format("{:.16g},{:.16g}\n", k * 0.005, 0.5 * alpha * k * k * 2.5e-5);
  for (const auto& [type, points, exact] :
       {std::tuple(0, fmt::format("0.0,0.0\n2.0,{}\n", 2 * alpha), 1e-12),
        std::tuple(1, fmt::format("0.0,{0}\n2.0,{0}\n", alpha), 1e-12), std::tuple(2, way, 1e-4)}) {
    JointDeck deck;
    const int base = deck.body({.m = 5, .J = about(J1, 0.3)}),
              wheel = deck.body({.m = 2, .J = about(J2, 0.1)});
    deck.joint("REVOLUTE", base, wheel, {Vec(0, 0, 0), z});
    deck.motor("ROTATIONAL", base, wheel, {0, 0, 0}, z, 7, type);
    deck.curve(7, points);
    auto s = simulation_of(deck.text(end));
    const auto& bodies = s->bodies()->bodies();
    Real turned = 0, back = 0;
    while (s->clock().t < end) {
      s->step(do_nothing);
      const Real t = s->clock().t, all = 0.5 * alpha * t * t;
      turned = turn_z(bodies[1], turned), back = turn_z(bodies[0], back);
      ASSERT_NEAR(turned, all * J1 / (J1 + J2), exact * (1 + all)) << type << " " << t;
      ASSERT_NEAR(back, -all * J2 / (J1 + J2), exact * (1 + all)) << type << " " << t;
    }
    EXPECT_GT(turned, pi) << "it went round";
    const Real moment = J1 * J2 / (J1 + J2) * alpha;
    if (type != 2) {  // of which the pieces of the curve jerk
      EXPECT_NEAR(force_of(*s, 1).moment[2], moment, 1e-9 * moment) << type;
    }
    EXPECT_LT(energy_error(*s), 1e-6) << type;
    // the last piece of the curve of displacements is slower than its end
    const Real late = type == 2 ? 1 - 0.0025 / end : 1,
               energy = moment * 0.5 * alpha * end * end * late * late;
    EXPECT_NEAR(s->world().energy.external_work, energy, 1.5e-3 * energy) << type;
  }
}

TEST(Motors, AnAcceleratingMotorGoesOnFromTheSpeedItHas) {
  JointDeck deck;
  const int ground = deck.ground(), wheel = deck.body({.J = about(0.2, 0.1), .omega = {0, 0, 3}});
  deck.joint("REVOLUTE", ground, wheel, {Vec(0, 0, 0), z});
  deck.motor("ROTATIONAL", ground, wheel, {0, 0, 0}, z, 7, 1);
  deck.curve(7, "0.0,0.0\n0.5,4.0\n2.0,4.0\n");
  auto s = simulation_of(deck.text(1));
  Real turned = 0;
  while (s->clock().t < 1) {
    s->step(do_nothing);
    const Real t = s->clock().t, late = std::max(t - 0.5, 0.0), early = std::min(t, 0.5);
    const Real from_curve = 4.0 / 3 * early * early * early + late * 1 + 2 * late * late;
    turned = turn_z(s->bodies()->bodies()[1], turned);
    ASSERT_NEAR(turned, 3 * t + from_curve, 1e-12) << t;
  }
}

// Speed at once: the wheel at rest gets it before the first step, and it is reported.
TEST(Motors, ThatRunAtOnceAreTold) {
  JointDeck deck;
  const int base = deck.body({.m = 5, .J = about(0.5, 0.3)}), wheel = deck.body({.J = about(0.2, 0.1)});
  deck.joint("REVOLUTE", base, wheel, {Vec(0, 0, 0), z});
  deck.motor("ROTATIONAL", base, wheel, {0, 0, 0}, z, 7, 0);
  deck.curve(7, "0.0,14.0\n2.0,14.0\n");
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text = deck.text(1)](const std::string&) { return text; };
  auto s = Simulation::build("test.k", options, diagnostics);
  ASSERT_NE(s, nullptr) << diagnostics.text();
  EXPECT_NE(diagnostics.text().find("do not fit the joints and motors"), std::string::npos)
      << diagnostics.text();
  EXPECT_NEAR(s->bodies()->bodies()[1].omega[2], 10, 1e-12);
  EXPECT_NEAR(s->bodies()->bodies()[0].omega[2], -4, 1e-12);
}

// A piston pushed out of a free cylinder, from 0.4 on; its nodes are apart.
TEST(Motors, PushAPiston) {
  const Real m1 = 3, m2 = 1.5, a = 2, end = 1;
  JointDeck deck;
  const int cylinder = deck.body({.m = m1, .J = about(0.5, 0.3)}),
            piston = deck.body({.x = {0.4, 0, 0}, .m = m2, .J = about(0.2, 0.1)});
  deck.joint("TRANSLATIONAL", cylinder, piston, {Vec(0.1, 0, 0), Vec(0.3, 0, 0), Vec(0.1, 0.2, 0)});
  deck.joint_at("TRANSLATIONAL_MOTOR", cylinder, piston, {{0, 0, 0}, {0.4, 0, 0}, {0.1, 0, 0}, {0.6, 0, 0}},
                ",7,0");
  deck.curve(7, fmt::format("0.0,0.0\n2.0,{}\n", 2 * a));
  auto s = simulation_of(deck.text(end));
  const auto& bodies = s->bodies()->bodies();
  while (s->clock().t < end) {
    s->step(do_nothing);
    const Real t = s->clock().t;
    ASSERT_NEAR(bodies[1].x[0] - bodies[0].x[0], 0.4 + 0.5 * a * t * t, 1e-12) << t;
    ASSERT_NEAR(bodies[1].x[0], 0.4 + m1 / (m1 + m2) * 0.5 * a * t * t, 1e-12) << t;
  }
  EXPECT_NEAR(force_of(*s, 1).force[0], m1 * m2 / (m1 + m2) * a, 1e-9);
  EXPECT_LT(energy_error(*s), 1e-6);
}

// The crank turns on the ground by a motor; nothing but joints holds it. Steps of two lengths.
TEST(Motors, DriveASliderCrank) {
  const Real r = 0.2, l = 0.7, rate = 20;
  for (const Real end : {0.6, 0.06}) {
    JointDeck deck;
    const int ground = deck.ground();
    const Matrix J = about(0.01, 0.01);
    const int crank = deck.body({.J = J}), rod = deck.body({.x = {r + 0.5 * l, 0, 0}, .J = J}),
              slider = deck.body({.x = {r + l, 0, 0}, .J = J});
    const auto with_axis = [](const Vec& x) { return std::vector<Vec>{x, x + z}; };
    deck.joint("REVOLUTE", ground, crank, with_axis({0, 0, 0}));
    deck.joint("REVOLUTE", crank, rod, with_axis({r, 0, 0}));
    deck.joint("REVOLUTE", rod, slider, with_axis({r + l, 0, 0}));
    deck.joint("TRANSLATIONAL", ground, slider,
               {Vec(r + l, 0, 0), Vec(r + l + 0.1, 0, 0), Vec(r + l, 0, 0.1)});
    deck.motor("ROTATIONAL", ground, crank, {0, 0, 0}, z, 7, 0);
    deck.curve(7, fmt::format("0.0,0.0\n0.05,{0}\n9.0,{0}\n", rate));
    auto s = simulation_of(deck.text(end));
    Real furthest = 10;
    while (s->clock().t < 0.6) {
      s->step(do_nothing);
      const Real t = s->clock().t, phi = t < 0.05 ? 0.5 * rate / 0.05 * t * t : rate * (t - 0.025);
      const Real x = r * std::cos(phi) + std::sqrt(l * l - r * r * std::sin(phi) * std::sin(phi));
      ASSERT_NEAR(s->bodies()->bodies()[3].x[0], x, 1e-11) << t;
      furthest = std::min(furthest, s->bodies()->bodies()[3].x[0]);
    }
    EXPECT_NEAR(furthest, l - r, 1e-2) << "it went through the dead centre";
    EXPECT_LT(energy_error(*s), 1e-4) << end;
  }
}

// Wheels of R2/R1 = 2.5: against each other, alike where one is a ring, and alike on a belt. The motor feels
// the second wheel's inertia by the ratio squared.
TEST(Gears, KeepTheirRatioAndPassTheMoment) {
  struct Case {
    const char* kind;
    Vec n5, n6;
    Real sense;
  };
  const Real ratio = 2.5, alpha = 10;
  for (const Case& c :
       {Case{"GEARS", {0.2, 0, 0}, {0.2, 0, 0}, -1}, Case{"GEARS", {-0.5, 0, 0}, {-0.5, 0, 0}, 1},
        Case{"PULLEY", {0, 0.2, 0}, {0.7, 0.5, 0}, 1}}) {
    Wheels w(true);
    w.deck.joint_at(c.kind, w.first, w.second, {{0, 0, 0}, {0.7, 0, 0}, z, Vec(0.7, 0, 0) + z, c.n5, c.n6},
                    fmt::format("{}", ratio));
    auto s = simulation_of(w.deck.text(2));
    const auto& bodies = s->bodies()->bodies();
    Real first = 0, second = 0;
    while (s->clock().t < 2) {
      s->step(do_nothing);
      first = turn_z(bodies[1], first), second = turn_z(bodies[2], second);
      ASSERT_NEAR(second, c.sense * first / ratio, 1e-11) << c.kind << " " << s->clock().t;
    }
    EXPECT_NEAR(first, 0.5 * alpha * s->clock().t * s->clock().t, 1e-9);
    EXPECT_NEAR(force_of(*s, 3).moment[2], c.sense * w.J2 * alpha / ratio, 1e-8) << c.kind;
    EXPECT_NEAR(force_of(*s, 2).moment[2], (w.J1 + w.J2 / ratio / ratio) * alpha, 1e-8) << c.kind;
    EXPECT_LT(energy_error(*s), 1e-6) << c.kind;
  }
}

// The carrier is free: momentum is kept, and the ratio is that of turns against the carrier, which turns,
// too.
TEST(Gears, OnAFreeCarrierKeepMomentumAndTheRatioAgainstIt) {
  for (const char* kind : {"GEARS", "PULLEY"}) {
    const Real ratio = 1.75, sense = std::string(kind) == "GEARS" ? -1 : 1;
    Wheels w(false);
    w.deck.joint_at(kind, w.first, w.second,
                    {{0, 0, 0}, {0.7, 0, 0}, z, Vec(0.7, 0, 0) + z, {0.3, 0, 0}, {0.3, 0, 0}},
                    fmt::format("{}", ratio));
    auto s = simulation_of(w.deck.text(3));
    const auto& bodies = s->bodies()->bodies();
    std::array<Real, 3> turned{};
    while (s->clock().t < 3) {
      s->step(do_nothing);
      for (std::size_t k = 0; k < 3; ++k) turned[k] = turn_z(bodies[k], turned[k]);
      ASSERT_NEAR(turned[2] - turned[0], sense * (turned[1] - turned[0]) / ratio, 1e-9) << s->clock().t;
    }
    EXPECT_GT(std::abs(turned[0]), 1) << "the carrier turns";
    const auto [p, L] = momenta(*s);
    EXPECT_LT(p.norm(), 1e-10) << kind;
    EXPECT_LT(L.norm(), 1e-10) << kind;
    EXPECT_LT(energy_error(*s), 1e-6) << kind;
  }
}

// Bevel gears about z and x that touch at (0.3, 0, 0.2), where both move along y.
TEST(Gears, AboutAxesAtRightAngles) {
  JointDeck deck;
  const int ground = deck.ground(), first = deck.body({.J = about(0.03, 0.02)}),
            second = deck.body({.x = {0.3, 0, 0}, .J = Vec(0.2, 0.1, 0.1).asDiagonal()});
  deck.joint("REVOLUTE", ground, first, {Vec(0, 0, 0.2), Vec(0, 0, 0.3)});
  deck.joint("REVOLUTE", ground, second, {Vec(0.3, 0, 0), Vec(0.4, 0, 0)});
  deck.motor("ROTATIONAL", ground, first, {0, 0, 0}, z, 7, 0);
  deck.joint_at("GEARS", first, second,
                {{0, 0, 0.2}, {0.3, 0, 0}, {0, 0, 0.3}, {0.4, 0, 0}, {0.3, 0, 0.2}, {0.3, 0, 0.2}},
                fmt::format("{:.16g},", 0.2 / 0.3));
  deck.curve(7, "0.0,0.0\n10.0,100.0\n");
  auto s = simulation_of(deck.text(1));
  const auto& bodies = s->bodies()->bodies();
  while (s->clock().t < 1) {
    s->step(do_nothing);
    const Vec touch(0.3, 0, 0.2), v1 = bodies[1].omega.cross(touch),
                                  v2 = bodies[2].omega.cross(touch - Vec(0.3, 0, 0));
    ASSERT_NEAR((v1 - v2).norm(), 0, 1e-9 * (1 + v1.norm())) << s->clock().t;
  }
  EXPECT_NEAR(force_of(*s, 3).moment[0], -0.2 * 10 * 1.5, 1e-8);
}

namespace {

constexpr Real pinion_h = 0.15, rack_m = 1.2;

/// A pinion that a motor turns on a frame, and its rack.
JointDeck pinion_on(bool held) {
  const Real h = pinion_h;
  JointDeck deck;
  const int frame = held ? deck.ground() : deck.body({.x = {0.1, 0.2, 0}, .m = 4, .J = about(0.5, 0.4)});
  const int pinion = deck.body({.m = 0.5, .J = about(0.03, 0.02)}),
            rack = deck.body({.x = {0.1, -h, 0}, .m = rack_m, .J = about(0.05, 0.04)});
  deck.joint("REVOLUTE", frame, pinion, {Vec(0, 0, 0), z});
  deck.joint("TRANSLATIONAL", frame, rack, {Vec(0, -h, 0), Vec(0.2, -h, 0), Vec(0, -h, 0.1)});
  deck.motor("ROTATIONAL", frame, pinion, {0, 0, 0}, z, 7, 0);
  deck.joint_at("RACK_AND_PINION", pinion, rack,
                {{0, 0, 0}, {0, -h, 0}, z, Vec(0.1, -h, 0), {0, -h, 0}, Vec(0, -h, 0) + z},
                fmt::format("{}", h));
  deck.curve(7, "0.0,0.0\n10.0,100.0\n");
  return deck;
}

/// The largest error of the rack's way until t = 1.
Real error_of_rack(Simulation& s) {
  const auto& bodies = s.bodies()->bodies();
  Real worst = 0;
  while (s.clock().t < 1) {
    s.step(do_nothing);
    const Real t = s.clock().t;
    const Vec way = bodies[0].q.conjugate() * (bodies[2].x - bodies[0].x) + (bodies[0].x0 - bodies[2].x0);
    worst = std::max(worst, std::abs(way[0] - pinion_h * 5 * t * t));
  }
  return worst;
}

}  // namespace

// A pinion that a motor turns moves a rack; on a free frame the frame the other way, with an error of second
// order.
TEST(Gears, APinionMovesItsRack) {
  auto held = simulation_of(pinion_on(true).text(1));
  EXPECT_LT(error_of_rack(*held), 1e-12);
  EXPECT_NEAR(force_of(*held, 3).force[0], rack_m * pinion_h * 10, 1e-9);
  EXPECT_NEAR(force_of(*held, 2).moment[2], (0.03 + rack_m * pinion_h * pinion_h) * 10, 1e-9);
  EXPECT_LT(energy_error(*held), 1e-6);
  std::vector<Real> errors;
  for (const Real end : {0.25, 1.0}) {
    auto free = simulation_of(pinion_on(false).text(end));
    errors.push_back(error_of_rack(*free));
    const auto [p, L] = momenta(*free);
    EXPECT_LT(p.norm(), 1e-10) << end;
    EXPECT_LT(L.norm(), 1e-10) << end;
    EXPECT_LT(energy_error(*free), 1e-6) << end;
  }
  EXPECT_LT(errors[1], 1e-6 * 0.75);
  EXPECT_NEAR(errors[1] / errors[0], 16, 2);
}

TEST(Gears, GiveTheSameBits) {
  Wheels w(false);
  w.deck.joint_at("GEARS", w.first, w.second,
                  {{0, 0, 0}, {0.7, 0, 0}, z, Vec(0.7, 0, 0) + z, {0.3, 0, 0}, {0.3, 0, 0}}, "1.75");
  const int hub = w.deck.body({.x = {0.7, 0, 0.3}, .J = about(0.1, 0.1), .omega = {0, 0, 2}});
  w.deck.joint("REVOLUTE", w.second, hub, {Vec(0.7, 0, 0.3), Vec(0.7, 0, 0.4)});
  w.deck.motor("ROTATIONAL", w.second, hub, {0.7, 0, 0.3}, z, 8, 1);
  w.deck.curve(8, "0.0,1.0\n0.3,-4.0\n9.0,2.0\n");
  test::expect_same_bits(w.deck.text(2), 900, 400);
}
