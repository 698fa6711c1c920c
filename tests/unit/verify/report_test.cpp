#include "verify/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "../text.hpp"
#include "made_suite.hpp"
#include "output/file.hpp"
#include "verify/report_charts.hpp"
#include "verify/report_tables.hpp"
#include "verify/report_text.hpp"

namespace courant::report {
namespace {

using test::count;
using testing::HasSubstr;
using testing::Not;

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// An empty folder that is gone after the test.
class ReportFiles : public testing::Test {
 protected:
  ReportFiles() { std::filesystem::remove_all(folder); }
  ~ReportFiles() override { std::filesystem::remove_all(folder); }
  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      ("report_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST(ReportText, HasNoMeaningToHtml) {
  EXPECT_EQ(escape_xml("<a href=\"x\" o='y'> & ü\n"), "&lt;a href=&quot;x&quot; o=&#39;y&#39;&gt; &amp; ü\n");
  EXPECT_EQ(escape_xml("a\x01z\xff\xc3"), "a?z??");  // a control character, no UTF-8, half a character
  EXPECT_EQ(escape_xml("\xed\xa0\x80|\xef\xbf\xbf"), "???|???");  // a surrogate, U+FFFF: not of XML
}

TEST(ReportText, HasNoMeaningToMarkdown) {
  EXPECT_EQ(escape_markdown("a|b *c* _d_ `e` <f>\n[g] #1 $x$"),
            "a\\|b \\*c\\* \\_d\\_ \\`e\\` &lt;f&gt; \\[g\\] \\#1 \\$x\\$");
  EXPECT_EQ(escape_markdown("- no list - here"), "\\- no list - here");
}

TEST(ReportText, Numbers) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(1234.56, 3), "1235");
  EXPECT_EQ(number(0.0123456, 3), "0.0123");
  EXPECT_EQ(number(1.2e-5, 3), "1.2e-5");
  EXPECT_EQ(number(-2.5e9, 3), "-2.5e9");
  EXPECT_EQ(number(made::no_number), "not a number");
  EXPECT_EQ(number(-made::infinite), "-infinite");
  EXPECT_EQ(percent(0.0123), "1.2\u00a0%");
  EXPECT_EQ(percent(0.125), "12.5\u00a0%");
  EXPECT_EQ(percent(3.5), "350\u00a0%");
  EXPECT_EQ(percent(1e-9), "1e-9");
  EXPECT_EQ(percent(made::infinite), "infinite");
  EXPECT_EQ(seconds(3.14), "3.1\u00a0s");
  EXPECT_EQ(seconds(754), "12\u00a0min\u00a034\u00a0s");
  EXPECT_EQ(seconds(7380), "2\u00a0h\u00a03\u00a0min");
  EXPECT_EQ(integer(-1234567), "-1\u00a0234\u00a0567");
  EXPECT_EQ(integer(999), "999");
  EXPECT_EQ(integer(123456), "123\u00a0456");
}

TEST(ReportText, PartsOfTexts) {
  EXPECT_EQ(shorten("dünn", 4), "dünn");
  EXPECT_EQ(shorten("dünner", 4), "dün…");
  EXPECT_EQ(file_stem("a/b: c.k"), "a-b-c-k");
  EXPECT_EQ(file_stem("../"), "unnamed");
  EXPECT_THAT(paragraphs("a\nb\n \n\nc\n"), testing::ElementsAre("a\nb", "c"));
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");  // RFC 4648, section 10
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xff\xff"), "////");
}

TEST(Report, SaysInOneLineWhetherTheSuiteHolds) {
  EXPECT_EQ(verdict(made::suite({made::one_run()})), "The suite states no bounds.");
  CaseResult c = made::one_run();
  c.checks = {{"a", "mass", "error at most", 0.1, 0.05, true}};
  EXPECT_EQ(verdict(made::suite({c})), "The one bound is met.");
  EXPECT_EQ(verdict(made::suite({c, c})), "All 2 bounds are met.");
  EXPECT_EQ(verdict(made::suite({c, made::all_stopped()})), "1 of 2 bounds is missed.");
  const std::string page = html(made::suite({c, made::all_stopped()}));
  EXPECT_THAT(page, HasSubstr("a, mass: error at most 10\u00a0%, measured not a number"));
  EXPECT_THAT(html(made::suite({c})), Not(HasSubstr("MISSED")));
}

TEST(Report, TextOfTheSuiteIsText) {
  const std::string page = html(made::whole_suite(), {"<earlier>", {{"<change>", true}}});
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  for (const char* raw : {"<in>", "<suite>", "<water>", "<earlier>", "<change>"})
    EXPECT_THAT(page, Not(HasSubstr(raw)));
}

TEST(Report, LoadsNothing) {
  const std::string page = html(made::whole_suite());
  EXPECT_EQ(count(page, "http"), count(page, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_EQ(count(page, "src="), 1u);  // the picture
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_EQ(count(page, "url("), 0u);
}

TEST(Report, HasAChartForEachObservationAndAMapForEachStabilityCase) {
  EXPECT_EQ(count(html(made::suite({made::wave()})), "<svg "), 3u);  // two errors, one curve
  EXPECT_EQ(count(html(made::suite({made::stability(3, 2)})), "<svg "), 1u);
  EXPECT_EQ(count(html(made::suite({made::one_run()})), "<svg "), 1u);
}

TEST(Report, ChangesAreThereWhenThereIsSomethingToCompareWith) {
  const SuiteResult result = made::suite({made::one_run()});
  EXPECT_THAT(html(result), Not(HasSubstr("id=\"changes\"")));
  EXPECT_THAT(html(result, {"yesterday's", {}}), HasSubstr("Nothing has changed."));
  EXPECT_THAT(html(result, {"yesterday's", {{"slower", true}}}), HasSubstr("Worse: slower"));
}

TEST(Report, WhatCannotBeDrawnIsTold) {
  const std::vector<Figure> stopped = figures(made::all_stopped());
  ASSERT_EQ(stopped.size(), 1u);
  EXPECT_EQ(stopped[0].svg, "");
  EXPECT_EQ(stopped[0].notes.size(), 3u);
  EXPECT_THAT(stopped[0].notes[1], HasSubstr("runaway energy"));
  const std::vector<Figure> free = figures(made::no_reference());
  ASSERT_EQ(free.size(), 1u);  // no chart of errors that do not exist
  EXPECT_THAT(free[0].notes,
              testing::ElementsAre("the run: 1 of 4 values are not finite numbers and are left out."));
  CaseResult nothing = made::one_run();
  nothing.definition.observations.clear();
  nothing.runs[0].observed.clear();
  EXPECT_THAT(figures(nothing).at(0).notes, testing::ElementsAre("Nothing is observed that could be drawn."));
  nothing.runs.clear();
  EXPECT_TRUE(figures(nothing).empty());
  EXPECT_THAT(html(made::suite({nothing})), HasSubstr("There is no run."));
  EXPECT_THAT(html(made::suite({})), HasSubstr("The suite states no bounds."));
}

TEST(Report, RunsHaveTheirCostAndTheOrderBesideTheFinest) {
  const Table table = runs_table(made::wave());
  ASSERT_EQ(table.rows.size(), 12u);
  const auto column = [&](const std::string& head) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (table.columns[i].head == head) return i;
    ADD_FAILURE() << "no column " << head;
    return std::size_t{0};
  };
  EXPECT_EQ(table.rows[3].cells[column("n")], "80");
  EXPECT_EQ(table.rows[3].cells[column("CPU time [s]")], "51.2");
  EXPECT_EQ(table.rows[3].cells[column("CPU ns per particle-step")], "2043");  // 51.2 s / (20880 * 1200)
  EXPECT_EQ(table.rows[3].cells[column("period [s]")], "1.2779");
  EXPECT_EQ(table.rows[3].cells[column("period: order")], "1.00");
  EXPECT_EQ(table.rows[2].cells[column("period: order")], "");
  for (const Table::Row& row : table.rows) EXPECT_EQ(row.cells.size(), table.columns.size());
}

TEST(Report, StoppedRunsStandOut) {
  const Table table = runs_table(made::strange());
  EXPECT_TRUE(table.rows[10].bad);
  EXPECT_FALSE(table.rows[0].bad);
  EXPECT_EQ(table.columns.back().head, "end");
  EXPECT_THAT(table.rows[10].cells.back(), HasSubstr("exit code 2, error: runaway energy"));
}

TEST_F(ReportFiles, ArePutWhereTheyBelong) {
  write_reports(made::whole_suite(), folder / "deep" / "down");
  EXPECT_THAT(content(folder / "deep" / "down" / "report.html"), testing::EndsWith("</html>\n"));
  write_page(made::whole_suite(), folder / "page.md", folder / "pictures here");
  const std::string page = content(folder / "page.md");
  EXPECT_THAT(page, HasSubstr("(<pictures here/wave-period-error.svg>)"));
  EXPECT_EQ(content(folder / "pictures here" / "wave-picture.png"), made::picture());
  const std::string svg = content(folder / "pictures here" / "wave-period-error.svg");
  EXPECT_THAT(svg, testing::StartsWith("<svg xmlns="));
  EXPECT_THAT(svg, HasSubstr("prefers-color-scheme"));
  for (std::size_t at = page.find("](<"); at != std::string::npos; at = page.find("](<", at + 1)) {
    const std::string name = page.substr(at + 3, page.find(">)", at) - at - 3);
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

TEST_F(ReportFiles, OfCasesWithTheSameNameAreKeptApart) {
  write_page(made::suite({made::one_run(), made::one_run()}), folder / "page.md", folder);
  EXPECT_TRUE(std::filesystem::exists(folder / "one-mass-error.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder / "one-mass-error-2.svg"));
  EXPECT_THAT(content(folder / "page.md"), HasSubstr("(<one-mass-error-2.svg>)"));
}

TEST_F(ReportFiles, ThatCannotBeWrittenAreAnError) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "file") << "not a folder";
  EXPECT_THROW(write_reports(made::suite({}), folder / "file" / "below"), OutputError);
  EXPECT_THROW(write_page(made::wave().runs.empty() ? made::suite({}) : made::suite({made::wave()}),
                          folder / "page.md", folder / "file"),
               OutputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "page.md"));
}

}  // namespace
}  // namespace courant::report
