#include "post/recipe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace courant {
namespace {

/// Reads values out of one map of the recipe and reports what is wrong with them.
class MapReader {
 public:
  MapReader(const YAML::Node& node, std::string name, const std::string& file, Diagnostics& diagnostics)
      : node_(node), name_(std::move(name)), file_(file), diagnostics_(diagnostics) {
    if (!node.IsMap())
      error(node, fmt::format("'{}' must be a map of keys and values", name_), "write 'key: value' lines");
  }

  /// Call it once with all keys that the map may have.
  void allow(std::initializer_list<const char*> keys) const {
    if (!node_.IsMap()) return;
    for (const auto& entry : node_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : std::string();
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        error(entry.first, fmt::format("'{}' does not know the key '{}'", name_, key),
              fmt::format("known keys: {}", fmt::join(keys, ", ")));
    }
  }

  void number(const char* key, Real& value, bool required = false) const {
    if (const auto node = get(key, required)) scalar(*node, key, value);
  }
  void positive(const char* key, Real& value, bool required = false) const {
    const auto node = get(key, required);
    if (node && scalar(*node, key, value) && !(value > 0))
      error(*node, fmt::format("'{}.{}' must be greater than 0, got {}", name_, key, value));
  }
  void text(const char* key, std::string& value, bool required = false) const {
    const auto node = get(key, required);
    if (!node) return;
    if (node->IsScalar())
      value = node->Scalar();
    else
      error(*node, fmt::format("'{}.{}' must be a text", name_, key));
  }
  void interval(const char* key, Interval& value, bool required = false) const {
    if (const auto node = get(key, required)) interval(*node, key, value);
  }
  void interval(const YAML::Node& node, const char* key, Interval& value) const {
    if (!node.IsSequence() || node.size() != 2)
      return error(node, fmt::format("'{}.{}' must be two numbers", name_, key), "for example [2.5, 5.0]");
    if (scalar(node[0], key, value.from) && scalar(node[1], key, value.to) && !(value.from < value.to))
      error(node, fmt::format("'{}.{}': the first number must be less than the second", name_, key));
  }
  /// Calls `use(element)` for each element of a list.
  template <class Use>
  void list(const char* key, const Use& use, bool required = false) const {
    const auto node = get(key, required);
    if (!node) return;
    if (!node->IsSequence())
      return error(*node, fmt::format("'{}.{}' must be a list", name_, key), "write [a, b, ...]");
    for (const auto& element : *node) use(element);
  }
  bool scalar(const YAML::Node& node, const char* key, Real& value) const {
    Real read = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, read) || !std::isfinite(read)) {
      error(node, fmt::format("'{}.{}' must be a number, got '{}'", name_, key,
                              node.IsScalar() ? node.Scalar() : "a list"));
      return false;
    }
    value = read;
    return true;
  }
  std::optional<MapReader> map(const char* key) const {
    const auto node = get(key, false);
    if (!node) return std::nullopt;
    return MapReader(*node, name_ == "recipe" ? key : name_ + "." + key, file_, diagnostics_);
  }
  MapReader element(const YAML::Node& node, const char* key) const {
    return {node, key, file_, diagnostics_};
  }
  void error(const YAML::Node& node, const std::string& message, const std::string& hint = {}) const {
    diagnostics_.error({file_, node.Mark().line + 1, node.Mark().column + 1}, message, hint);
  }
  const YAML::Node& node() const { return node_; }

 private:
  std::optional<YAML::Node> get(const char* key, bool required) const {
    if (!node_.IsMap()) return std::nullopt;
    if (const YAML::Node found = node_[key]; found && !found.IsNull()) return found;
    if (required) error(node_, fmt::format("'{}' lacks the key '{}'", name_, key));
    return std::nullopt;
  }

  const YAML::Node node_;  // const: looking up a key must not add it
  std::string name_;
  const std::string& file_;
  Diagnostics& diagnostics_;
};

ProbeRecipe read_probe(const MapReader& map, std::size_t number) {
  ProbeRecipe probe{.name = fmt::format("probe{}", number)};
  map.allow({"name", "x", "z", "bed"});
  map.text("name", probe.name);
  map.number("x", probe.x, true);
  map.number("z", probe.z);
  map.number("bed", probe.bed);
  return probe;
}

PublishedRow read_row(const MapReader& map) {
  PublishedRow row;
  map.allow({"case", "interval", "A", "P"});
  map.text("case", row.case_name, true);
  map.interval("interval", row.interval, true);
  map.number("A", row.A, true);
  map.number("P", row.P, true);
  return row;
}

JumpRecipe read_jump(const MapReader& map) {
  JumpRecipe jump;
  map.allow({"x", "z", "bed", "v1", "d1", "g", "intervals", "published", "toe", "front"});
  map.number("x", jump.x, true);
  map.number("z", jump.z);
  map.number("bed", jump.bed);
  map.positive("v1", jump.v1, true);
  map.positive("d1", jump.d1, true);
  map.positive("g", jump.g);
  const auto add_interval = [&](const YAML::Node& node) {
    map.interval(node, "intervals", jump.intervals.emplace_back());
  };
  map.list("intervals", add_interval, true);
  map.list("published", [&](const YAML::Node& node) {
    jump.published.push_back(read_row(map.element(node, "published")));
  });
  if (const auto toe = map.map("toe")) {
    toe->allow({"x", "threshold"});
    toe->interval("x", jump.toe_range, true);
    toe->positive("threshold", jump.toe_threshold);
  }
  if (const auto front = map.map("front")) {
    front->allow({"x", "threshold"});
    jump.front_x = 0;
    front->number("x", *jump.front_x, true);
    front->positive("threshold", jump.front_threshold);
  }
  return jump;
}

SnapshotRecipe read_snapshots(const MapReader& map) {
  SnapshotRecipe snapshots;
  map.allow({"times", "speed", "x", "y"});
  map.list(
      "times", [&](const YAML::Node& n) { map.scalar(n, "times", snapshots.times.emplace_back()); }, true);
  map.interval("speed", snapshots.range);
  map.interval("x", snapshots.x);
  map.interval("y", snapshots.y);
  return snapshots;
}

}  // namespace

std::optional<Recipe> read_recipe(const std::filesystem::path& file, Diagnostics& diagnostics) {
  Recipe recipe;
  recipe.file = file.string();
  YAML::Node root;
  try {
    root = YAML::LoadFile(recipe.file);
  } catch (const YAML::BadFile&) {
    diagnostics.error({recipe.file}, "cannot read the recipe",
                      "check the path; a recipe is a YAML file such as keyword_decks/*/post.yaml");
    return std::nullopt;
  } catch (const YAML::ParserException& e) {
    diagnostics.error({recipe.file, e.mark.line + 1, e.mark.column + 1}, "not valid YAML: " + e.msg);
    return std::nullopt;
  }
  const int errors_before = diagnostics.errors();
  const MapReader map(root, "recipe", recipe.file, diagnostics);
  map.allow({"case", "probes", "jump", "snapshots"});
  map.text("case", recipe.case_name);
  const auto add_probe = [&](const YAML::Node& node) {
    recipe.probes.push_back(read_probe(map.element(node, "probes"), recipe.probes.size() + 1));
  };
  map.list("probes", add_probe);
  if (const auto jump = map.map("jump")) recipe.jump = read_jump(*jump);
  if (const auto snapshots = map.map("snapshots")) recipe.snapshots = read_snapshots(*snapshots);
  if (diagnostics.errors() == errors_before && recipe.probes.empty() && !recipe.jump && !recipe.snapshots)
    diagnostics.error({recipe.file, 1, 1}, "the recipe asks for nothing",
                      "add one of: probes, jump, snapshots");
  if (diagnostics.errors() > errors_before) return std::nullopt;
  return recipe;
}

}  // namespace courant
