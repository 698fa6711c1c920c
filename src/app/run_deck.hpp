#pragma once
// From a deck to the end of its run: what the command line and the Python package do alike.
#include <functional>
#include <string>

#include "app/run/simulation.hpp"
#include "keyword/read/deck_reader.hpp"

namespace courant {

/// Normal, the input is wrong, the run ended in error or is broken, anything else.
enum ExitCode { exit_ok = 0, exit_input = 1, exit_run = 2, exit_other = 3 };

struct RunCall {
  std::string deck;
  ReadOptions read;
  std::string restart;  ///< file or folder of results to continue from; empty: from the start
  int threads = 0;      ///< 0: as many as are quickest
  RunOptions options;   ///< `warnings`, `restart`, `relaxing` and `choose_threads` are filled in
  /// Gets the messages about the deck before the run begins.
  std::function<void(const Diagnostics&)> messages{};
  std::function<void()> before_run{};  ///< once everything is read and built
};

struct RunResult {
  int exit_code = exit_other;
  std::string error;  ///< reason for no run, or for its end; lines with their ends, empty: none
  Summary summary;    ///< of a run that was started
};

/// Reads, builds and runs a deck. Never prints, never ends the program; a later run in the same process has
/// the bits of one in a process of its own.
RunResult run_deck(RunCall& call);

}  // namespace courant
