#pragma once
// Runs as child processes, several at once.
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verify/record.hpp"

namespace courant {

/// One call of a program. Its stdout and stderr go to `errors.txt` in `folder`.
struct ProcessJob {
  std::vector<std::string> words;  ///< the program and its arguments
  std::filesystem::path folder;
  Real time_limit = 0;  ///< [s]
};

struct ProcessCalls {
  std::function<void(std::size_t job)> started;
  /// The record has no key yet.
  std::function<void(std::size_t job, const RunRecord&)> ended;
  std::function<void()> waiting;  ///< about ten times a second
};

/// Runs all jobs in their order, at most `at_once` side by side. A job beyond its limit gets SIGTERM, and
/// SIGKILL five seconds later. Children end with this process, however it ends. False if `stop` was set:
/// children were killed, and `ended` was not called for them.
bool run_processes(const std::vector<ProcessJob>& jobs, int at_once, const std::atomic<bool>* stop,
                   const ProcessCalls& calls);

}  // namespace courant
