// *DEFINE_ELEMENT_DEATH: solids and shells that are deleted at a time.
#include <gtest/gtest.h>

#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;

namespace element_death_test {
namespace {

const std::string gravity = "*LOAD_BODY_Z\n9,10.0\n*DEFINE_CURVE\n9\n0.0,1.0\n9.0,1.0\n";
const std::string solids = "*SECTION_SOLID\n1,1\n*PART\ncolumn\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.0\n";

/// Four solids that hang on each other, the uppermost, the fourth, held; 0.1 each.
SolidDeck column(const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(0.1, 0.1, 0.4), 1, 1, 4, 1);
  deck.cards = solids + gravity + cards;
  deck.node_set(1, [](const Vec& x) { return x[2] > 0.4 - 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0,1,1,1\n";
  return deck;
}

Real momentum_below(const World& world, Real z) {
  Real out = 0;
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (world.nodes.x.vec(n)[2] < z) out += world.nodes.m[n] * world.nodes.v.vec(n)[2];
  return out;
}

std::vector<Id> dead_of(const ElementGroup& group) {
  std::vector<Id> out;
  const auto* eroded = shared_fields::eroded.find(group.fields);
  for (Index e = 0; eroded && e < group.size(); ++e)
    if ((*eroded)[e] != 0) out.push_back(group.id[e]);
  return out;
}

}  // namespace

// The third solid goes: what hung below it, with half of its mass, falls by its weight alone.
TEST(ElementDeath, WhatHungOnADeletedSolidFallsFreely) {
  for (const std::string& card : {"*DEFINE_ELEMENT_DEATH_SOLID\n3,0.02\n",
                                  "*DEFINE_ELEMENT_DEATH_SOLID_SET\n5,0.02\n*SET_SOLID\n5\n3\n"}) {
    auto s = simulation_of(column(card).text(1));
    while (s->clock().t < 0.02) {
      EXPECT_TRUE(dead_of(*s->world().groups[0]).empty()) << s->clock().t;
      s->step(do_nothing);
    }
    s->step(do_nothing);
    EXPECT_EQ(dead_of(*s->world().groups[0]), std::vector<Id>{3});
    const auto half = [&] { return s->clock().t - 0.5 * s->clock().dt_old; };
    const Real before = momentum_below(s->world(), 0.25), from = half();
    while (s->clock().t < 0.1) s->step(do_nothing);
    const Real weight = 10 * 2.5;  // of two solids and a half
    EXPECT_NEAR(momentum_below(s->world(), 0.25) - before, -weight * (half() - from), 1e-9 * weight);
  }
}

// The same bits as with FAILTM of *MAT_ADD_EROSION for a part of its own.
TEST(ElementDeath, IsThatOfAMaterialWhereAllOfItsElementsAreNamed) {
  auto named = simulation_of(column("*DEFINE_ELEMENT_DEATH_SOLID\n1,0.02\n2,0.02\n3,0.02\n4,0.02\n").text(1));
  auto all = simulation_of(column("*MAT_ADD_EROSION\n1\n,,,,,,,0.02\n").text(1));
  while (named->clock().t < 0.05) named->step(do_nothing), all->step(do_nothing);
  EXPECT_EQ(dead_of(*named->world().groups[0]).size(), 4u);
  for (Index n = 0; n < named->world().nodes.size(); ++n)
    EXPECT_EQ(named->world().nodes.x.vec(n), all->world().nodes.x.vec(n));
}

TEST(ElementDeath, DeletesShellsOfASet) {
  ShellDeck deck;
  deck.plate(1, 1, 3, 1, 1);
  deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
  deck.cards +=
      "*DEFINE_ELEMENT_DEATH_SHELL_SET\n5,0.002\n*SET_SHELL\n5\n1,2\n*DEFINE_ELEMENT_DEATH_SHELL\n2,0.001\n";
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.0015) s->step(do_nothing);
  EXPECT_EQ(dead_of(*s->world().groups[0]), std::vector<Id>{2}) << "the earlier time counts";
  while (s->clock().t < 0.0025) s->step(do_nothing);
  EXPECT_EQ(dead_of(*s->world().groups[0]), (std::vector<Id>{1, 2}));
}

TEST(ElementDeath, IsTheSameAfterARestartAndOnAnyNumberOfThreads) {
  test::expect_same_bits(column("*DEFINE_ELEMENT_DEATH_SOLID\n3,0.02\n").text(0.05), 200, 100);
}

}  // namespace element_death_test
