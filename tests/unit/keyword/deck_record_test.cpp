#include "keyword/deck_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "decks_in_memory.hpp"

namespace courant {
namespace {

const std::string first =
    "*KEYWORD\n*MAT_NULL\n1,1000.\n*SECTION_SPH\n1,1.2\n*DEFINE_CURVE\n1\n0.,1.\n1.,2.\n*SET_NODE_LIST\n4\n1,"
    "2,3\n"
    "*CONTROL_TERMINATION\n1.\n*DATABASE_GLSTAT\n0.1\n*CONTROL_SPH\n1\n*END\n";

Deck read(const std::string& text) {
  Diagnostics diagnostics;
  Deck deck = read_deck("deck.k", in_memory(text), diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  return deck;
}

struct Outcome {
  std::vector<std::string> allowed;
  std::string errors;
};

/// `first` with one text instead of another.
Outcome changed(const std::string& from, const std::string& to) {
  std::string text = first;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const Deck deck = read(text);
  Diagnostics diagnostics;
  Outcome out{compare_decks(record_deck(read(first)), deck, record_deck(deck), diagnostics), ""};
  out.errors = diagnostics.text();
  return out;
}

using Lines = std::vector<std::string>;

TEST(DeckRecord, TheSameDeckDiffersInNothing) {
  for (const auto& [from, to] :
       {std::pair{"1,1000.", "         1     1.0E3"}, {"*END\n", "$ a comment\n*END\n"}}) {
    const Outcome out = changed(from, to);
    EXPECT_EQ(out.errors, "");
    EXPECT_TRUE(out.allowed.empty());
  }
}

TEST(DeckRecord, EndTimeOutputsAndCurvesMayChange) {
  EXPECT_EQ(changed("*CONTROL_TERMINATION\n1.", "*CONTROL_TERMINATION\n2.").allowed,
            Lines{"*CONTROL_TERMINATION ENDTIM: '2', was '1'"});
  EXPECT_EQ(changed("GLSTAT\n0.1", "GLSTAT\n0.2").allowed, Lines{"*DATABASE_GLSTAT DT: '0.2', was '0.1'"});
  EXPECT_EQ(changed("1.,2.", "1.,3.").allowed, Lines{"*DEFINE_CURVE O1: '1 3', was '1 2'"});
  EXPECT_EQ(changed("*DATABASE_GLSTAT\n0.1\n", "").allowed,
            Lines{"*DATABASE_GLSTAT: the run so far had 1 entry, the deck has 0"});
  EXPECT_EQ(changed("*CONTROL_SPH\n1\n", "*CONTROL_SPH\n5\n").allowed,
            Lines{"*CONTROL_SPH NCBS: '5', was '1'"})
      << "a field without influence";
}

TEST(DeckRecord, OfTheStepOnlyItsScaleMayChange) {
  const auto with = [](const std::string& card) {
    std::string text = first;
    return text.replace(text.find("*END\n"), 5, card + "*END\n");
  };
  const auto compared = [&](const std::string& before, const std::string& now) {
    const Deck deck = read(with(now));
    Diagnostics diagnostics;
    Outcome out{compare_decks(record_deck(read(with(before))), deck, record_deck(deck), diagnostics), ""};
    out.errors = diagnostics.text();
    return out;
  };
  const Outcome smaller = compared("*CONTROL_TIMESTEP\n0.,0.9\n", "*CONTROL_TIMESTEP\n0.,0.5\n");
  EXPECT_EQ(smaller.allowed, Lines{"*CONTROL_TIMESTEP TSSFAC: '0.5', was '0.9'"});
  EXPECT_EQ(smaller.errors, "");
  const Outcome added = compared("", "*CONTROL_TIME_STEP\n0.,0.5\n");
  EXPECT_EQ(added.allowed, Lines{"*CONTROL_TIME_STEP TSSFAC: '0.5', was '0.9'"});
  EXPECT_EQ(added.errors, "");
  EXPECT_NE(compared("", "*CONTROL_TIMESTEP\n1e-6,0.5\n").errors.find("field 1 (DTINIT"), std::string::npos);
  EXPECT_NE(compared("*CONTROL_TIMESTEP\n0.,0.9\n", "*CONTROL_TIMESTEP\n1e-6,0.9\n").errors.find("(DTINIT"),
            std::string::npos);
  EXPECT_NE(compared("*CONTROL_TIMESTEP\n0.,0.5\n", "").errors.find("the run so far had 1 entry"),
            std::string::npos);
}

TEST(DeckRecord, PartsMayBeSwitchedAtARestart) {
  const auto compared = [](const std::string& before, const std::string& now) {
    const auto with = [](const std::string& card) {
      std::string text = first;
      return text.replace(text.find("*END\n"), 5, card + "*END\n");
    };
    const Deck deck = read(with(now));
    Diagnostics diagnostics;
    Outcome out{compare_decks(record_deck(read(with(before))), deck, record_deck(deck), diagnostics), ""};
    out.errors = diagnostics.text();
    return out;
  };
  const std::string one = "*RIGID_DEFORMABLE_D2R\n1\n", other = "*RIGID_DEFORMABLE_D2R\n2\n";
  EXPECT_EQ(compared("", one).allowed, Lines{"*RIGID_DEFORMABLE_D2R: new"});
  EXPECT_EQ(compared("", one).errors, "");
  EXPECT_TRUE(compared(one, one).allowed.empty());
  EXPECT_NE(compared(one, "").errors, "") << "what was switched stays so";
  EXPECT_NE(compared(one, other).errors, "");
}

TEST(DeckRecord, AnythingElseIsRefusedByName) {
  const std::string message = changed("1,1000.", "1,900.").errors;
  EXPECT_EQ(message.rfind("deck.k:3:3: error: *MAT_NULL field 2 (RO", 0), 0u) << message;
  EXPECT_NE(message.find("the run so far had '1000', the deck has '900'\n  hint: a run can go on with"),
            std::string::npos)
      << message;
  EXPECT_NE(changed("1,1.2", "1,1.3").errors.find("*SECTION_SPH field 2 (CSLH"), std::string::npos);
  EXPECT_NE(changed("1,2,3", "1,2,5").errors.find("the run so far had '1 2 3', the deck has '1 2 5'"),
            std::string::npos);
  EXPECT_NE(changed("*SECTION_SPH\n1,1.2\n", "")
                .errors.find("*SECTION_SPH: the run so far had 1 entry, the deck has 0"),
            std::string::npos);
  EXPECT_NE(changed("*MAT_NULL\n1,1000.", "*MAT_NULL\n2,1000.")
                .errors.find("this is not the entry of the run so far"),
            std::string::npos);
}

TEST(DeckRecord, OfManyEntriesOnlyASumIsKept) {
  std::string text = "*KEYWORD\n*NODE\n";
  for (int k = 1; k <= 1000; ++k) text += std::to_string(k) + ",0.," + std::to_string(k) + ".\n";
  const DeckRecord record = record_deck(read(text + "*END\n"));
  ASSERT_EQ(record.size(), 1u);
  EXPECT_EQ(record[0].entries, 1000);
  EXPECT_TRUE(record[0].lines.empty());
  const auto at = text.find(",777.");
  text.replace(at, 5, ",778.");
  const Deck deck = read(text + "*END\n");
  Diagnostics diagnostics;
  compare_decks(record, deck, record_deck(deck), diagnostics);
  EXPECT_NE(diagnostics.text().find("*NODE: the 1000 entries are not those of the run so far"),
            std::string::npos);
}

}  // namespace
}  // namespace courant
