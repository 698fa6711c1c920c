#include "verify/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_suite.hpp"

namespace courant::report {
namespace {

using testing::ElementsAre;

std::vector<std::size_t> runs(const std::vector<CostPoint>& front) {
  std::vector<std::size_t> all;
  for (const CostPoint& p : front) all.push_back(p.run);
  return all;
}

TEST(ParetoFront, HoldsWhatNothingElseBeats) {
  EXPECT_THAT(runs(pareto_front({{0, 4, 0.1}, {1, 1, 0.5}, {2, 2, 0.6}, {3, 2, 0.2}, {4, 8, 0.1}})),
              ElementsAre(1, 3, 0));
  EXPECT_THAT(runs(pareto_front({})), ElementsAre());
  EXPECT_THAT(runs(pareto_front({{7, 1, 1}})), ElementsAre(7));
}

TEST(ParetoFront, OfEqualsHasOne) {
  EXPECT_THAT(runs(pareto_front({{0, 1, 0.5}, {1, 1, 0.5}})), ElementsAre(0));
  EXPECT_THAT(runs(pareto_front({{0, 1, 0.5}, {1, 1, 0.4}})), ElementsAre(1));  // same cost
  EXPECT_THAT(runs(pareto_front({{0, 2, 0.5}, {1, 1, 0.5}})), ElementsAre(1));  // same error
}

TEST(ParetoFront, LeavesOutWhatIsNoMeasure) {
  using made::infinite, made::no_number;
  EXPECT_THAT(runs(pareto_front({{0, 1, no_number},
                                 {1, no_number, 0.1},
                                 {2, 1, infinite},
                                 {3, 5, 0.3},
                                 {4, -1, 0.1},
                                 {5, 1, -0.1}})),
              ElementsAre(3));
  EXPECT_THAT(runs(pareto_front({{0, 0, 0.1}, {1, 1, 0}})), ElementsAre(0, 1));  // zero is a measure
}

TEST(Choices, AreRoundLevelsEachWithItsCheapestRun) {
  const std::vector<Choice> all =
      choices({{0, 1, 0.3}, {1, 2, 0.21}, {2, 3, 0.2}, {3, 4, 0.0011}, {4, 5, 0}});
  ASSERT_EQ(all.size(), 4u);
  EXPECT_DOUBLE_EQ(all[0].level, 0.5);  // run 1 reaches no smaller level
  EXPECT_DOUBLE_EQ(all[1].level, 0.2);
  EXPECT_EQ(all[1].point.run, 2u);
  EXPECT_DOUBLE_EQ(all[2].level, 0.002);
  EXPECT_EQ(all[3].level, 0);
}

TEST(Choices, LevelsAreExactAtTheirEnds) {
  for (const Real level : {1e-7, 2e-5, 5e-3, 0.01, 0.02, 0.05, 0.1, 1.0, 5.0})
    EXPECT_DOUBLE_EQ(choices({{0, 1, level}}).at(0).level, level);
  EXPECT_DOUBLE_EQ(choices({{0, 1, 0.0501}}).at(0).level, 0.1);
}

TEST(Recommendation, NamesSettingResolutionTimeAndError) {
  const std::vector<std::string> text = recommendation(made::wave(), 0);
  ASSERT_EQ(text.size(), 4u);
  EXPECT_EQ(text[1],
            "at most 1\u00a0%: Wendland C2, h/dx = 1.6 at resolution 20, 1.7\u00a0s (error 0.8\u00a0%).");
}

TEST(Recommendation, TellsThatTheBoundIsOutOfReach) {
  EXPECT_EQ(recommendation(made::wave(), 1).back(),
            "No run reaches the bound of 0.1\u00a0%; the smallest error is 0.15\u00a0%.");
  EXPECT_THAT(recommendation(made::all_stopped(), 0), ElementsAre());
}

TEST(Recommendation, IsShort) {
  CaseResult c = made::one_run();
  for (int i = 1; i < 20; ++i) {
    c.runs.push_back(c.runs[0]);
    c.runs.back().resolution = std::to_string(i), c.runs.back().cpu_seconds = 2 * i;
    c.runs.back().observed[0].error = std::pow(0.1, i);
  }
  const std::vector<std::string> text = recommendation(c, 0);
  EXPECT_EQ(text.size(), 6u);
  EXPECT_THAT(text.front(), testing::HasSubstr("the run, 1.5"));
  EXPECT_THAT(text.back(), testing::HasSubstr("resolution 19"));
}

TEST(Recommendation, NeverChoosesARunThatStopped) {
  CaseResult c = made::one_run();
  c.runs.push_back(c.runs[0]);
  c.runs[1].cpu_seconds = 0.1, c.runs[1].exit_code = 2;
  EXPECT_THAT(runs(pareto_front(cost_points(c, 0))), ElementsAre(0));
  c.runs[1].exit_code = 0;
  EXPECT_THAT(runs(pareto_front(cost_points(c, 0))), ElementsAre(1));
  c.runs[1].verdict = Verdict::broken;
  EXPECT_THAT(runs(pareto_front(cost_points(c, 0))), ElementsAre(0));
}

TEST(Recommendation, NeverChoosesTheRunThatIsTheReference) {
  CaseResult c = made::one_run();
  c.runs[0].observed[0].error = 0;
  EXPECT_EQ(cost_points(c, 0).size(), 1u);
  c.definition.observations[0].reference.kind = SuiteReference::Kind::finest;
  EXPECT_EQ(cost_points(c, 0).size(), 0u);
}

TEST(CheapestWithinBounds, MeetsAllOfThem) {
  CaseResult c = made::wave();
  EXPECT_FALSE(cheapest_within_bounds(c));  // the second bound is out of reach
  c.definition.observations[1].bound.reset();
  ASSERT_TRUE(cheapest_within_bounds(c));
  EXPECT_EQ(*cheapest_within_bounds(c), 5u);  // Wendland at 20: 0.8 %
  c.runs[5].observed[0].error.reset();
  EXPECT_EQ(*cheapest_within_bounds(c), 6u);
  c.definition.observations[0].bound.reset();
  EXPECT_FALSE(cheapest_within_bounds(c));  // nothing is bounded
}

}  // namespace
}  // namespace courant::report
