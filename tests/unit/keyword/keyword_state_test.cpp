// What is said of a keyword's support follows from its table, and the reader does what is said.
#include "keyword/help/keyword_state.hpp"

#include <gtest/gtest.h>

#include "decks_in_memory.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct StateEntry : Entry {
  Id id;
  int kind, other, wish, hint;
};

using State = StateEntry;

KeywordSupport support(std::vector<FieldOf<State>> fields, const char* lacking = "") {
  return support_of(*make_keyword_spec<State>(
      KeywordOf<State>{.names = {"EXAMPLE"}, .lacking = lacking, .cards = {{.fields = std::move(fields)}}}));
}

TEST(KeywordState, FollowsFromTheTable) {
  const FieldOf<State> id{"ID", &State::id, "-", "id"},
      kind{"KIND", &State::kind, "-", "kind", {.allowed = {0, 2}}},
      other{"OTHER", &State::other, "-", "physics", unsupported},
      wish{"WISH", &State::wish, "-", "output", no_output},
      hint{"HINT", &State::hint, "-", "memory", no_effect};
  EXPECT_EQ(support({id, hint}).state, KeywordState::honoured);
  EXPECT_EQ(support({hint, wish}).state, KeywordState::no_effect);
  EXPECT_EQ(support({id}, "wings").state, KeywordState::refused);
  EXPECT_EQ(support({}).state, KeywordState::honoured);
  const KeywordSupport some = support({id, kind, {}, other, wish, hint});
  EXPECT_EQ(some.state, KeywordState::partly);
  EXPECT_EQ(some.refused, std::vector<std::string>{"OTHER"});
  EXPECT_EQ(some.limited, std::vector<std::string>{"KIND (0, 2)"});
  EXPECT_EQ(some.warned, std::vector<std::string>{"WISH"});
}

/// A deck of one keyword, and what the reader says of it.
Diagnostics told_of(const std::string& keyword) {
  Diagnostics diagnostics;
  read_deck("deck.k", in_memory("*KEYWORD\n" + keyword + "*END\n"), diagnostics);
  return diagnostics;
}

TEST(KeywordState, IsWhatTheReaderDoes) {
  const auto state_of = [](const char* name) {
    const KeywordMatch match = KeywordIndex().match(name);
    return support_of(*keyword_registry().at(static_cast<std::size_t>(match.keyword)));
  };
  EXPECT_EQ(state_of("CONTROL_ENERGY").state, KeywordState::no_effect);
  EXPECT_EQ(told_of("*CONTROL_ENERGY\n1,1\n").all().size(), 0u);
  EXPECT_EQ(state_of("MAT_SPH_VISCOUS").state, KeywordState::refused);
  EXPECT_EQ(told_of("*MAT_SPH_VISCOUS\n1,1.,0.,1.\n").errors(), 1);
  const KeywordSupport history = state_of("DATABASE_SLEOUT");
  EXPECT_EQ(history.state, KeywordState::partly);
  EXPECT_EQ(history.warned, std::vector<std::string>{"OPTION1"});
  EXPECT_EQ(told_of("*DATABASE_SLEOUT\n0.1,0,0,1,1.\n").warnings(), 1);
  EXPECT_EQ(history.limited, (std::vector<std::string>{"BINARY (0, 1, 2, 3)", "IOOPT (1, 2, 3)"}));
  EXPECT_EQ(told_of("*DATABASE_SLEOUT\n0.1,0,0,4\n").errors(), 1);
  EXPECT_EQ(told_of("*DATABASE_SLEOUT\n0.1,0,0,3\n").errors(), 0);
}

TEST(KeywordState, FamiliesOfWhichSomeAreSupportedAreToldApart) {
  const std::string page = cannot_do_markdown();
  const std::size_t none = page.find("## Physics"), some = page.find("## Of these only"),
                    read = page.find("## Keywords whose");
  const auto place = [&](const char* text) { return page.find(text); };
  EXPECT_LT(none, place("| airbags | `*AIRBAG`"));
  EXPECT_LT(place("| airbags | `*AIRBAG`"), some);
  EXPECT_LT(some, place("| this material | `*MAT` |"));
  EXPECT_LT(place("| this material | `*MAT` |"), read);
  EXPECT_LT(read, place("`*MAT_SPH_VISCOUS`"));
  EXPECT_LT(some, place("`*BOUNDARY_SPH_SYMMETRY_PLANE`"));  // there, but for its options
}

}  // namespace

}  // namespace courant
