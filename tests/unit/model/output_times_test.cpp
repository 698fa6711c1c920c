#include "model/requests/output_times.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

/// The next output after t with an interval that is the curve's value at the next output itself.
Real next_after(Real t, std::vector<Real> abscissa, std::vector<Real> ordinate) {
  OutputTimes times;
  times.rule = OutputTimes::Rule::implicit;
  times.curve.abscissa = std::move(abscissa), times.curve.ordinate = std::move(ordinate);
  return next_output(times, t);
}

TEST(OutputTimes, ImplicitIntervalsOfALine) {
  EXPECT_NEAR(next_after(0, {0, 4}, {1, 3}), 2, 1e-14);  // s = 1 + s/2
  EXPECT_NEAR(next_after(3, {0, 1}, {1, 2}), 5, 1e-14);  // constant behind the last point
}

TEST(OutputTimes, ImplicitIntervalsOfACurveThatJumps) {
  EXPECT_NEAR(next_after(0, {0, 1, 1, 2}, {1, 1, 0.1, 0.1}), 1, 1e-14);  // in front of the jump f(1) is 1
  EXPECT_NEAR(next_after(0, {0, 1, 1, 2}, {3, 3, 0.5, 0.5}), 1, 1e-14);  // t + f jumps across s
  EXPECT_NEAR(next_after(0, {0, 5, 5}, {10, 10, 1}), 5, 1e-14);          // at the end, too
}

}  // namespace
}  // namespace courant
