// How many threads are quickest, on machines made up: seconds of a step by the number of threads.
#include "parallel/thread_choice.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace courant {

namespace {

struct Course {
  double seconds = 0;
  int threads = 0;  ///< at the end
  int lines = 0;
};

using StepTime = std::function<double(int threads, int step)>;

/// `share`: of the threads' time that is computed.
Course run(int most, std::int64_t work, int busy, int steps, const StepTime& time, double share = 1) {
  ThreadChoice choice(most, work, busy);
  Course c;
  double cpu = 0;
  for (int k = 0; k < steps; ++k) {
    c.threads = choice.threads();
    EXPECT_GE(c.threads, 1);
    EXPECT_LE(c.threads, most);
    const double seconds = time(c.threads, k);
    c.seconds += seconds, cpu += share * c.threads * seconds;
    c.lines += !choice.step(c.seconds, cpu).empty();
  }
  c.threads = choice.threads();
  return c;
}

/// Each thread more helps, as on a machine of one's own.
double idle(int threads, int) {
  return 1e-3 * (0.1 + 0.9 / threads);
}
/// Each wait for another thread lasts a time slice.
double taken(int threads, int) {
  return threads == 1 ? 1e-3 : 6e-3;
}

TEST(ThreadChoice, LosesLittleOnAnIdleMachine) {
  for (const int most : {1, 2, 16}) {
    const Course c = run(most, 100000, 0, 5000, idle);
    EXPECT_EQ(c.threads, most);
    EXPECT_EQ(c.lines, 0);
    EXPECT_LT(c.seconds, 1.03 * 5000 * idle(most, 0)) << most;
  }
}

TEST(ThreadChoice, GivesWayOnABusyMachine) {
  const Course known = run(2, 100000, 8, 1000, taken);
  EXPECT_EQ(known.threads, 1);
  EXPECT_LT(known.seconds, 1.3 * 1000 * taken(1, 0));
  // nobody was seen at the start, but threads wait
  const Course found = run(2, 100000, 0, 1000, taken, 0.3);
  EXPECT_EQ(found.threads, 1);
  EXPECT_EQ(found.lines, 1);
  EXPECT_LT(found.seconds, 1.3 * 1000 * taken(1, 0));
}

TEST(ThreadChoice, FollowsWhenOthersComeAndGo) {
  const auto changing = [](int threads, int step) {
    return step < 2000 || step > 6000 ? idle(threads, step) : taken(threads, step);
  };
  EXPECT_EQ(run(2, 100000, 0, 2000, changing).threads, 2);
  EXPECT_EQ(run(2, 100000, 0, 6000, changing).threads, 1);
  EXPECT_EQ(run(2, 100000, 0, 40000, changing).threads, 2);
}

TEST(ThreadChoice, SmallScenesBeginWithOneThread) {
  EXPECT_EQ(ThreadChoice(8, 999, 0).threads(), 1);
  EXPECT_EQ(ThreadChoice(8, 1000, 0).threads(), 8);
  EXPECT_EQ(ThreadChoice(8, 1000, 6).threads(), 2);
  EXPECT_EQ(ThreadChoice(8, 1000, 20).threads(), 1);
  EXPECT_EQ(run(8, 500, 0, 20000, idle).threads, 8);  // where more are quicker all the same
}

}  // namespace

}  // namespace courant
