#pragma once
// Work of several parts that threads go through together.
#include <atomic>
#include <thread>

#include <omp.h>

namespace courant {

/// A barrier of the threads of a team. They spin for some 20 microseconds, which is how long a thread that
/// sleeps takes to wake up, before they let others run.
class Meeting {
 public:
  /// For all `team` threads, behind what they have written before.
  void wait(int team) {
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == team) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      return;
    }
    for (int looks = 0; round_.load(std::memory_order_acquire) == round; ++looks)
      if (looks < patience)
        pause();
      else
        std::this_thread::yield();
  }

 private:
  static constexpr int patience = 1000;
  static void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  std::atomic<int> arrived_{0};
  std::atomic<unsigned> round_{0};
};

/// Calls `body(part, t)` for every part in [0, parts), one after the other, and every t in [0, n), on threads
/// of their own where there are as many; none begins a part before all have ended the one before.
template <class Body>
void on_threads_in_parts(int parts, int n, const Body& body) {
  Meeting meeting;
#pragma omp parallel num_threads(n) if (n > 1)
  {
    const int team = omp_get_num_threads();
    for (int part = 0; part < parts; ++part) {
      if (part > 0) meeting.wait(team);
      for (int t = omp_get_thread_num(); t < n; t += team) body(part, t);
    }
  }
}

}  // namespace courant
