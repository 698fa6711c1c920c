#pragma once
// `courant verify`: all runs of a suite, what is observed in them, and what that comes to.
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "verify/results.hpp"

namespace courant {

struct VerifyOptions {
  std::filesystem::path folder;                     ///< for runs and results; made if missing
  std::filesystem::path executable;                 ///< that is called as `EXECUTABLE run DECK -o FOLDER ...`
  int jobs = 0;                                     ///< runs at once; 0: one per core
  bool fresh = false;                               ///< take over nothing from earlier calls
  std::vector<std::string> only;                    ///< names of cases; empty: all
  const std::atomic<bool>* stop = nullptr;          ///< set by a signal
  std::function<void(const std::string&)> print{};  ///< a line per finished run
  std::function<void(const std::string&)>
      progress{};  ///< a line that replaces the one before; may be missing
};

struct VerifyOutcome {
  SuiteResult result;
  bool interrupted = false;  ///< runs that ended are kept; the result is not filled
};

/// Generates the decks, runs them, observes and judges. Runs that an earlier call has finished in this
/// folder, of the same deck and build, are taken over. Nothing, with messages in `diagnostics` and nothing
/// run, if the suite is wrong or another call works in the folder. Throws OutputError.
std::optional<VerifyOutcome> verify_suite(const Suite& suite, const VerifyOptions& options,
                                          Diagnostics& diagnostics);

}  // namespace courant
