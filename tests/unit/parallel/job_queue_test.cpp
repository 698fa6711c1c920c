#include "parallel/job_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace courant {
namespace {

/// With a thread and without one the queue must look the same from outside.
class JobQueueTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Capacities, JobQueueTest, testing::Values(0, 1, 32));

TEST_P(JobQueueTest, KeepsTheOrder) {
  std::vector<int> done, expected(200);
  std::iota(expected.begin(), expected.end(), 0);
  JobQueue queue(GetParam());
  for (const int i : expected) queue.submit([&done, i] { done.push_back(i); }, 1 + i % 7);
  queue.wait();
  EXPECT_EQ(done, expected);
}

TEST_P(JobQueueTest, FailureReachesTheSubmitterOnceAndLaterJobsAreDropped) {
  std::vector<int> done;
  JobQueue queue(GetParam());
  std::string told;
  try {
    for (int i = 0; i < 40; ++i)
      queue.submit([&done, i] {
        if (i == 3) throw std::out_of_range("job 3");
        done.push_back(i);
      });
    queue.wait();
  } catch (const std::out_of_range& error) {
    told = error.what();
  }
  EXPECT_EQ(told, "job 3");
  EXPECT_NO_THROW(queue.submit([&done] { done.push_back(99); }));
  EXPECT_NO_THROW(queue.wait());
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2}));
}

TEST_P(JobQueueTest, TakesWhatCannotBeCopied) {
  int got = 0;
  JobQueue queue(GetParam());
  queue.submit([&got, value = std::make_unique<int>(7)] { got = *value; });
  queue.wait();
  EXPECT_EQ(got, 7);
}

TEST_P(JobQueueTest, CountsCpuTimeOfJobs) {
  JobQueue queue(GetParam());
  queue.submit([] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
    volatile int work = 0;
    while (std::chrono::steady_clock::now() < end) work = work + 1;
  });
  queue.wait();
  EXPECT_GT(queue.cpu_seconds(), 0.0);
  EXPECT_LT(queue.cpu_seconds(), 0.5);
}

TEST(JobQueue, FailureOfTheLastJobIsToldByWait) {
  JobQueue queue(8);
  queue.submit([] { throw std::runtime_error("late"); });
  EXPECT_THROW(queue.wait(), std::runtime_error);
}

TEST(JobQueue, SubmitReturnsBeforeTheJobIsDone) {
  std::promise<void> gate;
  JobQueue queue(8);
  bool done = false;
  queue.submit([&] {
    gate.get_future().wait();
    done = true;
  });
  gate.set_value();  // would never be reached if submit did the job
  queue.wait();
  EXPECT_TRUE(done);
}

TEST(JobQueue, FullQueueHoldsUpTheSubmitter) {
  std::promise<void> gate;
  std::shared_future<void> open = gate.get_future();
  std::atomic<int> submitted = 0;
  JobQueue queue(2);
  std::thread submitter([&] {  // the only one that calls the queue until it is joined
    for (int i = 0; i < 4; ++i) {
      queue.submit([open] { open.wait(); });
      ++submitted;
    }
  });
  while (submitted < 2) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(submitted, 2);  // one is running, one waits, the third finds no space
  gate.set_value();
  submitter.join();
  queue.wait();
  EXPECT_EQ(submitted, 4);
}

TEST(JobQueue, DestructorFinishesTheJobs) {
  int done = 0;
  {
    JobQueue queue(64);
    for (int i = 0; i < 50; ++i) queue.submit([&done] { ++done; });
  }
  EXPECT_EQ(done, 50);
}

}  // namespace
}  // namespace courant
