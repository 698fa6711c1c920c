#include "post/recipe.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "post/yaml_map.hpp"

namespace courant {
namespace {

void read_interval(const MapReader& map, const YAML::Node& node, const char* key, Interval& value) {
  if (!node.IsSequence() || node.size() != 2)
    return map.error(node, fmt::format("'{}.{}' must be two numbers", map.name(), key),
                     "for example [2.5, 5.0]");
  if (map.scalar(node[0], key, value.from) && map.scalar(node[1], key, value.to) && !(value.from < value.to))
    map.error(node, fmt::format("'{}.{}': the first number must be less than the second", map.name(), key));
}

void read_interval(const MapReader& map, const char* key, Interval& value, bool required = false) {
  if (const auto node = map.get(key, required)) read_interval(map, *node, key, value);
}

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
  read_interval(map, "interval", row.interval, true);
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
    read_interval(map, node, "intervals", jump.intervals.emplace_back());
  };
  map.list("intervals", add_interval, true);
  map.list("published", [&](const YAML::Node& node) {
    jump.published.push_back(read_row(map.element(node, "published")));
  });
  if (const auto toe = map.map("toe")) {
    toe->allow({"x", "threshold"});
    read_interval(*toe, "x", jump.toe_range, true);
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
  read_interval(map, "speed", snapshots.range);
  read_interval(map, "x", snapshots.x);
  read_interval(map, "y", snapshots.y);
  return snapshots;
}

}  // namespace

std::optional<Recipe> read_recipe(const std::filesystem::path& file, Diagnostics& diagnostics) {
  Recipe recipe;
  recipe.file = file.string();
  const std::optional<YAML::Node> root = load_yaml(
      recipe.file, "recipe", "a recipe is a YAML file such as keyword_decks/*/post.yaml", diagnostics);
  if (!root) return std::nullopt;
  const int errors_before = diagnostics.errors();
  const MapReader map(*root, "recipe", recipe.file, diagnostics);
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
