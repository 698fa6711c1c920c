// *CASE: which runs a text asks for, and what each of them reads.
#include <gtest/gtest.h>

#include <string>

#include "keyword/read/cases.hpp"

using namespace courant;

namespace {

std::vector<LoadCase> cases(const std::string& text, int errors = 0) {
  Diagnostics diagnostics;
  auto out = cases_in("deck.k", text, diagnostics);
  EXPECT_EQ(diagnostics.errors(), errors) << diagnostics.text();
  return out;
}
std::string fault(const std::string& text) {
  Diagnostics diagnostics;
  cases_in("deck.k", text, diagnostics);
  return diagnostics.text();
}
const std::string blocks = "*CASE_BEGIN_1\n*A\n1\n*CASE_END_1\n*case_begin_22\r\n*B\n2\n*CASE_END_22\n";

}  // namespace

TEST(Cases, StandInTheirOrder) {
  const auto found = cases("*KEYWORD\n*CASE\n         3pull\n\n         1        22\n*CASE\n2\n$\n\n22\n" +
                           blocks + "*END\n");
  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(found[0].id, 3);
  EXPECT_EQ(found[0].job, "pull");
  EXPECT_EQ(found[0].subcases, (std::set<Id>{1, 22}));
  EXPECT_EQ(found[1].job, "CASE2");
  EXPECT_EQ(found[1].subcases, (std::set<Id>{22}));
  const auto commas = cases("*CASE\n3,push\n\n1,22\n" + blocks);
  EXPECT_EQ(commas[0].job, "push");
  EXPECT_EQ(commas[0].subcases.size(), 2);
}

TEST(Cases, WithoutAListAreTheBlocks) {
  const auto found = cases(blocks + blocks);
  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(found[1].job, "CASE22");
}

TEST(Cases, FaultsAreNamed) {
  EXPECT_NE(fault("*CASE\n1\n\n7\n" + blocks).find("there is no *CASE_BEGIN_7"), std::string::npos);
  EXPECT_NE(fault("*CASE_BEGIN_1\n*A\n").find("deck.k:1"), std::string::npos);
  EXPECT_NE(fault("*CASE_END_1\n").find("without a *CASE_BEGIN_1"), std::string::npos);
  EXPECT_NE(fault("*CASE_BEGIN_x\n").find("is not understood"), std::string::npos);
  EXPECT_NE(fault("*CASE\n1\ncheck=7\n1\n" + blocks).find("COMMANDS"), std::string::npos);
  EXPECT_NE(fault("*CASE\n1         a/b\n\n1\n" + blocks).find("no name of a folder"), std::string::npos);
  EXPECT_NE(fault("*CASE\n1         x\n\n1\n*CASE\n2         x\n\n1\n" + blocks).find("two cases are named"),
            std::string::npos);
  EXPECT_NE(fault("*CASE\n1\n\n1\n*CASE\n1         x\n\n1\n" + blocks).find("defined twice"),
            std::string::npos);
}

TEST(Cases, OthersAreCommentsAndLinesStayInPlace) {
  const std::string text = "*KEYWORD\n*CASE\n1\n\n1\n" + blocks +
                           "*CASE_BEGIN_1\n*CASE_BEGIN_22\n*C\n*CASE_END_22\n*CASE_END_1\n*D";
  EXPECT_EQ(text_of_case(text, {1}), "*KEYWORD\n$\n$\n$\n$\n$\n*A\n1\n$\n$\n$\n$\n$\n$\n$\n*C\n$\n$\n*D");
  EXPECT_EQ(text_of_case(text, {5}), "*KEYWORD\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n$\n*D");
  EXPECT_TRUE(has_cases(text));
  EXPECT_FALSE(has_cases("*KEYWORD\n1 *CASE\n"));
}
