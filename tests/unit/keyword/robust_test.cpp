// Input of any kind takes bounded time and memory, and its messages can be read.
#include <gtest/gtest.h>

#include <ctime>

#include "../../sanitized.hpp"
#include "decks_in_memory.hpp"
#include "keyword/conversion.hpp"
#include "keyword/registry.hpp"
#include "model/build_model.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

struct TimedRead {
  Diagnostics diagnostics;
  Model model;
  double seconds = 0;  ///< of processor time
};

TimedRead timed_read(const std::string& text) {
  const ReadOptions options = in_memory(text);
  TimedRead out;
  const std::clock_t begin = std::clock();
  const Deck deck = read_deck("deck.k", options, out.diagnostics);
  if (out.diagnostics.ok()) out.model = build_model(deck, out.diagnostics);
  out.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return out;
}

std::string repeated(const std::string& text, std::size_t bytes) {
  std::string out;
  while (out.size() + text.size() <= bytes) out += text;
  return out;
}

std::string nodes(int count) {
  std::string out = "*NODE\n";
  for (int n = 1; n <= count; ++n) out += std::to_string(n) + ",0\n";
  return out;
}

// s. All below take a few hundredths; instructions of the sanitizers make that 10 to 60 times as slow.
constexpr double soon = test::address_sanitizer ? 20.0 : 1.0;

}  // namespace

TEST(Robust, ManyWarningsAreCounted) {
  Diagnostics diagnostics;
  for (int k = 0; k < 5000; ++k) diagnostics.warning({"deck.k", k + 1, 0}, "odd");
  diagnostics.error({"deck.k", 1, 1}, "wrong");
  EXPECT_EQ(diagnostics.warnings(), 5000);
  EXPECT_EQ(diagnostics.errors(), 1);
  ASSERT_EQ(diagnostics.all().size(), 102u);
  EXPECT_EQ(diagnostics.all()[100].text(), "deck.k: note: 4900 more warnings are not shown");
  EXPECT_EQ(diagnostics.all()[101].text(), "deck.k:1:1: error: wrong");
}

TEST(Robust, MessagesHoldNoControlCharactersAndEnd) {
  Diagnostics diagnostics;
  diagnostics.error({"de\x1b[2Jck.k", 1, 1}, "got '\x1b[31m\x7f'", std::string(5000, 'x'));
  diagnostics.error({"deck.k", 1, 1}, std::string(499, 'x') + "\xC3\xA4");  // not within a letter
  diagnostics.error({"deck.k", 1, 1}, std::string(3000, 'x') + "\n" + "said by another program");
  EXPECT_EQ(diagnostics.all()[0].where.file, "de?[2Jck.k");
  EXPECT_EQ(diagnostics.all()[0].message, "got '?[31m?'");
  EXPECT_EQ(diagnostics.all()[0].hint, std::string(500, 'x') + "...");
  EXPECT_EQ(diagnostics.all()[1].message, std::string(499, 'x') + "...");
  EXPECT_EQ(diagnostics.all()[2].message.size(), 3001u + 23u);
}

TEST(Robust, OffsetsStopShortOfTheEndOfIds) {
  IdOffsets offsets;
  offsets.node = 9'000'000'000'000'000'000;
  EXPECT_EQ(offsets.shifted(IdSpace::node, 5), Id(1) << 62);
  EXPECT_EQ(offsets.shifted(IdSpace::node, -5), -(Id(1) << 62));
  EXPECT_EQ(offsets.shifted(IdSpace::node, 0), 0);
  offsets.node = 100;
  EXPECT_EQ(offsets.shifted(IdSpace::node, 5), 105);
  EXPECT_EQ(offsets.shifted(IdSpace::node, -5), -105);
}

TEST(Robust, OptionsStandInAnyOrder) {
  const KeywordIndex index;
  for (const char* name : {"BOUNDARY_SPC_SET_ID", "BOUNDARY_SPC_ID_SET"})
    EXPECT_TRUE(index.match(name).id) << name;
  for (const char* name : {"DEFINE_BOX_TITLE", "DEFINE_TITLE_BOX"})
    EXPECT_TRUE(index.match(name).title) << name;
  for (const char* name : {"DEFINE_BOX_ID", "DEFINE_BOX_TITLE_TITLE", "DEFINE_BOX_MPP", "_ID", "TITLE_ID", "",
                           "ID", "_", "__TITLE_"})
    EXPECT_LT(index.match(name).keyword, 0) << name;
}

TEST(Robust, BlankLinesTakeTimeInProportion) {
  const TimedRead r =
      timed_read("*KEYWORD\n*DEFINE_CURVE\n1\n" + std::string(60000, '\n') + "1.0,2.0\n*END\n");
  EXPECT_LT(r.seconds, soon);
}

TEST(Robust, UnknownKeywordsTakeTimeInProportion) {
  EXPECT_LT(timed_read("*KEYWORD\n" + repeated("*DATABASE_X\n", 60000) + "*END\n").seconds, soon);
  EXPECT_LT(
      timed_read("*KEYWORD\n" + repeated("*" + std::string(20000, 'Q') + "\n", 60000) + "*END\n").seconds,
      soon);
}

TEST(Robust, NamesOfAWholeLineTakeTimeInProportion) {
  const std::string name(20000, 'a');
  EXPECT_LT(timed_read("*KEYWORD\n*PARAMETER\nR" + name + ",1.0\n*NODE\n" + "1,&b" + name + "\n1,&c" + name +
                       "\n*END\n")
                .seconds,
            soon);
}

TEST(Robust, RangesOfParticlesEndAtTheNodes) {
  const TimedRead r = timed_read("*KEYWORD\n" + nodes(4000) + "*PART\n\n1,1,1\n*ELEMENT_SPH\n" +
                                 repeated("1,1,1.0,4000\n", 30000) + "*END\n");
  EXPECT_FALSE(r.diagnostics.ok());
  EXPECT_LE(r.model.sph.size(), 8000u);
  EXPECT_LT(r.seconds, soon);
}

TEST(Robust, RangesOfSetsMayOverlap) {
  const TimedRead r =
      timed_read("*KEYWORD\n" + nodes(4000) + "*SET_NODE_LIST_GENERATE\n1\n" +
                 repeated("1,9999,1,9999,1,9999,1,9999\n", 30000) + "*CONTROL_TERMINATION\n1.0\n*END\n");
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(r.model.node_sets.at(1).size(), 4000u);
  EXPECT_LT(r.seconds, soon);
}

TEST(Robust, RangesInStepsMayOverlap) {
  const TimedRead r = timed_read("*KEYWORD\n" + nodes(4000) + "*SET_NODE_LIST_GENERATE_INCREMENT\n1\n" +
                                 repeated("1,9999,1\n", 3000) + "*CONTROL_TERMINATION\n1.0\n*END\n");
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(r.model.node_sets.at(1).size(), 4000u);
  EXPECT_LT(r.seconds, soon);
}

TEST(Robust, SetsMayBeNamedOften) {
  const TimedRead r = timed_read("*KEYWORD\n" + nodes(2000) +
                                 "*PART\n\n1,1,1\n*ELEMENT_SPH\n1,1,1.0,2000\n*SET_NODE_LIST_GENERATE\n"
                                 "1\n1,2000\n*DATABASE_HISTORY_SPH_SET\n" +
                                 repeated("1,1,1,1,1,1,1,1\n", 40000) + "*CONTROL_TERMINATION\n1.0\n*END\n");
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(r.model.output.history_sph.size(), 2000u);
  EXPECT_LT(r.seconds, soon);
}

TEST(Robust, VelocitiesOfManyPartsTakeTimeInProportion) {
  std::string text = "*KEYWORD\n" + nodes(800) + "*PART\n";
  for (int k = 1; k <= 800; ++k) text += "\n" + std::to_string(k) + ",1,1\n";
  text += "*ELEMENT_SPH\n";
  for (int k = 1; k <= 800; ++k) text += std::to_string(k) + "," + std::to_string(k) + ",1.0\n";
  text += "*SET_PART_LIST\n1\n";
  for (int k = 1; k <= 800; ++k) text += std::to_string(k) + (k % 8 == 0 ? "\n" : ",");
  text +=
      "*INITIAL_VELOCITY_GENERATION\n" + repeated("1,1\n0\n", 20000) + "*CONTROL_TERMINATION\n1.0\n*END\n";
  const TimedRead r = timed_read(text);
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_LT(r.seconds, soon);
}

TEST(Robust, FilesThatAreReadOftenTakeBoundedTime) {
  const Files files = {{"deck.k", "*KEYWORD\n*INCLUDE\n" + repeated("a\n", 20000) + "*END\n"},
                       {"a", "*COMMENT\n" + repeated("x\n", 40000)}};
  const ReadOptions options = in_memory(files);
  Diagnostics diagnostics;
  const std::clock_t begin = std::clock();
  const Deck deck = read_deck("deck.k", options, diagnostics);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, soon);
  ASSERT_EQ(diagnostics.errors(), 1);
  EXPECT_NE(diagnostics.text().find("*INCLUDE: the same files are read more than 500 times"),
            std::string::npos);
  ASSERT_GT(deck.files.size(), 500u);
  EXPECT_EQ(deck.files[1].source, deck.files[500].source);  // one text for all
}

TEST(Robust, AFileReadAgainBeginsInStandardFormat) {
  const Files files = {
      {"deck.k", "*KEYWORD\n*INCLUDE\na\na\n*END\n"},
      {"a",
       "*NODE\n       1             1.0\n*KEYWORD LONG=Y\n*NODE\n                   2                 "
       "2.0\n*END\n"}};
  Diagnostics diagnostics;
  const Deck deck = read_deck("deck.k", in_memory(files), diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.all<NodeCard>().size(), 4u);
  for (const NodeCard& node : deck.all<NodeCard>()) EXPECT_EQ(node.x, static_cast<Real>(node.nid));
}

}  // namespace courant
