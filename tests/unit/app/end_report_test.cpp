#include "app/report/end_report.hpp"

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
