// The fast path through tables must say and store what the careful one does.
#include "keyword/read/table_lines.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "decks_in_memory.hpp"
#include "keyword/read/number.hpp"
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

/// One field as decks may hold it, right or wrong.
std::string random_field(std::mt19937& random) {
  static const std::vector<std::string> fields = {"",
                                                  "0",
                                                  "1",
                                                  "7",
                                                  "8",
                                                  "-3",
                                                  "+5",
                                                  "2.0",
                                                  "1.5",
                                                  "12345678",
                                                  "1e3",
                                                  "1.5-3",
                                                  "1.d2",
                                                  ".5",
                                                  "-.25E+0",
                                                  "x",
                                                  "1 2",
                                                  "1e999",
                                                  "-0.0",
                                                  "0.0",
                                                  "123456789012345678901234",
                                                  "9999999999999999",
                                                  "99999999999999999",
                                                  "-1",
                                                  "1.",
                                                  ".",
                                                  "-",
                                                  "$",
                                                  "3000000000"};
  return fields[random() % fields.size()];
}

std::string describe(const Deck& deck) {
  std::string out;
  const auto number = [&](Real value) { out += std::to_string(value) + (std::signbit(value) ? "- " : " "); };
  for (const NodeCard& n : deck.all<NodeCard>()) {
    out += std::to_string(n.line) + ": " + std::to_string(n.nid) + " ";
    for (const Real x : {n.x, n.y, n.z}) number(x);
    out += std::to_string(n.tc) + "\n";
  }
  return out;
}

}  // namespace

TEST(TableLines, SayAndStoreWhatTheCarefulWayDoes) {
  std::mt19937 random(7);
  constexpr int width[] = {8, 16, 16, 16, 8};
  const std::string quick = "*KEYWORD\n*COMMENT\nno parameter\n*NODE\n",
                    careful = "*KEYWORD\n*PARAMETER\nI      z,0\n*NODE\n";
  for (int k = 0; k < 400; ++k) {
    const bool commas = random() % 3 == 0;
    std::string line;
    for (int f = 0; f < 5; ++f) {
      std::string field = f == 0 && random() % 4 != 0 ? std::to_string(k + 1) : random_field(random);
      if (commas)
        line += field + ",";
      else
        line += field.size() < static_cast<std::size_t>(width[f])
                    ? std::string(static_cast<std::size_t>(width[f]) - field.size(), ' ') + field
                    : field.substr(0, static_cast<std::size_t>(width[f]));
    }
    // errors end the reading, so each line is a deck of its own
    const ReadDeck a = read_in_memory(in_memory(quick + line + "       0\n*END\n"));
    // a parameter sends the line the careful way
    const ReadDeck b = read_in_memory(in_memory(careful + line + "      &z\n*END\n"));
    EXPECT_EQ(a.diagnostics.text(), b.diagnostics.text()) << line;
    EXPECT_EQ(describe(a.deck), describe(b.deck)) << line;
  }
}

TEST(TableLines, AreForTablesOfNumbers) {
  const auto usable = [](const char* name) {
    return TableLines(*keyword_registry()[static_cast<std::size_t>(KeywordIndex().match(name).keyword)],
                      CardFormat::standard)
        .usable();
  };
  EXPECT_TRUE(usable("NODE"));
  EXPECT_TRUE(usable("ELEMENT_SPH"));
  EXPECT_TRUE(usable("ELEMENT_SHELL"));
  EXPECT_FALSE(usable("SET_NODE_LIST"));
}

TEST(TableLines, LeaveFaultsToTheCarefulWay) {
  const TableLines lines(*keyword_registry()[static_cast<std::size_t>(KeywordIndex().match("NODE").keyword)],
                         CardFormat::standard);
  std::byte entry[sizeof(NodeCard)] = {};
  EXPECT_TRUE(lines.read("       1             1.0", entry));
  EXPECT_TRUE(lines.read("1,1.0,,2.0, ,, ,", entry));
  for (const char* line :
       {"", "       x", "1,&low", "1,1.0,,,,,,8",
        "       1             1.0                                       9", "       1             <1>"})
    EXPECT_FALSE(lines.read(line, entry)) << line;
}

TEST(PlainNumber, IsRoundedAsTheLibraryDoes) {
  std::mt19937_64 random(3);
  int taken = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string text = random() % 2 ? "-" : "";
    const std::size_t digits = 1 + random() % 19, point = random() % (digits + 1);
    for (std::size_t d = 0; d < digits; ++d) {
      if (d == point) text += '.';
      text += static_cast<char>('0' + random() % 10);
    }
    if (random() % 2) text += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
    Real plain = 0, careful = 0;
    ASSERT_TRUE(parse_real(text, careful)) << text;
    EXPECT_EQ(careful, std::strtod(text.c_str(), nullptr)) << text;
    if (!parse_plain_real(text.data(), text.data() + text.size(), plain)) continue;
    ++taken;
    EXPECT_EQ(plain, careful) << text;
  }
  EXPECT_GT(taken, 5000);
}

TEST(PlainNumber, LeavesOthersAlone) {
  for (const char* text : {"", "-", ".", "+1", "1e", "1e+", "1-", "1 0", "1x", "e5", "1e5.0", "1e3-2",
                           "1234567890123456789", "1e23", "1e9999999999", "1.5dd3", "--1"}) {
    Real value = 0;
    EXPECT_FALSE(parse_plain_real(text, text + std::char_traits<char>::length(text), value)) << text;
  }
  Id value = 0;
  for (const char* text : {"", "-", "+1", "1.0", "1 ", "1234567890123456789"})
    EXPECT_FALSE(parse_plain_integer(text, text + std::char_traits<char>::length(text), value)) << text;
}

TEST(NumberHint, NamesWhatMayBeWrong) {
  EXPECT_EQ(number_hint("*NODE"), "a keyword begins in column 1");
  EXPECT_EQ(number_hint("1.0 $ x"), "a comment is a line of its own, with $ in column 1");
  EXPECT_EQ(number_hint("1 0.0"), "a number must not contain blanks; is it within the columns of its field?");
  EXPECT_EQ(number_hint("1.0d-999"), "numbers other than 0 range from 1e-307 to 1e308");
  EXPECT_EQ(number_hint("1e999"), "numbers other than 0 range from 1e-307 to 1e308");
  EXPECT_EQ(number_hint("\xA0"
                        "1.0"),
            "a character in it is not ASCII: a blank or a sign of a text program?");
  for (const char* text : {"", "x", "1e3-2", "1.5e", "1-2-3", "edd3"})
    EXPECT_EQ(number_hint(text), "") << text;
}

/// Columns as the keyword manual has them.
TEST(Formats, HaveTheirColumns) {
  struct Card {
    const char* name;
    std::size_t card;
    std::vector<int> standard, i10;
  };
  const std::vector<Card> cards = {
      {"NODE", 0, {8, 16, 16, 16, 8, 8}, {10, 16, 16, 16, 10, 10}},
      {"ELEMENT_SHELL", 0, {8, 8, 8, 8, 8, 8, 8, 8, 8, 8}, {10, 10, 10, 10, 10, 10, 10, 10, 10, 10}},
      {"ELEMENT_SPH", 0, {8, 8, 16, 10}, {10, 10, 16, 10}},  // NEND: some have 8, which read the same
      {"PART", 0, {10, 10, 10, 10, 10, 10, 10, 10}, {10, 10, 10, 10, 10, 10, 10, 10}},
      {"DEFINE_CURVE", 1, {20, 20}, {20, 20}}};
  for (const Card& c : cards) {
    const CardSpec& card =
        keyword_registry()[static_cast<std::size_t>(KeywordIndex().match(c.name).keyword)]->cards[c.card];
    ASSERT_EQ(card.fields.size(), c.standard.size()) << c.name;
    for (std::size_t f = 0; f < card.fields.size(); ++f) {
      EXPECT_EQ(field_width(card.fields[f], CardFormat::standard), c.standard[f]) << c.name << " " << f;
      EXPECT_EQ(field_width(card.fields[f], CardFormat::i10), c.i10[f]) << c.name << " " << f;
      EXPECT_EQ(field_width(card.fields[f], CardFormat::long_fields), 20) << c.name << " " << f;
    }
  }
}

}  // namespace courant
