// Parameters of a deck: what they are worth where, and what `courant check` can report them.
#include "keyword/read/parameters.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "decks_in_memory.hpp"
#include "keyword/source.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

/// Reads "main.k" of some files in memory.
ReadDeck read(const Files& files, std::map<std::string, std::string> overrides = {}) {
  ReadOptions options = in_memory(files);
  options.parameters = std::move(overrides);
  return read_in_memory(options, "main.k");
}

ReadDeck read_lines(const std::string& lines, std::map<std::string, std::string> overrides = {}) {
  return read({{"main.k", "*KEYWORD\n" + lines + "*END\n"}}, std::move(overrides));
}

/// XMX of every *DEFINE_BOX by its id.
std::map<Id, Real> boxes(const ReadDeck& read) {
  std::map<Id, Real> out;
  for (const DefineBoxCard& box : read.deck.all<DefineBoxCard>()) out[box.boxid] = box.xmx;
  return out;
}

std::string box(int id, const std::string& xmx) {
  return "*DEFINE_BOX\n" + std::to_string(id) + ",0.0," + xmx + "\n";
}

TEST(ParameterScopes, ReachFilesIncludedLater) {
  const ReadDeck r =
      read({{"main.k", "*KEYWORD\n*INCLUDE\nvalues.k\nuses.k\n*END\n"},
            {"values.k", "*KEYWORD\n*PARAMETER\nRwide         1234.0Inumber           56\n*END\n"},
            {"uses.k", "*KEYWORD\n" + box(1, "&wide") + box(2, "&number") + "*END\n"}});
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 1234}, {2, 56}}));
}

TEST(ParameterScopes, ReachFilesIncludedByIncludedOnes) {
  const ReadDeck r = read({{"main.k", "*KEYWORD\n*PARAMETER\nRwide          100.0\n*INCLUDE\none.k\n*END\n"},
                           {"one.k", box(1, "1.0") + "*INCLUDE\ntwo.k\n*END\n"},
                           {"two.k", box(2, "&wide")}});
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 1}, {2, 100}}));
}

TEST(ParameterScopes, KeepLocalOnesToTheirFile) {
  const std::string local = "*PARAMETER_LOCAL\nRscale        ";
  const ReadDeck r = read({{"main.k", "*KEYWORD\n*INCLUDE\na.k\nb.k\n*END\n"},
                           {"a.k", local + "1.0\n*INCLUDE\ninner.k\n" + box(1, "&scale")},
                           {"b.k", local + "2.0\n" + box(2, "&scale")},
                           {"inner.k", box(3, "&scale") + local + "3.0\n" + box(4, "&scale")}});
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 1}, {2, 2}, {3, 1}, {4, 3}}));
}

TEST(ParameterScopes, HideLocalOnesFromIncludingFilesAndSiblings) {
  const ReadDeck r =
      read({{"main.k", "*KEYWORD\n*PARAMETER\nRall           200.0\n*INCLUDE\na.k\nb.k\n" + box(4, "&loc") +
                           box(5, "&all") + "*END\n"},
            {"a.k", "*PARAMETER_LOCAL\nRloc           999.0\n" + box(1, "&loc") + box(2, "&all")},
            {"b.k", box(3, "&loc")}});
  EXPECT_EQ(
      r.diagnostics.text(),
      "b.k:2:7: error: *DEFINE_BOX field 3 (XMX, highest x [L]): parameter '&loc' is not defined (here and "
      "at 1 more field)\n  included from main.k:6\n"
      "  hint: &loc is local to the file that defines it, at a.k:2\n");
  EXPECT_EQ(boxes(r).at(1), 999);
  EXPECT_EQ(boxes(r).at(2), 200);
  EXPECT_EQ(boxes(r).at(5), 200);
}

TEST(ParameterScopes, GiveAFileReadTwiceItsOwnLocalOnes) {
  const ReadDeck r = read({{"main.k",
                            "*KEYWORD\n*PARAMETER_MUTABLE\nI id, 1\n*INCLUDE\na.k\n*PARAMETER_EXPRESSION\n"
                            "I id      id+1\n*INCLUDE\na.k\n*END\n"},
                           {"a.k", "*PARAMETER_EXPRESSION_LOCAL\nR x,10.0*id\n*DEFINE_BOX\n&id,0.0,&x\n"}});
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 10}, {2, 20}}));
}

TEST(ParameterDuplication, KeepsTheFirstWithAWarning) {
  const ReadDeck r = read({{"main.k", "*KEYWORD\n*INCLUDE\na.k\nb.k\nc.k\n*END\n"},
                           {"a.k", "*PARAMETER\nRscale        1.0\n" + box(1, "&scale")},
                           {"b.k", "*PARAMETER\nRscale        2.0\n" + box(2, "&scale")},
                           {"c.k", box(3, "&scale")}});
  EXPECT_EQ(r.diagnostics.errors(), 0);
  ASSERT_EQ(r.diagnostics.warnings(), 1);
  EXPECT_EQ(r.diagnostics.all()[0].where.file, "b.k");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 1}, {2, 1}, {3, 1}}));
}

TEST(ParameterDuplication, FollowsDflag) {
  const auto result = [](int dflag) {
    const ReadDeck r = read_lines("*PARAMETER_DUPLICATION\n" + std::to_string(dflag) +
                                  "\n*PARAMETER\nR x, 1.0\nR x, 2.0\n" + box(1, "&x"));
    return std::to_string(r.diagnostics.errors()) + " " + std::to_string(r.diagnostics.warnings()) + " " +
           std::to_string(static_cast<int>(boxes(r).at(1)));
  };
  EXPECT_EQ(result(0), "0 1 1");
  EXPECT_EQ(result(1), "0 1 1");
  EXPECT_EQ(result(2), "0 1 2");
  EXPECT_EQ(result(3), "1 0 1");
  EXPECT_EQ(result(4), "0 0 2");
  EXPECT_EQ(result(5), "0 0 1");
}

TEST(ParameterValues, KeepTheirKindInExpressions) {
  const ReadDeck r = read_lines(
      "*PARAMETER\nI n, 5, R x, 5\n*PARAMETER_EXPRESSION\nR a, n/2\nR b, x/2\nI c, x/2\nI d       -7/2.0\n" +
      box(1, "&a") + box(2, "&b") + box(3, "&c") + box(4, "&d") + box(5, "<n/2>") + box(6, "-<x/2>"));
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 2}, {2, 2.5}, {3, 2}, {4, -3}, {5, 2}, {6, -2.5}}));
}

TEST(ParameterValues, MatchTheManualsPlotInterval) {
  const ReadDeck r =
      read_lines("*PARAMETER\nrtErm,0.01,iStates,101\n*PARAMETER_EXPRESSION\nrPlot, tErm/(States-30)\n" +
                 box(1, "&PLOT") + box(2, "-&plot"));
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 0.01 / 71}, {2, -0.01 / 71}}));
}

TEST(ParameterValues, AreReadWithOptionsInAnyOrder) {
  const ReadDeck r = read_lines(
      "*PARAMETER_NOECHO_LOCAL\nI a, 1\n*PARAMETER_LOCAL_MUTABLE_EXPRESSION\nI b, a+1\n"
      "*PARAMETER_EXPRESSION_GLOBAL_NOECHO\nI c, b+1\n*parameter_type\nI        d         4       NID\n"
      "*PARAMETER_EXPRESSION\nC title   water, with an odd ( and a comma\n*TITLE\n&title\n" +
      box(1, "&a") + box(2, "&b") + box(3, "&c") + box(4, "&d"));
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 1}, {2, 2}, {3, 3}, {4, 4}}));
  EXPECT_EQ(r.deck.title, "water, with an odd ( and a comma");
}

TEST(ParameterOverrides, ReplaceNumbersTextsAndExpressions) {
  const std::string lines =
      "*PARAMETER\nR x, 1.0, I n, 2, C name, one\n*PARAMETER_EXPRESSION\nR sum     x+n\n"
      "*TITLE\ntitle &name\n" +
      box(1, "&x") + box(2, "&n") + box(3, "&sum");
  const ReadDeck r = read_lines(lines, {{"X", "4.5"}, {"n", "7"}, {"NAME", "two"}});
  EXPECT_EQ(r.diagnostics.text(), "");
  EXPECT_EQ(r.deck.title, "title two");
  EXPECT_EQ(boxes(r), (std::map<Id, Real>{{1, 4.5}, {2, 7}, {3, 11.5}}));
  const ReadDeck sum = read_lines(lines, {{"sum", "-1"}});
  EXPECT_EQ(sum.diagnostics.text(), "");  // x and n are in use all the same
  EXPECT_EQ(boxes(sum).at(3), -1);
  EXPECT_EQ(read_lines(lines, {{"n", "7.5"}}).diagnostics.text(),
            "main.k:3:11: error: *PARAMETER n: expected an integer, got '7.5' from --param\n"
            "  hint: the deck declares it with the type letter I\n");
}

TEST(ParameterList, TellsTypesValuesAndUse) {
  const ReadDeck r = read_lines(
      "*PARAMETER\nR dx, 8.-3, I unused, 2, C name, one\n*PARAMETER_EXPRESSION_LOCAL\nR sum     2*dx\n"
      "*TITLE\n&name\n" +
          box(1, "&sum"),
      {{"name", "two"}});
  const auto& p = r.deck.parameters;
  ASSERT_EQ(p.size(), 4u);
  EXPECT_EQ(p[0].name, "dx");
  EXPECT_EQ(p[0].type, 'R');
  EXPECT_EQ(p[0].text, "8.-3");
  EXPECT_EQ(p[0].where.line, 3);
  EXPECT_TRUE(p[0].used);  // by sum, which a field uses
  EXPECT_EQ(p[1].type, 'I');
  EXPECT_FALSE(p[1].used);
  EXPECT_EQ(p[2].text, "two");
  EXPECT_TRUE(p[2].given);
  EXPECT_EQ(p[3].text, "0.016");
  EXPECT_EQ(p[3].where.line, 5);
  EXPECT_TRUE(p[3].local && !p[0].local);
  EXPECT_EQ(r.diagnostics.text(), "main.k:3:13: warning: parameter 'unused' is never used\n");
}

TEST(ParameterExpressions, SeparateFieldsOnlyOutsideOfBrackets) {
  std::vector<Slice> slices = split_equal("<max(1,2)>,(3, 4), 5", 10, 80);
  ASSERT_EQ(slices.size(), 3u);
  EXPECT_EQ(slices[0].text, "<max(1,2)>");
  EXPECT_EQ(slices[1].text, "(3, 4)");
  EXPECT_EQ(slices[2].column, 20);
  EXPECT_EQ(split_equal("<max(1,2)>       3.0", 10, 80).size(), 2u);
  EXPECT_EQ(split_equal("1,<2+3,4", 10, 80).size(), 3u);  // not closed
  EXPECT_EQ(split_equal("a>b,4", 10, 80).size(), 2u);
}

TEST(ParameterExpressions, SurviveRandomLines) {
  std::mt19937 random(11);
  const std::string pieces[] = {"R a",
                                "I b",
                                "C c",
                                ",",
                                "1.0",
                                "2",
                                "<a+b>",
                                "&a",
                                "-&b",
                                "\n",
                                "\n",
                                " ",
                                "         ",
                                "(",
                                ")",
                                "**",
                                "&",
                                "<",
                                ">",
                                "max(",
                                "$",
                                "9e99",
                                "\n*PARAMETER_LOCAL\n",
                                "&c",
                                "-",
                                "\n*PARAMETER_EXPRESSION\n",
                                "\n*PARAMETER\n",
                                "\xe4",
                                "\r\n",
                                "\n*DEFINE_BOX\n",
                                "\n*TITLE\n"};
  for (int k = 0; k < 2000; ++k) {
    std::string lines = "*PARAMETER\n";
    for (std::size_t j = random() % 30; j > 0; --j) lines += pieces[random() % std::size(pieces)];
    const ReadDeck r = read_lines(lines + "\n");
    for (const Diagnostic& d : r.diagnostics.all()) EXPECT_GE(d.where.column, 0) << lines;
  }
}

}  // namespace

}  // namespace courant
