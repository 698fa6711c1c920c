#include <gtest/gtest.h>

#include <set>

#include "keyword/read/number.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

Real real(std::string_view text) {
  Real value = -12345;
  EXPECT_TRUE(parse_real(text, value)) << text;
  return value;
}

TEST(Number, ReadsFortranReals) {
  EXPECT_EQ(real("7850"), 7850);
  EXPECT_EQ(real("+1.5"), 1.5);
  EXPECT_EQ(real("-.5"), -0.5);
  EXPECT_EQ(real("5."), 5);
  EXPECT_EQ(real("1.5-3"), 1.5e-3);
  EXPECT_EQ(real("-1+4"), -1e4);
  EXPECT_EQ(real("1.5d-3"), 1.5e-3);
  EXPECT_EQ(real("2D3"), 2000);
  EXPECT_EQ(real("1e+3"), 1000);
  EXPECT_EQ(real("0.1"), 0.1);  // correctly rounded
}

TEST(Number, RefusesWhatIsNone) {
  Real value = 0;
  for (const char* text : {"",    "-",   "+",   ".",    "e5",   "2o.0",  "1.5e", "1.5-", "1.5-3-2", "1e3-2",
                           "1 0", "nan", "inf", "-inf", "0x10", "1e999", "+-1",  "--1",  "1.5d",    "1,5"})
    EXPECT_FALSE(parse_real(text, value)) << text;
}

TEST(Number, ReadsIntegers) {
  Id value = 0;
  EXPECT_TRUE(parse_integer("9007199254740993", value));
  EXPECT_EQ(value, 9007199254740993);
  EXPECT_TRUE(parse_integer("+12", value));
  EXPECT_EQ(value, 12);
  EXPECT_TRUE(parse_integer("-5.0", value));
  EXPECT_EQ(value, -5);
  for (const char* text : {"", "1.5", "x", "1x", "+-1", "99999999999999999999"})
    EXPECT_FALSE(parse_integer(text, value)) << text;
}

TEST(Source, ExpandsTabsAndDropsLineEnds) {
  const auto source = make_source("\xEF\xBB\xBF*NODE\r\n\t1\n1234567\tx\n\nlast");
  ASSERT_EQ(source->lines.size(), 5u);
  EXPECT_EQ(source->lines[0], "*NODE");
  EXPECT_EQ(source->lines[1], "        1");
  EXPECT_EQ(source->lines[2], "1234567 x");
  EXPECT_EQ(source->lines[3], "");
  EXPECT_EQ(source->lines[4], "last");
}

TEST(KeywordLine, TakesNameAndFormat) {
  const auto format = [](const char* line) {
    return parse_keyword_line(line, CardFormat::long_fields).format;
  };
  EXPECT_EQ(parse_keyword_line("*node (all)", CardFormat::standard).name, "NODE");
  EXPECT_EQ(parse_keyword_line("*NODE+", CardFormat::standard).name, "NODE");
  EXPECT_EQ(format("*NODE"), CardFormat::long_fields);
  EXPECT_EQ(format("*NODE-"), CardFormat::standard);
  EXPECT_EQ(format("*NODE %"), CardFormat::i10);
  EXPECT_EQ(format("*NODE -remark"), CardFormat::long_fields);
}

TEST(DataLines, SkipsCommentsAndEndsAtTheNextKeyword) {
  const auto source = make_source("*A\n$ no\n1\n$ no\n\n$ no\n*B\n2\n");
  DataLines data(*source, 1);
  ASSERT_FALSE(data.done());
  EXPECT_EQ(data.line(), "1");
  data.step();
  EXPECT_TRUE(data.only_blanks_left());
  EXPECT_FALSE(data.done());  // a blank line is a card
  data.step();
  EXPECT_TRUE(data.done());
  EXPECT_EQ(data.index(), 6u);
}

const KeywordSpec& spec(const std::string& name) {
  return *keyword_registry()[static_cast<std::size_t>(KeywordIndex().match(name).keyword)];
}

TEST(SplitCard, CutsColumnsByFormat) {
  const CardSpec& card = spec("NODE").cards[0];
  std::vector<Slice> slices;
  split_card("       1             1.0             2.0", card, CardFormat::standard, slices);
  ASSERT_EQ(slices.size(), 6u);
  EXPECT_EQ(slices[0].text, "1");
  EXPECT_EQ(slices[0].column, 8);
  EXPECT_EQ(slices[2].text, "2.0");
  EXPECT_EQ(slices[2].column, 38);
  EXPECT_TRUE(slices[3].text.empty());
  split_card("         1             1.0", card, CardFormat::i10, slices);
  EXPECT_EQ(slices[1].text, "1.0");
  split_card("                   1                 1.0", card, CardFormat::long_fields, slices);
  EXPECT_EQ(slices[1].text, "1.0");
}

TEST(SplitCard, CutsAtCommasPerLine) {
  const CardSpec& card = spec("NODE").cards[0];
  std::vector<Slice> slices;
  int extra = 0;
  split_card("1, 0.123456789012345678, ,4", card, CardFormat::standard, slices, &extra);
  ASSERT_EQ(slices.size(), 6u);
  EXPECT_EQ(slices[1].text, "0.123456789012345678");
  EXPECT_EQ(slices[1].column, 4);
  EXPECT_TRUE(slices[2].text.empty());
  EXPECT_EQ(slices[3].text, "4");
  EXPECT_EQ(extra, 0);
  split_card("1,2,3,4,5,6,7,,8", card, CardFormat::standard, slices, &extra);
  EXPECT_EQ(extra, 2);
}

TEST(Registry, NamesAreUniqueAndCardsFit) {
  std::set<std::string> names;
  for (const auto& keyword : keyword_registry()) {
    EXPECT_FALSE(keyword->names.empty());
    EXPECT_FALSE(keyword->purpose.empty()) << keyword->names[0];
    for (const std::string& name : keyword->names) EXPECT_TRUE(names.insert(name).second) << name;
    for (const CardSpec& card : keyword->cards) {
      ASSERT_FALSE(card.fields.empty()) << keyword->names[0];
      EXPECT_LE(card.fields.back().column + card.fields.back().rules.width, 80) << keyword->names[0];
      for (const FieldSpec& field : card.fields)
        if (field.type != FieldType::skip) {
          EXPECT_FALSE(field.name.empty() || field.meaning.empty() || field.dimension.empty())
              << keyword->names[0];
        }
    }
  }
}

TEST(Registry, MatchesNamesAndOptions) {
  const KeywordIndex index;
  EXPECT_GE(index.match("DEFINE_BOX").keyword, 0);
  EXPECT_TRUE(index.match("DEFINE_BOX_TITLE").title);
  EXPECT_TRUE(index.match("BOUNDARY_SPC_SET_ID").id);
  EXPECT_EQ(index.match("LOAD_BODY_Z").name, 2);
  EXPECT_LT(index.match("NODE_TITLE").keyword, 0);
  EXPECT_LT(index.match("NOD").keyword, 0);
}

TEST(Registry, HelpComesFromTheTable) {
  const std::string help = keyword_help("*define_box");
  EXPECT_NE(help.find("BOXID"), std::string::npos);
  EXPECT_NE(help.find("11-20"), std::string::npos);
  EXPECT_NE(help.find("required"), std::string::npos);
  EXPECT_TRUE(keyword_help("NO_SUCH_KEYWORD").empty());
  EXPECT_NE(keyword_list().find("*ELEMENT_SPH"), std::string::npos);
  EXPECT_NE(keyword_markdown().find("## *SET_NODE_LIST\n\nAlso: `*SET_NODE`."), std::string::npos);
}

}  // namespace

}  // namespace courant
