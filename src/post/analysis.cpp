#include "post/analysis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/nearest_word.hpp"

namespace courant {
namespace {

struct Kind {
  const char* name;
  std::unique_ptr<Analysis> (*read)(const MapReader&, const PostSettings&);
};
constexpr Kind kinds[] = {{"probe", read_probe_analysis},       {"surface", read_surface_analysis},
                          {"grid", read_grid_analysis},         {"profile", read_profile_analysis},
                          {"spectrum", read_spectrum_analysis}, {"flux", read_flux_analysis},
                          {"history", read_history_analysis},   {"force", read_force_analysis},
                          {"toe", read_toe_analysis},           {"roller", read_roller_analysis}};

bool is_file_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

}  // namespace

const ParticleGrid& PostState::selection(const std::string& text, const CompiledExpression& where) const {
  if (const auto found = selections_.find(text); found != selections_.end()) return found->second;
  const std::vector<Real> counts = evaluate(where, frame);
  const auto active = frame.arrays.find("active");
  std::vector<char> taken(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i)
    taken[i] = counts[i] > 0 && (active == frame.arrays.end() || active->second[i] > 0);
  return selections_.emplace(text, ParticleGrid(frame, taken)).first->second;
}

const ParticleGrid& PostState::water(const std::string& text, const CompiledExpression& where,
                                     const SprayRule& rule) const {
  const std::string key = fmt::format("{} {} {}", rule.link, rule.share, text);
  if (const auto found = waters_.find(key); found != waters_.end()) return found->second;
  return waters_.emplace(key, water_body(selection(text, where), rule)).first->second;
}

Analysis::Analysis(std::string kind, const MapReader& map) : kind_(std::move(kind)) {
  map.text("name", name_, true);
  where_ = map.where(map.node());
  file_ = where_.file;
  if (const auto node = map.get("name", false); node && node->IsScalar() && !is_file_name(name_))
    map.error(*node, fmt::format("the name '{}' of an analysis must be of letters, digits, - and _", name_),
              "files are named after it");
}

PostTable& Analysis::add_table(const std::string& suffix) {
  return result_.tables.emplace_back(PostTable{suffix.empty() ? name_ : name_ + "_" + suffix, {}});
}

void Analysis::add_scalar(const std::string& name, const std::string& unit, Real value) {
  result_.scalars.push_back({name, unit, value});
}

void Analysis::fault(Diagnostics& diagnostics, const std::string& message, const std::string& hint) const {
  diagnostics.error(where_, fmt::format("analysis '{}': {}", name_, message), hint);
}

void Analysis::fault_no_state(Diagnostics& diagnostics) const {
  fault(diagnostics, "the results have no state in its window in time");
}

const Analysis* find_analysis(const std::vector<std::unique_ptr<Analysis>>& earlier, const std::string& name,
                              const Analysis& asking, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const auto& analysis : earlier) {
    if (analysis.get() == &asking) break;
    if (analysis->name() == name) return analysis.get();
    names.push_back(analysis->name());
  }
  diagnostics.error(asking.where(),
                    fmt::format("analysis '{}': there is no analysis '{}' above it", asking.name(), name),
                    names.empty() ? "it must stand above the one that uses it"
                                  : fmt::format("above it stand {}", fmt::join(names, ", ")));
  return nullptr;
}

void RunningMoments::add(Real value) {
  if (std::isnan(value)) return;
  n += 1;
  const Real before = value - mean;
  mean += before / n;
  squares += before * (value - mean);
  least = std::min(least, value), most = std::max(most, value);
}

Real RunningMoments::deviation() const {
  return n > 0 ? std::sqrt(squares / n) : std::nan("");
}

Real RunningMoments::mean_or_nan() const {
  return n > 0 ? mean : std::nan("");
}

Real median(std::vector<Real> values) {
  std::erase_if(values, [](Real v) { return std::isnan(v); });
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Real slack_of(const std::vector<Real>& times) {
  return times.size() > 1 ? 0.25 * (times.back() - times.front()) / static_cast<Real>(times.size() - 1) : 0;
}

bool TimeWindow::holds_any(const std::vector<Real>& times) const {
  const Real slack = slack_of(times);
  return std::any_of(times.begin(), times.end(), [&](Real t) { return holds(t, slack); });
}

void read_window(const MapReader& map, TimeWindow& window) {
  map.number("from", window.from);
  map.number("to", window.to);
  if (const auto node = map.get("from", false); node && !(window.from < window.to))
    map.error(*node, fmt::format("'{}.from' must be less than 'to'", map.name()));
}

std::optional<std::pair<Real, Real>> read_range(const MapReader& map, const char* key, bool required) {
  const auto node = map.get(key, required);
  if (!node) return std::nullopt;
  if (!node->IsSequence() || node->size() != 2) {
    map.error(*node, fmt::format("'{}.{}' must be two numbers", map.name(), key), "for example [0, 1.1]");
    return std::nullopt;
  }
  Real low = 0, high = 0;
  if (!map.scalar((*node)[0], key, low) || !map.scalar((*node)[1], key, high)) return std::nullopt;
  if (!(low < high)) {
    map.error(*node, fmt::format("'{}.{}': the first number must be less than the second", map.name(), key));
    return std::nullopt;
  }
  return std::pair{low, high};
}

std::vector<Real> read_places(const MapReader& map, const char* key, bool required) {
  std::vector<Real> out;
  const auto node = map.get(key, required);
  if (!node) return out;
  if (node->IsMap()) {
    const MapReader range = map.element(*node, (map.name() + "." + key).c_str());
    range.allow({"from", "to", "step"});
    Real from = 0, to = 0, step = 0;
    range.number("from", from, true);
    range.number("to", to, true);
    range.positive("step", step, true);
    constexpr Real most = 1e5;
    if (!(step > 0)) return out;
    if (!(from <= to) || (to - from) / step > most)
      range.error(*node, fmt::format("'{}' must go upwards in at most {:g} steps", range.name(), most));
    else
      for (int k = 0; from + k * step <= to + 1e-6 * step; ++k) out.push_back(from + k * step);
  } else if (node->IsSequence()) {
    for (const auto& element : *node) map.scalar(element, key, out.emplace_back());
    if (out.empty()) map.error(*node, fmt::format("'{}.{}' is empty", map.name(), key));
  } else {
    map.scalar(*node, key, out.emplace_back());
  }
  return out;
}

std::size_t read_choice(const MapReader& map, const char* key, const std::vector<std::string>& words) {
  std::string word = words.front();
  map.text(key, word);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  map.error(*map.get(key, false), fmt::format("'{}.{}' cannot be '{}'", map.name(), key, word),
            fmt::format("it is one of {}", fmt::join(words, ", ")));
  return 0;
}

Where read_where(const MapReader& map) {
  Where out;
  if (const auto node = map.get("where", false)) {
    map.text("where", out.text);
    out.of = read_expression(map, *node, "where", quantity_variables());
  }
  return out;
}

SprayRule read_spray(const MapReader& map) {
  SprayRule out;
  map.positive("link", out.link);
  if (out.link > 2)
    map.error(*map.get("link", false),
              fmt::format("'{}.link' must be at most 2, got {:g}", map.name(), out.link),
              "particles further apart than 2 h do not know each other");
  map.number("share", out.share);
  if (out.share < 0 || out.share > 1)
    map.error(*map.get("share", false),
              fmt::format("'{}.share' must be 0 to 1, got {:g}", map.name(), out.share),
              "0 lets every drop count");
  return out;
}

std::string short_number(Real value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0 : value);
}

std::vector<Quantity> read_quantities(const MapReader& map, const PostUnits& units) {
  std::vector<Quantity> out;
  map.list(
      "of", [&](const YAML::Node& node) { out.push_back(read_quantity(map, node, "of", units)); }, true);
  if (const auto node = map.get("of", false); node && node->IsSequence() && out.empty())
    map.error(*node, fmt::format("'{}.of' is empty", map.name()), "for example [vx, vy, p]");
  return out;
}

std::unique_ptr<Analysis> read_analysis(const MapReader& map, const PostSettings& settings) {
  std::string word;
  map.text("kind", word, true);
  std::vector<std::string> words;
  for (const Kind& kind : kinds) {
    if (word == kind.name) return kind.read(map, settings);
    words.emplace_back(kind.name);
  }
  if (const auto node = map.get("kind", false); node && node->IsScalar()) {
    const std::string near = nearest_word(word, words);
    map.error(*node, fmt::format("there is no kind of analysis '{}'", word),
              fmt::format("{}kinds: {}", near.empty() ? "" : fmt::format("did you mean {}? ", near),
                          fmt::join(words, ", ")));
  }
  return nullptr;
}

}  // namespace courant
