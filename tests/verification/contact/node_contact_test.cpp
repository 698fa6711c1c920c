// Contact of solids with each other and with rigid plates, against theory.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "parallel/parallel.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

using namespace courant;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

constexpr auto write_nothing = [](World&, const Clock&, const std::string&) {};

std::string elastic_part(int part, Real ro, Real E, Real pr) {
  return fmt::format(
      "*PART\nblock\n{0:10}{0:10}{0:10}\n*SECTION_SOLID\n{0:10}         1\n*MAT_ELASTIC\n"
      "{0:10}{1:10.4g}{2:10.4g}{3:10.4g}\n",
      part, ro, E, pr);
}

std::string initial_velocity(int set, const Vec& v) {
  return fmt::format("*INITIAL_VELOCITY\n{:10}\n{:10.4g}{:10.4g}{:10.4g}\n", set, v[0], v[1], v[2]);
}

/// Gravity g along -z and h along x.
std::string weight(Real g, Real h = 0) {
  std::string out = fmt::format(
      "*LOAD_BODY_Z\n       901{:10.4g}\n*DEFINE_CURVE\n       901\n                 0.0                 "
      "1.0\n"
      "               100.0                 1.0\n",
      g);
  return h == 0 ? out : out + fmt::format("*LOAD_BODY_X\n       901{:10.4g}\n", -h);
}

/// Nodes first to last of the deck as a set.
void nodes_as_set(SolidDeck& deck, int id, std::size_t first, std::size_t last) {
  deck.cards += fmt::format("*SET_NODE_LIST_GENERATE\n{:10}\n{:10}{:10}\n", id, first, last);
}

/// A rigid plate of shells of thickness t in the plane z = -t/2, held: its upper side is z = 0.
void add_plate(SolidDeck& deck, int part, const Vec& low, const Vec& high, int n, Real t) {
  const std::size_t first = deck.nodes.size() + 1;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      deck.nodes.emplace_back(low[0] + (high[0] - low[0]) * i / n, low[1] + (high[1] - low[1]) * j / n,
                              -0.5 * t);
  deck.particles += "*ELEMENT_SHELL\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::size_t a = first + static_cast<std::size_t>(i + (n + 1) * j),
                        up = a + static_cast<std::size_t>(n) + 1;
      deck.particles +=
          fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}\n", 100000 + i + n * j, part, a, a + 1, up + 1, up);
    }
  deck.cards += fmt::format(
      "*PART\nplate\n{0:10}{0:10}{0:10}\n*SECTION_SHELL\n{0:10}         "
      "2\n{1:10.4g}{1:10.4g}{1:10.4g}{1:10.4g}\n"
      "*MAT_RIGID\n{0:10}    7800.0     1e9       0.3\n       1.0         7         7\n",
      part, t);
}

std::string contact(const std::string& name, Real mu = 0, const std::string& more = "") {
  const bool single = name.find("SINGLE") != std::string::npos;
  return fmt::format("*CONTACT_{}\n{}\n{:10.4g}{:10.4g}\n       1.0\n", name,
                     single ? "         0" : "         1         2         3         3", mu, mu) +
         more;
}

Vec momentum_of(const World& world) {
  Vec p = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n) p += world.nodes.m[n] * world.nodes.v.vec(n);
  return p;
}

Vec mean_velocity(const World& world, Index part) {
  Vec p = Vec::Zero();
  Real m = 0;
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (world.nodes.part[n] == part) p += world.nodes.m[n] * world.nodes.v.vec(n), m += world.nodes.m[n];
  return p / m;
}

InterfaceForce interface_of(const Simulation& s) {
  return s.world().passes.all<const InterfaceReporter>().at(0)->report();
}

Real lost_share(Simulation& s) {
  sample_energy(s.world(), s.clock());
  const EnergyLedger& e = s.world().energy;
  return e.unexplained() / e.initial;
}

/// Two equal bars along x of n solids each; the first one moves towards the second.
SolidDeck two_bars(int n, const std::string& kind, const std::string& more = "") {
  SolidDeck deck;
  const Real a = 2.0 / n;
  deck.block(Vec(1, a, a), n, 2, 2, 1);
  const std::size_t first = deck.nodes.size();
  deck.block(Vec(1, a, a), n, 2, 2, 2, [](const Vec& x) { return Vec(x + Vec(1 + 1e-7, 0, 0)); });
  deck.cards = elastic_part(1, 7800, 2e11, 0) + elastic_part(2, 7800, 2e11, 0);
  nodes_as_set(deck, 1, 1, first);
  deck.cards += initial_velocity(1, Vec(1, 0, 0)) + contact(kind, 0, more);
  return deck;
}

}  // namespace

// Waves run to the free ends and back: after 2 L/c the bars part, having exchanged their velocities. The
// penalty makes the force rise and fall slowly; from half to half it is 2 L/c.
TEST(NodeContact, EqualBarsExchangeTheirVelocities) {
  constexpr Real duration = 2 / 5063.7;  // 2 L/c, c = sqrt(E/RO)
  for (const char* kind : {"AUTOMATIC_SURFACE_TO_SURFACE", "AUTOMATIC_SINGLE_SURFACE", "SURFACE_TO_SURFACE",
                           "AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", "NODES_TO_SURFACE"})
    for (const auto& [n, bound] : {std::pair(20, 0.06), {80, 0.02}}) {
      auto s = simulation_of(two_bars(n, kind).text(1));
      start_ledger(*s);
      const Vec before = momentum_of(s->world());
      std::vector<Real> time, force;  // up to a factor
      while (s->clock().t < 6e-4) {
        s->step(write_nothing);
        time.push_back(s->clock().t), force.push_back(std::sqrt(interface_of(*s).energy_stored));
      }
      const Real half = 0.5 * *std::max_element(force.begin(), force.end());
      Real from = 0, to = 0;
      for (std::size_t k = 0; k < time.size(); ++k)
        if (force[k] > half) from = from > 0 ? from : time[k], to = time[k];
      EXPECT_NEAR((momentum_of(s->world()) - before).norm() / before.norm(), 0, 1e-12) << kind << n;
      EXPECT_NEAR(mean_velocity(s->world(), 0)[0], 0, bound) << kind << n;
      EXPECT_NEAR(mean_velocity(s->world(), 1)[0], 1, bound) << kind << n;
      EXPECT_NEAR((to - from) / duration, 1, n == 80 ? 0.02 : 0.15) << kind << n;
      EXPECT_NEAR(lost_share(*s), 0, 0.01) << kind << n;
      EXPECT_EQ(s->world().counters.at("leaked_nodes"), 0) << kind << n;
    }
}

// Equal pressure makes equal depth up to the edges, so that the weight of the upper block goes into the lower
// one without bending it: stress as in one piece.
TEST(NodeContact, StressGoesOnFromBlockToBlock) {
  constexpr Real L = 0.1, E = 1e7, rho = 2000, g = 100;
  constexpr int n = 4;
  for (const int soft : {0, 1}) {
    SolidDeck deck;
    deck.block(Vec(L, L, L), n, n, n, 1);
    deck.block(Vec(L, L, L), n, n, n, 2, [=](const Vec& x) { return Vec(x + Vec(0, 0, L)); });
    deck.cards = elastic_part(1, rho, E, 0) + elastic_part(2, rho, E, 0);
    deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
    deck.cards += "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n" + weight(g) +
                  "*DAMPING_GLOBAL\n         0     600.0\n" +
                  contact("AUTOMATIC_SURFACE_TO_SURFACE", 0, fmt::format("{:10}\n", soft));
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 0.15) s->step(write_nothing);
    const World& world = s->world();
    const Real h = L / n;
    for (const auto& group : world.groups) {
      const auto* stress = dynamic_cast<const Field<Real>*>(group->fields.find("stress"));
      for (Index e = 0; e < group->size(); ++e) {
        const Real above = 2 * L - (group->part * L + (std::floor(Real(e) / (n * n)) + 0.5) * h);
        EXPECT_NEAR(stress->data(2)[e] / (-rho * g * above), 1, 0.01) << soft << " solid " << group->id[e];
      }
    }
    EXPECT_NEAR(interface_of(*s).on_surfa[2] / (-rho * g * L * L * L), 1, 1e-3);
  }
}

// Nine nodes are behind the upper face of the larger block when the contact is born, and keep their depth
// without force: the summary counts them.
TEST(NodeContact, TellsOfWhatIsBehindFacesAtItsBirth) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 0.5), 2, 2, 2, 1);
  deck.block(Vec(0.4, 0.4, 0.4), 2, 2, 2, 2, [](const Vec& x) { return Vec(x + Vec(0.3, 0.3, 0.49)); });
  deck.cards = elastic_part(1, 1000, 1e7, 0) + elastic_part(2, 1000, 1e7, 0) +
               "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n         2         1         3         3\n"
               "                                                                 0.002\n       1.0\n";
  auto s = simulation_of(deck.text(1));
  EXPECT_EQ(s->world().counters.at("penetrations_at_birth"), 0);
  while (s->clock().t < 0.001) s->step(write_nothing);
  EXPECT_EQ(s->world().counters.at("penetrations_at_birth"), 0);
  while (s->clock().t < 0.01) s->step(write_nothing);
  EXPECT_EQ(s->world().counters.at("penetrations_at_birth"), 9);
  EXPECT_EQ(interface_of(*s).on_surfa, Vec::Zero());
}

// A column of three: a transducer states what all contacts do to its parts, and what is inside of it cancels.
TEST(NodeContact, TransducersTellTheForceOnTheirParts) {
  constexpr Real L = 0.1, E = 1e7, rho = 1000, g = 200;
  SolidDeck deck;
  for (int k = 0; k < 3; ++k)
    deck.block(Vec(L, L, L), 2, 2, 2, k + 1, [=](const Vec& x) { return Vec(x + Vec(0, 0, k * L)); });
  for (int k = 1; k <= 3; ++k) deck.cards += elastic_part(k, rho, E, 0);
  deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n" + weight(g) +
                "*DAMPING_GLOBAL\n         0     600.0\n" + contact("AUTOMATIC_SURFACE_TO_SURFACE") +
                "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n         2         3         3         3\n\n\n"
                "*SET_PART_LIST\n         7\n         2         3\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY_ID\n        11middle\n         2         0         3\n\n\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n         3         0         3\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n         7         0         2\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n         1         0         3\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n         2         1         3         3\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n         2         3         3         3\n"
                "*CONTACT_FORCE_TRANSDUCER_PENALTY\n         1         3         3         3\n";
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.15) s->step(write_nothing);
  const auto all = s->world().passes.all<InterfaceReporter>();
  ASSERT_EQ(all.size(), 9u);
  const Real one = rho * g * L * L * L;
  const std::array<Real, 7> expected{one, one, 2 * one, -2 * one, 2 * one, -one, 0};  // the last between two
  const std::array<Id, 7> ids{11, 4, 5, 6, 7, 8, 9};
  for (std::size_t k = 0; k < 7; ++k) {
    const InterfaceForce told = all[2 + k]->report();
    EXPECT_EQ(told.id, ids[k]);
    EXPECT_NEAR((told.on_surfa - Vec(0, 0, expected[k])).norm(), 0, 2e-3 * one) << k;
  }
  EXPECT_EQ(all[2]->report().title, "middle");
}

// a = g (sin alpha - mu cos alpha) above the angle of friction; below it the block creeps only as far as the
// springs of friction yield, mu N / (k of all nodes).
// Small solids on large ones, pressed in by a good part of their own size, cross the edges of the large ones.
// A part far away with a fine mesh has no influence.
TEST(NodeContact, ABlockOfSmallSolidsSlidesOverLargeOnes) {
  for (const int fine : {1, 8}) {
    SolidDeck deck;
    deck.block(Vec(0.05, 0.05, 0.02), 10, 10, 4, 1);
    deck.block(Vec(1, 0.4, 0.1), 5, 2, 1, 2, [](const Vec& x) { return Vec(x + Vec(-0.12, -0.17, -0.1)); });
    deck.block(Vec(0.02, 0.02, 0.02), fine, fine, fine, 3,
               [](const Vec& x) { return Vec(x + Vec(3, 3, 3)); });
    const char* const held = "         2    7800.0     1e9       0.3\n       1.0         7         7\n";
    deck.cards = elastic_part(1, 1000, 1e8, 0.3) +
                 "*PART\nground\n         2         1         2\n*PART\nfar\n         3         1         2\n"
                 "*MAT_RIGID\n" +
                 held + "*SET_PART_LIST\n        20\n         2         3\n" + weight(3000) +
                 "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n         1        20         3         2\n"
                 "       0.0       0.0       0.0       0.0      20.0\n       0.3\n";
    nodes_as_set(deck, 1, 1, 11 * 11 * 5);
    deck.cards += initial_velocity(1, Vec(5, 0, 0));
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    const Real from = s->world().nodes.x.data(0)[0];
    while (s->clock().t < 0.02) s->step(write_nothing);  // past an edge of the ground
    const Real way = s->world().nodes.x.data(0)[0] - from;
    EXPECT_NEAR(way / (5 * s->clock().t), 1, 0.01) << fine;
    EXPECT_GT(s->world().nodes.x.data(2)[0], -2e-3) << fine;  // 2 mm is 0.4 of a small solid
    EXPECT_EQ(s->world().counters["leaked_nodes"], 0) << fine;
  }
}

TEST(NodeContact, ABlockSlidesOrSticksOnAnIncline) {
  constexpr Real g = 9.81, alpha = 0.5, L = 0.1;
  for (const Real mu : {0.0, 0.2, 0.4, 0.7}) {
    SolidDeck deck;
    deck.block(Vec(L, L, L / 2), 4, 4, 2, 1);
    deck.cards = elastic_part(1, 1000, 1e7, 0.3);
    add_plate(deck, 2, Vec(-0.22, -0.13, 0), Vec(1.33, 0.21, 0), 9, 0.01);
    deck.cards += weight(g * std::cos(alpha), g * std::sin(alpha)) +
                  fmt::format(
                      "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n         1         2         3         3\n"
                      "{0:10}{0:10}       0.0       0.0      20.0\n       1.0\n",
                      mu);
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    const Real from = 0.1, until = 0.4;
    Real v = 0, t = 0, x = 0;
    while (s->clock().t < until) {
      s->step(write_nothing);
      if (t > 0 || s->clock().t < from) continue;
      t = s->clock().t, v = mean_velocity(s->world(), 0)[0], x = s->world().nodes.x.data(0)[0];
    }
    const Real a = (mean_velocity(s->world(), 0)[0] - v) / (s->clock().t - t);
    const Real expected = g * std::max(std::sin(alpha) - mu * std::cos(alpha), 0.0);
    EXPECT_NEAR(a, expected, 0.01 * g * std::sin(alpha)) << mu;
    if (expected == 0) EXPECT_NEAR(s->world().nodes.x.data(0)[0], x, 1e-5) << "it sticks";
    EXPECT_NEAR(lost_share(*s), 0, 0.01) << mu;
  }
}

// An elastic block of uniform stress leaves a rigid plate as fast as it came, 2 L/c later (E for K: no
// lateral motion at PR = 0).
TEST(NodeContact, AnElasticBlockBouncesOffARigidPlate) {
  constexpr Real L = 0.1, E = 1e7, rho = 1000;
  for (const int tilt : {0, 1}) {
    SolidDeck deck;
    const Eigen::AngleAxisd turn(tilt * 0.6, Vec(1, 0.5, 0.2).normalized());
    deck.block(Vec(L, L, L), 8, 8, 8, 1, [&](const Vec& x) {
      return Vec(turn * (x - Vec(L, L, L) / 2) + Vec(0, 0, tilt ? 0.085 : 0.051));
    });
    const std::size_t last = deck.nodes.size();
    deck.cards = elastic_part(1, rho, E, 0);
    nodes_as_set(deck, 1, 1, last);
    add_plate(deck, 2, Vec(-0.31, -0.3, 0), Vec(0.3, 0.32, 0), 7, 0.01);
    deck.cards += initial_velocity(1, Vec(0, 0, -1)) + contact("AUTOMATIC_NODES_TO_SURFACE");
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    while (s->clock().t < 0.04) s->step(write_nothing);
    EXPECT_EQ(s->world().counters.at("leaked_nodes"), 0) << tilt;
    EXPECT_NEAR(lost_share(*s), 0, 0.02) << tilt;
    const Vec v = mean_velocity(s->world(), 0);
    if (tilt == 0) EXPECT_NEAR(v[2], 1, 0.03);
    EXPECT_GT(v[2], 0.2) << tilt;
    EXPECT_NEAR(v[0], 0, 1e-12) << "no friction";
  }
}

namespace {

/// Two cubes of different meshes, turned at random, thrown at each other off their centres.
SolidDeck two_cubes(int number, Real speed, Real mu, const std::string& kind) {
  SolidDeck deck;
  const auto turn = [&](int k) {
    return Eigen::Quaterniond(std::cos(number * 1.3 + k), std::sin(number * 2.1 + 2 * k),
                              std::cos(number * 0.7 + 3 * k), std::sin(number * 1.9 + 5 * k))
        .normalized();
  };
  constexpr Real L = 0.1;
  const Vec middle = Vec(L, L, L) / 2;
  const int n1 = 5 + number % 3, n2 = 6 + number % 2;
  deck.block(Vec(L, L, L), n1, n1, n1, 1, [&](const Vec& x) { return Vec(turn(1) * (x - middle)); });
  const std::size_t first = deck.nodes.size();
  const Vec off(0.02 * std::sin(number), 0.02 * std::cos(number), 0.18);
  deck.block(Vec(L, L, L), n2, n2, n2, 2, [&](const Vec& x) { return Vec(turn(2) * (x - middle) + off); });
  deck.cards = elastic_part(1, 1000, 1e7, 0.3) + elastic_part(2, 1000, 1e7, 0.3);
  nodes_as_set(deck, 1, 1, first);
  nodes_as_set(deck, 2, first + 1, deck.nodes.size());
  deck.cards += initial_velocity(1, Vec(0, 0, speed)) + initial_velocity(2, Vec(0.3 * speed, 0, -speed)) +
                contact(kind, mu);
  return deck;
}

}  // namespace

// Corners, edges and faces on each other, each at 0.5 % of the speed of sound. What is lost or won is mostly
// below 0.2 % of the energy; where a corner slides off an edge deep in the other cube, the fading push does
// not follow from its energy exactly, as faces also stretch.
TEST(NodeContact, CubesAtAnyAngleBounceWithoutLeaksAndLosses) {
  int close = 0;
  for (int number = 1; number <= 8; ++number)
    for (const Real mu : {0.0, 0.3}) {
      auto s = simulation_of(two_cubes(number, 0.5, mu, "AUTOMATIC_SURFACE_TO_SURFACE").text(1));
      start_ledger(*s);
      const Vec before = momentum_of(s->world());
      Real stored = 0;
      while (s->clock().t < 0.3) {
        s->step(write_nothing);
        stored = std::max(stored, interface_of(*s).energy_stored);
      }
      EXPECT_GT(stored, 0.01 * s->world().energy.initial) << "they meet";
      EXPECT_EQ(s->world().counters.at("leaked_nodes"), 0) << number;
      EXPECT_NEAR(lost_share(*s), 0, 0.05) << number << " " << mu;
      close += std::abs(lost_share(*s)) < 0.02;
      EXPECT_NEAR((momentum_of(s->world()) - before).norm(), 0, 1e-12) << number;
    }
  EXPECT_GE(close, 15) << "of 16";
}

TEST(NodeContact, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  constexpr int after = 60;
  const std::string deck = two_cubes(2, 2, 0.3, "AUTOMATIC_SINGLE_SURFACE").text(1);
  auto s = simulation_of(deck);
  int steps = 0;
  while (interface_of(*s).energy_stored < 0.01 && steps < 1000) s->step(write_nothing), ++steps;
  ASSERT_LT(steps, 1000) << "they meet";
  test::expect_same_bits(deck, steps + 20 + after, steps + 20);
}

// What the penalty loses by damping: e = exp(-(xi/omega)(pi - atan2(2 xi omega, omega^2 - xi^2))) of a spring
// that cannot pull, omega^2 = 1 - xi^2. The damping is that of the four nodes below, which carry an eighth of
// the block each and move a quarter of it: xi = VDC/sqrt(2).
TEST(NodeContact, DampingTakesWhatAOneSidedSpringLoses) {
  for (const Real vdc : {10.0, 20.0, 40.0}) {
    SolidDeck deck;
    deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 1, [](const Vec& x) { return Vec(x + Vec(0, 0, 1e-4)); });
    deck.cards = elastic_part(1, 1000, 1e12, 0);  // stiff beside the penalty
    nodes_as_set(deck, 1, 1, 8);
    add_plate(deck, 2, Vec(-0.3, -0.3, 0), Vec(0.3, 0.3, 0), 1, 0.01);
    deck.cards += initial_velocity(1, Vec(0, 0, -0.1));
    deck.cards += fmt::format(
        "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n         1         2         3         3\n       0.0       0.0 "
        " "
        "     0.0       0.0{:10.1f}\n       1.0\n",
        vdc);
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    while (s->clock().t < 0.01 && mean_velocity(s->world(), 0)[2] <= 0) s->step(write_nothing);
    for (int k = 0; k < 4000; ++k) s->step(write_nothing);
    const Real xi = 0.01 * vdc / std::sqrt(2.0), omega = std::sqrt(1 - xi * xi);
    const Real expected =
        std::exp(-xi / omega * (std::acos(-1.0) - std::atan2(2 * xi * omega, omega * omega - xi * xi)));
    EXPECT_NEAR(mean_velocity(s->world(), 0)[2] / 0.1, expected, 0.01) << vdc;
    EXPECT_NEAR(lost_share(*s), 0, 0.01) << vdc;
  }
}

// A cube comes down on an equal one, beside whose edges it has drifted meanwhile: the nodes that are over the
// top touch the top, and none the side that they have never been in front of.
TEST(NodeContact, WhatDriftsPastAnEdgeMakesNoEnergy) {
  for (const Real v : {1.0, 10.0}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
    deck.block(Vec(1, 1, 1), 3, 3, 3, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 1.04)); });
    deck.cards = fmt::format(
        "*SECTION_SOLID\n1,1\n*PART\nbelow\n1,1,1\n*PART\nabove\n2,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n"
        "*CONTROL_HOURGLASS\n4,0.05\n*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n2,1,3,3\n\n\n"
        "*CONTROL_TIMESTEP\n0.0,0.5\n*INITIAL_VELOCITY\n1\n{},0.0,{}\n",
        0.1 * v, -v);
    deck.node_set(1, [](const Vec& x) { return x[2] > 1.02; });
    auto s = simulation_of(deck.text(10));
    test::start_ledger(*s);
    Real worst = 0;
    while (s->clock().t < 0.04 / v + 0.01)
      s->step([&](World& world, const Clock& clock, const std::string&) {
        worst = std::max(worst, test::energy_error(world, clock));
      });
    EXPECT_LT(worst, 2e-3) << v;  // 0.25 and 0.02 by the side
  }
}

// Thin plates meet at the step of their elements, at any time of a step: contact is far stiffer than the step
// of 0.9 allows for, and before nothing had told it so until they touched (0.9 of rms, 2.0 at most).
TEST(NodeContact, PlatesThatMeetAtAnyTimeOfAStepKeepTheirEnergy) {
  for (const auto& [tssfac, most_rms, most] :
       {std::tuple(0.9, 0.01, 0.015), {0.6, 0.01, 0.015}, {0.3, 0.004, 0.006}}) {
    constexpr int cases = 10;
    Real squares = 0;
    for (int k = 0; k < cases; ++k) {
      test::ShellDeck deck;
      deck.plate(1, 1, 4, 4, 1);
      deck.plate(1, 1, 4, 4, 2, [&](const Vec& x) { return Vec(x + Vec(0, 0, 0.0101 + 0.0002 * k)); });
      for (const int part : {1, 2})
        deck.part(part, 0.01, fmt::format("*MAT_ELASTIC\n{},7800.0,2.0E11,0.3\n", part));
      deck.node_set(1, [](const Vec& x) { return x[2] > 0.005; });
      deck.cards += fmt::format(
          "*INITIAL_VELOCITY\n1\n0.0,0.0,-20.0\n*CONTROL_TIMESTEP\n0.0,{}\n"
          "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n",
          tssfac);
      auto s = simulation_of(deck.text(1e-3));
      start_ledger(*s);
      while (s->clock().t < 8e-4) s->step(write_nothing);
      Real came = 0;
      constexpr int samples = 40;  // of plates that swing
      for (int i = 0; i < samples; ++i) {
        test::energy_error_of_a_step(*s);
        came += (s->world().energy.total() / s->world().energy.initial - 1) / samples;
      }
      EXPECT_LT(std::abs(came), most) << tssfac << " " << k;
      squares += came * came / cases;
    }
    EXPECT_LT(std::sqrt(squares), most_rms) << tssfac;
  }
}

// A point slides without friction into a dented shell and up its other side: within the thickness it is with
// the nearest face. With the least deep one it stayed with the first face until its foot left that, far below
// the other one, and gained 2 to 5 % of its fall.
TEST(NodeContact, PointsInADentKeepTheirEnergy) {
  for (const Real slope : {0.1, 0.2, 0.3}) {
    test::ShellDeck deck;
    deck.plate(4, 1, 4, 1, 1, [&](const Vec& x) { return Vec(x[0] - 2, x[1], slope * std::abs(x[0] - 2)); });
    deck.part(1, 0.2, "*MAT_ELASTIC\n1,1000.0,2.0E4,0.3\n");
    deck.hold(1, "xyzXYZ", [](const Vec&) { return true; });
    deck.nodes.push_back(Vec(-1.5, 0.5, 1.5 * slope + 0.1));
    deck.node_set(2, [&](const Vec& x) { return x[1] > 0.4 && x[1] < 0.6; });
    deck.cards += fmt::format(
        "*CONTROL_TIMESTEP\n0.0,0.01\n*ELEMENT_MASS\n1,{},1.0\n"
        "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n2,1,4,3\n\n\n"
        "*LOAD_BODY_Z\n1,10.0\n*DEFINE_CURVE\n1\n0.0,1.0\n100.0,1.0\n",
        deck.nodes.size());
    auto s = simulation_of(deck.text(3));
    start_ledger(*s);
    const auto x = [&] { return s->world().nodes.x.data(0)[s->world().nodes.size() - 1]; };
    const Real fall = 10 * 1.5 * slope;
    while (s->clock().t < 2.5 && x() < 0.8) s->step(write_nothing);
    test::energy_error_of_a_step(*s);
    EXPECT_GT(x(), 0.8) << slope;
    EXPECT_NEAR(s->world().energy.unexplained(), 0, 0.003 * fall) << slope;
  }
}
