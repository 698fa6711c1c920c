// What passes beside a body, and what slides on one, feels no push from beside.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::simulation_of;
using test::SolidDeck;

namespace contact_beside_test {
namespace {

using Turn = Eigen::Matrix3d;

Turn some_turn(bool turned) {
  return turned ? Turn(Eigen::AngleAxisd(0.83, Vec(1, -2, 0.7).normalized())) : Turn::Identity();
}

/// Shapes of nodes: shifted, then turned.
auto placed(const Turn& turn, const Vec& by) {
  return [=](const Vec& x) { return Vec(turn * (x + by)); };
}

std::string contact(const std::string& kind, Real friction = 0) {
  std::string name = kind == "single"    ? "AUTOMATIC_SINGLE_SURFACE"
                     : kind == "general" ? "AUTOMATIC_GENERAL"
                     : kind == "nodes"   ? "AUTOMATIC_NODES_TO_SURFACE"
                                         : "AUTOMATIC_SURFACE_TO_SURFACE";
  std::string sides = kind == "single" || kind == "general" ? "0" : "1,2,3,3";
  return fmt::format("*CONTACT_{}\n{}\n{:g},{:g}\n\n{}", name, sides, friction, friction,
                     kind == "soft 1"   ? "1\n"
                     : kind == "soft 2" ? "2,,,,35\n"
                                        : "");
}

std::string part(int id, bool rigid) {
  return fmt::format("*PART\nblock\n{0},1,{0}\n*MAT_{1}\n{0},1000.0,1e7,0.3\n{2}", id,
                     rigid ? "RIGID" : "ELASTIC", rigid ? "1,7,7\n" : "");
}

std::string along(const Vec& v, const std::string& card) {
  return fmt::format(fmt::runtime(card), v[0], v[1], v[2]);
}

std::string moving(const Vec& v) {
  return along(v, "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,{:.16g},{:.16g},{:.16g}\n0\n");
}

/// A body force; a factor of 0 counts as 1.
std::string weight(const Vec& g) {
  std::string out = "*DEFINE_CURVE\n9\n0,1\n9,1\n";
  for (Eigen::Index k = 0; k < 3; ++k)
    if (g[k] != 0) out += fmt::format("*LOAD_BODY_{}\n9,{:.16g}\n", "XYZ"[k], g[k]);
  return out;
}

/// Largest force of all contacts while the run goes on, and the largest change of a velocity of part 1.
struct Felt {
  Real force = 0, change = 0;
};
Felt felt_in(Simulation& s, Real until) {
  const auto reports = s.world().passes.all<const InterfaceReporter>();
  const Nodes& nodes = s.world().nodes;
  std::vector<Vec> v;
  for (Index n = 0; n < nodes.size(); ++n) v.push_back(nodes.v.vec(n));
  Felt out;
  while (s.clock().t < until) {
    s.step(test::do_nothing);
    for (const auto* one : reports) {  // a single surface tells no force, but energies
      const InterfaceForce told = one->report();
      const Real energies = told.energy_stored + told.energy_damping + told.energy_friction;
      out.force = std::max({out.force, told.on_surfa.norm(), energies});
    }
  }
  for (Index n = 0; n < nodes.size(); ++n)
    out.change = std::max(out.change, (nodes.v.vec(n) - v[static_cast<std::size_t>(n)]).norm());
  return out;
}

const std::vector<std::string> kinds{"surfaces", "single", "general", "nodes", "soft 1", "soft 2"};

}  // namespace

// Past a wall, and past its edges, at every small distance.
TEST(ContactBeside, ABlockThatPassesAWallFeelsNothing) {
  int k = 0;
  for (const Real gap : {1e-6, 1e-4, 5e-4, 8e-4, 2e-3})
    for (const bool rigid : {false, true})
      for (const Real aside : {0.0, 0.14}) {
        const std::string& kind = kinds[static_cast<std::size_t>(++k) % kinds.size()];
        const Turn turn = some_turn(k % 3 != 0);
        SolidDeck deck;
        deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1, placed(turn, Vec(gap, aside, 0)));
        deck.block(Vec(0.1, 0.35, 0.5), 1, 3, 8, 2, placed(turn, Vec(-0.1, -0.07, -0.4)));
        deck.cards = "*SECTION_SOLID\n1,1\n" + part(1, false) + part(2, rigid) + contact(kind) +
                     moving(turn * Vec(0, 0, -2));
        const auto s = simulation_of(deck.text(1));
        const Felt felt = felt_in(*s, 0.15);
        EXPECT_EQ(felt.force, 0) << kind << " " << gap << " " << aside;
        EXPECT_LT(felt.change, 1e-12) << kind << " " << gap << " " << aside;
      }
}

// A square peg that goes through a hole of eight blocks with play at its sides.
TEST(ContactBeside, APegGoesThroughItsHole) {
  for (const Real play : {1e-5, 5e-4})
    for (const std::string& kind : kinds) {
      const Turn turn = some_turn(kind != "single");
      SolidDeck deck;
      deck.block(Vec(0.1 - 2 * play, 0.1 - 2 * play, 0.2), 2, 2, 3, 1,
                 placed(turn, Vec(0.1 + play, 0.1 + play, 0.06)));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (i != 1 || j != 1)
            deck.block(Vec(0.1, 0.1, 0.05), 3, 3, 1, 2, placed(turn, Vec(0.1 * i, 0.1 * j, 0)));
      deck.cards = "*SECTION_SOLID\n1,1\n" + part(1, false) + part(2, true) + contact(kind) +
                   moving(turn * Vec(0, 0, -3));
      const auto s = simulation_of(deck.text(1));
      const Felt felt = felt_in(*s, 0.1);
      EXPECT_EQ(felt.force, 0) << kind << " " << play;
      EXPECT_LT(felt.change, 1e-12) << kind << " " << play;
    }
}

// Over a floor of one piece or of three with nodes of their own, of solids that deform or rigid ones: without
// friction at its speed, with friction v^2/(2 mu g). The floor's nodes are level with the block's lower
// edges, or above them by what the weight presses.
TEST(ContactBeside, ABlockSlidesAtItsSpeedOrStopsByFriction) {
  constexpr Real g = 10, v = 1;
  int k = 0;
  for (const Real friction : {0.0, 0.3})
    for (const bool two : {false, true})
      for (const char* kind : {"surfaces", "single", "soft 1", "nodes"}) {
        const Turn turn = some_turn(++k % 2 == 0);
        SolidDeck deck;
        deck.block(Vec(0.2, 0.2, 0.1), 2, 2, 1, 1, placed(turn, Vec::Zero()));
        const std::size_t block = deck.nodes.size();
        const bool rigid = k % 3 != 0;
        const std::vector<Real> seams =
            two ? std::vector<Real>{-0.2, 0.15, 0.4, 0.9} : std::vector<Real>{-0.2, 0.9};
        for (std::size_t m = 0; m + 1 < seams.size(); ++m)
          deck.block(Vec(seams[m + 1] - seams[m], 0.5, 0.1), two ? 2 : 7, 3, 1, 2,
                     placed(turn, Vec(seams[m], -0.15, -0.1)));
        deck.node_set(7, [&](const Vec& x) { return (turn.transpose() * x)[2] < -0.05; });
        deck.cards += "*SECTION_SOLID\n1,1\n" + part(1, false) + part(2, rigid) + contact(kind, friction) +
                      (rigid ? "" : "*BOUNDARY_SPC_SET\n7,0,1,1,1\n") + moving(turn * Vec(v, 0, 0)) +
                      "*DAMPING_PART_STIFFNESS\n1,0.1\n" + weight(turn * Vec(0, 0, g));
        const auto s = simulation_of(deck.text(1));
        EXPECT_EQ(s->world().counters.at("initial_penetrations"), 0) << kind;
        const Nodes& nodes = s->world().nodes;
        const auto mean = [&](const Field<Real>& of) {
          Vec sum = Vec::Zero();
          Real m = 0;
          for (Index n = 0; n < static_cast<Index>(block); ++n)
            sum += nodes.m[n] * of.vec(n), m += nodes.m[n];
          return Vec(turn.transpose() * sum / m);
        };
        const Vec start = mean(nodes.x);
        while (s->clock().t < 0.4) s->step(test::do_nothing);
        if (friction == 0)
          // at a seam nodes that bear weight return what they store, m g/2 times their depth
          EXPECT_NEAR(mean(nodes.v)[0], v, (two ? 5e-3 : 1e-3) * v) << kind << " " << two;
        else
          EXPECT_NEAR((mean(nodes.x) - start)[0], v * v / (2 * friction * g),
                      0.01 * v * v / (2 * friction * g))
              << kind << " " << two;
      }
}

// Deeper in the floor than contact has pressed it, from the start on, its front meets no node of the floor.
TEST(ContactBeside, ABlockThatStartsInTheFloorSlidesOn) {
  for (const char* kind : {"surfaces", "single"}) {
    SolidDeck deck;
    deck.block(Vec(0.2, 0.2, 0.1), 2, 2, 1, 1, placed(some_turn(true), Vec(0, 0, -0.001)));
    const std::size_t block = deck.nodes.size();
    deck.block(Vec(1.1, 0.5, 0.1), 7, 3, 1, 2, placed(some_turn(true), Vec(-0.2, -0.15, -0.1)));
    deck.cards = "*SECTION_SOLID\n1,1\n" + part(1, false) + part(2, true) + contact(kind) +
                 moving(some_turn(true) * Vec(1, 0, 0));
    const auto s = simulation_of(deck.text(1));
    const Felt felt = felt_in(*s, 0.4);
    EXPECT_LT(felt.force, 1e-6) << kind;
    EXPECT_LT(felt.change, 1e-6) << kind << " of " << block << " nodes";
  }
}

// A wall that is on a floor of the same body: the block's lower edge is level with the floor, but that
// does not rise in front of it.
TEST(ContactBeside, ABlockOnAFloorMeetsAWallOfTheSameBody) {
  for (const auto& [kind, rows] :
       {std::pair("nodes", 1), {"nodes", 2}, {"surfaces", 1}, {"surfaces", 2}, {"single", 2}}) {
    SolidDeck deck;
    const std::size_t floor =
        deck.block(Vec(0.4, 0.3, 0.1), 4, 3, 1, 2, placed(some_turn(false), Vec(0, 0, -0.1)));
    deck.block(Vec(0.1, 0.06, 0.2), 1, 1, rows, 1, placed(some_turn(false), Vec(0.19, 0.12, 0)));
    const auto top = [&](int i, int j) { return floor + static_cast<std::size_t>(i + 5 * (j + 4)); };
    const std::size_t up = deck.nodes.size() + 1;
    for (const auto& [i, j] : {std::pair(3, 1), {4, 1}, {4, 2}, {3, 2}})
      deck.nodes.emplace_back(0.1 * i, 0.1 * j, 0.1);
    deck.elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", 901, 2, top(3, 1), top(4, 1),
                                 top(4, 2), top(3, 2), up, up + 1, up + 2, up + 3);
    deck.cards =
        "*SECTION_SOLID\n1,1\n" + part(1, false) + part(2, true) + contact(kind) + moving(Vec(1, 0, 0));
    const auto s = simulation_of(deck.text(1));
    EXPECT_EQ(s->world().counters.at("initial_penetrations"), 0) << kind;
    while (s->clock().t < 0.03) s->step(test::do_nothing);
    Real momentum = 0, mass = 0;
    for (std::size_t n = floor + 39; n < floor + 39 + 4 * (static_cast<std::size_t>(rows) + 1); ++n) {
      const auto k = static_cast<Index>(n);
      momentum += s->world().nodes.m[k] * s->world().nodes.v.vec(k)[0], mass += s->world().nodes.m[k];
    }
    // of one row the lower edge alone meets the wall, and the block turns over it
    EXPECT_LT(momentum / mass, rows == 1 ? 0.5 : -0.5) << kind << " " << rows;
  }
}

// A block that lands on the rim of a floor with 6 % of its width is held there, whatever else lies on that
// floor.
TEST(ContactBeside, WhatLiesElsewhereDoesNotTakeARimAway) {
  for (const bool heavy : {false, true}) {
    SolidDeck deck;
    deck.block(Vec(0.4, 0.1, 0.1), 4, 1, 1, 2, placed(some_turn(false), Vec(0, 0, -0.1)));
    const std::size_t first = deck.nodes.size();
    deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 1, placed(some_turn(false), Vec(0.394, 0, 0.02)));
    if (heavy) deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 3, placed(some_turn(false), Vec(0.13, 0, 0)));
    deck.cards = "*SECTION_SOLID\n1,1\n" + part(1, false) + part(2, true) +
                 "*PART\nheavy\n3,1,3\n*MAT_ELASTIC\n3,1e5,1e7,0.3\n" + contact("single") +
                 moving(Vec(0, 0, -2)) + weight(Vec(0, 0, 50));
    const auto s = simulation_of(deck.text(1));
    Real highest = -1e3;
    while (s->clock().t < 0.03) {
      s->step(test::do_nothing);
      for (std::size_t n = first; n < first + 8; ++n)
        highest = std::max(highest, s->world().nodes.v.vec(static_cast<Index>(n))[2]);
    }
    EXPECT_GT(highest, 0.5) << "its rim bounces, heavy " << heavy;
  }
}

}  // namespace contact_beside_test
