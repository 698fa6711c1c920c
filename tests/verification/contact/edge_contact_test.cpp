// Contact of edges with edges, against theory.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "parallel/parallel.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::simulation_of;
using test::start_ledger;
using test::beams::BeamDeck;
using test::beams::square_1;
using test::beams::steel_of_beams;

namespace {

const Real rod_r = std::sqrt(1e-4 / pi);  // of square_1

std::string general_contact(Real mu = 0, Real vdc = 0, const std::string& more = "") {
  return fmt::format("*CONTACT_AUTOMATIC_GENERAL\n         0\n{:10.4g}{:10.4g}{:>20}{:10.4g}\n       1.0\n",
                     mu, mu, "", vdc) +
         more;
}

/// n beams from a to b, the first node of the line returned.
int add_rod(BeamDeck& deck, const Vec& a, const Vec& b, int n) {
  const int first = deck.node + 1;
  for (int k = 0; k <= n; ++k) deck.at(a + (b - a) * k / n);
  const int third = deck.at(0.5 * (a + b) + (b - a).unitOrthogonal(), ",7,7");
  for (int k = 0; k < n; ++k) deck.beam(1, first + k, first + k + 1, third);
  return first;
}

/// A rod of length 0.2 along x above one that crosses it at an angle below, which it hits after `way`.
BeamDeck crossed_rods(int n, Real v, Real way, Real angle = 90,
                      const std::string& contact = general_contact(), Vec off = Vec::Zero()) {
  BeamDeck deck;
  deck.part(1, square_1, steel_of_beams);
  const Vec along(std::cos(angle * pi / 180), std::sin(angle * pi / 180), 0);
  add_rod(deck, Vec(-0.1, 0, 2 * rod_r + way) + off, Vec(0.1, 0, 2 * rod_r + way) + off, n);
  const int second = add_rod(deck, -0.1 * along, 0.1 * along, n);
  deck.velocity([&](int k) { return k < second - 1 ? Vec(0, 0, -v) : Vec(Vec::Zero()); });
  deck.cards += contact;
  return deck;
}

Vec edge_momentum(const World& world) {
  Vec p = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n) p += world.nodes.m[n] * world.nodes.v.vec(n);
  return p;
}
Vec edge_spin(const World& world) {
  Vec l = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n)
    l += world.nodes.m[n] * world.nodes.x.vec(n).cross(world.nodes.v.vec(n));
  return l;
}
/// Of the next step: terms belong together at t^n alone.
Real edge_residual(Simulation& s) {
  Real out = 0;
  s.step([&](World& world, const Clock& clock, const std::string&) {
    sample_energy(world, clock);
    out = world.energy.residual() / world.energy.initial;
  });
  return out;
}
Real edge_contact_energy(Simulation& s) {
  sample_energy(s.world(), s.clock());
  return s.world().energy.contact;
}

}  // namespace

// One element each: a spring between two masses. It rests pi sqrt(m/(2 k)) in touch and gives all back.
TEST(EdgeContact, CrossedRodsExchangeTheirVelocities) {
  for (const Real v : {0.1, 1.0, 20.0}) {
    auto s = simulation_of(crossed_rods(1, v, 1e-5).text(1));
    start_ledger(*s);
    const Real m = 7850 * 1e-4 * 0.2, k = 0.1 * 1.75e11 * 1e-4 / 0.2;
    const Vec before = edge_momentum(s->world());
    Real begin = 0, end = 0, most = 0;
    while (s->clock().t < 1e-5 / v + 4 * std::sqrt(m / k)) {
      s->step(test::do_nothing);
      const Real stored = edge_contact_energy(*s);
      if (stored > 0 && begin == 0) begin = s->clock().t;
      if (stored > 0) end = s->clock().t;
      most = std::max(most, stored);
    }
    const World& w = s->world();
    EXPECT_NEAR((end - begin) / (pi * std::sqrt(m / (2 * k))), 1, 0.25) << v;  // to a step or two
    EXPECT_NEAR(most / (0.25 * m * v * v), 1, 0.05) << v;
    EXPECT_NEAR(w.nodes.v.vec(0)[2] / v, 0, 0.02) << v;
    EXPECT_NEAR(w.nodes.v.vec(3)[2] / v, -1, 0.02) << v;
    EXPECT_LT((edge_momentum(w) - before).norm(), 1e-13 * before.norm());
    EXPECT_EQ(w.counters.at("leaked_edges"), 0);
  }
}

// The number of elements is that of the mesh; rods end beside each other, in the middle of elements and at
// nodes.
TEST(EdgeContact, RodsThatCrossKeepMomentumAndEnergy) {
  for (const int n : {1, 4, 5, 10})
    for (const Real v : {1.0, 20.0, 100.0})
      for (const Real angle : {90.0, 30.0, 10.0, 0.0}) {
        if (n == 1 && v > 20) continue;  // so soft that one goes round the other
        auto s =
            simulation_of(crossed_rods(n, v, 1e-4, angle, general_contact(), Vec(0.013, 0.002, 0)).text(1));
        start_ledger(*s);
        const Vec p = edge_momentum(s->world());
        const Real end = 1e-4 / v + 1e-3;
        while (s->clock().t < end) s->step(test::do_nothing);
        const World& w = s->world();
        Real low = 0, high = 0;
        for (int k = 0; k <= n; ++k) high += w.nodes.x.vec(k)[2], low += w.nodes.x.vec(n + 1 + k)[2];
        edge_residual(*s);
        EXPECT_LT(std::abs(w.energy.unexplained() / w.energy.initial), 0.01) << n << " " << v << " " << angle;
        EXPECT_LT((edge_momentum(w) - p).norm(), 1e-12 * p.norm());
        EXPECT_GT(high - low, 0) << n << " " << v << " " << angle;
        EXPECT_EQ(w.counters.at("leaked_edges"), 0);
      }
}

// Rods without rotations, of one element each, off their middles and askew, and side by side.
TEST(EdgeContact, KeepsAngularMomentum) {
  for (const Real angle : {90.0, 30.0, 3.0}) {
    BeamDeck deck = crossed_rods(1, 5, 1e-4, angle, general_contact(), Vec(0.03, 0.003, 0));
    deck.cards.replace(deck.cards.find(square_1), square_1.size(), "         3\n    1.0E-4\n");
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    const Vec p = edge_momentum(s->world()), l = edge_spin(s->world());
    while (s->clock().t < 1e-3) s->step(test::do_nothing);
    const World& w = s->world();
    EXPECT_LT((edge_spin(w) - l).norm(), 1e-12 * l.norm()) << angle;
    EXPECT_LT((edge_momentum(w) - p).norm(), 1e-12 * p.norm());
    EXPECT_GT(std::abs(w.nodes.v.vec(0)[2] - w.nodes.v.vec(1)[2]), 0.1) << angle;
  }
}

namespace {

std::string segment_contact(int depth, const std::string& name = "AUTOMATIC_SINGLE_SURFACE") {
  return fmt::format(
      "*CONTACT_{}\n         0\n       0.0\n       1.0\n         2{:>50}\n*CONTROL_CONTACT\n\n{:>60}\n", name,
      depth, 1);
}

/// A plate that is on its edge, above one that it hits with this after `way`: edges of n elements each,
/// at an angle.
test::ShellDeck crossed_plates(int n, Real v, Real t, Real way, Real angle, const std::string& material,
                               const std::string& contact, const Vec& off = Vec::Zero()) {
  test::ShellDeck deck;
  deck.plate(0.1, 0.05, n, n / 2, 1,
             [&](const Vec& x) { return Vec(Vec(x[0] - 0.05, 0, x[1] + t + way) + off); });
  const Real c = std::cos(angle * pi / 180), s = std::sin(angle * pi / 180);
  deck.plate(0.1, 0.05, n, n / 2, 2,
             [&](const Vec& x) { return Vec((x[0] - 0.05) * c, (x[0] - 0.05) * s, x[1] - 0.05); });
  deck.part(1, t, fmt::format(fmt::runtime(material), 1)),
      deck.part(2, t, fmt::format(fmt::runtime(material), 2));
  const auto upper = deck.nodes.size() / 2;
  std::size_t k = 0;
  deck.velocity([&](const Vec&) { return k++ < upper ? Vec(0, 0, -v) : Vec(Vec::Zero()); });
  deck.cards += contact;
  return deck;
}
const std::string elastic_plate = "*MAT_ELASTIC\n{:10}    7850.0   2.1E+11       0.3\n";
const std::string rigid_plate = "*MAT_RIGID\n{:10}    7850.0   2.1E+11       0.3\n";

}  // namespace

TEST(EdgeContact, EdgesOfShellsMeet) {
  for (const std::string& contact : {segment_contact(5), segment_contact(35), general_contact()})
    for (const int n : {6, 10})
      for (const Real angle : {90.0, 30.0}) {
        auto s = simulation_of(
            crossed_plates(n, 5, 0.002, 1e-4, angle, elastic_plate, contact, Vec(0.004, 0.001, 0)).text(1));
        start_ledger(*s);
        const Vec p = edge_momentum(s->world());
        while (s->clock().t < 2e-4) s->step(test::do_nothing);
        const World& w = s->world();
        Real up = 0, low = 0;
        const Index half = w.nodes.size() / 2;
        for (Index k = 0; k < half; ++k) up += w.nodes.x.vec(k)[2], low += w.nodes.x.vec(k + half)[2];
        edge_residual(*s);
        EXPECT_LT(std::abs(w.energy.unexplained() / w.energy.initial), 0.01) << contact << n << " " << angle;
        EXPECT_LT((edge_momentum(w) - p).norm(), 1e-12 * p.norm());
        EXPECT_GT(w.maxima.at("max_penetration"), 0);
        EXPECT_LT(w.maxima.at("max_penetration"), 0.002);
        EXPECT_EQ(w.counters.at("leaked_edges"), 0);
      }
}

// Cubes that meet with an edge each, of which no corner comes near a face.
TEST(EdgeContact, EdgesOfSolidsMeet) {
  for (const int n : {1, 2, 4}) {
    test::SolidDeck deck;
    const Real c = std::sqrt(0.5), half = 0.05;
    deck.block(Vec(1, 1, 1) * 2 * half, n, n, n, 1, [&](const Vec& x) {
      const Vec y = x - Vec(1, 1, 1) * half;
      return Vec(y[0] + 0.004, c * (y[1] - y[2]) + 0.003, c * (y[1] + y[2]) + 2 * half / c + 1e-4);
    });
    const std::size_t first = deck.nodes.size();
    deck.block(Vec(1, 1, 1) * 2 * half, n, n, n, 2, [&](const Vec& x) {
      const Vec y = x - Vec(1, 1, 1) * half;
      return Vec(c * (y[0] + y[2]), y[1], c * (y[2] - y[0]));
    });
    for (const int part : {1, 2})
      deck.cards += fmt::format(
          "*PART\nblock\n{0:10}{0:10}{0:10}\n*SECTION_SOLID\n{0:10}         1\n*MAT_ELASTIC\n"
          "{0:10}    7800.0   2.1E+11       0.3\n",
          part);
    deck.cards += "*INITIAL_VELOCITY_NODE\n";
    for (std::size_t k = 1; k <= first; ++k)
      deck.cards += fmt::format("{:10}{:10}{:10}{:10}\n", k, 0.0, 0.0, -5.0);
    deck.cards += segment_contact(5);
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    const World& w = s->world();
    const Vec p = edge_momentum(w);
    while (s->clock().t < 1e-3) s->step(test::do_nothing);
    edge_residual(*s);
    const Real up = w.nodes.v.vec(0)[2];
    EXPECT_LT((edge_momentum(w) - p).norm(), 1e-12 * p.norm());
    EXPECT_EQ(w.counters.at("leaked_edges") + w.counters.at("leaked_nodes"), 0);
    Real above = 0;
    for (Index k = 0; k < w.nodes.size(); ++k)
      above += (k < static_cast<Index>(first) ? 1 : -1) * w.nodes.x.vec(k)[2] / static_cast<Real>(first);
    EXPECT_GT(above, 2 * half / c) << n;
  }
}

// Rigid plates bounce off each other edge on edge, in the middle of both, and exchange their velocities.
TEST(EdgeContact, RigidEdgesGiveAllBack) {
  for (const int n : {2, 10})
    for (const Real angle : {90.0, 30.0}) {
      auto s =
          simulation_of(crossed_plates(n, 1, 0.002, 1e-4, angle, rigid_plate, segment_contact(5)).text(5e-4));
      start_ledger(*s);
      while (s->clock().t < 5e-4) s->step(test::do_nothing);
      const World& w = s->world();
      const Index half = w.nodes.size() / 2;
      Real up = 0, low = 0;
      for (Index k = 0; k < half; ++k)
        up += w.nodes.v.vec(k)[2] / Real(half), low += w.nodes.v.vec(half + k)[2] / Real(half);
      EXPECT_NEAR(up, 0, 0.02);
      EXPECT_NEAR(low, -1, 0.02);
    }
}

// Rods so thin for contact that they are never seen within it: what went through within a step is pushed back
// to where it came from, on and on.
TEST(EdgeContact, WhatGoesThroughWithinAStepComesBack) {
  for (const int n : {1, 4, 5})
    for (const Real v : {2.0, 20.0, 100.0}) {
      std::string thin = general_contact();
      thin.replace(thin.rfind("       1.0"), 10, "       1.0       1.0   2.0E-08");
      auto s = simulation_of(crossed_rods(n, v, 1e-4 - 2 * rod_r, 50, thin, Vec(0.013, 0.002, 0)).text(1));
      start_ledger(*s);
      while (s->clock().t < 1e-4 / v + 1e-3) s->step(test::do_nothing);
      const World& w = s->world();
      edge_residual(*s);
      Real up = 0, low = 0;
      for (int k = 0; k <= n; ++k) up += w.nodes.x.vec(k)[2], low += w.nodes.x.vec(n + 1 + k)[2];
      EXPECT_EQ(w.counters.at("leaked_edges"), 0) << n << " " << v;
      EXPECT_GT(up - low, 0) << n << " " << v;
      EXPECT_LT(std::abs(w.energy.unexplained() / w.energy.initial), 0.01) << n << " " << v;
    }
}

namespace {

/// A net of n x n woven wires of radius 1 mm, 10 mm apart, held at their ends, and a rigid ball of radius 20
/// mm above its middle. No wire shares a node with another.
test::SolidDeck net_and_ball(int n, Real v) {
  test::SolidDeck deck;
  const Real pitch = 0.01, r = 0.001, a = r * (1 + 1e-9), radius = 0.02, half = 0.5 * pitch * (n + 1);
  deck.block(Vec(2, 2, 2), 4, 4, 4, 1, [&](const Vec& x) {
    const Vec y = x - Vec(1, 1, 1);
    const Real most = y.cwiseAbs().maxCoeff();
    return Vec(Vec(0, 0, radius + 2.2 * r) + (most > 0 ? Vec(y.normalized() * (most * radius)) : y));
  });
  const std::size_t ball = deck.nodes.size();
  deck.cards =
      "*PART\nball\n         1         1         1\n*SECTION_SOLID\n         1         1\n"
      "*MAT_RIGID\n         1    7800.0   2.1E+11       0.3\n"
      "*PART\nwires\n         2         2         2\n*SECTION_BEAM\n         2         1       1.0         2 "
      "        1\n"
      "     0.002     0.002\n*MAT_ELASTIC\n         2    7850.0   2.1E+11       0.3\n";
  std::string held = "*SET_NODE_LIST\n         9\n";
  int beam = 0;
  deck.particles = "*ELEMENT_BEAM\n";
  for (const int along : {0, 1})
    for (int i = 1; i <= n; ++i) {
      const std::size_t first = deck.nodes.size() + 1;
      for (int j = 0; j <= n + 1; ++j) {
        const Real up = (along == 0 ? a : -a) * ((i + j) % 2 == 0 ? 1 : -1) * (j > 0 && j <= n ? 1 : 0);
        const Real x = pitch * j - half, y = pitch * i - half;
        deck.nodes.push_back(along == 0 ? Vec(x, y, up) : Vec(y, x, up));
      }
      held += fmt::format("{:10}{:10}\n", first, deck.nodes.size());
      deck.nodes.push_back(deck.nodes.back() + Vec(0, 0, 0.1));
      for (int j = 0; j <= n; ++j)
        deck.particles +=
            fmt::format("{:8}{:8}{:8}{:8}{:8}\n", 1000 + ++beam, 2, first + static_cast<std::size_t>(j),
                        first + static_cast<std::size_t>(j) + 1, deck.nodes.size());
    }
  deck.cards +=
      held +
      "*BOUNDARY_SPC_SET\n         9         0         1         1         1\n*INITIAL_VELOCITY_NODE\n";
  for (std::size_t k = 1; k <= ball; ++k)
    deck.cards += fmt::format("{:10}{:10}{:10}{:10.3f}\n", k, 0.0, 0.0, -v);
  deck.cards += general_contact();
  return deck;
}

}  // namespace

// A net stops a ball and throws it back: where wires cross they hold each other by their edges alone.
TEST(EdgeContact, NetThrowsABallBack) {
  constexpr int n = 6;
  auto s = simulation_of(net_and_ball(n, 10).text(1));
  start_ledger(*s);
  const World& w = s->world();
  while (s->clock().t < 2.5e-3) s->step(test::do_nothing);
  edge_residual(*s);
  const Real back = w.nodes.v.vec(0)[2];
  EXPECT_LT(std::abs(w.energy.unexplained() / w.energy.initial), 0.01);
  EXPECT_GT(back, 7.5);
  EXPECT_LT(back, 10);
  EXPECT_EQ(w.counters.at("leaked_edges") + w.counters.at("leaked_nodes"), 0);
  const Index ball = w.nodes.size() - 2 * n * (n + 2);
  for (Index i = 1; i <= n; ++i)
    for (Index j = 1; j <= n; ++j) {
      const Index a = ball + (i - 1) * (n + 2) + j, b = ball + (n + j - 1) * (n + 2) + i;
      const Real above = w.nodes.x.vec(a)[2] - w.nodes.x.vec(b)[2];
      EXPECT_GT((i + j) % 2 == 0 ? above : -above, 0.001) << "wires " << i << " and " << j;
    }
}

// What a step leads so far that no spring could bring it back is reported.
TEST(EdgeContact, RodsThatCannotBeHeldAreCounted) {
  int counted = 0;
  for (const Real way : {0.03, 0.08, 0.13, 0.18, 0.23}) {
    auto s = simulation_of(crossed_rods(1, 6000, way).text(1));
    const World& w = s->world();
    while (s->clock().t < 1e-4) s->step(test::do_nothing);
    const bool through = w.nodes.x.vec(0)[2] < w.nodes.x.vec(3)[2];
    EXPECT_EQ(through, w.counters.at("leaked_edges") > 0) << way;
    counted += through;
  }
  EXPECT_GT(counted, 0);
}

// SOFT 1 takes its stiffness from a step, which none is known before the first one.
TEST(EdgeContact, SoftSpringsHoldWhatTouchesAtTheStart) {
  const std::string soft = "*CONTACT_AUTOMATIC_GENERAL\n         0\n\n     1e-12\n         1\n";
  auto s = simulation_of(crossed_rods(1, 1, -0.1 * rod_r, 90, soft).text(1));
  const World& w = s->world();
  while (s->clock().t < 2e-3) s->step(test::do_nothing);
  EXPECT_GT(w.nodes.x.vec(0)[2], w.nodes.x.vec(3)[2]);
  EXPECT_EQ(w.counters.at("leaked_edges"), 0);
}

// Springs that ask for a smaller step than the rods, wherever within a step they meet.
TEST(EdgeContact, StiffSpringsAreToldBeforeTheyPush) {
  std::string stiff = general_contact();
  stiff.replace(stiff.rfind("       1.0"), 10, "     100.0");
  for (const Real way : {1e-4, 1.3e-4, 1.7e-4}) {
    auto s = simulation_of(crossed_rods(4, 5, way, 50, stiff, Vec(0.013, 0.002, 0)).text(1));
    start_ledger(*s);
    while (s->clock().t < way / 5 + 3e-4) s->step(test::do_nothing);
    edge_residual(*s);
    const EnergyLedger& e = s->world().energy;
    EXPECT_LT(std::abs(e.unexplained() / e.initial), 0.01) << way;
  }
}

// Without it they go through each other, and all is as before.
TEST(EdgeContact, IsThereWhereItIsAskedFor) {
  auto s = simulation_of(crossed_plates(4, 5, 0.002, 1e-4, 90, elastic_plate, segment_contact(3)).text(1));
  while (s->clock().t < 1e-4) s->step(test::do_nothing);
  EXPECT_EQ(s->world().counters.count("contact_edges"), 0U);
  EXPECT_DOUBLE_EQ(s->world().nodes.v.vec(0)[2], -5);
}

TEST(EdgeContact, StateIsTheSameForAnyThreadsAndAfterARestart) {
  for (const Real angle : {90.0, 5.0})
    test::expect_same_bits(
        crossed_rods(70, 20, 1e-4, angle, general_contact(0.2, 10), Vec(0.01, 0.001, 0)).text(1), 40, 25);
}
