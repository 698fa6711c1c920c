// `courant check` from end to end, on decks in memory.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "../keyword/decks_in_memory.hpp"
#include "../text.hpp"
#include "app/check/check.hpp"

namespace courant {

namespace {

using test::holds;

/// 4 x 4 particles, 0.1 apart; `more` goes before *END, `sph` are the fields of *CONTROL_SPH.
std::string deck(const std::string& more = "",
                 const std::string& sph = "         1         0    1.0E20         2") {
  std::string nodes, elements;
  for (int i = 0; i < 16; ++i) {
    nodes += fmt::format("{:8}{:16.2f}{:16.2f}\n", i + 1, 0.1 * (i % 4), 0.1 * (i / 4));
    elements += fmt::format("{:8}{:8}{:16}\n", i + 1, 1, 10.0);
  }
  return "*KEYWORD\n*TITLE\na puddle\n*NODE\n" + nodes + "*ELEMENT_SPH\n" + elements +
         "*PART\nwater\n         1         1         1         1\n*SECTION_SPH\n         1       1.2       "
         "1.0       1.0\n"
         "*MAT_NULL\n         1    1000.0   -1.0E20\n*EOS_LINEAR_POLYNOMIAL\n         1       0.0     9.0E5\n"
         "*CONTROL_SPH\n" +
         sph + "\n*CONTROL_TERMINATION\n       1.0\n" + more + "*END\n";
}

CheckResult check(const std::string& text, bool strict = false) {
  return check_deck("deck.k", in_memory(text), strict);
}

TEST(Check, SoundDeckIsShownWithItsNumbers) {
  const CheckResult result = check(deck());
  EXPECT_TRUE(result.sound);
  EXPECT_EQ(result.messages, "");
  EXPECT_TRUE(holds(result.deck, "a puddle\nFiles\n")) << result.deck;
  EXPECT_FALSE(holds(result.deck, "What a run would need")) << result.deck;
  // mass, volume, density, sound speed, spacing, h
  EXPECT_TRUE(holds(result.model,
                    "       1 water                 16 sph         160      0.16      1000        30       "
                    "0.1      0.12\n"))
      << result.model;
  // 0.9 h / c
  EXPECT_TRUE(
      holds(result.model, "First step 0.0036 [T], set by sph 1 of part 1\n  278 steps to ENDTIM = 1 "))
      << result.model;
  EXPECT_EQ(result.verdict, "The deck can be run: 0 errors, 0 warnings\n");
}

TEST(Check, WarningsAreErrorsOnlyWithStrict) {
  const std::string text = deck("*DATABASE_FSI_SENSOR\n       0.1\n");
  EXPECT_TRUE(check(text).sound);
  EXPECT_EQ(check(text).verdict, "The deck can be run: 0 errors, 1 warning\n");
  EXPECT_FALSE(check(text, true).sound);
  EXPECT_EQ(check(text, true).verdict, "0 errors, 1 warning; refused because of --strict\n");
  EXPECT_TRUE(check(deck(), true).sound);
}

TEST(Check, RefusedDeckIsStillCounted) {
  const CheckResult result = check(deck("*AIRBAG_ALE\n         1\n"));
  EXPECT_FALSE(result.sound);
  EXPECT_EQ(result.model, "");
  EXPECT_TRUE(holds(result.deck, "SPH particles                   16  given mass 160 [M]\n")) << result.deck;
  EXPECT_TRUE(holds(result.deck, "What a run would need\n  not supported: airbags: *AIRBAG_ALE\n"))
      << result.deck;
  EXPECT_TRUE(holds(result.deck, "Units: kg-m-s")) << result.deck;
  EXPECT_EQ(result.verdict, "1 error, 0 warnings; the deck cannot be run\n");
}

TEST(Check, FaultOfTheModelIsToldBesideTheReport) {
  const CheckResult result = check(deck("*ELEMENT_SPH\n      99       1            10.0\n"));
  EXPECT_FALSE(result.sound);
  EXPECT_TRUE(holds(result.messages, "node 99 has no coordinates")) << result.messages;
  EXPECT_TRUE(holds(result.deck, "SPH particles                   17 ")) << result.deck;
}

TEST(Check, RunThatCouldNotBeginIsRefused) {
  const CheckResult result =
      check(deck("*DEFINE_BOX\n         5      10.0      11.0      10.0      11.0     -10.0      10.0\n",
                 "         1         5    1.0E20         2"));
  EXPECT_FALSE(result.sound);
  EXPECT_TRUE(holds(result.messages, "deck.k: error: nothing limits the step size")) << result.messages;
}

TEST(Check, MissingDeckHasNothingToShow) {
  const CheckResult result = check_deck("deck.k", in_memory(Files{}), false);
  EXPECT_FALSE(result.sound);
  EXPECT_TRUE(holds(result.messages, "deck.k: error: cannot read the deck"));
}

}  // namespace

}  // namespace courant
