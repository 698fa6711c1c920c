#include "parallel/job_queue.hpp"

#include <sched.h>

#include <ctime>
#include <system_error>

namespace courant {
namespace {

double cpu_seconds_of_this_thread() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

JobQueue::JobQueue(int capacity) : capacity_(capacity) {
  if (capacity_ <= 0) return;
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {
    capacity_ = 0;
  }
}

JobQueue::~JobQueue() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void JobQueue::push(Entry entry) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failed_ || load_ == 0 || load_ + entry.weight <= capacity_; });
  tell_failure(lock);
  if (failed_) return;
  const int weight = entry.weight;
  if (thread_.joinable()) {
    jobs_.push_back(std::move(entry));
    load_ += weight;
    lock.unlock();
    changed_.notify_all();
  } else {
    load_ += weight;
    run(std::move(entry), lock);
    tell_failure(lock);
  }
}

void JobQueue::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return load_ == 0; });
  tell_failure(lock);
}

double JobQueue::cpu_seconds() {
  const std::lock_guard lock(mutex_);
  return cpu_seconds_;
}

void JobQueue::work() {
  // A job takes its share of time, but its start must not interrupt the thread that submits it.
  const sched_param none{};
  sched_setscheduler(0, SCHED_BATCH,
                     &none);  // only a hint: where it is refused the jobs are done all the same
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Entry entry = std::move(jobs_.front());
    jobs_.pop_front();
    run(std::move(entry), lock);
    changed_.notify_all();
  }
}

/// Runs the job without the lock, unless one before it failed. The task keeps what the job throws.
void JobQueue::run(Entry entry, std::unique_lock<std::mutex>& lock) {
  if (!failed_) {
    lock.unlock();
    succeeded_ = false;
    std::future<void> result = entry.task.get_future();
    const double start = cpu_seconds_of_this_thread();
    entry.task();
    entry.task = {};  // what the job holds is released before anybody waits for the lock
    const double seconds = cpu_seconds_of_this_thread() - start;
    lock.lock();
    cpu_seconds_ += seconds;
    if (!succeeded_) {
      failed_ = true;
      failure_ = std::move(result);
    }
  }
  load_ -= entry.weight;
}

void JobQueue::tell_failure(std::unique_lock<std::mutex>& lock) {
  if (!failure_.valid()) return;
  std::future<void> failure = std::move(failure_);
  lock.unlock();
  failure.get();
  lock.lock();
}

}  // namespace courant
