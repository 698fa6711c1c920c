// *CHANGE_VELOCITY and *DELETE: what changes once when a run goes on from a restart file.
#include <gtest/gtest.h>

#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;

namespace changes_at_restart_test {

using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;
using test::state_of;

namespace {

/// Two blocks of parts 1 and 2, apart from each other, that stretch.
std::string blocks(const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(0.4, 0.2, 0.2), 4, 2, 2, 1);
  deck.block(Vec(0.4, 0.2, 0.2), 4, 2, 2, 2, [](const Vec& x) { return Vec(x + Vec(0, 1, 0)); });
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.4 - 1e-9; });
  deck.cards +=
      "*PART\nfirst\n1,1,1\n*PART\nsecond\n2,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n"
      "*CONTROL_TIMESTEP\n0.0,0.1\n*INITIAL_VELOCITY\n1\n1.0,0.5,0.0\n*SET_SOLID_GENERATE\n2\n17,32\n" +
      cards;
  return deck.text(1);
}

void steps(Simulation& s, int count) {
  for (int k = 0; k < count; ++k) s.step(do_nothing);
}

std::unique_ptr<Simulation> taken_up(Simulation& before, const std::string& text) {
  SavedState state;
  Archive save = Archive::saver(state);
  before.keep(save);
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text](const std::string&) { return text; };
  auto after = Simulation::build("test.k", options, diagnostics, &before.record());
  EXPECT_TRUE(after) << diagnostics.text();
  if (!after) return after;
  Archive load = Archive::loader(state);
  after->keep(load);
  return after;
}

std::unique_ptr<Simulation> run_so_far(const std::string& cards = "") {
  auto s = simulation_of(blocks(cards));
  test::start_ledger(*s);
  steps(*s, 40);
  return s;
}

}  // namespace

// Cards that wait for a restart change nothing before it, and a restart that changes nothing has the same
// bits.
TEST(ChangesAtRestart, DoNothingBefore) {
  const std::string cards = "*CHANGE_VELOCITY_ZERO\n*DELETE_PART\n2\n*CHANGE_OUTPUT\n1\n";
  auto plain = run_so_far(), waiting = run_so_far(cards);
  EXPECT_EQ(state_of(plain->world()), state_of(waiting->world()));
  auto again = taken_up(*plain, blocks("*CHANGE_OUTPUT\n1\n*CHANGE_STATUS_REPORT_FREQUENCY\n10\n"));
  steps(*plain, 30), steps(*again, 30);
  EXPECT_EQ(state_of(plain->world()), state_of(again->world()));
}

// All at rest, or only what is not named; and the ledger knows.
TEST(ChangesAtRestart, GiveVelocities) {
  auto before = run_so_far();
  auto zero = taken_up(*before, blocks("*CHANGE_VELOCITY_ZERO\n"));
  auto others =
      taken_up(*before, blocks("*CHANGE_VELOCITY\n1\n3.0,2.0,1.0\n*CHANGE_VELOCITY_NODE\n1,-1.0,0,0\n"));
  auto only = taken_up(*before, blocks("*CHANGE_VELOCITY_ONLY\n1\n3.0,2.0,1.0\n"));
  const Nodes &b = before->world().nodes, &z = zero->world().nodes, &o = others->world().nodes,
              &n = only->world().nodes;
  int named = 0;
  for (Index i = 0; i < b.size(); ++i) {
    const bool in_set = i % 5 == 4;  // the last node of each row
    EXPECT_EQ(z.v.vec(i).norm(), 0);
    const Vec expected(3, 2, 1);
    EXPECT_EQ(n.v.vec(i), in_set ? expected : b.v.vec(i)) << i;
    EXPECT_EQ(o.v.vec(i), i == 0 ? Vec(-1, 0, 0) : in_set ? expected : Vec(Vec::Zero())) << i;
    named += in_set;
  }
  EXPECT_EQ(named, 18);
  auto plain = taken_up(*before, blocks(""));
  for (Simulation* s : {plain.get(), zero.get(), others.get(), only.get()}) {
    steps(*s, 60);
    EXPECT_LT(test::energy_error_of_a_step(*s), 5e-2);
  }
  // once: a run that goes on again does not stop again
  auto third = taken_up(*zero, blocks("*CHANGE_VELOCITY_ZERO\n"));
  steps(*zero, 20), steps(*third, 20);
  EXPECT_EQ(state_of(zero->world()), state_of(third->world()));
  EXPECT_GT(third->world().nodes.v.vec(4).norm(), 0);
}

// What is deleted at the restart has the bits of what *DEFINE_ELEMENT_DEATH deletes at that time; the rest
// moves on as if nothing had happened.
TEST(ChangesAtRestart, DeletePartsAndSets) {
  auto before = run_so_far();
  auto timed = taken_up(*run_so_far("*DEFINE_ELEMENT_DEATH_SOLID_SET\n2,1000.0\n"),
                        blocks("*DEFINE_ELEMENT_DEATH_SOLID_SET\n2,1000.0\n"));
  for (const char* card : {"*DELETE_PART\n2\n", "*DELETE_ELEMENT_SOLID\n2\n"}) {
    auto after = taken_up(*before, blocks(card));
    steps(*after, 30);
    EXPECT_EQ(after->world().counters["deleted_solids"], 16) << card;
    auto death = run_so_far(fmt::format("*DEFINE_ELEMENT_DEATH_SOLID_SET\n2,{:.17g}\n", before->clock().t));
    steps(*death, 30);
    EXPECT_EQ(death->world().counters["deleted_solids"], 16);
    EXPECT_EQ(state_of(after->world()), state_of(death->world())) << card;
    auto third = taken_up(*after, blocks(card));
    steps(*after, 20), steps(*third, 20);
    EXPECT_EQ(state_of(after->world()), state_of(third->world())) << card;
    EXPECT_EQ(third->world().counters["deleted_solids"], 16);
  }
  ASSERT_TRUE(timed);
  auto whole = run_so_far();
  steps(*whole, 30);
  auto after = taken_up(*before, blocks("*DELETE_PART\n2\n"));
  steps(*after, 30);
  for (Index i = 0; i < 45; ++i)
    EXPECT_LT((whole->world().nodes.x.vec(i) - after->world().nodes.x.vec(i)).norm(), 1e-12) << i;
}

}  // namespace changes_at_restart_test
