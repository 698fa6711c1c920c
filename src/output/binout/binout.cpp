#include "output/binout/binout.hpp"

#include <fmt/format.h>

namespace courant {
namespace {

LsdaArray lsda_array(const std::string& folder, const HistoryArray& one) {
  if (const auto* reals = std::get_if<std::vector<Real>>(&one.values))
    return lsda_reals(folder, one.name, *reals);
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&one.values))
    return lsda_integers(folder, one.name, *integers);
  return lsda_text(folder, one.name, std::get<std::string>(one.values));
}

std::string padded(std::string text, std::size_t width) {
  text.resize(width, ' ');
  return text;
}

}  // namespace

void Binout::add_metadata(const std::string& folder, const HistoryFolder& of,
                          const std::vector<Legend>& legend, std::vector<LsdaArray>& out) const {
  constexpr std::size_t title_width = 80, legend_width = 70, word_width = 10;
  const std::string name = folder + "/metadata";
  out.push_back(lsda_text(name, "title", padded(title_, title_width)));
  out.push_back(lsda_text(name, "version", padded("courant", word_width)));
  out.push_back(lsda_text(name, "date", padded(date_, word_width)));
  if (!legend.empty()) {
    std::vector<std::int64_t> ids;
    std::string titles;
    for (const Legend& one : legend) ids.push_back(one.id), titles += padded(one.title, legend_width);
    out.push_back(lsda_integers(name, "legend_ids", ids));
    out.push_back(lsda_text(name, "legend", titles));
  }
  for (const HistoryArray& one : of.fixed) out.push_back(lsda_array(name, one));
}

// A folder may have its first entity later than others of the history: elements, driven particles.
void Binout::write(const std::string& history, Real t, std::int64_t cycle, const HistoryNumbers& numbers,
                   const std::vector<Legend>& legend) {
  const std::int64_t number = ++states_[history];
  std::vector<LsdaArray> all;
  for (const HistoryFolder& one : numbers.folders) {
    const std::string folder = "/" + history + (one.name.empty() ? "" : "/" + one.name);
    if (std::int64_t& begun = states_[folder]; begun == 0) {
      begun = 1;
      add_metadata(folder, one, legend, all);
    }
    const std::string state = fmt::format("{}/d{:06d}", folder, number);
    all.push_back(lsda_reals(state, "time", {t}));
    all.push_back(lsda_integers(state, "cycle", {cycle}));
    for (const HistoryArray& array : one.state) all.push_back(lsda_array(state, array));
  }
  if (!all.empty()) file_.write(all);
}

}  // namespace courant
