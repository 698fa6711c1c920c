#include "app/end_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace courant {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Summary closed() {
  Summary s;
  s.energy = {.kinetic = 1, .external_work = 1, .throughput = 1};
  return s;
}

TEST(EndReport, WarnsOfLeaksAndOfALedgerThatDoesNotClose) {
  EXPECT_THAT(end_warnings(closed()), IsEmpty());
  EXPECT_THAT(end_warnings(Summary()), IsEmpty());
  Summary s = closed();
  s.leaked_particles = 2;
  EXPECT_THAT(end_warnings(s), ElementsAre(HasSubstr("2 particles leaked")));
  s = closed();
  s.energy.kinetic = 1.049;
  EXPECT_THAT(end_warnings(s), IsEmpty());
  s.energy.kinetic = 1.06;
  EXPECT_THAT(end_warnings(s), ElementsAre(HasSubstr("6 % of what passed through came from nowhere")));
  s.energy.kinetic = 0.9;
  EXPECT_THAT(end_warnings(s), ElementsAre(HasSubstr("10 % of what passed through was lost")));
  s.energy = {.kinetic = 1e9 + 1e-3, .throughput = 1e-3, .initial = 1e9};  // round-off of what is there
  EXPECT_THAT(end_warnings(s), IsEmpty());
  s.energy = {.kinetic = 1, .initial = 1};  // nothing passed through
  EXPECT_THAT(end_warnings(s), IsEmpty());
  s.energy = {.kinetic = 2, .initial = 1};
  EXPECT_THAT(end_warnings(s), ElementsAre(HasSubstr("50 % of the energy came from nowhere")));
}

TEST(EndReport, WhatElementsTakeUpPassedThroughThem) {
  Summary s;
  s.energy = {.kinetic = 1, .internal = 97, .hourglass = 2, .dissipated = 1, .throughput = 1, .initial = 100};
  EXPECT_THAT(end_warnings(s), IsEmpty()) << "1 of 101";
  s.energy.internal = 103;
  EXPECT_THAT(end_warnings(s), ElementsAre(HasSubstr("6.6 % of what passed through came from nowhere")));
}

TEST(EndReport, WarnsOfWindowsThatLastForLessThanTwoSteps) {
  Summary s = closed();
  s.steps = 300;
  s.counters["pair_geometry_windows"] = 150;
  EXPECT_THAT(end_warnings(s), IsEmpty());
  s.counters["pair_geometry_windows"] = 200;
  EXPECT_THAT(end_warnings(s),
              ElementsAre(HasSubstr("200 windows of *COURANT_PAIR_GEOMETRY lasted 1.5 steps")));
  s.steps = s.counters["pair_geometry_windows"] = 1;  // a run that ends at once
  EXPECT_THAT(end_warnings(s), IsEmpty());
}

TEST(EndReport, TableHoldsEveryRowAndTheTotal) {
  Summary s = closed();
  s.read_seconds = 1, s.wall_seconds = 3;
  s.passes = {{"keyword reader", 1, 1}, {"sph rates", 2.5, 10}, {"rest", 0.5, 1}};
  s.output = {0.3, 4, 8000000, 1000000};
  const std::vector<std::string> lines = end_report(s);
  EXPECT_THAT(lines, Contains("  sph rates                                  2.500     62.5"));
  EXPECT_THAT(lines, Contains("  T o t a l                                  4.000    100.0"));
  EXPECT_THAT(
      lines,
      Contains(" output: 4 field states, 8 MB (2000 kB each), histories 1 MB; 10 % of the elapsed time"));
}

}  // namespace
}  // namespace courant
