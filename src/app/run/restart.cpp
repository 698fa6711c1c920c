#include "app/run/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include "app/run/app_cards.hpp"
#include "app/run/result_folder.hpp"
#include "base/instruction_set.hpp"
#include "base/version.hpp"
#include "output/hdf5.hpp"
#include "output/restart_file.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

void keep_deck(DeckRecord& deck, Archive& archive) {
  const Archive::Group inside(archive, "deck");
  std::vector<std::string> names, lines;
  std::vector<std::int64_t> entries, sums, line_counts;
  for (const KeywordRecord& k : deck) {
    names.push_back(k.name);
    entries.push_back(k.entries);
    sums.push_back(static_cast<std::int64_t>(k.sum));
    line_counts.push_back(static_cast<std::int64_t>(k.lines.size()));
    lines.insert(lines.end(), k.lines.begin(), k.lines.end());
  }
  archive("keywords", names);
  archive("entries", entries);
  archive("sums", sums);
  archive("line_counts", line_counts);
  archive("lines", lines);
  if (!archive.loading()) return;
  deck.clear();
  if (entries.size() != names.size() || sums.size() != names.size() || line_counts.size() != names.size())
    archive.stop("keywords", "has another length than its numbers");
  auto line = lines.begin();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (line_counts[k] < 0 || line_counts[k] > lines.end() - line)
      archive.stop("line_counts", "counts lines that are not there");
    const auto end = line + line_counts[k];
    deck.push_back({names[k], entries.at(k), static_cast<std::uint64_t>(sums.at(k)), {line, end}});
    line = end;
  }
}

Restart read(const fs::path& file) {
  Restart out;
  out.file = file;
  out.state = read_restart_file(file);
  Archive archive = Archive::loader(out.state);
  keep_head(out, archive);
  if (out.version != COURANT_VERSION)
    out.warnings.push_back(
        fmt::format("the restart file was written by courant {}, this is {}: the last bits "
                    "may differ from those of an uninterrupted run",
                    out.version, COURANT_VERSION));
  if (out.instruction_set != name_of(instruction_set()))
    out.warnings.push_back(
        fmt::format("the run so far used {} instructions, this machine {}: the last bits may "
                    "differ; COURANT_SIMD chooses",
                    out.instruction_set, name_of(instruction_set())));
  return out;
}

/// The latest whole file of those, without `but`; what is wrong with those before it goes to `faults`.
std::string latest_whole(const std::vector<RestartFile>& files, const fs::path& but,
                         std::vector<std::string>& faults) {
  for (const RestartFile& one : files) {
    if (one.file == but) continue;
    try {
      read_restart_file(one.file);
      return one.file.string();
    } catch (const RestartError& error) {
      faults.push_back(error.what());
    }
  }
  return "";
}

Restart latest_of(const fs::path& folder) {
  std::vector<RestartFile> files = restart_files(folder / "restart");
  if (files.empty()) files = restart_files(folder);
  std::vector<std::string> faults;
  const std::string file = latest_whole(files, "", faults);
  if (file.empty()) {
    std::string text =
        fmt::format("cannot restart from '{}': there is no whole restart file in it", folder.string());
    for (const std::string& fault : faults) text += "\n  " + fault;
    throw RestartError(text +
                       "\n  hint: start the run again; *DATABASE_BINARY_RUNRSF requests restart files");
  }
  Restart out = read(file);
  out.warnings.insert(out.warnings.begin(), faults.begin(), faults.end());
  return out;
}

}  // namespace

void keep_head(Restart& head, Archive& archive) {
  const Archive::Group inside(archive, "head");
  archive("version", head.version);
  archive("instruction_set", head.instruction_set);
  archive("t", head.t);
  archive("cycle", head.cycle);
  keep_deck(head.deck, archive);
}

Restart open_restart(const fs::path& file_or_folder) {
  std::error_code error;
  if (fs::is_directory(file_or_folder, error)) return latest_of(file_or_folder);
  try {
    return read(file_or_folder);
  } catch (const RestartError& fault) {
    std::vector<std::string> ignored;
    fs::path folder = file_or_folder.parent_path();
    if (folder.empty()) folder = ".";
    const std::string other = latest_whole(restart_files(folder), file_or_folder, ignored);
    throw RestartError(std::string(fault.what()) + "\n  hint: " +
                       (other.empty() ? "give a file that `courant run` wrote to its folder restart/, or the "
                                        "folder of the run; without one start the run again"
                                      : fmt::format("'{}' is whole: --restart {}", other, other)));
  }
}

Restart head_of(Simulation& simulation) {
  Restart head;
  head.version = COURANT_VERSION;
  head.instruction_set = name_of(instruction_set());
  head.t = simulation.clock().t;
  head.cycle = simulation.clock().cycle;
  head.deck = simulation.record();
  return head;
}

RestartSchedule::RestartSchedule(const Deck& deck) {
  constexpr Real never = 1e15;  // also what no integer holds
  const auto cycles = [](Real cycl) {
    return cycl > 0 && cycl < never ? std::max<std::int64_t>(1, std::llround(cycl)) : 0;
  };
  if (const auto* card = deck.last<DatabaseRunrsfCard>()) {
    runrsf_ = cycles(card->cycl);
    files_ = std::max(card->nr, 1);
  }
  if (const auto* card = deck.last<DatabaseD3dumpCard>()) d3dump_ = cycles(card->cycl);
}

std::string RestartSchedule::next_dump() {
  return fmt::format("d3dump{:02d}", ++dumps_);
}

std::vector<std::string> RestartSchedule::due(std::int64_t cycle) {
  std::vector<std::string> names;
  if (runrsf_ > 0 && cycle % runrsf_ == 0)
    names.push_back(files_ == 1 ? "runrsf" : fmt::format("runrsf{:02d}", (cycle / runrsf_ - 1) % files_ + 1));
  if (d3dump_ > 0 && cycle % d3dump_ == 0) names.push_back(next_dump());
  return names;
}

bool prepare_folder(const RunOptions& options, const Deck& deck) {
  const fs::path dir = options.dir;
  std::error_code ignored;  // a file that cannot be removed cannot be replaced either: that is reported then
  const bool goes_on = options.restart && fs::equivalent(fs::absolute(options.restart->file).parent_path(),
                                                         dir / "restart", ignored);
  std::vector<fs::path> inputs;
  for (const DeckFile& file : deck.files) inputs.push_back(file.name);
  if (options.restart && !goes_on) inputs.push_back(options.restart->file);
  check_result_folder(dir, inputs);
  Hdf5Use::reserve();
  make_folder(dir / "restart");
  retire_restart_files(dir, goes_on ? options.restart->cycle : -1,
                       options.restart ? options.restart->file : fs::path());
  for (const char* name :
       {"summary.yaml", "fields/failed.vtp", "fields/failed_shells.vtu", "fields/failed_solids.vtu"})
    fs::remove(dir / name, ignored);
  if (!goes_on) remove_results(dir);
  return goes_on;
}

HistoryPositions positions_before(const RunOptions& options) {
  HistoryPositions out;
  if (!options.restart) return out;
  Archive archive = Archive::loader(options.restart->state);
  const Archive::Group inside(archive, "files");
  out.keep(archive);
  return out;
}

namespace {

/// A word as a shell takes it.
std::string in_shell(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::strchr("_-./=+,:@%", c) != nullptr;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string call_to_go_on(const std::string& deck, const RunOptions& options, const std::string& file) {
  std::string call =
      fmt::format("courant run {} -o {} --restart {}", in_shell(deck), in_shell(options.dir), in_shell(file));
  for (const std::string& param : options.params) call += " --param " + in_shell(param);
  if (options.d3plot) call += " --d3plot";
  if (options.load_case > 0) call += fmt::format(" --case {}", options.load_case);
  if (options.until > 0) call += fmt::format(" --until {}", options.until);
  return call;
}

int retire_restart_files(const fs::path& dir, std::int64_t cycle, const fs::path& in_use) {
  int count = 0;
  for (const RestartFile& one : restart_files(dir / "restart")) {
    if (one.cycle <= cycle) continue;
    make_folder(dir / "restart_old");
    fs::path to = dir / "restart_old" / one.file.filename();
    std::error_code error;
    if (fs::equivalent(to, in_use, error)) to.replace_filename("later_" + one.file.filename().string());
    fs::rename(one.file, to, error);
    if (error) throw OutputError(to, error.message());
    ++count;
  }
  return count;
}

}  // namespace courant
