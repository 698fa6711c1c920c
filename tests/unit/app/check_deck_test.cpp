// What `courant check` says of a deck before, and without, a run.
#include <gtest/gtest.h>

#include "../keyword/decks_in_memory.hpp"
#include "../text.hpp"
#include "app/check/check.hpp"

namespace courant {

namespace {

using test::holds;

TEST(CheckDeck, FilesAreATreeWithTheirPlaces) {
  const ReadDeck read = read_in_memory(in_memory(Files{{"deck.k", "*KEYWORD\n*INCLUDE\na.k\nb.k\n*END\n"},
                                                       {"a.k", "*INCLUDE\nb.k\n"},
                                                       {"b.k", "*TITLE\nb\n"}}));
  const std::string text = files_text(read.deck);
  EXPECT_TRUE(holds(text, "\n  deck.k ")) << text;
  EXPECT_TRUE(holds(text, "\n    a.k ")) << text;
  EXPECT_TRUE(holds(text, "\n      b.k ")) << text;
  EXPECT_TRUE(holds(text, "2 lines, 13 bytes, included by deck.k:3\n")) << text;
  EXPECT_TRUE(holds(text, "2 lines, 9 bytes, included by a.k:2\n")) << text;
}

TEST(CheckDeck, KeywordsWithWhatBecomesOfThem) {
  const ReadDeck read = read_in_memory(in_memory(
      Files{{"deck.k",
             "*KEYWORD\n*NODE\n       1\n       2\n*DATABASE_FSI\n       0.1\n"
             "*AIRBAG_ALE\n         1\n$ comment\n         2\n*AIRBAG_ALE\n*COFFEE_BREAK\n*END\n"}}));
  const std::string text = keywords_text(read.deck);
  EXPECT_TRUE(holds(text, "*NODE                                         1          2  honoured\n")) << text;
  EXPECT_TRUE(holds(text, "*DATABASE_FSI                                 1    1 lines  no effect: output\n"))
      << text;
  EXPECT_TRUE(holds(text, "*AIRBAG_ALE                                   2    2 lines  REFUSED: airbags\n"))
      << text;
  EXPECT_TRUE(holds(text, "*COFFEE_BREAK                                 1          -  REFUSED: unknown\n"))
      << text;
}

TEST(CheckDeck, MeshIsCountedWhateverElseIsWrong) {
  const ReadDeck read = read_in_memory(in_memory(
      Files{{"deck.k",
             "*KEYWORD\n*NODE\n       1             1.0             2.0\n       2             4.0\n"
             "*ELEMENT_SPH\n       1       7             2.5       4\n       5       7            -0.5\n"
             "*ELEMENT_SEATBELT\n       1\n       2\n*PART\nwater\n         7         1         x\n"
             "*PART\nlonely\n         8         1         1\n*END\n"}}));
  EXPECT_FALSE(read.diagnostics.ok());
  const std::string text = mesh_text(gather_facts(read.deck));
  EXPECT_TRUE(holds(text, "  nodes                            2  from (1, 0, 0), size 3 x 2 x 0 [L]\n"))
      << text;
  EXPECT_TRUE(holds(text, "  SPH particles                    5  given mass 10 [M]  given volume 0.5 [L3"))
      << text;
  EXPECT_TRUE(holds(text, "  seat belts                       2  (lines that are not read)\n")) << text;
  EXPECT_TRUE(holds(text, "7  water ")) << text;
  EXPECT_TRUE(holds(text, "SPH particles 5\n")) << text;
  EXPECT_TRUE(holds(text, "8  lonely                                 1        1        0  none\n")) << text;
}

TEST(CheckDeck, NeedsAreWhatIsRefusedAndWhatIsMissing) {
  const ReadDeck read = read_in_memory(in_memory(
      Files{{"deck.k", "*KEYWORD\n*NODE\n       1\n*AIRBAG_ALE\n*AIRBAG_LINEAR_FLUID\n*EOS_JWLB\n*END\n"}}));
  EXPECT_EQ(needs_text(read.deck, gather_facts(read.deck)),
            "What a run would need\n"
            "  not supported: airbags: *AIRBAG_ALE, *AIRBAG_LINEAR_FLUID\n"
            "  not supported: this equation of state (EOS_014): *EOS_JWLB\n"
            "  not in the deck: *ELEMENT_SPH or *ELEMENT_SOLID (particles, or solids)\n"
            "  not in the deck: *PART (what the elements are made of)\n"
            "  not in the deck: *SECTION_SPH (smoothing length)\n"
            "  not in the deck: *MAT_NULL (density of the particles' material)\n"
            "  not in the deck: *CONTROL_TERMINATION (end time)\n");
}

TEST(CheckDeck, ShellsNeedNoParticles) {
  const ReadDeck read = read_in_memory(in_memory(
      Files{{"deck.k",
             "*KEYWORD\n*NODE\n       1\n*PART\nstrip\n         1         1         1\n*AIRBAG_ALE\n"
             "*ELEMENT_SHELL\n       1       1       1       1       1       1\n*CONTROL_TERMINATION\n       "
             "1.0\n*END\n"}}));
  EXPECT_EQ(needs_text(read.deck, gather_facts(read.deck)),
            "What a run would need\n  not supported: airbags: *AIRBAG_ALE\n");
}

TEST(CheckDeck, NeedsOfSolidsAreNotThoseOfParticles) {
  const ReadDeck read = read_in_memory(in_memory(Files{
      {"deck.k",
       "*KEYWORD\n*NODE\n       1\n*PART\nblock\n         1         1         1\n*AIRBAG_ALE\n"
       "*ELEMENT_SOLID\n       1       1       1       1       1       1       1       1       1       1\n"
       "*CONTROL_TERMINATION\n       1.0\n*END\n"}}));
  EXPECT_EQ(needs_text(read.deck, gather_facts(read.deck)),
            "What a run would need\n"
            "  not supported: airbags: *AIRBAG_ALE\n"
            "  not in the deck: *SECTION_SOLID (formulation of the solids)\n"
            "  not in the deck: *MAT_ELASTIC (what the solids are made of)\n");
}

TEST(CheckDeck, UnusedIdsAreListedWithTheirPlaces) {
  const ReadDeck read =
      read_in_memory(in_memory(Files{{"deck.k", "*KEYWORD\n*DEFINE_BOX\n         3\n*END\n"}}));
  UnusedIds unused;
  EXPECT_EQ(unused_text(read.deck, unused), "");
  Entry entry;
  entry.file = 0, entry.line = 3;
  unused.named.push_back({IdSpace::box, 3, entry});
  for (Id id = 1; id <= 30; ++id) unused.nodes.push_back(id);
  const std::string text = unused_text(read.deck, unused);
  EXPECT_TRUE(holds(text, "  box                      3 (deck.k:3)\n")) << text;
  EXPECT_TRUE(holds(text, "  30 nodes                 1, 2, 3,")) << text;
  EXPECT_TRUE(holds(text, "20,\n                           ... 10 more\n")) << text;
}

}  // namespace

}  // namespace courant
