#pragma once
// Work that need not hold up the computation: jobs that one thread does beside the computing ones.
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace courant {

/// Runs jobs one after the other in the order they were submitted. What a job throws reaches the submitter:
/// the next `submit` or `wait` throws it, once. The jobs after the one that failed are dropped. All calls
/// come from one thread.
class JobQueue {
 public:
  /// capacity: how much weight of jobs may be waiting or running. 0: there is no thread, `submit` does the
  /// job itself; so it is, too, where the system gives no thread.
  explicit JobQueue(int capacity);
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;
  /// Waits for the jobs. What they throw is lost: call `wait` before.
  ~JobQueue();

  /// Waits until there is space, then leaves the job to the queue. A job heavier than the capacity waits
  /// until it is alone. Throws what an earlier job threw; then the new one is dropped.
  template <class Job>
  void submit(Job job, int weight = 1) {
    push({std::packaged_task<void()>([this, job = std::move(job)]() mutable {
            job();
            succeeded_ = true;
          }),
          weight});
  }
  /// Waits until all jobs are done. Throws what one of them threw.
  void wait();
  /// CPU time of the jobs that were done so far [s].
  double cpu_seconds();

 private:
  struct Entry {
    std::packaged_task<void()> task;
    int weight;
  };
  void push(Entry entry);
  void work();
  void run(Entry entry, std::unique_lock<std::mutex>& lock);
  void tell_failure(std::unique_lock<std::mutex>& lock);

  int capacity_;
  std::mutex
      mutex_;  // guards what follows, except succeeded_, which belongs to the thread that does the jobs
  std::condition_variable changed_;
  std::deque<Entry> jobs_;
  int load_ = 0;  // weight of the jobs waiting and running
  bool failed_ = false, ending_ = false;
  std::future<void> failure_;  // of the job that failed, until it was reported
  double cpu_seconds_ = 0;
  bool succeeded_ = false;
  std::thread thread_;
};

}  // namespace courant
