// *ELEMENT_INERTIA: tops, shafts and bodies, against Euler's equations and the parallel axis theorem.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

/// A card of a tensor; `offset` makes it three lines.
std::string inertia_card(int id, int node, const Matrix& J, Real mass, const Vec* offset = nullptr) {
  std::string out = fmt::format("{:8}{:8}\n{:10.4g}{:10.4g}{:10.4g}{:10.4g}{:10.4g}{:10.4g}{:10.4g}\n", id,
                                node, J(0, 0), J(0, 1), J(0, 2), J(1, 1), J(1, 2), J(2, 2), mass);
  if (offset) out += fmt::format("{:10.4g}{:10.4g}{:10.4g}\n", (*offset)[0], (*offset)[1], (*offset)[2]);
  return out;
}
Matrix tensor(Real xx, Real yy, Real zz, Real xy = 0, Real xz = 0, Real yz = 0) {
  Matrix J;
  J << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return J;
}

/// One node that turns with omega at the start.
std::string top_deck(Real endtim, const Matrix& J, const Vec& omega, const std::string& more = "") {
  return fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n{}\n*NODE\n1,0.0,0.0,0.0\n*SET_NODE_LIST\n1\n1\n",
                     endtim) +
         "*ELEMENT_INERTIA\n" + inertia_card(1, 1, J, 5) +
         (omega.norm() > 0
              ? fmt::format(
                    "*INITIAL_VELOCITY_GENERATION\n1,3,{:.16g}\n0.0,0.0,0.0,{:.16g},{:.16g},{:.16g}\n",
                    omega.norm(), omega[0], omega[1], omega[2])
              : "") +
         more + "*END\n";
}
Vec turning(const Simulation& s, Index n = 0) {
  return shared_fields::angular_velocity.find(s.world().nodes.fields)->vec(n);
}

/// Omega in space of a top that nothing holds, by Euler's equations in its principal axes and Runge-Kutta.
Vec euler(const Vec& J, const Vec& omega, Real until) {
  constexpr int steps = 20000;
  struct State {
    Vec w;
    Eigen::Quaterniond q;
  };
  const auto slope = [&](const State& s) {
    const Vec L = J.cwiseProduct(s.w);
    const Vec dw = (-s.w.cross(L)).cwiseQuotient(J);
    const Eigen::Quaterniond spin(0, s.w[0], s.w[1], s.w[2]);
    Eigen::Quaterniond dq = s.q * spin;
    dq.coeffs() *= 0.5;
    return State{dw, dq};
  };
  const auto add = [](const State& a, const State& b, Real h) {
    State out{a.w + h * b.w, a.q};
    out.q.coeffs() += h * b.q.coeffs();
    return out;
  };
  State s{omega, Eigen::Quaterniond::Identity()};
  const Real h = until / steps;
  for (int k = 0; k < steps; ++k) {
    const State a = slope(s), b = slope(add(s, a, h / 2)), c = slope(add(s, b, h / 2)),
                d = slope(add(s, c, h));
    s.w += h / 6 * (a.w + 2 * b.w + 2 * c.w + d.w);
    s.q.coeffs() += h / 6 * (a.q.coeffs() + 2 * b.q.coeffs() + 2 * c.q.coeffs() + d.q.coeffs());
    s.q.normalize();
  }
  return s.q * s.w;
}

}  // namespace

// A top that turns about its middle axis turns over; steps of ENDTIM/1000. Second order.
TEST(NodeInertias, ATopTurnsOverAsEulerSays) {
  const Vec J(1, 2, 3), start(0.05, 3, 0.02);
  std::array<Real, 3> error{};
  for (int level = 0; level < 3; ++level) {
    auto s = simulation_of(top_deck(20 / std::pow(2, level), tensor(1, 2, 3), start));
    ASSERT_NE(s, nullptr);
    while (s->clock().t < 4.99) s->step(do_nothing);
    const Real between = s->clock().t - 0.5 * s->clock().dt_old;  // velocities are those of half steps
    error[static_cast<std::size_t>(level)] = (turning(*s) - euler(J, start, between)).norm();
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      const Real energy = 0.5 * start.dot(J.cwiseProduct(start));  // of t^n, and of the half step before
      EXPECT_NEAR((world.energy.kinetic + world.energy.half_step) / energy, 1, 1e-4 / std::pow(4, level));
      EXPECT_NEAR(world.energy.kinetic / energy, 1, 1e-4 / std::pow(4, level));
    });
  }
  EXPECT_LT(error[2], 2e-3);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.1);
}

// With CSID the same top is in the axes of a system.
TEST(NodeInertias, CsidGivesThePrincipalAxes) {
  const Vec start(0.4, 1, 2);
  const auto end = [&](const std::string& text) {
    auto s = simulation_of(text);
    while (s->clock().t < 3) s->step(do_nothing);
    return turning(*s);
  };
  const Real c = 0.6, d = 0.8;  // x' = (c, d, 0), y' = (-d, c, 0): moments 1 and 2
  const Matrix J = tensor(c * c + 2 * d * d, d * d + 2 * c * c, 4, c * d - 2 * c * d);
  std::string text = top_deck(10, J, start);
  const Vec by_tensor = end(text);
  const std::string plain = inertia_card(1, 1, J, 5);
  std::string in_axes = inertia_card(1, 1, tensor(1, 2, 4), 5);
  in_axes.insert(16, "       9");
  text.replace(text.find(plain), plain.size(), in_axes);
  text.insert(text.find("*ELEMENT_INERTIA"),
              "*DEFINE_COORDINATE_SYSTEM\n9,0.0,0.0,0.0,0.6,0.8,0.0\n-0.8,0.6,0.0\n");
  EXPECT_LT((end(text) - by_tensor).norm(), 1e-12 * by_tensor.norm());
}

// A shaft of ELFORM 2, clamped, with a disc at its end: 2 pi sqrt(Ixx L/(G J)), and in bending the rotation
// of the end, with its translation held, 2 pi sqrt(I L/(4 E I)).
TEST(NodeInertias, DiscsOnShaftsSwing) {
  const Real GJ = 2.1e11 / 2.6 * 1.6667e-9, EI = 2.1e11 * 8.3333e-10, L = 1;
  const Vec J(0.5, 0.2, 0.1);
  for (int axis = 0; axis < 3; ++axis) {
    test::beams::BeamDeck deck;
    deck.part(1, test::beams::square_2, test::beams::steel_of_beams);
    constexpr int n = 10;
    deck.line(n, L, [](int k) { return k == 0 ? ",7,7" : k == n ? ",7" : ""; });
    deck.cards +=
        "*ELEMENT_INERTIA\n" + inertia_card(1, n + 1, tensor(J[0], J[1], J[2]), 0) +
        fmt::format("*LOAD_NODE_POINT\n{},{},1,1.0\n*DEFINE_CURVE\n1\n0.0,1.0\n100.0,1.0\n", n + 1, axis + 5);
    auto s = simulation_of(deck.text(1));
    ASSERT_NE(s, nullptr);
    // half a period after the moment began, the end has turned by twice what it would rest at
    const Real k = axis == 0 ? GJ / L : 4 * EI / L, period = 2 * pi * std::sqrt(J[axis] / k);
    const Field<Real>& angle = *shared_fields::rotation.find(s->world().nodes.fields);
    while (s->clock().t < 0.5 * period) s->step(do_nothing);
    EXPECT_NEAR(angle.vec(n)[axis] / (2 / k), 1, 0.01) << axis;
    while (s->clock().t < period) s->step(do_nothing);
    EXPECT_NEAR(angle.vec(n)[axis] / (2 / k), 0, 0.02) << axis;
  }
}

// About x alone, under a moment: alpha = M/Ixx, and what holds y and z feels d(R J omega)/dt.
TEST(NodeInertias, SupportsFeelWhatTurnsBesideTheAxis) {
  const Real M = 2, Ixx = 2, Ixy = 0.3, alpha = M / Ixx;
  auto s = simulation_of(top_deck(2, tensor(Ixx, 1.5, 1, Ixy), Vec::Zero(),
                                  "*BOUNDARY_SPC_NODE\n1,0,1,1,1,0,1,1\n*LOAD_NODE_POINT\n1,5,1,2.0\n"
                                  "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n*DATABASE_SPCFORC\n1.0\n"));
  ASSERT_NE(s, nullptr);
  Vec seen = Vec::Zero();
  Real t = 0;
  while (s->clock().t < 1.5)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      std::vector<BoundaryForce> all;
      for (const auto* pass : world.passes.all<const BoundaryForceReporter>())
        pass->report_forces(world, clock, all);
      for (const BoundaryForce& one : all)
        if (one.kind == BoundaryForce::Kind::held_rotation) seen = one.moment;
      t = clock.t;
    });
  EXPECT_NEAR(turning(*s)[0], alpha * (s->clock().t - 0.5 * s->clock().dt_old), 1e-9);
  const Real omega = alpha * t, angle = 0.5 * alpha * t * t;
  EXPECT_NEAR(seen[1], Ixy * (alpha * std::cos(angle) - omega * omega * std::sin(angle)), 1e-3);
  EXPECT_NEAR(seen[2], Ixy * (alpha * std::sin(angle) + omega * omega * std::cos(angle)), 1e-3);
}

// A brick of 48 kg that turns, with inertias on two corners, one of them beside its node.
TEST(NodeInertias, JoinRigidBodies) {
  const Vec edges(0.2, 0.4, 0.6), c = 0.5 * edges, omega(1, -2, 0.5), v(0.1, 0.2, 0.3),
                                  offset(0.3, -0.1, 0.2);
  const Real m = 48;
  SolidDeck deck;
  deck.block(edges, 2, 2, 2, 1);
  const Matrix J1 = tensor(2, 3, 4, 0.5), J2 = tensor(1, 1, 1, 0, 0.2, 0.1);
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nrigid\n1,1,1\n*MAT_RIGID\n1,1000.0,1.0E9,0.3\n*ELEMENT_INERTIA\n" +
      inertia_card(1, 1, J1, 7) + "*ELEMENT_INERTIA_OFFSET\n" + inertia_card(2, 27, J2, 5, &offset);
  deck.cards += "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < deck.nodes.size(); ++n) {
    const Vec at = v + omega.cross(deck.nodes[n] - c);
    deck.cards += fmt::format("{},{:.16g},{:.16g},{:.16g}\n", n + 1, at[0], at[1], at[2]);
  }
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  ASSERT_EQ(s->bodies()->bodies().size(), 1u);
  const RigidBody& b = s->bodies()->bodies().front();
  const Vec e2 = edges.cwiseProduct(edges), x1 = Vec::Zero(), x2 = edges + offset;
  const Matrix brick = (m / 12 * (e2.sum() * Vec::Ones() - e2)).asDiagonal();
  const Vec centre = (m * c + 7 * x1 + 5 * x2) / (m + 12);
  const auto far = [&](Real mass, const Vec& x) {
    const Vec r = x - centre;
    return Matrix(mass * (r.squaredNorm() * Matrix::Identity() - r * r.transpose()));
  };
  const Matrix J = brick + J1 + J2 + far(m, c) + far(7, x1) + far(5, x2);
  EXPECT_NEAR(b.m, m + 12, 1e-10);
  EXPECT_NEAR((b.x - centre).norm(), 0, 1e-8);
  EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-7 * J.norm());
  EXPECT_NEAR((b.omega - omega).norm(), 0, 1e-7);
  EXPECT_NEAR((b.v - (v + omega.cross(centre - c))).norm(), 0, 1e-7);
  EXPECT_NEAR((b.L - J * omega).norm(), 0, 1e-7 * b.L.norm());
}

// A body of two free nodes is nothing but its inertias.
TEST(NodeInertias, AreTheMassOfBodiesOfNodes) {
  const auto s = simulation_of(
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*NODE\n1,0.0,0.0,0.0\n2,0.0,0.0,2.0\n*SET_NODE_LIST\n1\n1,2\n"
      "*CONSTRAINED_NODAL_RIGID_BODY\n1,0,1\n*ELEMENT_INERTIA\n" +
      inertia_card(1, 1, tensor(1, 2, 3), 1) + inertia_card(2, 2, tensor(1, 1, 1), 3) + "*END\n");
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_NEAR(b.m, 4, 1e-14);
  EXPECT_NEAR(b.x[2], 1.5, 1e-14);
  EXPECT_NEAR((b.J0 - tensor(2 + 3, 3 + 3, 4)).norm(), 0, 1e-12);  // reduced mass 3/4 at 2
}

// The same about all axes goes with damping and prescribed rotations; as a mass alone it turns nothing.
TEST(NodeInertias, TheSameAboutAllAxesIsARotaryInertia) {
  auto s = simulation_of(
      top_deck(1, tensor(2, 2, 2), Vec::Zero(),
               "*LOAD_NODE_POINT\n1,6,1,3.0\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n*DAMPING_GLOBAL\n0,0.5\n"));
  ASSERT_NE(s, nullptr);
  while (s->clock().t < 0.8) s->step(do_nothing);
  const Real t = s->clock().t - 0.5 * s->clock().dt_old;
  EXPECT_NEAR(turning(*s)[1], 3 / (2 * 0.5) * (1 - std::exp(-0.5 * t)), 1e-5);
  EXPECT_EQ(s->world().nodes.m[0], 5);
}

TEST(NodeInertias, AreRefusedByName) {
  const auto faults = [](const std::string& text) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.open = [text](const std::string&) { return text; };
    Simulation::build("test.k", options, diagnostics);
    return diagnostics.text();
  };
  const auto expect = [&](const std::string& text, const char* message) {
    EXPECT_NE(faults(text).find(message), std::string::npos) << message << "\n" << faults(text);
  };
  expect(top_deck(1, tensor(1, 1, 1, 2), Vec::Zero()), "the tensor has a principal moment below 0");
  expect(top_deck(1, tensor(0, 1, 1), Vec::Zero()), "has no inertia about an axis about which it may turn");
  expect(top_deck(1, tensor(1, 2, 3), Vec::Zero(), "*DAMPING_GLOBAL\n0,0.5\n"), "in a deck with damping");
  expect(top_deck(1, tensor(1, 2, 3), Vec::Zero(),
                  "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n1,5,0,1\n"),
         "whose rotation is prescribed");
  const Vec offset(1, 0, 0);
  expect("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*NODE\n1,0.0,0.0,0.0\n*ELEMENT_INERTIA_OFFSET\n" +
             inertia_card(1, 1, tensor(1, 1, 1), 1, &offset) + "*END\n",
         "an offset is not supported on node 1");
  expect(
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*NODE\n1,0.0,0.0,0.0\n2,1.0,0.0,0.0\n*SET_NODE_LIST\n1\n1,2\n"
      "*CONSTRAINED_NODAL_RIGID_BODY_INERTIA\n1,0,1\n0.0,0.0,0.0,2.0\n1.0,0.0,0.0,1.0,0.0,1.0\n\n"
      "*ELEMENT_INERTIA\n" +
          inertia_card(1, 1, tensor(1, 1, 1), 1) + "*END\n",
      "whose inertia is given by a card");
}

// A heavy top on a bending shaft.
TEST(NodeInertias, HaveTheSameBitsOnAnyNumberOfThreadsAndOverARestart) {
  test::beams::BeamDeck deck;
  deck.part(1, test::beams::square_1, test::beams::steel_of_beams);
  deck.line(4, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += "*ELEMENT_INERTIA\n" + inertia_card(1, 5, tensor(0.5, 0.2, 0.1, 0.05), 3) +
                "*SET_NODE_LIST\n1\n5\n*INITIAL_VELOCITY_GENERATION\n1,3,20.0\n1.0,0.0,0.0,1.0,0.5,0.2\n";
  test::expect_same_bits(deck.text(1), 60, 23);
}
