// Ids that nothing refers to, with keywords of this test's own: real ones change.
#include <gtest/gtest.h>

#include "../keyword/decks_in_memory.hpp"
#include "keyword/registry.hpp"
#include "model/sets/unused_ids.hpp"

namespace courant {

namespace {

struct Thing : Entry {
  Id id, other;
};
struct ThingUser : Entry {
  Id first, second, set;
  std::vector<Id> nodes;
};
struct ThingRange : Entry {
  Id sid;
  std::vector<Id> ids;
};

const RegisterKeyword<Thing> thing{
    {.names = {"TEST_THING"},
     .purpose = "defines a box and names another",
     .id_space = IdSpace::box,
     .cards = {{.fields = {{"ID", &Thing::id, "-", "box id"},
                           {"OTHER", &Thing::other, "-", "another box", {.refers = IdSpace::box}}}}}}};
const RegisterKeyword<ThingUser> thing_user{
    {.names = {"TEST_THING_USER"},
     .purpose = "names boxes and nodes",
     .cards = {{.fields = {{"FIRST", &ThingUser::first, "-", "a box", {.refers = IdSpace::box}},
                           {"SECOND", &ThingUser::second, "-", "a box", {.refers = IdSpace::box}},
                           {"SET", &ThingUser::set, "-", "a set", {.refers = IdSpace::node_set}}}},
               {.fields = {{"NODES", &ThingUser::nodes, "-", "node ids", {.refers = IdSpace::node}}},
                .optional = true,
                .repeat = true}}}};
const RegisterKeyword<ThingRange> thing_range{
    {.names = {"TEST_THING_GENERATE"},
     .purpose = "names ranges of nodes",
     .id_space = IdSpace::node_set,
     .cards = {{.fields = {{"SID", &ThingRange::sid, "-", "set id"}}},
               {.fields = {{"IDS", &ThingRange::ids, "-", "first, last, ...", {.refers = IdSpace::node}}},
                .repeat = true}}}};

struct ThingIncrement : Entry {
  Id sid;
  std::vector<Id> first, last, step;
};
const RegisterKeyword<ThingIncrement> thing_increment{
    {.names = {"TEST_THING_GENERATE_INCREMENT"},
     .purpose = "names ranges of nodes in steps",
     .id_space = IdSpace::node_set,
     .cards = {{.fields = {{"SID", &ThingIncrement::sid, "-", "set id"}}},
               {.fields = {{"BBEG", &ThingIncrement::first, "-", "first id", {.refers = IdSpace::node}},
                           {"BEND", &ThingIncrement::last, "-", "last id", {.refers = IdSpace::node}},
                           {"INCR", &ThingIncrement::step, "-", "step"}},
                .repeat = true}}}};
struct ThingGeneral : Entry {
  Id sid;
  std::vector<std::string> words;
  std::vector<Id> ids;
};
const RegisterKeyword<ThingGeneral> thing_general{
    {.names = {"TEST_THING_GENERAL"},
     .purpose = "rows whose word tells what their ids number",
     .id_space = IdSpace::node_set,
     .cards = {{.fields = {{"SID", &ThingGeneral::sid, "-", "set id"}}},
               {.fields = {{"OPTION", &ThingGeneral::words, "-", "BOX, NODE, ..."},
                           {"E1", &ThingGeneral::ids, "-", "an id"}},
                .repeat = true}}}};

UnusedIds unused_of(const std::string& text, const std::string& messages = "") {
  Diagnostics diagnostics;
  const Deck deck = read_deck("deck.k", in_memory("*KEYWORD\n" + text + "*END\n"), diagnostics);
  EXPECT_EQ(diagnostics.text(), messages);
  return find_unused_ids(deck);
}

std::vector<Id> boxes(const UnusedIds& unused) {
  std::vector<Id> ids;
  for (const UnusedId& one : unused.named)
    if (one.space == IdSpace::box) ids.push_back(one.id);
  return ids;
}

TEST(UnusedIds, AreThoseThatNoFieldNames) {
  const auto unused =
      unused_of("*TEST_THING\n         1\n         2         3\n         3\n*TEST_THING_USER\n         1\n");
  EXPECT_EQ(boxes(unused), std::vector<Id>{2});
  EXPECT_EQ(unused.named.at(0).entry.line, 4);
  EXPECT_TRUE(unused.any());
}

TEST(UnusedIds, FlaggedOnesAreUsed) {
  EXPECT_FALSE(unused_of("*TEST_THING\n         7\n*TEST_THING_USER\n        -7\n").any());
}

TEST(UnusedIds, AnIdOfAnotherSpaceIsNoUse) {
  const auto unused = unused_of(
      "*TEST_THING\n         5\n*TEST_THING_USER\n         0         0\n         5\n*NODE\n       5\n");
  EXPECT_EQ(boxes(unused), std::vector<Id>{5});
  EXPECT_TRUE(unused.nodes.empty());
}

TEST(UnusedIds, ParticlesUseTheirNodes) {
  const auto unused = unused_of(
      "*NODE\n       1\n       2\n       3\n       4\n       9\n"
      "*ELEMENT_SPH\n       1       1             1.0\n       3       1             1.0       4\n");
  EXPECT_EQ(unused.nodes, (std::vector<Id>{2, 9}));
}

TEST(UnusedIds, ElementsThatAreNotReadMayUseAnyNode) {
  EXPECT_TRUE(unused_of("*NODE\n       5\n").any());
  EXPECT_FALSE(unused_of("*NODE\n       5\n*ELEMENT_TSHELL\n       1       1       5\n",
                         "deck.k:4:1: error: *ELEMENT_TSHELL: thick shell elements are not supported\n")
                   .any());
}

TEST(UnusedIds, RangesUseAllBetween) {
  const auto unused = unused_of(
      "*NODE\n       1\n       2\n       3\n       4\n 5000000\n"
      "*TEST_THING_GENERATE\n         8\n         2         3   4000000   6000000\n");
  EXPECT_EQ(unused.nodes, (std::vector<Id>{1, 4}));
  ASSERT_EQ(unused.named.size(), 1u);
  EXPECT_EQ(unused.named[0].space, IdSpace::node_set);
}

TEST(UnusedIds, ColumnsOfFirstAndLastIdsAreRanges) {
  const auto unused = unused_of(
      "*NODE\n       1\n       2\n       7\n      20\n      25\n      31\n"
      "*TEST_THING_GENERATE_INCREMENT\n         8\n         2         7         5\n        20        30      "
      "   1\n");
  EXPECT_EQ(unused.nodes, (std::vector<Id>{1, 31}));
}

TEST(UnusedIds, RowsWithAWordMayUseAnything) {
  const auto unused = unused_of(
      "*TEST_THING\n         5\n         6\n*NODE\n       3\n       4\n"
      "*TEST_THING_GENERAL\n         8\nBOX                5\nNODE               4\n");
  EXPECT_EQ(boxes(unused), std::vector<Id>{6});
  EXPECT_EQ(unused.nodes, std::vector<Id>{3});
}

TEST(UnusedIds, ASetOfAllNodesUsesThemAll) {
  EXPECT_TRUE(unused_of("*NODE\n       3\n     400\n*TEST_THING_GENERAL\n         8\nALL\n").nodes.empty());
}

}  // namespace

}  // namespace courant
