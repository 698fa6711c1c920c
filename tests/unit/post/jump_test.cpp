#include "post/jump.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace courant {
namespace {

TEST(Belanger, ThePapersJump) {
  EXPECT_NEAR(froude(1.5, 0.02, 9.81), 3.3864, 1e-4);
  EXPECT_NEAR(belanger_depth(1.5, 0.02, 9.81), 0.08630, 1e-5);
  EXPECT_NEAR(belanger_depth(std::sqrt(9.81 * 0.02), 0.02, 9.81), 0.02, 1e-15);  // Fr = 1: no jump
}

/// Against hand calculation with tables of tanh and exp.
TEST(EmpiricalEquations, ThePapersJump) {
  EXPECT_NEAR(0.02 * roller_length_over_d1(3.4), 0.2988, 5e-3 * 0.2988);  // the number in the paper
  EXPECT_NEAR(velocity_decay(10), 0.75578, 1e-5);
  EXPECT_NEAR(velocity_decay(0), 1, 0);
  EXPECT_NEAR(largest_deviation_over_d1(2), 0.116, 1e-12);
  EXPECT_NEAR(surface_strouhal(0), 0.143, 1e-12);
  EXPECT_NEAR(surface_strouhal(3.4) * 1.5 / 0.02, 4.28, 0.01);
}

TEST(Agreement, MadeSignals) {
  const std::vector<Real> exact = {2, 2, 2}, scaled = {1.8, 1.8}, mixed = {1, 3};
  EXPECT_DOUBLE_EQ(agreement_A(exact, 2), 1);
  EXPECT_DOUBLE_EQ(agreement_P(exact, 2), 0);
  EXPECT_DOUBLE_EQ(agreement_A(scaled, 2), 0.9);
  EXPECT_NEAR(agreement_P(scaled, 2), 0.1, 1e-15);
  EXPECT_DOUBLE_EQ(agreement_A(mixed, 2), std::sqrt(10.0 / 8));
  EXPECT_DOUBLE_EQ(agreement_P(mixed, 2), 0.5);
  EXPECT_TRUE(std::isnan(agreement_A({}, 2)));
}

JumpRecipe recipe() {
  JumpRecipe r;
  r.x = 1, r.v1 = 1.5, r.d1 = 0.02;
  r.intervals = {{2.5, 5}, {15, 30}};
  r.published = {
      {"d1/4", {2.5, 5}, 0.969, 0.049}, {"d1/10", {2.5, 5}, 0.936, 0.119}, {"d1/4", {15, 30}, 1.041, 0.045}};
  r.front_x = 1.08;
  return r;
}

/// Depth a d2 before 2.5 s, b d2 from then on; states up to one step early.
JumpSeries series(Real a, Real b, Real end) {
  JumpSeries s;
  const Real d2 = belanger_depth(1.5, 0.02, 9.81);
  for (int i = 0; 0.01 * i < end + 1e-9; ++i) {
    s.t.push_back(i == 0 ? 0 : 0.01 * i - 2e-6);
    s.depth.push_back((i < 250 ? a : b) * d2);
    s.front.push_back(i < 80 ? 0.02 : 0.03);
    s.toe.push_back(i < 80 ? std::nan("") : 0.9);
  }
  return s;
}

TEST(EvaluateJump, OnlyTheIntervalCounts) {
  const JumpResult r = evaluate_jump(recipe(), "d1/4", series(9, 0.95, 5));
  ASSERT_EQ(r.intervals.size(), 2u);
  EXPECT_EQ(r.intervals[0].states, 251);
  EXPECT_TRUE(r.intervals[0].complete);
  EXPECT_NEAR(r.intervals[0].A, 0.95, 1e-12);
  EXPECT_NEAR(r.intervals[0].P, 0.05, 1e-12);
  ASSERT_EQ(r.intervals[0].published.size(), 1u);
  EXPECT_EQ(r.intervals[0].published[0].A, 0.969);
  EXPECT_EQ(r.intervals[1].states, 0);
  EXPECT_NEAR(r.front_time.value(), 0.8, 1e-5);
  const std::string text = jump_text(recipe(), r);
  EXPECT_NE(text.find("0.950    0.050   d1/4"), std::string::npos) << text;
  EXPECT_NE(text.find("do not reach this interval"), std::string::npos) << text;
}

TEST(EvaluateJump, PartOfAnIntervalIsToldAndUnknownCaseShowsAllRows) {
  const JumpResult r = evaluate_jump(recipe(), "", series(1, 1, 4));
  EXPECT_FALSE(r.intervals[0].complete);
  EXPECT_EQ(r.intervals[0].states, 151);
  EXPECT_EQ(r.intervals[0].published.size(), 2u);
  EXPECT_EQ(r.intervals[1].published.size(), 1u);
  EXPECT_NE(jump_text(recipe(), r).find("cover only a part"), std::string::npos);
}

TEST(FindCase, InTheTitle) {
  const auto rows = recipe().published;
  EXPECT_EQ(find_case("Hydraulic jump, D1 / 10", rows), "d1/10");
  EXPECT_EQ(find_case("jump d1/4, 30 s", rows), "d1/4");
  EXPECT_EQ(find_case("jump d1/40", rows), "");
  EXPECT_EQ(find_case("", rows), "");
}

}  // namespace
}  // namespace courant
