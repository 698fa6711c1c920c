#pragma once
// Histories as binout: the numbers of the ASCII files in LSDA, by the names that LS-DYNA gives them.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "output/binout/lsda.hpp"
#include "output/sample.hpp"

namespace courant {

/// Whether there is a binout of a history.
bool has_binout(const std::string& history);

/// The arrays of one state, without those that never change; `first_potential` as of glstat_text.
/// number: of the state, from 1 on. Empty: nothing to tell.
std::vector<LsdaArray> binout_state(const std::string& history, const Sample& sample, Real first_potential,
                                    std::int64_t number);
/// What never changes: ids in the order of the arrays, and the title.
std::vector<LsdaArray> binout_head(const std::string& history, const Sample& sample,
                                   const std::string& title);

/// The file `binout0000` with the histories that a deck asks for in it.
class Binout {
 public:
  /// Goes on behind what `states` (of each history) and `bytes` tell, or begins. Throws OutputError.
  Binout(std::filesystem::path file, std::string title, std::map<std::string, std::int64_t> states,
         std::optional<std::uintmax_t> bytes)
      : file_(std::move(file), bytes), title_(std::move(title)), states_(std::move(states)) {}

  /// Throws OutputError.
  void write(const std::string& history, const Sample& sample, Real first_potential);
  std::uintmax_t size() const { return file_.size(); }
  const std::map<std::string, std::int64_t>& states() const { return states_; }

 private:
  LsdaFile file_;
  std::string title_;
  std::map<std::string, std::int64_t> states_;
};

}  // namespace courant
