// *TERMINATION_NODE, _BODY, _DELETED_SOLIDS: runs end in the step in which it happens.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "joint_decks.hpp"
#include "state/ending.hpp"

using namespace courant;
using test::do_nothing;
using test::JointDeck;
using test::simulation_of;
using test::SolidDeck;

namespace {

/// Time at which some criterion ends the run, and why; the end time and nothing if none does.
std::pair<Real, std::string> end_of(Simulation& s, Real end) {
  const auto endings = s.world().passes.all<const Ending>();
  while (s.clock().t < end) {
    for (const Ending* ending : endings)
      if (const auto why = ending->ended(s.world(), s.clock())) return {s.clock().t, *why};
    s.step(do_nothing);
  }
  return {end, ""};
}

bool has(const std::string& text, const char* what) {
  return text.find(what) != std::string::npos;
}

/// What is said of a deck that may not be built.
std::string said_of(const std::string& text) {
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text](const std::string&) { return text; };
  Simulation::build("test.k", options, diagnostics);
  return diagnostics.text();
}

/// A body thrown up with 3 along z and 1 along x; its part is 1.
std::string thrown(const std::string& cards) {
  JointDeck deck;
  deck.body({.x = {0.5, 0, 0}, .v = {1, 0, 3}});
  deck.gravity(10);
  deck.more += cards;
  return deck.text(1);
}

}  // namespace

// z = 3 t - 5 t^2 comes to 0.4 at 0.2 and to -0.8 at 0.8; the distance to 0.5 at 0.171...
TEST(Endings, ABodyHasMovedSoFar) {
  const struct {
    const char* card;
    Real at;
    const char* why;
  } cases[] = {{"1,3,0.4", 0.2, "along z: MAXC"},
               {"1,3,,-0.8", 0.8, "along z: MINC"},
               {"1,1,0.25,-9", 0.25, "along x: MAXC"}};
  for (const auto& one : cases) {
    auto s = simulation_of(thrown(std::string("*TERMINATION_BODY\n") + one.card + "\n"));
    const auto [t, why] = end_of(*s, 1);
    EXPECT_GE(t, one.at - 1e-9) << one.card;
    EXPECT_LT(t, one.at + 2 * s->clock().dt_old) << one.card;
    EXPECT_TRUE(has(why, one.why)) << why;
  }
  auto s = simulation_of(thrown("*TERMINATION_BODY\n1,4,0.5\n"));
  const auto [t, why] = end_of(*s, 1);
  const Real z = 3 * t - 5 * t * t;
  EXPECT_NEAR(std::hypot(t, z), 0.5, 4 * s->clock().dt_old);
  EXPECT_TRUE(has(why, "has moved by")) << why;
  auto never = simulation_of(thrown("*TERMINATION_BODY\n1,3,0.46\n1,3,0.0,-2.1\n1,2,1e-3,-1e-3\n"));
  EXPECT_EQ(end_of(*never, 1).second, "") << "its height is 0.45";
}

TEST(Endings, ANodeHasComeToACoordinate) {
  // node 1 of the cube around the centre is 0.01 below and left of it
  auto s = simulation_of(thrown("*TERMINATION_NODE\n1,3,0.39\n1,3,,-0.5\n"));
  const auto [t, why] = end_of(*s, 1);
  EXPECT_NEAR(t, 0.2, 2 * s->clock().dt_old);
  EXPECT_TRUE(has(why, "node 1: z = ") && has(why, "MAXC")) << why;
  auto down = simulation_of(thrown("*TERMINATION_NODE\n1,3,,-0.81\n"));
  EXPECT_NEAR(end_of(*down, 1).first, 0.8, 2e-3);
}

TEST(Endings, WhatCannotBeIsRefused) {
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_NODE\n1,3,-0.1\n")), "already at the start"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_NODE\n1,4,1.0\n")), "'4' is not supported"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_NODE\n77,1,1.0\n")), "node 77 belongs to no element or body"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_BODY\n2,1,1.0\n")), "part 2"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_BODY\n1,1,-1.0\n")), "the body is there at the start"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_BODY\n1,1\n")), "without bounds it does nothing"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_BODY\n1,4,1.0,-2.0\n")), "has no meaning for STOP 4"));
  EXPECT_TRUE(has(said_of(thrown("*TERMINATION_DELETED_SOLIDS\n1,1\n")), "part 1 has 0 solids"));
}

// Three cubes are pulled with 0.1, 0.2 and 0.3 and fail at a strain of 0.05, the quickest first.
TEST(Endings, SoManySolidsAreDeleted) {
  for (const int nds : {1, 2, 3}) {
    SolidDeck deck;
    deck.cards = fmt::format(
        "*PART\nbar\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E9,0.0\n*MAT_ADD_EROSION\n1\n"
        ",,,0.05\n*DEFINE_CURVE\n9\n0.0,0.1\n9.0,0.1\n*TERMINATION_DELETED_SOLIDS\n1,{}\n",
        nds);
    for (const int k : {1, 2, 3}) {
      deck.block({1, 1, 1}, 1, 1, 1, 1, [&](const Vec& x) { return Vec(x + Vec(2 * k, 0, 0)); });
      deck.node_set(k, [&](const Vec& x) { return std::abs(x[0] - 2 * k - 0.5) < 1 && x[2] > 0.5; });
      deck.node_set(10 + k, [&](const Vec& x) { return std::abs(x[0] - 2 * k - 0.5) < 1 && x[2] < 0.5; });
      deck.cards += fmt::format(
          "*BOUNDARY_PRESCRIBED_MOTION_SET\n{},3,0,9,{}\n*BOUNDARY_SPC_SET\n{},0,1,1,1\n", k, k, 10 + k);
    }
    auto s = simulation_of(deck.text(1));
    const auto [t, why] = end_of(*s, 1);
    EXPECT_NEAR(t, std::expm1(0.05) / (0.1 * (4 - nds)), 5e-3) << nds;
    EXPECT_TRUE(has(why, fmt::format("{} elements are deleted, NDS = {}", nds, nds).c_str())) << why;
  }
}
