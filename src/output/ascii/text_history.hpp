#pragma once
// The text histories that the library writes from samples: each is one file that registers itself. Layouts:
// those that LS-DYNA R16 prints, measured on real files.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "output/sample.hpp"

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
  std::string name{};  ///< of the file; *DATABASE_ and this in capitals ask for it
  /// One state; first_potential: potential energy at the first state [ML2/T2].
  std::function<std::string(const Sample& sample, Real first_potential)> text{};
  /// Behind the title, once; none: nothing.
  std::function<std::string(const HistoryTitles&)> head{};
};

/// By name.
const std::vector<TextHistory>& text_histories();
/// One state of a history of the registry. Throws std::out_of_range where there is none of that name.
std::string history_text(const std::string& name, const Sample& sample, Real first_potential = 0);

struct RegisterTextHistory {
  explicit RegisterTextHistory(TextHistory file);
};

/// `{BEGIN LEGEND}` ... `{END LEGEND}`.
std::string ascii_legend(const std::vector<Legend>& entries);

}  // namespace courant
