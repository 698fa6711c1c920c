#pragma once
// What a finished run left behind besides its results: how it ended, and for which deck and build.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/real.hpp"
#include "verify/results.hpp"

namespace courant {

/// Content of record.yaml in the folder of a run. It is there only if the run has ended.
struct RunRecord {
  std::string key;  ///< of deck, parameters and build; another key: the results are of something else
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none
  bool timed_out = false;
  Real time_limit = 0;                       ///< [s]
  double wall_seconds = 0, cpu_seconds = 0;  ///< of the whole process
  std::int64_t peak_memory_bytes = 0;
};

/// Throws OutputError.
void write_record(const std::filesystem::path& folder, const RunRecord& record);
/// The record in a folder; nothing if there is none or it cannot be understood.
std::optional<RunRecord> read_record(const std::filesystem::path& folder);

/// What limits of stability cases may name.
struct RunNumbers {
  Real residual = 0, ratio = 0, leaked = 0, penetration = 0, steps = 0;
};

/// A run's result from its record and the files it left, without observations: termination, reason, times,
/// counts, and the verdict as far as it follows from the way it ended (stable, stopped, refused or broken).
/// `numbers`: filled where the run ended normally.
RunResult result_of_run(const std::filesystem::path& folder, const RunRecord& record, RunNumbers& numbers);

/// Whether a run ended for reasons of its own, so that it would end so again: nobody interrupted or killed
/// it, it could be started, and there was room for what it wrote.
bool says_something_of_the_deck(const RunRecord& record, const RunResult& result);

/// 16 hexadecimal digits that tell texts apart (FNV-1a, 64 bits), going on from `before`.
std::string digest(const std::string& text, const std::string& before = {});
/// The digest of a deck with the files that a run with these parameters would read. A deck that cannot be
/// read counts by its name.
std::string digest_of_deck(const std::filesystem::path& deck,
                           const std::map<std::string, std::string>& parameters = {});
/// The digest of a program and the library with this function: another build has another one.
std::string digest_of_build(const std::filesystem::path& executable);

}  // namespace courant
