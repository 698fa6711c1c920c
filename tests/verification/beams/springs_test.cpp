// Springs, dampers and lumped masses, against closed solutions of oscillators.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "elements/discrete/discrete.hpp"
#include "joint_decks.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::simulation_of;
using test::start_ledger;

namespace {

/// Masses at positions, and springs between them; material and section of part p have the number p.
struct SpringDeck {
  std::string nodes, masses, springs, cards;
  int node = 0, spring = 0;

  int mass(const Vec& x, Real m, const char* code = "0", const Vec& v = Vec::Zero()) {
    nodes += fmt::format("{},{:.16g},{:.16g},{:.16g},{}\n", ++node, x[0], x[1], x[2], code);
    if (m > 0) masses += fmt::format("{:8}{:8}{:16.9e}\n", node, node, m);
    if (v.norm() > 0)
      cards += fmt::format("*INITIAL_VELOCITY_NODE\n{},{:.16g},{:.16g},{:.16g}\n", node, v[0], v[1], v[2]);
    return node;
  }
  void part(int id, const std::string& material, const std::string& section = "") {
    cards += fmt::format("*PART\nsprings\n{0:10}{0:10}{0:10}\n*SECTION_DISCRETE\n{0:10}{1}\n", id, section);
    cards += material;
  }
  void between(int part, int a, int b, int vid = 0, Real s = 0, Real offset = 0) {
    springs +=
        fmt::format("{:8}{:8}{:8}{:8}{:8}{:16.9e}{:8}{:16.9e}\n", ++spring, part, a, b, vid, s, 0, offset);
  }
  std::string text(Real endtim) const {
    return fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n{:.16g}\n", endtim) + cards + "*NODE\n" + nodes +
           (masses.empty() ? "" : "*ELEMENT_MASS\n" + masses) + "*ELEMENT_DISCRETE\n" + springs + "*END\n";
  }
};

Real x_of(const Simulation& s, Index n) {
  return s.world().nodes.x.data(0)[n];
}
std::vector<SpringForce> springs_of(Simulation& s) {
  std::vector<SpringForce> out;
  for (const auto* pass : s.world().passes.all<const SpringReporter>()) pass->report_springs(out);
  return out;
}
/// Times at which `value` passes 0.
template <class Value>
std::vector<Real> crossings(Simulation& s, Real until, const Value& value) {
  std::vector<Real> at;
  Real before = value(), t_before = s.clock().t;
  while (s.clock().t < until) {
    s.step(test::do_nothing);
    const Real now = value(), t = s.clock().t;
    if (before * now < 0) at.push_back(t_before + before / (before - now) * (t - t_before));
    before = now, t_before = t;
  }
  return at;
}
Real frequency(const std::vector<Real>& at) {
  return at.size() < 2 ? 0 : static_cast<Real>(at.size() - 1) / (2 * (at.back() - at.front()));
}

const char* const small_steps = "*CONTROL_TIMESTEP\n       0.0      0.05\n";

}  // namespace

// omega = sqrt(k (1/m1 + 1/m2)); steps of 0.05 * 2/omega change it by (omega dt)^2/24 = 4e-4.
TEST(Springs, FrequenciesOfOneAndOfTwoMasses) {
  for (const bool held : {true, false}) {
    SpringDeck deck;
    deck.cards = small_steps;
    deck.part(1, "*MAT_SPRING_ELASTIC\n         1     400.0\n");
    deck.mass({0, 0, 0}, held ? 0 : 2, held ? "7" : "0", {held ? 0 : -0.5, 0, 0});
    deck.mass({1, 0, 0}, 1, "0", {1, 0, 0});
    deck.between(1, 1, 2);
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    const auto at = crossings(*s, 4, [&] { return x_of(*s, 1) - x_of(*s, 0) - 1; });
    const Real omega = std::sqrt(400 * (1 + (held ? 0 : 0.5)));
    EXPECT_NEAR(frequency(at) / (omega / (2 * pi)), 1, 5e-4) << held;
    EXPECT_LT(test::energy_error_of_a_step(*s), 2.6e-3);  // (omega dt)^2/4, which the leapfrog does not lose
    if (!held) EXPECT_NEAR(2 * x_of(*s, 0) + x_of(*s, 1), 1, 1e-12);  // the centre of mass
  }
}

// x = e^{-z w t} v0/w_d sin(w_d t): the ratio of maxima a period apart is e^{-2 pi z/sqrt(1 - z^2)}.
TEST(Springs, DampedDecay) {
  constexpr Real k = 400, z = 0.05, omega = 20;
  SpringDeck deck;
  deck.cards = "*CONTROL_TIMESTEP\n       0.0     0.005\n";
  deck.part(1, fmt::format("*MAT_SPRING_ELASTIC\n         1{:10.4f}\n", k));
  deck.part(2, fmt::format("*MAT_DAMPER_VISCOUS\n         2{:10.6f}\n", 2 * z * omega));
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1, "0", {1, 0, 0});
  deck.between(1, 1, 2), deck.between(2, 1, 2);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  const Real period = 2 * pi / (omega * std::sqrt(1 - z * z));
  Real first = 0, fifth = 0;
  while (s->clock().t < 5 * period) {
    s->step(test::do_nothing);
    const Real u = x_of(*s, 1) - 1;
    if (s->clock().t < period) first = std::max(first, u);
    if (s->clock().t > 4 * period) fifth = std::max(fifth, u);
  }
  EXPECT_NEAR(std::log(first / fifth) / (4 * 2 * pi * z / std::sqrt(1 - z * z)), 1, 5e-3);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-6);
}

// Bodies of inertia J, held but for turning about z: omega = sqrt(k (1/J1 + 1/J2)).
TEST(Springs, TorsionBetweenRigidBodies) {
  test::JointDeck deck;
  deck.body({.J = 2 * Matrix::Identity(), .omega = {0, 0, 0.1}, .con1 = 7, .con2 = 4});
  deck.body({.x = {0, 0, 1}, .J = 4 * Matrix::Identity(), .omega = {0, 0, -0.05}, .con1 = 7, .con2 = 4});
  deck.more =
      "*CONTROL_TIMESTEP\n       0.0      0.05\n*PART\nspring\n         7         7         7\n"
      "*SECTION_DISCRETE\n         7         1\n*MAT_SPRING_ELASTIC\n         7     300.0\n"
      "*DEFINE_SD_ORIENTATION\n         3         0       0.0       0.0       2.0\n"
      "*ELEMENT_DISCRETE\n       1       7       1       9       3\n";
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  const auto twist = [&] { return springs_of(*s).at(0).stretch; };
  const auto at = crossings(*s, 4, twist);
  EXPECT_NEAR(frequency(at) / (std::sqrt(300 * 0.75) / (2 * pi)), 1, 5e-4);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-4);
  EXPECT_TRUE(springs_of(*s).at(0).turns);
}

// A body on two springs, one of them off its centre: bounce and pitch, omega^2 from det(K - omega^2 M) = 0
// with k = 100 at x = 0 and x = 1, m = 1, J = 0.25: heave z and pitch p (of the spring at arm a: z + a p).
TEST(Springs, PitchOfABody) {
  test::JointDeck deck;
  deck.body({.m = 1, .J = 0.25 * Matrix::Identity(), .v = {0, 0, 0.01}, .con1 = 4, .con2 = 6});
  deck.more =
      "*CONTROL_TIMESTEP\n       0.0      0.02\n*PART\nspring\n         7         7         7\n"
      "*SECTION_DISCRETE\n         7\n*MAT_SPRING_ELASTIC\n         7     100.0\n"
      "*CONSTRAINED_EXTRA_NODES_NODE\n         1       101\n         1       102\n"
      "*NODE\n     101             0.0             0.0             0.0\n     102             1.0             "
      "0.0             0.0\n"
      "     103             0.0             0.0            -1.0       7\n     104             1.0            "
      " 0.0            -1.0       7\n"
      "*ELEMENT_DISCRETE\n       1       7     101     103\n       2       7     102     104\n";
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  // (200 - w2)(100/.25 - w2) - 100 * 100/.25 = 0: w2 = 300 -+ 223.607
  const Real low = std::sqrt(300 - std::sqrt(50000)), high = std::sqrt(300 + std::sqrt(50000));
  const Real ratio_low = (200 - low * low) / 100,
             ratio_high = (200 - high * high) / 100;         // -p/z of the modes
  const Real share = ratio_high / (ratio_high - ratio_low);  // of the low mode in z, p' = 0 at the start
  const auto expected = [&](Real t) {
    return 0.01 * (share * std::sin(low * t) / low + (1 - share) * std::sin(high * t) / high);
  };
  Real worst = 0;
  while (s->clock().t < 2) {
    s->step(test::do_nothing);
    worst = std::max(worst, std::abs(s->bodies()->bodies()[0].x[2] - expected(s->clock().t)));
  }
  EXPECT_LT(worst, 0.01 * 0.01 / low);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// Pulled by 0.3 and back by 0.45 with K = 100, KT = 20, FY = 10 (H = 25): by hand
// yields at 0.1; at 0.3 force 10 + 0.2 * 20 = 14, limit 14; backwards it yields at 0.3 - 0.28 = 0.02, at
// -0.15 force -14 - 0.17 * 20 = -17.4.
TEST(Springs, ElastoplasticPath) {
  SpringDeck deck;
  deck.part(1, "*MAT_SPRING_ELASTOPLASTIC\n         1     100.0      20.0      10.0\n");
  deck.cards +=
      "*DEFINE_CURVE\n         5\n0.0,0.0\n1.0,0.3\n2.0,-0.15\n3.0,-0.15\n"
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n         2         1         2         5\n";
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1, "0");
  deck.between(1, 1, 2);
  auto s = simulation_of(deck.text(3));
  start_ledger(*s);
  Real at_1 = 0, at_2 = 0;
  while (s->clock().t < 2.5) {
    s->step(test::do_nothing);
    const Real f = springs_of(*s).at(0).resultant;
    if (s->clock().t < 1.001) at_1 = f;
    at_2 = f;
  }
  EXPECT_NEAR(at_1, 14, 0.06);  // of the last step before 1
  EXPECT_NEAR(at_2, -17.4, 0.05);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
}

// f = 100 u below 0.1 and 1000 (u - 0.09) above: v0 = 2 takes it to where the work is m v0^2/2 = 2:
// 0.5 + 10 (u - 0.1) + 500 (u - 0.1)^2 = 2. Beyond the last point the last slope goes on.
TEST(Springs, CurvesGoOnBeyondTheirEnds) {
  SpringDeck deck;
  deck.cards = "*CONTROL_TIMESTEP\n       0.0      0.01\n";
  deck.part(1,
            "*MAT_SPRING_NONLINEAR_ELASTIC\n         1         5\n*DEFINE_CURVE\n         "
            "5\n-0.1,-10.0\n0.0,0.0\n0.1,10.0\n0.11,20.0\n");
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1, "0", {2, 0, 0});
  deck.between(1, 1, 2);
  auto s = simulation_of(deck.text(1));
  start_ledger(*s);
  Real most = 0;
  while (s->clock().t < 0.3) {
    s->step(test::do_nothing);
    most = std::max(most, x_of(*s, 1) - 1);
  }
  const Real beyond = (-10 + std::sqrt(100 + 4 * 500 * 1.5)) / 1000;
  EXPECT_NEAR(most, 0.1 + beyond, 2e-4);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// m v' = -c v|v| by points on the parabola: v = v0/(1 + c v0 t/m).
TEST(Springs, NonlinearDamper) {
  SpringDeck deck;
  deck.cards = "*CONTROL_TIMESTEP\n       0.0      0.02\n";
  std::string curve = "*DEFINE_CURVE\n         5\n";
  for (int k = -40; k <= 40; ++k) curve += fmt::format("{:.6g},{:.6g}\n", 0.1 * k, 0.03 * k * std::abs(k));
  deck.part(1, "*MAT_DAMPER_NONLINEAR_VISCOUS\n         1         5\n" + curve);
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1, "0", {3, 0, 0});
  deck.between(1, 1, 2);
  auto s = simulation_of(deck.text(1));
  start_ledger(*s);
  while (s->clock().t < 0.99) s->step(test::do_nothing);
  const Real v = s->world().nodes.v.data(0)[1];
  EXPECT_NEAR(v * (1 + 3 * 3 * (s->clock().t - 0.5 * s->clock().dt_old)) / 3, 1, 0.01);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// KD and V0, S and OFFSET, and a spring to the ground along a vector: f = S K (x + OFFSET)(1 + KD |v|/V0).
TEST(Springs, FieldsOfTheCards) {
  SpringDeck deck;
  deck.part(1, "*MAT_SPRING_ELASTIC\n         1     100.0\n", "         0       0.5       4.0");
  deck.cards += "*DEFINE_SD_ORIENTATION\n         3         0       0.0       3.0       4.0\n";
  deck.mass({0, 0, 0}, 1, "0", {0, -0.6, -0.8});
  deck.springs = "       1       1       1       0       3             2.0       0             0.1\n";
  auto s = simulation_of(deck.text(1));
  s->step(test::do_nothing);
  // the ground is at the end of the vector: the node moves away from it at speed 1
  const SpringForce spring = springs_of(*s).at(0);
  EXPECT_NEAR(spring.stretch, 0.1, 1e-12);
  EXPECT_NEAR(spring.resultant, 2 * 100 * 0.1 * (1 + 0.5 * 1 / 4.0), 1e-9);
  EXPECT_NEAR((spring.force - spring.resultant * Vec(0, 0.6, 0.8)).norm(), 0, 1e-9);
}

// OFFSET 0.3 with K = 100, KT = 20, FY = 10 leaves 10 + 0.2 * 20 = 14, after the work of 0.5 + 0.2 * 12
// = 2.9; of an elastic spring 30 and 4.5. That is energy of the start, what swings afterwards comes from it.
TEST(Springs, OffsetHasItsForceAndEnergyFromTheStart) {
  for (const auto& [material, force, energy, left] :
       {std::tuple("*MAT_SPRING_ELASTOPLASTIC\n         1     100.0      20.0      10.0\n", 14.0, 2.9, 1.92),
        {"*MAT_SPRING_ELASTIC\n         1     100.0\n", 30.0, 4.5, 0.0},
        {"*MAT_SPRING_NONLINEAR_ELASTIC\n         1         5\n*DEFINE_CURVE\n         "
         "5\n-1.0,-100.0\n0.0,0.0\n"
         "0.1,10.0\n1.1,30.0\n",
         14.0, 2.9, 0.0}}) {
    SpringDeck deck;
    deck.cards = small_steps;
    deck.part(1, material);
    deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1);
    deck.between(1, 1, 2, 0, 0, 0.3);
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    EXPECT_NEAR(s->world().energy.internal, energy, 1e-4) << material;
    s->step(test::do_nothing);
    EXPECT_NEAR(springs_of(*s).at(0).resultant, force, 1e-9) << material;
    Real least = energy;
    while (s->clock().t < 1) {
      s->step(test::do_nothing);
      sample_energy(s->world(), s->clock());
      least = std::min(least, s->world().energy.internal);
    }
    // where the force is 0, 14^2/200 less of the plastic one
    EXPECT_NEAR(least, left, 0.02) << material;
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.01) << material;
  }
}

// Drawn out at 2: f(u) of the first curve times g(2) = 3 of the second.
TEST(Springs, CurveOfTheRate) {
  SpringDeck deck;
  deck.cards = small_steps;
  deck.part(
      1,
      "*MAT_SPRING_NONLINEAR_ELASTIC\n         1         5         6\n*DEFINE_CURVE\n5\n-1.0,-50.0\n0.0,0.0\n"
      "1.0,50.0\n*DEFINE_CURVE\n6\n0.0,1.0\n1.0,1.0\n3.0,5.0\n*DEFINE_CURVE\n7\n0.0,2.0\n9.0,2.0\n"
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,7\n");
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1);
  deck.between(1, 1, 2);
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.2) s->step(test::do_nothing);
  const SpringForce spring = springs_of(*s).at(0);
  EXPECT_NEAR(spring.stretch, 0.4, 0.03);
  EXPECT_NEAR(spring.resultant, 50 * spring.stretch * 3, 1e-9);
}

// A mass that circles at the end of a spring: m v^2/r = K (r - 1) at r = 1.1.
TEST(Springs, CircularOrbit) {
  SpringDeck deck;
  deck.cards = small_steps;
  deck.part(1, "*MAT_SPRING_ELASTIC\n         1     100.0\n");
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1.1, 0, 0}, 1, "0", {0, std::sqrt(11.0), 0});
  deck.between(1, 1, 2, 0, 0, 0.1);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  Real far = 0, near = 9;
  while (s->clock().t < 2 * 2 * pi * 1.1 / std::sqrt(11.0)) {
    s->step(test::do_nothing);
    const Real r = s->world().nodes.x.vec(1).norm();
    far = std::max(far, r), near = std::min(near, r);
  }
  EXPECT_NEAR(far, 1.1, 0.004);
  EXPECT_NEAR(near, 1.1, 0.004);
  EXPECT_NEAR(s->world().nodes.x.data(0)[1], 1.1, 0.01);  // after two turns
}

// A mass between two springs that axial force with 100, whatever their length: across, it is held by 2 F/L.
TEST(Springs, PullHoldsAcross) {
  SpringDeck deck;
  deck.cards = "*CONTROL_TIMESTEP\n       0.0       0.9\n";
  deck.part(1,
            "*MAT_SPRING_NONLINEAR_ELASTIC\n         1         5\n*DEFINE_CURVE\n5\n-1.0,99.999\n0.0,100.0\n"
            "1.0,100.001\n");
  deck.mass({0, 0, 0}, 0, "7"), deck.mass({1, 0, 0}, 1, "0", {0, 1e-4, 0}), deck.mass({2, 0, 0}, 0, "7");
  deck.between(1, 1, 2), deck.between(1, 2, 3);
  auto s = simulation_of(deck.text(1e4));
  while (s->clock().t < 40) s->step(test::do_nothing);
  EXPECT_LT(std::abs(s->world().nodes.x.data(1)[1]), 1e-4);
}

// PF 1 keeps a spring out of deforc; each node of a set gets the whole mass.
TEST(Springs, OutputAndMassesOfSets) {
  SpringDeck deck;
  deck.part(1, "*MAT_SPRING_ELASTIC\n         1     100.0\n");
  for (int k = 0; k < 4; ++k) deck.mass({1.0 * k, 0, 0}, 0);
  deck.cards += "*SET_NODE_LIST\n8\n1,2,3,4\n*ELEMENT_MASS_NODE_SET\n1,8,2.5\n";
  deck.springs = "1,1,1,2,0,1.0,1\n2,1,2,3,0,1.0,0\n3,1,3,4\n";
  auto s = simulation_of(deck.text(1));
  for (Index k = 0; k < 4; ++k) EXPECT_NEAR(s->world().nodes.m[k], 2.5, 1e-12);
  s->step(test::do_nothing);
  ASSERT_EQ(springs_of(*s).size(), 2u);
  EXPECT_EQ(springs_of(*s)[0].id, 2);
}

// Chains, nets and stars of springs and dampers of all stiffnesses are stable at TSSFAC 0.9.
TEST(Springs, RandomNetsAreStable) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> number(0, 1);
  for (int net = 0; net < 12; ++net) {
    SpringDeck deck;
    constexpr int n = 12;
    for (int k = 0; k < n; ++k)
      deck.mass({number(random), number(random), number(random)}, std::pow(10, 2 * number(random)), "0",
                1e-6 * Vec(number(random), number(random), number(random)));
    for (int p = 1; p <= 3; ++p)
      deck.part(p, fmt::format("*MAT_SPRING_ELASTIC\n{:10}{:10.4g}\n", p, std::pow(100, p)));
    deck.part(4, "*MAT_DAMPER_VISCOUS\n         4      30.0\n");
    for (int k = 0; k < 40; ++k) {
      const int a = 1 + static_cast<int>(n * number(random)), b = 1 + static_cast<int>(n * number(random));
      if (a != b) deck.between(1 + k % 4, a, b);
    }
    auto s = simulation_of(deck.text(1e6));
    start_ledger(*s);
    for (int k = 0; k < 2000; ++k) s->step(test::do_nothing);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.02) << net;
  }
}

// Stiff springs and dampers between corners of a shell whose own step is at its limit.
TEST(Springs, OnShellsAreStable) {
  for (const char* material :
       {"*MAT_SPRING_ELASTIC\n         2     1.0E8\n", "*MAT_DAMPER_VISCOUS\n         2     3.0E3\n"}) {
    test::ShellDeck deck;
    deck.plate(0.2, 0.2, 4, 4, 1);
    deck.part(1, 0.005, "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.3\n");
    deck.cards += "*PART\nsprings\n         2         2         2\n*SECTION_DISCRETE\n         2\n" +
                  std::string(material);
    deck.velocity([](const Vec& x) { return Vec(1e-4 * x[1], -1e-4 * x[0], 1e-4 * x[0] * x[1]); });
    deck.particles =
        "*ELEMENT_DISCRETE\n       1       2       1      13\n       2       2       7      19\n       3     "
        "  2       2      12\n";
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    for (int k = 0; k < 4000; ++k) s->step(test::do_nothing);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.05);
  }
}

TEST(Springs, SameBits) {
  SpringDeck deck;
  deck.part(1, "*MAT_SPRING_ELASTOPLASTIC\n         1     100.0      20.0       1.0\n");
  deck.part(2, "*MAT_DAMPER_VISCOUS\n         2       0.1\n");
  const int first = deck.mass({0, 0, 0}, 0, "7");
  int last = first;
  for (int k = 1; k < 200; ++k) {
    const int next = deck.mass({1.0 * k, 0.01 * (k % 3), 0}, 1 + k % 5, "0", {0.1 * (k % 7), 0.2, 0});
    deck.between(1, last, next), deck.between(2, last, next);
    last = next;
  }
  test::expect_same_bits(deck.text(10), 60, 23);
}
