#include "app/terminal.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace courant {

namespace {

TEST(ProgressTimes, ComeLessAndLessOften) {
  ProgressTimes times;
  std::vector<double> when;
  for (double t = 0; t <= 300; t += 0.5)
    if (times.take(t)) when.push_back(t);
  EXPECT_EQ(when, (std::vector<double>{5, 15, 35, 75, 135, 195, 255}));
}

TEST(ProgressTimes, AreNotMadeUpForWhereNobodyAsked) {
  ProgressTimes times;
  EXPECT_TRUE(times.take(100));
  EXPECT_FALSE(times.take(101));
  EXPECT_TRUE(times.take(135));
}

}  // namespace

}  // namespace courant
