#pragma once
// The histories that the library writes from samples: each is one file that registers itself, with its text
// and its numbers for binout. Layouts: those that LS-DYNA R16 prints, measured on real files; folders and
// names of binout: those that LS-DYNA's converter l2a reads.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "output/sample.hpp"
#include "state/history_numbers.hpp"

namespace courant {

struct Legend {
  Id id = 0;
  std::string title;
};

/// Titles that heads of files show.
struct HistoryTitles {
  std::vector<Legend> parts{}, contacts{}, nodes{}, rigid_walls{};
};

struct TextHistory {
  std::string name{};  ///< of the file; *DATABASE_ and this in capitals request it
  /// One state; first_potential: potential energy at the first state [ML2/T2].
  std::function<std::string(const Sample& sample, Real first_potential)> text{};
  /// The numbers of one state for binout; none: text alone.
  std::function<void(const Sample& sample, Real first_potential, HistoryNumbers& to)> numbers{};
  /// Titles of the legend; none: there is no legend.
  std::function<std::vector<Legend>(const HistoryTitles&)> legend{};
  bool empty_legend = true;  ///< a legend without titles is printed
  std::string columns{};     ///< lines behind the legend, once
};

/// By name.
const std::vector<TextHistory>& text_histories();
/// One state of a history of the registry. Throws std::out_of_range where there is none of that name.
std::string history_text(const std::string& name, const Sample& sample, Real first_potential = 0);

struct RegisterTextHistory {
  explicit RegisterTextHistory(TextHistory file);
};

/// What the text file shows behind its title, once.
std::string history_head(const TextHistory& file, const HistoryTitles& titles);

/// `{BEGIN LEGEND}` ... `{END LEGEND}`.
std::string ascii_legend(const std::vector<Legend>& entries);

}  // namespace courant
