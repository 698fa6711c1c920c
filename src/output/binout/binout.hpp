#pragma once
// Histories as binout: arrays in LSDA, in the folders and by the names that LS-DYNA gives them.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "output/ascii/text_history.hpp"
#include "output/binout/lsda.hpp"
#include "state/history_numbers.hpp"

namespace courant {

/// The file `binout0000` with the histories that a deck requests in it.
class Binout {
 public:
  /// Continues behind the `states` of each history and the `bytes` of the file, or starts a new file. `date`:
  /// MM/DD/YYYY. Throws OutputError.
  Binout(std::filesystem::path file, std::string title, std::string date,
         std::map<std::string, std::int64_t> states, std::optional<std::uintmax_t> bytes)
      : file_(std::move(file), bytes),
        title_(std::move(title)),
        date_(std::move(date)),
        states_(std::move(states)) {}

  /// Adds a state to a history; the first one writes `metadata`, too. Throws OutputError.
  void write(const std::string& history, Real t, std::int64_t cycle, const HistoryNumbers& numbers,
             const std::vector<Legend>& legend);
  std::uintmax_t size() const { return file_.size(); }
  /// Number of states of each history; of its folders the ones whose `metadata` is written count 1.
  const std::map<std::string, std::int64_t>& states() const { return states_; }

 private:
  void add_metadata(const std::string& folder, const HistoryFolder& of, const std::vector<Legend>& legend,
                    std::vector<LsdaArray>& out) const;

  LsdaFile file_;
  std::string title_, date_;
  std::map<std::string, std::int64_t> states_;
};

}  // namespace courant
