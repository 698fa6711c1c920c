// Beams and trusses against closed solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "base/run_error.hpp"
#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using namespace courant::test::beams;
using test::simulation_of;
using test::start_ledger;

namespace {

/// From the times at which a component of a node's place passes that at the start.
Real beam_frequency(Simulation& s, const Field<Real>& field, int component, Index node, int crossings) {
  const Real zero = field.data(component)[node];
  std::vector<Real> at;
  Real before = 0, t_before = 0;
  while (static_cast<int>(at.size()) < crossings && s.clock().t < 10) {
    s.step(test::do_nothing);
    const Real u = field.data(component)[node] - zero, t = s.clock().t;
    if (before * u < 0) at.push_back(t_before + before / (before - u) * (t - t_before));
    before = u, t_before = t;
  }
  return at.size() < 2 ? 0 : static_cast<Real>(at.size() - 1) / (2 * (at.back() - at.front()));
}

/// Of all nodes about the origin.
Vec angular_momentum_of(Simulation& s) {
  Nodes& nodes = s.world().nodes;
  const Field<Real>& inertia = *shared_fields::rotary_inertia.find(nodes.fields);
  const Field<Real>& w = *shared_fields::angular_velocity.find(nodes.fields);
  Vec sum = Vec::Zero();
  for (Index n = 0; n < nodes.size(); ++n)
    sum += nodes.m[n] * nodes.x.vec(n).cross(nodes.v.vec(n)) + inertia[n] * w.vec(n);
  return sum;
}

/// Kept with the results of the tests.
void note(const std::string& what, Real value) {
  testing::Test::RecordProperty(what, fmt::format("{:.5f}", value));
}

/// Shape of the first mode of a cantilever, of x/L.
Real cantilever_shape(Real x) {
  const Real b = 1.8751040687119611, sigma = 0.7340955137589;
  return std::cosh(b * x) - std::cos(b * x) - sigma * (std::sinh(b * x) - std::sin(b * x));
}

}  // namespace

// lambda^2/(2 pi L^2) sqrt(EI/(rho A)): 8.355166 Hz.
TEST(Beams, FrequencyOfACantilever) {
  for (const std::string& section : {square_1, square_2})
    for (const int n : {5, 10, 20})
      for (const int axis : {1, 2}) {
        BeamDeck deck;
        deck.part(1, section, steel_of_beams);
        deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
        deck.velocity([&](int k) -> Vec {
          return k > n + 1 ? Vec(Vec::Zero())
                           : Vec(0.01 * cantilever_shape(Real(k - 1) / n) * Vec::Unit(axis));
        });
        auto s = simulation_of(deck.text(1));
        start_ledger(*s);
        const Real f = beam_frequency(*s, s->world().nodes.x, axis, n, 5);
        note(fmt::format("n{}_elform{}", n, section == square_1 ? 1 : 2), f / 8.355166);
        EXPECT_NEAR(f / 8.355166, 1, n == 5 ? 0.03 : 0.01) << n << " " << axis << section;
        EXPECT_LT(test::energy_error_of_a_step(*s), 0.015);
      }
}

// pi n^2/(2 L^2) sqrt(EI/(rho A)): 23.45331, 93.81322 Hz.
TEST(Beams, FrequenciesOfASimplySupportedBeam) {
  for (const std::string& section : {square_1, square_2})
    for (const int mode : {1, 2})
      for (const int n : {10, 20, 40}) {
        if (mode == 2 && n == 10) continue;
        BeamDeck deck;
        deck.part(1, section, steel_of_beams);
        deck.line(n, 1, [n](int k) { return k == 0 ? ",7,6" : k == n ? ",5,6" : ""; });
        deck.velocity([&](int k) -> Vec {
          return k > n + 1 ? Vec(Vec::Zero()) : Vec(0, 0, 0.01 * std::sin(mode * pi * (k - 1) / n));
        });
        auto s = simulation_of(deck.text(1));
        start_ledger(*s);
        const Real f = beam_frequency(*s, s->world().nodes.x, 2, mode == 1 ? n / 2 : n / 4, 7);
        note(fmt::format("mode{}_n{}_elform{}", mode, n, section == square_1 ? 1 : 2),
             f / (mode == 1 ? 23.45331 : 93.81322));
        EXPECT_NEAR(f / (mode == 1 ? 23.45331 : 93.81322), 1, 0.01) << n << " " << mode << section;
      }
}

// Clamped and free: c/(4 L), c of waves along the bar, and of twist sqrt(G J/(rho Ip)).
TEST(Beams, WavesAlongBarsAndTwist) {
  const Real c = std::sqrt(2.1e11 / 7850), ct = std::sqrt(2.1e11 / 2.6 / 7850);
  constexpr int n = 20;
  for (const char* truss : {"         3\n    1.0E-4\n", "         2\n    1.0E-48.3333E-10\n"}) {
    BeamDeck deck;
    deck.part(1, truss, steel_of_beams);
    deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ",5,7"; });
    deck.velocity([](int k) -> Vec {
      return k > n + 1 ? Vec(Vec::Zero()) : Vec(std::sin(0.5 * pi * (k - 1) / n), 0, 0);
    });
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    const Real f = beam_frequency(*s, s->world().nodes.x, 0, n, 9) / (c / 4);
    note(truss[9] == '3' ? "along_truss" : "along_beam", f);
    EXPECT_NEAR(f, 1, 2e-3) << truss;
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
  }
  for (const std::string& section :
       {std::string("         1       1.0         2         1\n      0.02      0.02      0.01      0.01\n"),
        std::string("         2\n    2.3E-4 8.3333E-9\n")}) {
    BeamDeck deck;
    deck.part(1, section, steel_of_beams);
    deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ",7,5"; });
    auto s = simulation_of(deck.text(1));
    Field<Real>& w = *shared_fields::angular_velocity.find(s->world().nodes.fields);
    Field<Real>& angle = *shared_fields::rotation.find(s->world().nodes.fields);
    for (Index k = 0; k <= n; ++k) w.data(0)[k] = 0.01 * std::sin(0.5 * pi * k / n);
    // Of the inertia of ends, which is for bending, too, that about the axis is a part, by hand: of the tube
    // 0.5 r^2/(0.125 h^2 0.625), r^2 = 6.25e-5, h = 1/20, of the other (1 - 12 I/(A h^2))/1.5.
    const Real part = section[9] == '1' ? 0.16 : 0.55072;
    const Real f = beam_frequency(*s, angle, 0, n, 5);
    EXPECT_NEAR(f / (ct / 4) / std::sqrt(part), 1, 3e-3) << section;
  }
}

namespace {

/// A cantilever of EI = 175, L = 1 under a load at its end that grows over 0.5 s, damped; where the end is
/// after 1 s.
Vec bent_end(const std::string& section, int n, int dof, Real load, bool half_turn = false) {
  BeamDeck deck;
  deck.part(1, section, steel_of_beams);
  deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += fmt::format(
      "*LOAD_NODE_POINT\n{:10}{:10}         1{:10.4f}\n*DEFINE_CURVE\n         1\n0.0,0.0\n0.5,1.0\n9.0,1.0\n"
      "*DAMPING_GLOBAL\n         0      60.0\n*CONTROL_TIMESTEP\n       0.0       0.9\n",
      n + 1, dof, load);
  auto s = simulation_of(deck.text(2));
  while (s->clock().t < (half_turn ? 1.5 : 1.0)) s->step(test::do_nothing);
  return s->world().nodes.x.vec(n);
}

}  // namespace

// P L^3/(3 EI), small. One point along each of n beams leaves 1/(4 n^2) of it out.
TEST(Beams, DeflectionOfACantilever) {
  for (const std::string& section : {square_1, square_2})
    for (const int n : {5, 10})
      for (const int dof : {2, 3}) {
        const Real deflection = bent_end(section, n, dof, 5)[dof - 1];
        const Real lacks = section == square_1 ? 0.25 / (n * n) : 0;
        note(fmt::format("n{}_elform{}", n, section == square_1 ? 1 : 2), deflection / (5 / (3 * 175.0)));
        EXPECT_NEAR(deflection / (5 / (3 * 175.0)), 1 - lacks, 1e-3) << n << section;
      }
}

// Elastica: P L^2/EI = 10 bends the end to 0.8106 L across, and 0.5550 L back (elliptic integrals); a moment
// pi/2 EI/L to a quarter of a circle, 2/pi L, 2/pi L.
TEST(Beams, LargeRotations) {
  for (const std::string& section : {square_1, square_2}) {
    const Vec force = bent_end(section, 10, 2, 10 * 175.0);
    note(section == square_1 ? "force_elform1" : "force_elform2", force[1]);
    note(section == square_1 ? "back_elform1" : "back_elform2", 1 - force[0]);
    EXPECT_NEAR(force[1], 0.8106, 0.006) << section;
    EXPECT_NEAR(1 - force[0], 0.5550, 0.006) << section;
    for (const int dof : {6, 7}) {
      const Vec moment = bent_end(section, 10, dof, pi / 2 * 175.0);
      note(section == square_1 ? "moment_elform1" : "moment_elform2", moment[0] * pi / 2);
      EXPECT_NEAR(moment[0], 2 / pi, 0.006) << section;
      EXPECT_NEAR(moment[dof == 7 ? 1 : 2], dof == 7 ? 2 / pi : -2 / pi, 0.006) << section;
    }
  }
}

// A free beam that spins keeps its length and its energy, over some turns.
TEST(Beams, FreeSpinStaysRigid) {
  for (const std::string& section : {square_1, square_2}) {
    BeamDeck deck;
    deck.part(1, section, steel_of_beams);
    deck.line(4, 1, [](int) { return ""; });
    const Vec omega(0, 40, 30);
    deck.velocity(
        [&](int k) -> Vec { return k > 5 ? Vec(Vec::Zero()) : Vec(omega.cross(Vec((k - 3) / 4.0, 0, 0))); });
    auto s = simulation_of(deck.text(1));
    Field<Real>& w = *shared_fields::angular_velocity.find(s->world().nodes.fields);
    for (Index k = 0; k < 5; ++k) w.set(k, omega);
    start_ledger(*s);
    while (s->clock().t < 0.5) s->step(test::do_nothing);
    const Nodes& nodes = s->world().nodes;
    // stretched by its own axial force, rho omega^2 L^2/(12 E) of its length
    EXPECT_NEAR((nodes.x.vec(4) - nodes.x.vec(0)).norm(), 1, 1e-4);
    EXPECT_NEAR((nodes.x.vec(2) - 0.5 * (nodes.x.vec(0) + nodes.x.vec(4))).norm(), 0, 1e-3);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
    EXPECT_LT(s->world().energy.internal, 1e-3 * s->world().energy.initial);
  }
}

// One beam, whose end turns at 1 rad/s: torsion is G J theta/L, bending 4 E I theta/L (at one point along the
// beam E I/L, and G A L/4 of shear), up to where the two ends' axes no longer tell which way: there the run
// stops.
TEST(Beams, TurnsOfMoreThanTheyCanTellStopTheRun) {
  for (const std::string& section : {square_1, square_2})
    for (const int dof : {5, 7}) {
      BeamDeck deck;
      deck.part(1, section, "*MAT_ELASTIC\n         1    7850.0   2.6E+06       0.3\n");
      const int a = deck.at({0, 0, 0}, ",7,7"), b = deck.at({1, 0, 0}, dof == 5 ? ",7,5" : ",7,4"),
                third = deck.at({0, 1, 0}, ",7,7");
      deck.beam(1, a, b, third);
      deck.cards += fmt::format(
          "*CONTROL_TIMESTEP\n0.0,0.01\n*DEFINE_CURVE\n5\n0.0,1.0\n9.0,1.0\n"
          "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,{},0,5\n",
          dof);
      auto s = simulation_of(deck.text(9));
      const auto moment = [&] { return s->world().groups[0]->corner_moment->data(dof == 5 ? 0 : 2)[0]; };
      while (s->clock().t < 1.4) s->step(test::do_nothing);
      const Real angle = s->clock().t - s->clock().dt_old;
      const Real EI = 2.6e6 * 8.3333e-10, GJ = 1e6 * 1.6667e-9, GA = 1e6 * 1e-4;
      const Real stiffness = dof == 5 ? GJ : section == square_2 ? -2 * EI : EI - GA / 4;
      EXPECT_NEAR(moment() / (stiffness * angle), 1, 0.002) << dof << section;
      Real last = 0;
      EXPECT_THROW(
          while (s->clock().t < 8) {
            s->step(test::do_nothing);
            last = s->clock().t;
          },
          RunError)
          << dof << section;
      EXPECT_NEAR(last, dof == 5 ? 3 : 1.5, 0.01) << dof << section;
    }
}

// By hand: sigma = SIGY + ETAN (ln(1 + u/L) - SIGY/E), of the true stress on the area that the card gives.
TEST(Beams, PlasticTruss) {
  for (const char* section :
       {"         3\n    1.0E-4\n",
        "         1       1.0         2         0\n      0.01      0.01      0.01      0.01\n"}) {
    BeamDeck deck;
    deck.part(
        1, section,
        "*MAT_PLASTIC_KINEMATIC\n         1    7850.0   2.0E+11       0.3   2.0E+08   1.0E+10       1.0\n");
    const int a = deck.at({0, 0, 0}, ",7,7"), b = deck.at({1, 0, 0}, ",5,7"), third = deck.at({0, 1, 0});
    deck.beam(1, a, b, third);
    deck.cards +=
        "*DEFINE_CURVE\n         5\n0.0,0.0\n0.1,0.05\n1.0,0.05\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n         "
        "2         1         2         5\n";
    auto s = simulation_of(deck.text(0.11));
    while (s->clock().t < 0.105) s->step(test::do_nothing);
    const Real strain = std::log(1.05);
    EXPECT_NEAR(s->world().groups[0]->corner_force->data(0)[0] / (1e-4 * (2e8 + 1e10 * (strain - 1e-3))), 1,
                1e-3)
        << section;
  }
}

// Layers of points carry sigma_y A h/2 times the sum of their weights and positions, by hand: of Gauss 2, 3,
// 4 and of Lobatto 3.
TEST(Beams, PlasticBending) {
  for (const auto& [rule, share] : {std::pair(2, 0.57735), {3, 0.43033}, {5, 0.52127}, {4, 1.0 / 3}}) {
    BeamDeck deck;
    deck.part(
        1,
        fmt::format("         1       1.0{:10}         0\n      0.01      0.01      0.01      0.01\n", rule),
        "*MAT_PLASTIC_KINEMATIC\n         1    7850.0   2.0E+11       0.3   2.0E+08       0.0       1.0\n");
    const int a = deck.at({0, 0, 0}, ",7,7"), b = deck.at({0.1, 0, 0}, ",3,4"), third = deck.at({0, 1, 0});
    deck.beam(1, a, b, third);
    deck.cards +=
        "*DAMPING_GLOBAL\n0,2000.0\n*DEFINE_CURVE\n5\n0.0,0.0\n0.1,0.1\n1.0,0.1\n*BOUNDARY_PRESCRIBED_MOTION_"
        "NODE\n2,7,2,5\n";
    auto s = simulation_of(deck.text(0.12));
    while (s->clock().t < 0.1) s->step(test::do_nothing);
    const ElementGroup& group = *s->world().groups[0];
    EXPECT_NEAR(std::abs(group.corner_moment->data(5)[0]) / (2e8 * 1e-4 * 0.005 * share), 1, 0.02) << rule;
  }
}

// Frames of short, long, thick and thin beams with all formulations, thrown at random, are stable at 0.9.
TEST(Beams, RandomFramesAreStable) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(0, 1);
  for (int frame = 0; frame < 12; ++frame) {
    BeamDeck deck;
    constexpr int n = 14;
    std::vector<Vec> x;
    for (int k = 0; k < n; ++k)
      x.emplace_back(number(random), number(random), number(random)), deck.at(x.back());
    const Real thick = std::pow(10, -0.3 - 2 * number(random)), wide = 2 * thick, A = thick * wide;
    deck.part(1,
              fmt::format("         1       1.0         2         0\n{0:10.5f}{0:10.5f}{1:10.5f}{1:10.5f}\n",
                          thick, wide),
              steel_of_beams);
    deck.part(2,
              fmt::format("         2\n{:10.3e}{:10.3e}{:10.3e}{:10.3e}\n", A, A * thick * thick / 12,
                          A * wide * wide / 12, A * thick * thick / 6),
              "");
    deck.part(3, fmt::format("         3\n{:10.3e}\n", A), "");
    for (int k = 0; k < 30; ++k) {
      const int a = static_cast<int>(n * number(random)), b = static_cast<int>(n * number(random));
      int c = 0;
      while (c == a || c == b) ++c;
      if (a != b) deck.beam(1 + k % 3, a + 1, b + 1, c + 1);
    }
    deck.velocity([&](int) -> Vec { return 1e-4 * Vec(number(random), number(random), number(random)); });
    for (int k = 1; k < n; ++k) deck.beam(1, k, k + 1, (k + 1) % n + 1);
    deck.cards += "*CONTROL_TIMESTEP\n       0.0       0.9\n";
    auto s = simulation_of(deck.text(1e6));
    start_ledger(*s);
    for (int k = 0; k < 3000; ++k) s->step(test::do_nothing);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.1) << frame;
  }
}

// Free wires and rods in elements of 20 mm, whose nodes fly off at random, bend and twist by up to a radian.
// Bounds are twice what is measured; with moments that are those of small turns, or steps that follow the
// elements as they stretch, each of these runs makes more than ten times its energy.
TEST(Beams, BentFarKeepTheirEnergy) {
  for (const int form : {1, 2})
    for (const Real d : {5e-4, 2e-3})
      for (const auto& [speed, bound] : {std::pair(10.0, 0.02), {50.0, 0.08}}) {
        BeamDeck deck;
        const Real A = pi * d * d / 4, I = A * d * d / 16;
        deck.part(1,
                  form == 1 ? fmt::format("         1       1.0         2         1\n{0:10.6f}{0:10.6f}\n", d)
                            : fmt::format("         2\n{:10.3e}{:10.3e}{:10.3e}{:10.3e}\n", A, I, I, 2 * I),
                  steel_of_beams);
        deck.line(16, 0.32, [](int) { return ""; });
        std::mt19937 random(3);
        std::uniform_real_distribution<Real> number(-1, 1);
        deck.velocity([&, speed = speed](int) -> Vec {
          return speed * Vec(number(random), number(random), number(random));
        });
        deck.cards += "*CONTROL_TIMESTEP\n       0.0       0.9\n";
        auto s = simulation_of(deck.text(1e6));
        start_ledger(*s);
        s->step(test::do_nothing);
        const Vec turning = angular_momentum_of(*s);
        Real worst = 0;
        for (int k = 0; k < 6000; ++k) {
          s->step(test::do_nothing);
          if (k % 100 == 0) worst = std::max(worst, test::energy_error_of_a_step(*s));
        }
        note(fmt::format("energy_of_form_{}_d_{}_um_at_{}", form, std::lround(1e6 * d), speed), worst);
        EXPECT_LT(worst, bound) << form << " " << d << " " << speed;
        EXPECT_LT((angular_momentum_of(*s) - turning).norm(), 1e-11 * turning.norm()) << form << " " << d;
      }
}

// A shell with a beam along its edge and a spring: all of it on shared nodes.
TEST(Beams, SameBits) {
  test::ShellDeck deck;
  deck.plate(0.4, 0.1, 40, 10, 1);
  deck.part(
      1, 0.005,
      "*MAT_PLASTIC_KINEMATIC\n         1    7850.0   2.0E+11       0.3   2.0E+06   1.0E+09       0.0\n");
  deck.cards += "*PART\nbeams\n         2         2         1\n*SECTION_BEAM\n         2" + square_1 +
                "*PART\nbeams\n         3         3         4\n*SECTION_BEAM\n         3" + square_2 +
                "*MAT_ELASTIC\n         4    7850.0   2.1E+11       0.3\n";
  deck.velocity([](const Vec& x) { return Vec(-x[0], x[1], 5 * x[0] * x[0]); });
  deck.particles = "*ELEMENT_BEAM\n";
  for (int k = 1; k <= 40; ++k)
    deck.particles += fmt::format("{:8}{:8}{:8}{:8}{:8}\n", k, 2 + k % 2, k, k + 1, k + 60);
  test::expect_same_bits(deck.text(1), 60, 23);
}
