// Every deck in tests/decks/reject must give exactly the messages in the .txt file beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "read_and_check.hpp"

namespace courant {

namespace {

const std::string folder = SOURCE_DIR "/tests/decks/reject";

std::vector<std::string> deck_names() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    if (file.path().extension() == ".k") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string content(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class RejectDeck : public testing::TestWithParam<std::string> {};

TEST_P(RejectDeck, GivesItsMessages) {
  const WorkingDirectory there(folder);
  const std::string expected = content(GetParam() + ".txt");
  ASSERT_NE(expected.find("error: "), std::string::npos) << "no error is expected of " << GetParam();
  EXPECT_EQ(read_and_check(GetParam() + ".k"), expected);
}

INSTANTIATE_TEST_SUITE_P(Decks, RejectDeck, testing::ValuesIn(deck_names()),
                         [](const auto& test) { return test.param; });

TEST(RejectDecks, AreMany) {
  EXPECT_GE(deck_names().size(), 40u);
}

TEST(RejectDecks, MissingDeckIsNamed) {
  EXPECT_EQ(
      read_and_check("no_such_deck.k"),
      "no_such_deck.k: error: cannot read the deck\n  hint: is the name right, and is it a readable file?\n");
}

}  // namespace

}  // namespace courant
