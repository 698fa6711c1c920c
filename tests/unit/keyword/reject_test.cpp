// Decks as a user gives them. Every deck in tests/decks/reject must be refused with exactly the messages in
// the .txt file beside it; what is not wrong in it, it includes from tests/decks/base. Every deck in
// tests/decks/warn must build with exactly the warnings beside it; tests/decks/accept/whole*.k are the same
// scene without a fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "read_and_check.hpp"

namespace courant {

namespace {

const std::string decks = SOURCE_DIR "/tests/decks/";

std::vector<std::string> deck_names(const std::string& folder, const std::string& begin = "") {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(decks + folder))
    if (file.path().extension() == ".k" && file.path().stem().string().rfind(begin, 0) == 0)
      names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string content(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Every message must say where: the file, and the line unless something is missing in the whole deck.
void expect_places(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.all()) {
    EXPECT_FALSE(d.where.file.empty()) << d.text();
    EXPECT_FALSE(d.message.empty());
  }
}

const auto name_of = [](const auto& test) { return test.param; };

class RejectDeck : public testing::TestWithParam<std::string> {};

TEST_P(RejectDeck, GivesItsMessages) {
  const WorkingDirectory there(decks + "reject");
  const std::string expected = content(GetParam() + ".txt");
  ASSERT_NE(expected.find("error: "), std::string::npos) << "no error is expected of " << GetParam();
  const Checked checked = read_and_check(GetParam() + ".k");
  EXPECT_FALSE(checked.built);
  EXPECT_EQ(checked.diagnostics.text(), expected);
  expect_places(checked.diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Decks, RejectDeck, testing::ValuesIn(deck_names("reject")), name_of);

class WarnDeck : public testing::TestWithParam<std::string> {};

TEST_P(WarnDeck, BuildsWithItsWarnings) {
  const WorkingDirectory there(decks + "warn");
  const std::string expected = content(GetParam() + ".txt");
  ASSERT_NE(expected.find("warning: "), std::string::npos) << "no warning is expected of " << GetParam();
  const Checked checked = read_and_check(GetParam() + ".k");
  EXPECT_TRUE(checked.built);
  EXPECT_EQ(checked.diagnostics.text(), expected);
  expect_places(checked.diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Decks, WarnDeck, testing::ValuesIn(deck_names("warn")), name_of);

class WholeDeck : public testing::TestWithParam<std::string> {};

TEST_P(WholeDeck, BuildsWithoutAWord) {
  const WorkingDirectory there(decks + "accept");
  const Checked checked = read_and_check(GetParam() + ".k");
  EXPECT_TRUE(checked.built);
  EXPECT_EQ(checked.diagnostics.text(), "");
}

INSTANTIATE_TEST_SUITE_P(Decks, WholeDeck, testing::ValuesIn(deck_names("accept", "whole")), name_of);

TEST(RejectDecks, AreMany) {
  EXPECT_GE(deck_names("reject").size(), 150u);
}

TEST(RejectDecks, MissingDeckIsNamed) {
  EXPECT_EQ(
      read_and_check("no_such_deck.k").diagnostics.text(),
      "no_such_deck.k: error: cannot read the deck\n  hint: is the name right, and is it a readable file?\n");
}

}  // namespace

}  // namespace courant
