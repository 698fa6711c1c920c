// kinds: history and force. Series of history.h5, forces on walls and bodies among them, or of one ASCII
// file.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/nearest_word.hpp"
#include "post/analysis.hpp"
#include "post/ascii_history.hpp"
#include "post/history_file.hpp"

namespace courant {
namespace {

/// One column: a component of a dataset, or a series of an ASCII file, times a factor.
struct Source {
  std::string name, path;
  int component = 0;
  Real factor = 1;
  std::string unit{};  // empty: from the dimension in the file
  AsciiKey key{};
};

/// "contacts/1/force.x" -> path and component. Returns false where the component is none.
bool split(const std::string& text, Source& source) {
  source.path = text.starts_with('/') ? text : "/" + text;
  const auto dot = source.path.rfind('.');
  if (dot == std::string::npos) return true;
  const auto axis = std::string("xyz").find(source.path.substr(dot + 1));
  if (source.path.size() != dot + 2 || axis == std::string::npos) return false;
  source.component = static_cast<int>(axis);
  source.path.resize(dot);
  return true;
}

/// "kinetic energy" of nothing -> kinetic_energy, "x" of 4 SURFA -> x_4_SURFA.
std::string column_name(const AsciiKey& key) {
  std::string name = key.name + (key.id ? fmt::format(" {}", *key.id) : "") + " " + key.side;
  std::string out;
  for (const unsigned char c : name) {
    if (std::isalnum(c))
      out += static_cast<char>(c);
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// A plain name is a file of the run, any other path counts from the recipe.
std::filesystem::path place_of(const std::string& file, const std::string& recipe,
                               const std::filesystem::path& run) {
  const std::filesystem::path path = file;
  return (path.has_parent_path() ? std::filesystem::path(recipe).parent_path() : run) / path;
}

class HistoryAnalysis : public Analysis {
 public:
  HistoryAnalysis(const char* kind, const MapReader& map, const PostSettings& settings)
      : Analysis(kind, map), units_(settings.units) {
    read_window(map, window_);
  }
  void read_sources(const MapReader& map) {
    map.allow({"kind", "name", "file", "of", "id", "side", "from", "to"});
    map.text("file", ascii_);
    AsciiKey common;
    read_owner(map, common);
    map.list(
        "of", [&](const YAML::Node& node) { add_source(map, node, common); }, true);
  }
  void read_forces(const MapReader& map) {
    map.allow({"kind", "name", "contacts", "bodies", "from", "to"});
    const auto add = [&](const char* group, const char* word, Real factor, const YAML::Node& node) {
      const std::string id = node.IsScalar() ? node.Scalar() : "";
      for (int a = 0; a < 3; ++a) {
        const char axis = "xyz"[a];
        sources_.push_back({fmt::format("force_{}_{}{}", axis, word, id),
                            fmt::format("/{}/{}/force", group, id), a, factor});
      }
    };
    // a contact's history is the force on the particles; on the walls it is the opposite
    map.list("contacts", [&](const YAML::Node& node) { add("contacts", "contact", -1, node); });
    map.list("bodies", [&](const YAML::Node& node) { add("rigid_bodies", "body", 1, node); });
    if (sources_.empty())
      map.error(map.node(), fmt::format("'{}' names neither contacts nor bodies", map.name()),
                "for example contacts: [1]");
  }

  bool needs_states() const override { return false; }
  std::vector<PostSeries> series() const override { return series_; }

  void finish(const std::vector<std::unique_ptr<Analysis>>&, const std::filesystem::path& dir,
              Diagnostics& diagnostics) override {
    if (ascii_.empty())
      take_h5(dir, diagnostics);
    else
      take_ascii(place_of(ascii_, where().file, dir), diagnostics);
  }

 private:
  void take_h5(const std::filesystem::path& dir, Diagnostics& diagnostics) {
    const auto file = HistoryFile::open(dir / "history.h5", diagnostics);
    if (!file) return;
    if (!begin_table(*file->column("/global/time"), diagnostics)) return;
    for (const Source& source : sources_) {
      auto values = file->column(source.path, source.component);
      if (!values) {
        const std::string near = nearest_word(source.path, file->names());
        fault(diagnostics,
              fmt::format("history.h5 has no dataset '{}' with component {}", source.path, source.component),
              near.empty() ? "h5ls -r history.h5 lists them" : fmt::format("did you mean {}?", near));
        continue;
      }
      add_column(source, std::move(*values), units_.of(parse_dimension(file->dimension(source.path))));
    }
  }

  void take_ascii(const std::filesystem::path& path, Diagnostics& diagnostics) {
    const auto file = AsciiFile::open(path, diagnostics);
    if (!file) return;
    if (!begin_table(file->times(), diagnostics)) return;
    const auto repeated = std::adjacent_find(times_.begin(), times_.end());
    if (repeated != times_.end())
      diagnostics.warning(
          where(),
          fmt::format("analysis '{}': {} has states with the same time, {:g}, as it prints few "
                      "digits: integrals and spectra of it are coarse",
                      name(), path.string(), *repeated),
          "history.h5 has all digits");
    for (const Source& source : sources_) {
      std::string why, hint;
      const AsciiColumn* column = file->find(source.key, why, hint);
      if (!column) {
        fault(diagnostics, fmt::format("{}: {}", path.string(), why), hint);
        continue;
      }
      const std::string dimension = file->dimension(*column);
      const bool is_unit = dimension == "?" || dimension == "ns" || dimension == "%";
      add_column(source, column->values, is_unit ? dimension : units_.of(parse_dimension(dimension)));
    }
  }

  /// False: no state is in the window.
  bool begin_table(std::vector<Real> times, Diagnostics& diagnostics) {
    times_ = std::move(times);
    slack_ = slack_of(times_);
    if (!window_.holds_any(times_)) {
      fault_no_state(diagnostics);
      return false;
    }
    add_table().columns.push_back({"t", units_.of({0, 0, 1}), times_});
    return true;
  }

  void add_column(const Source& source, std::vector<Real> values, const std::string& unit_of_file) {
    for (Real& value : values) value *= source.factor;
    const std::string unit = source.unit.empty() ? unit_of_file : source.unit;
    series_.push_back({source.name, unit, std::nullopt, values});
    result_.tables.front().columns.push_back({source.name, unit, std::move(values)});
    add_statistics(series_.back());
  }

  /// id, side: what a series of an ASCII file belongs to.
  void read_owner(const MapReader& map, AsciiKey& key) {
    Real id = 0;
    for (const char* word : {"id", "side"})
      if (const auto node = map.get(word, false); node && ascii_.empty())
        map.error(*node, fmt::format("'{}.{}' goes with 'file', an ASCII history", map.name(), word),
                  "a dataset of history.h5 has its id in its name: contacts/1/force.x");
    if (const auto node = map.get("id", false); node && map.scalar(*node, "id", id)) {
      if (id != std::floor(id) || id < 0) map.error(*node, fmt::format("'{}.id' must be an id", map.name()));
      key.id = static_cast<std::int64_t>(id);
    }
    map.text("side", key.side);
  }

  void add_source(const MapReader& map, const YAML::Node& node, const AsciiKey& common) {
    Source source;
    source.key = common;
    std::string text;
    if (node.IsMap()) {
      const MapReader entry = map.element(node, "of");
      entry.allow({"name", "of", "id", "side", "factor", "unit"});
      entry.text("name", source.name, true);
      entry.text("of", text, true);
      entry.number("factor", source.factor);
      entry.text("unit", source.unit);
      read_owner(entry, source.key);
    } else if (node.IsScalar()) {
      text = source.name = node.Scalar();
    }
    if (!ascii_.empty()) {
      source.key.name = text;
      if (node.IsScalar()) source.name = column_name(source.key);
      if (text.empty())
        map.error(node, fmt::format("'{}.of' must name a series of {}", map.name(), ascii_),
                  "for example kinetic energy, or {name: px, of: x-mom, id: 1}");
    } else if (!split(text, source) || text.empty()) {
      map.error(node, fmt::format("'{}.of' must name a dataset of history.h5, got '{}'", map.name(), text),
                "for example contacts/1/force.x or global/kinetic");
    }
    sources_.push_back(std::move(source));
  }

  void add_statistics(const PostSeries& series) {
    RunningMoments moments;
    Real impulse = 0;
    bool whole = true;  // no gap in the series
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (!window_.holds(times_[i], slack_)) continue;
      moments.add(series.values[i]);
      if (std::isnan(series.values[i])) whole = false;
      if (i > 0 && whole && window_.holds(times_[i - 1], slack_))
        impulse += 0.5 * (times_[i] - times_[i - 1]) * (series.values[i] + series.values[i - 1]);
    }
    add_scalar(series.name + "_mean", series.unit, moments.mean_or_nan());
    add_scalar(series.name + "_deviation", series.unit, moments.deviation());
    add_scalar(series.name + "_least", series.unit, moments.n > 0 ? moments.least : std::nan(""));
    add_scalar(series.name + "_most", series.unit, moments.n > 0 ? moments.most : std::nan(""));
    add_scalar(series.name + "_integral", series.unit + " " + units_.time, whole ? impulse : std::nan(""));
    result_.text +=
        fmt::format("  {}: mean {:.5g} {}, deviation {:.3g}, {:.5g} to {:.5g}\n", series.name,
                    moments.mean_or_nan(), series.unit, moments.deviation(), moments.least, moments.most);
  }

  PostUnits units_;
  TimeWindow window_;
  Real slack_ = 0;
  std::string ascii_;  // empty: history.h5
  std::vector<Source> sources_;
  std::vector<PostSeries> series_;
};

}  // namespace

std::unique_ptr<Analysis> read_history_analysis(const MapReader& map, const PostSettings& settings) {
  auto out = std::make_unique<HistoryAnalysis>("history", map, settings);
  out->read_sources(map);
  return out;
}

std::unique_ptr<Analysis> read_force_analysis(const MapReader& map, const PostSettings& settings) {
  auto out = std::make_unique<HistoryAnalysis>("force", map, settings);
  out->read_forces(map);
  return out;
}

}  // namespace courant
