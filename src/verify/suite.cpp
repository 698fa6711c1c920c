#include "verify/suite.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "base/nearest_word.hpp"
#include "post/yaml_map.hpp"
#include "verify/suite_check.hpp"

namespace courant {
namespace {

using Words = std::vector<std::string>;

/// Whether an expression of limits can name it.
bool is_identifier(const std::string& text) {
  const auto word = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), word);
}

class SuiteReader {
 public:
  SuiteReader(const std::filesystem::path& file, Diagnostics& diagnostics)
      : file_(file.string()), folder_(file.parent_path()), diagnostics_(diagnostics) {}

  Suite read(const YAML::Node& root) {
    Suite suite;
    suite.file = file_;
    const MapReader map(root, "suite", file_, diagnostics_);
    map.allow({"title", "about", "time_limit", "cases"});
    map.text("title", suite.title);
    map.text("about", suite.about);
    Real time_limit = SuiteCase{}.time_limit;
    map.positive("time_limit", time_limit);
    std::set<std::string> names;
    map.list(
        "cases",
        [&](const YAML::Node& node) {
          suite.cases.push_back(read_case(map.element(node, "case"), time_limit));
          const std::string& name = suite.cases.back().name;
          if (!name.empty() && !names.insert(name).second)
            map.error(node, fmt::format("two cases are called '{}'", name));
        },
        true);
    if (suite.cases.empty() && diagnostics_.ok()) map.error(root, "the suite has no cases");
    if (suite.title.empty()) suite.title = std::filesystem::path(file_).stem().string();
    return suite;
  }

 private:
  /// A text that must be one of `allowed`.
  void choice(const MapReader& map, const char* key, std::string& value, const Words& allowed) const {
    map.text(key, value);
    if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
    const std::string near = nearest_word(value, allowed);
    map.error(*map.get(key, true), fmt::format("'{}.{}' cannot be '{}'", map.name(), key, value),
              fmt::format("{}it may be {}", near.empty() ? "" : fmt::format("did you mean {}? ", near),
                          fmt::join(allowed, ", ")));
  }
  Words texts(const MapReader& map, const char* key) const {
    Words out;
    map.list(key, [&](const YAML::Node& node) {
      if (node.IsScalar())
        out.push_back(node.Scalar());
      else
        map.error(node, fmt::format("'{}.{}' must be a list of values", map.name(), key));
    });
    return out;
  }
  void file(const MapReader& map, const char* key, std::filesystem::path& value) const {
    std::string text;
    map.text(key, text);
    if (text.empty()) return;
    value = (folder_ / text).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(value, ignored))
      map.error(*map.get(key, true),
                fmt::format("'{}.{}': there is no file '{}'", map.name(), key, value.string()),
                "paths count from the folder of the suite");
  }
  /// NAME: VALUE
  void parameters(const MapReader& map, SuiteParameters& out) const {
    const auto values = map.map("parameters");
    if (!values || !values->node().IsMap()) return;
    for (const auto& entry : values->node()) {
      if (!entry.first.IsScalar() || !entry.second.IsScalar())
        map.error(entry.first, "parameters: expected NAME: VALUE with a number or an expression");
      else if (!out.emplace(entry.first.Scalar(), entry.second.Scalar()).second)
        map.error(entry.first, fmt::format("parameters: '{}' stands twice", entry.first.Scalar()));
    }
  }
  /// An expression, noted for the check.
  void expression(const MapReader& map, const char* key, std::string& value, CheckedExpression::Over over,
                  bool required = false) {
    map.text(key, value, required);
    const auto node = map.get(key, false);
    if (node && node->IsScalar()) noted_.push_back({map.where(*node), map.name() + "." + key, value, over});
  }
  void moment(const MapReader& map, const char* key, std::optional<std::string>& value) {
    if (!map.has(key)) return;
    expression(map, key, value.emplace(), CheckedExpression::Over::nothing);
  }

  SuiteCase read_case(const MapReader& map, Real time_limit) {
    using Over = CheckedExpression::Over;
    SuiteCase out;
    noted_.clear();
    out.where = map.where(map.node());
    out.time_limit = time_limit;
    map.allow({"name", "title", "about", "scene", "deck", "parameters", "resolution", "resolutions", "size",
               "settings", "observations", "stability", "time_limit", "picture_of", "picture_title",
               "picture_at", "picture_where"});
    map.text("name", out.name, true);
    const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (!std::all_of(out.name.begin(), out.name.end(), plain))
      map.error(*map.get("name", true), "'case.name' is a word of letters, digits, _ and -",
                "put the rest in 'title'");
    map.text("title", out.title);
    if (out.title.empty()) out.title = out.name;
    map.text("about", out.about);
    file(map, "scene", out.scene);
    file(map, "deck", out.deck);
    if (map.node().IsMap() && map.has("scene") == map.has("deck"))
      map.error(map.node(), "a case has either a 'scene' or a 'deck'");
    parameters(map, out.parameters);
    map.text("resolution", out.resolution);
    out.resolutions = texts(map, "resolutions");
    expression(map, "size", out.size, Over::nothing);
    map.positive("time_limit", out.time_limit);
    read_settings(map, out);
    map.list("observations", [&](const YAML::Node& node) {
      out.observations.push_back(read_observation(map.element(node, "observation")));
    });
    if (const auto stability = map.map("stability")) out.stability = read_stability(*stability, out);
    expression(map, "picture_of", out.picture_of, Over::particles);
    map.text("picture_title", out.picture_title);
    expression(map, "picture_at", out.picture_at, Over::nothing);
    expression(map, "picture_where", out.picture_where, Over::particles);
    check_case(map, out, noted_, diagnostics_);
    return out;
  }

  void read_settings(const MapReader& map, SuiteCase& out) {
    map.list("settings", [&](const YAML::Node& node) {
      const MapReader entry = map.element(node, "setting");
      SuiteSetting& setting = out.settings.emplace_back();
      entry.allow({"name", "parameters", "resolutions"});
      entry.text("name", setting.name, true);
      parameters(entry, setting.parameters);
      setting.resolutions = texts(entry, "resolutions");
    });
    if (out.settings.empty()) out.settings.push_back({"default", {}, {}});
  }

  SuiteObservation read_observation(const MapReader& map) {
    using Kind = SuiteObservation::Kind;
    using Over = CheckedExpression::Over;
    SuiteObservation out;
    map.allow({"name",   "title", "unit",           "kind",       "of", "where", "along",     "bins",
               "reduce", "take",  "align",          "from",       "to", "at",    "reference", "norm",
               "scale",  "bound", "bound_settings", "least_order"});
    map.text("name", out.name, true);
    if (map.has("name") && !is_identifier(out.name))
      map.error(*map.get("name", true), "'observation.name' is a word of letters, digits and _",
                "put the rest in 'title'");
    map.text("title", out.title);
    if (out.title.empty()) out.title = out.name;
    map.text("unit", out.unit);
    std::string kind = "history";
    choice(map, "kind", kind, {"history", "particles", "profile"});
    if (kind == "particles") out.kind = Kind::particles;
    if (kind == "profile") out.kind = Kind::profile;
    const Over over = out.kind == Kind::history ? Over::histories : Over::particles;
    expression(map, "of", out.of, over, true);
    expression(map, "where", out.where, Over::particles);
    expression(map, "along", out.along, Over::particles, out.kind == Kind::profile);
    choice(map, "reduce", out.reduce, {"mean", "sum", "min", "max", "count", "median", "p01", "p99"});
    if (map.has("bins")) {
      Real bins = 0;
      map.positive("bins", bins);
      out.bins = static_cast<int>(std::min(bins, 1e6));
      if (bins != out.bins) map.error(*map.get("bins", true), "'observation.bins' must be a whole number");
    }
    if (map.has("align")) {
      Real row = 0;
      map.positive("align", row);
      out.align = static_cast<int>(row);
    }
    choice(map, "take", out.take,
           {"curve", "final", "mean", "min", "max", "at", "period", "decay", "slope", "growth"});
    moment(map, "from", out.from);
    moment(map, "to", out.to);
    moment(map, "at", out.at);
    if (const auto reference = map.get("reference", false)) read_reference(map, *reference, out);
    choice(map, "norm", out.norm, {"l1", "l2", "linf"});
    expression(map, "scale", out.scale, Over::nothing);
    if (map.has("bound")) map.positive("bound", out.bound.emplace());
    if (map.has("least_order")) map.number("least_order", out.least_order.emplace());
    out.bound_settings = texts(map, "bound_settings");
    check_observation(map, out);
    return out;
  }

  /// `finest`, a formula, or a map.
  void read_reference(const MapReader& map, const YAML::Node& node, SuiteObservation& of) {
    using Kind = SuiteReference::Kind;
    SuiteReference& out = of.reference;
    const auto over = over_of_formula(of);
    if (node.IsScalar()) {
      out.kind = node.Scalar() == "finest" ? Kind::finest : Kind::formula;
      if (out.kind == Kind::formula) expression(map, "reference", out.formula, over);
      return;
    }
    const MapReader entry(node, "reference", file_, diagnostics_);
    entry.allow({"formula", "csv", "finest", "csv_x", "csv_y", "scale_x", "scale_y", "offset_x", "offset_y",
                 "source"});
    if (!node.IsMap()) return;
    if (entry.has("formula") + entry.has("csv") + entry.has("finest") != 1)
      entry.error(node, "a reference has one of 'formula', 'csv' and 'finest: true'");
    entry.text("source", out.source);
    if (entry.has("formula")) {
      out.kind = Kind::formula;
      expression(entry, "formula", out.formula, over);
    } else if (entry.has("finest")) {
      out.kind = Kind::finest;
      bool yes = false;
      if (!YAML::convert<bool>::decode(*entry.get("finest", true), yes) || !yes)
        entry.error(*entry.get("finest", true), "'reference.finest' can only be true");
    }
    for (const char* key : {"csv_x", "csv_y", "scale_x", "scale_y", "offset_x", "offset_y"})
      if (entry.has(key) && !entry.has("csv"))
        entry.error(*entry.get(key, true), fmt::format("'reference.{}' belongs to a csv", key));
    if (!entry.has("csv")) return;
    out.kind = Kind::csv;
    file(entry, "csv", out.csv);
    out.csv_x = "1", out.csv_y = "2";
    entry.text("csv_x", out.csv_x);
    entry.text("csv_y", out.csv_y);
    expression(entry, "scale_x", out.scale_x, CheckedExpression::Over::nothing);
    expression(entry, "scale_y", out.scale_y, CheckedExpression::Over::nothing);
    expression(entry, "offset_x", out.offset_x, CheckedExpression::Over::nothing);
    expression(entry, "offset_y", out.offset_y, CheckedExpression::Over::nothing);
    check_table(entry, out, diagnostics_);
  }

  SuiteStability read_stability(const MapReader& map, const SuiteCase& of) {
    using Over = CheckedExpression::Over;
    SuiteStability out;
    map.allow({"sweep", "limits", "must_be_stable", "must_stop"});
    if (const auto sweep = map.map("sweep"); sweep && sweep->node().IsMap()) {
      for (const auto& entry : sweep->node()) {
        const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
        out.sweep.emplace_back(name, texts(*sweep, name.c_str()));
        if (out.sweep.back().second.empty())
          sweep->error(entry.first, fmt::format("'{}' is swept over no values", name), "write [a, b, ...]");
      }
      if (out.sweep.size() > 2) sweep->error(sweep->node(), "at most two parameters can be swept");
    }
    if (out.sweep.empty() && of.settings.size() < 2 && !map.has("sweep"))
      map.error(map.node(), "a stability case needs a 'sweep' or several settings");
    map.list("limits", [&](const YAML::Node& node) {
      const MapReader entry = map.element(node, "limit");
      SuiteStability::Limit& limit = out.limits.emplace_back();
      entry.allow({"name", "value", "at_most"});
      entry.text("name", limit.name, true);
      expression(entry, "value", limit.value, Over::outcome, true);
      expression(entry, "at_most", limit.at_most, Over::outcome, true);
    });
    expression(map, "must_be_stable", out.must_be_stable, Over::nothing);
    expression(map, "must_stop", out.must_stop, Over::nothing);
    return out;
  }

  std::string file_;
  std::filesystem::path folder_;
  Diagnostics& diagnostics_;
  std::vector<CheckedExpression> noted_;  // expressions of the case that is read
};

}  // namespace

Suite read_suite(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const auto root =
      load_yaml(file.string(), "suite", "a suite is a YAML file; the user guide shows one", diagnostics);
  return root ? SuiteReader(file, diagnostics).read(*root) : Suite{};
}

}  // namespace courant
