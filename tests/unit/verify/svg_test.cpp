#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../text.hpp"
#include "made_suite.hpp"
#include "verify/report_charts.hpp"
#include "verify/svg_axis.hpp"
#include "verify/svg_chart.hpp"
#include "verify/svg_map.hpp"

namespace courant::report {
namespace {

using test::count;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> all;
  for (const Axis::Tick& t : axis.ticks) all.push_back(t.label);
  return all;
}

Axis axis(bool logarithmic, const std::vector<Real>& values, bool percentages = false) {
  return make_axis(logarithmic, values, percentages);
}

TEST(Axis, TicksAreRound) {
  EXPECT_THAT(labels(axis(false, {0, 4})), ElementsAre("0", "1", "2", "3", "4"));
  EXPECT_THAT(labels(axis(false, {-0.1, 0.3})), ElementsAre("-0.1", "0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(labels(axis(false, {1000.001, 1000.003})),
              ElementsAre("1000.001", "1000.0015", "1000.002", "1000.0025", "1000.003"));
  EXPECT_THAT(labels(axis(false, {101324.99991, 101325.00009})),
              ElementsAre("101324.9999", "101324.99995", "101325", "101325.00005", "101325.0001"));
  EXPECT_THAT(labels(axis(false, {1.0e8, 1.02e8})),
              ElementsAre("1e8", "1.005e8", "1.01e8", "1.015e8", "1.02e8"));
  EXPECT_THAT(labels(axis(false, {0, 2e-5})), ElementsAre("0", "5e-6", "1e-5", "1.5e-5", "2e-5"));
  EXPECT_THAT(labels(axis(true, {0.01, 100})), ElementsAre("0.01", "0.1", "1", "10", "100"));
  EXPECT_THAT(labels(axis(true, {0.011, 0.09}, true)), ElementsAre("1 %", "2 %", "5 %", "10 %"));
}

TEST(Axis, WideRangesHaveFewTicks) {
  const Axis wide = axis(true, {1e-16, 1}, true);
  EXPECT_LE(wide.ticks.size(), 7u);
  EXPECT_GE(wide.ticks.size(), 4u);
  for (const std::string& label : labels(wide))
    EXPECT_THAT(label, Not(HasSubstr("%")));  // 1e-14 % helps nobody
}

TEST(Axis, HasTwoTicksWhateverItShows) {
  using made::infinite, made::no_number;
  for (const bool logarithmic : {false, true})
    for (const std::vector<Real>& values : std::vector<std::vector<Real>>{{},
                                                                          {0},
                                                                          {3},
                                                                          {2.5, 2.5},
                                                                          {-1, -1},
                                                                          {1, 1 + 1e-15},
                                                                          {6.1, 6.2},
                                                                          {1e-290},
                                                                          {1e299},
                                                                          {1e-299, 1e299},
                                                                          {no_number, infinite},
                                                                          {-infinite, 0, 2},
                                                                          {1e9, 1e9 + 1}}) {
      const Axis a = axis(logarithmic, values);
      EXPECT_GE(a.ticks.size(), 2u) << testing::PrintToString(values) << logarithmic;
      EXPECT_LE(a.ticks.size(), 10u) << testing::PrintToString(values) << logarithmic;
      EXPECT_LT(a.from, a.to) << testing::PrintToString(values);
      for (const Real v : values)
        if (a.shows(v)) {
          EXPECT_GE(a.place(v), -1e-9) << testing::PrintToString(values);
          EXPECT_LE(a.place(v), 1 + 1e-9) << testing::PrintToString(values);
        }
    }
}

TEST(Axis, PlacesAreProportionalToTheValueOrItsLogarithm) {
  const Axis linear = axis(false, {0, 4}), logarithmic = axis(true, {0.01, 100});
  EXPECT_NEAR(linear.place(1), 0.25, 1e-12);
  EXPECT_NEAR(logarithmic.place(1), 0.5, 1e-12);
  EXPECT_FALSE(logarithmic.shows(0));
  EXPECT_TRUE(linear.shows(0));
}

Chart chart(const std::vector<ChartPoint>& points) {
  Chart c;
  c.log_x = c.log_y = true;
  c.series = {{"a <b>", points}};
  return c;
}

TEST(SvgChart, EveryPointHasAMarkThatTellsItsNumbers) {
  const std::string svg = svg_chart(chart({{1, 0.1, "one"}, {2, 0.05, "two & more"}}));
  EXPECT_EQ(count(svg, "class=\"mark\""), 3u);  // and one in the legend
  EXPECT_THAT(svg, HasSubstr("<title>one</title>"));
  EXPECT_THAT(svg, HasSubstr("<title>two &amp; more</title>"));
  EXPECT_THAT(svg, HasSubstr("a &lt;b&gt;"));
  EXPECT_THAT(svg, Not(HasSubstr("a <b>")));
}

TEST(SvgChart, PointsWithoutAPlaceStandAtTheEdge) {
  using made::infinite, made::no_number;
  const std::string svg =
      svg_chart(chart({{1, 0.1, ""}, {2, 0, "zero"}, {3, no_number, ""}, {4, infinite, ""}, {0, 0.2, ""}}));
  EXPECT_EQ(count(svg, "class=\"mark\""), 6u);
  EXPECT_EQ(count(svg, "class=\"arrow\""), 3u);
  EXPECT_THAT(svg, HasSubstr(">NaN</text>"));
  EXPECT_THAT(svg, HasSubstr(">inf</text>"));
  EXPECT_THAT(svg, HasSubstr(">time 0</text>"));
  EXPECT_THAT(svg, HasSubstr("<title>zero</title>"));
  EXPECT_EQ(count(svg, "nan"), 0u);  // no coordinate is one
  EXPECT_EQ(count(svg, "\"inf"), 0u);
}

TEST(SvgChart, LinesBreakWhereValuesAreMissing) {
  Chart c;
  c.series = {{"a", {{0, 0}, {1, 1}, {2, made::no_number}, {3, 1}, {4, 0}}, ChartSeries::Style::line}};
  const std::string svg = svg_chart(c);
  const std::size_t at = svg.find("class=\"line\" d=\"");
  const std::string path = svg.substr(at, svg.find("/path", at) - at);
  EXPECT_EQ(count(path, "M"), 2u);
  EXPECT_EQ(count(path, "L"), 2u);
}

TEST(SvgChart, FrontAndBoundAreDrawnAndNamed) {
  Chart c = chart({{1, 0.1, ""}, {2, 0.05, ""}});
  EXPECT_EQ(count(svg_chart(c), "class=\"front\""), 0u);
  c.front = c.series[0].points;
  c.levels = {{"bound 1 %", 0.01}};
  const std::string svg = svg_chart(c);
  EXPECT_EQ(count(svg, "class=\"front\""), 2u);
  EXPECT_EQ(count(svg, "r=\"9\""), 2u);
  EXPECT_EQ(count(svg, "class=\"bound\""), 2u);
  EXPECT_THAT(svg, HasSubstr(">bound 1 %</text>"));
}

TEST(SvgChart, HasAllSortsOfNothing) {
  EXPECT_THAT(svg_chart(Chart{}), testing::EndsWith("</svg>"));
  EXPECT_THAT(svg_chart(chart({})), testing::EndsWith("</svg>"));
}

TEST(SvgChart, AFileOfItsOwnBringsItsStyle) {
  EXPECT_THAT(standalone_svg(svg_chart(Chart{})), HasSubstr("><style>"));
}

TEST(SvgMap, CellsTellTheirVerdictByALetter) {
  const CaseResult c = made::stability(5, 4);
  const std::string svg = svg_map(stability_map(c).value());
  EXPECT_EQ(count(svg, ">S</text>"), 11u);  // ten cells and the legend
  EXPECT_EQ(count(svg, ">X</text>"), 4u);
  EXPECT_THAT(svg, HasSubstr("stable (10)"));
  EXPECT_THAT(svg, HasSubstr("runaway energy"));
  EXPECT_THAT(svg, HasSubstr("growth 0.03 &gt; 0.01"));
  EXPECT_EQ(verdict_counts(c), "10 stable, 7 degraded, 3 stopped");
}

TEST(SvgMap, LongSweepsStandInRows) {
  const StabilityMap map = stability_map(made::stability(13, 6)).value();
  EXPECT_EQ(map.columns.size(), 6u);
  EXPECT_EQ(map.rows.size(), 13u);
  EXPECT_EQ(map.row_name, "tssfac");
  // The cell at tssfac 0.2, scale 1e-3: the second run.
  EXPECT_THAT(map.cells.at(6).hover, testing::StartsWith("tssfac = 0.2, scale = 1e-3: stable"));
}

TEST(SvgMap, WhatIsNotAllowedStandsOut) {
  const std::string svg = svg_map(stability_map(made::stability(12, 0)).value());
  EXPECT_EQ(count(svg, "class=\"fault\""), 2u);
  EXPECT_THAT(svg, HasSubstr(">! ✗</text>"));
  EXPECT_EQ(count(svg_map(stability_map(made::stability(5, 4)).value()), "class=\"fault\""), 0u);
}

TEST(SvgMap, MissingRunsAreMissing) {
  CaseResult c = made::stability(3, 2);
  c.runs.erase(c.runs.begin());
  const StabilityMap map = stability_map(c).value();
  EXPECT_FALSE(map.cells.at(0).verdict);
  EXPECT_THAT(svg_map(map), HasSubstr("no run (1)"));
}

TEST(SvgMap, OfSeveralRunsTheWorstStandsInTheCell) {
  CaseResult c = made::stability(2, 0);
  c.runs.push_back(c.runs[0]);
  c.runs.back().verdict = Verdict::stopped;
  EXPECT_EQ(stability_map(c)->cells.at(0).verdict, Verdict::stopped);
  c.runs.push_back(c.runs[0]);
  EXPECT_EQ(stability_map(c)->cells.at(0).verdict, Verdict::stopped);
}

TEST(SvgMap, SettingsHaveMapsOfTheirOwn) {
  CaseResult c = made::stability(2, 0);
  for (RunResult& run : c.runs) run.setting = "cubic, " + run.setting;
  c.runs.push_back(c.runs[0]);
  c.runs.back().setting = "cubic spline, tssfac = 0.1", c.runs.back().verdict = Verdict::broken;
  EXPECT_EQ(stability_map(c, "cubic")->cells.at(0).verdict, Verdict::stable);
  EXPECT_EQ(stability_map(c, "cubic spline")->cells.at(0).verdict, Verdict::broken);
  c.definition.settings = {{"cubic", {}, {}}, {"cubic spline", {}, {}}};
  EXPECT_EQ(figures(c).size(), 2u);
}

TEST(SvgMap, ACaseWithoutSweepShowsItsRuns) {
  CaseResult c = made::stability(2, 0);
  c.definition.stability->sweep.clear();
  EXPECT_EQ(stability_map(c)->columns.at(1), "tssfac = 0.2");
  EXPECT_FALSE(stability_map(made::wave()));
}

}  // namespace
}  // namespace courant::report
