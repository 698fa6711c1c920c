// What a deck keeps in memory, and for how long.
#include "keyword/deck.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "model/cards.hpp"

namespace courant {

namespace {

Deck deck_of(const std::string& text) {
  const auto path =
      std::filesystem::temp_directory_path() / ("courant_deck_test_" + std::to_string(::getpid()) + ".k");
  std::ofstream(path) << text;
  Diagnostics diagnostics;
  Deck deck = read_deck(path.string(), {}, diagnostics);
  std::filesystem::remove(path);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  return deck;
}

std::string node_lines(int first, int count) {
  std::string text = "*NODE\n";
  for (int k = first; k < first + count; ++k) text += std::to_string(k) + ", 1.0, 2.0, 3.0\n";
  return text;
}

TEST(Deck, KeepsTheLastOfACardThatCountsOnce) {
  const ReadDeck read = read_in_memory(
      in_memory("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*DATABASE_GLSTAT\n0.1\n*DATABASE_MATSUM\n0.2\n"
                "*CONTROL_TERMINATION\n3.0\n*DATABASE_GLSTAT\n0.1\n*END\n"));
  ASSERT_EQ(read.deck.all<ControlTerminationCard>().size(), 1u);
  EXPECT_EQ(read.deck.last<ControlTerminationCard>()->endtim, 3.0);
  EXPECT_EQ(read.deck.all<DatabaseAsciiCard>().size(), 2u);
  EXPECT_EQ(read.diagnostics.warnings(), 1) << read.diagnostics.text();  // none where both say the same
  EXPECT_TRUE(read.diagnostics.ok());
}

}  // namespace

TEST(Deck, AllocatesATableOnce) {
  const Deck deck = deck_of("*KEYWORD\n" + node_lines(1, 1000) + "*END\n");
  EXPECT_EQ(deck.all<NodeCard>().size(), 1000u);
  EXPECT_EQ(deck.all<NodeCard>().capacity(), 1000u);
}

TEST(Deck, DoesNotMoveATableForEveryShortBlock) {
  std::string text = "*KEYWORD\n";
  for (int k = 0; k < 200; ++k) text += node_lines(3 * k + 1, 3);
  const Deck deck = deck_of(text + "*END\n");
  ASSERT_EQ(deck.all<NodeCard>().size(), 600u);
  for (int k = 0; k < 600; ++k) EXPECT_EQ(deck.all<NodeCard>()[static_cast<std::size_t>(k)].nid, k + 1);
  EXPECT_EQ(deck.all<NodeCard>().capacity(), 768u);  // 3 x 2^8: doubled, not enlarged block by block
}

TEST(Deck, NamesTheColumnUntilItsTextIsGivenBack) {
  Deck deck = deck_of("*KEYWORD\n" + node_lines(1, 2) + "*END\n");
  const NodeCard card = deck.all<NodeCard>()[1];
  EXPECT_EQ(deck.where(card, "Y").line, 4);
  EXPECT_EQ(deck.where(card, "Y").column, 9);
  deck.release_sources();
  EXPECT_EQ(deck.where(card, "Y").line, 4);
  EXPECT_EQ(deck.where(card, "Y").column, 1);
  EXPECT_EQ(deck.describe(card, "Y"), "*NODE field 3 (Y, y coordinate [L])");
  deck.release<NodeCard>();
  EXPECT_TRUE(deck.all<NodeCard>().empty());
}

}  // namespace courant
