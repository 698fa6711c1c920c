#pragma once
// Restart files of runs: the one to continue from, those to write, and when.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/run/simulation.hpp"
#include "base/restart_error.hpp"
#include "output/ascii/ascii.hpp"
#include "output/result_names.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// A state to continue from.
struct Restart {
  std::filesystem::path file;
  SavedState state;
  std::string version, instruction_set;  ///< of the program that wrote it
  Real t = 0;                            ///< [T]
  std::int64_t cycle = 0;
  DeckRecord deck;
  std::vector<std::string> warnings;  ///< files passed over, and why bits may differ from here on
};

/// The file, or the latest whole one of a folder of results. Throws RestartError, which states what is wrong
/// and which other file could be used.
Restart open_restart(const std::filesystem::path& file_or_folder);

/// The first entries of a restart file: its program, time and deck.
void keep_head(Restart& head, Archive& archive);
/// Of this program, at the present state of `simulation`.
Restart head_of(Simulation& simulation);

/// When restart files are due and how they are called.
class RestartSchedule {
 public:
  RestartSchedule() = default;
  explicit RestartSchedule(const Deck& deck);
  /// Names of the files due when `cycle` steps have been taken.
  std::vector<std::string> due(std::int64_t cycle);
  std::string next_dump();  ///< d3dump01, d3dump02, ...
  void keep(Archive& archive) { archive("dumps", dumps_); }

 private:
  std::int64_t runrsf_ = 0, d3dump_ = 0;  ///< cycles between files, 0: none
  int files_ = 1, dumps_ = 0;
};

/// Makes the folder of results and takes away what an older run's results could pass for this one's by, if
/// this one is killed. Returns whether the run goes on in the folder that it was in before, and so with the
/// files there. Throws OutputError, before anything has changed where a result would go over a file of the
/// deck or through a link.
bool prepare_folder(const RunOptions& options, const Deck& deck);
/// How far the files had come when the restart file was written.
HistoryPositions positions_before(const RunOptions& options);

/// The command to continue a run of this deck from a restart file.
std::string call_to_go_on(const std::string& deck, const RunOptions& options, const std::string& file);

/// Moves the restart files in `dir`/restart of states later than `cycle` to `dir`/restart_old, so that nobody
/// takes those of another run, or of another branch of this one, for the latest. Returns their number.
/// `in_use`: a file there that must not be replaced. Throws OutputError.
int retire_restart_files(const std::filesystem::path& dir, std::int64_t cycle,
                         const std::filesystem::path& in_use = {});

}  // namespace courant
