#include "post/recipe.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

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

PostSettings read_settings(const MapReader& map) {
  PostSettings out;
  if (const auto units = map.map("units")) {
    units->allow({"mass", "length", "time"});
    units->text("mass", out.units.mass);
    units->text("length", out.units.length);
    units->text("time", out.units.time);
  }
  out.up = read_choice(map, "up", {"y", "z"}) + 1;
  return out;
}

void read_one_analysis(const MapReader& list, const YAML::Node& node, Recipe& recipe) {
  std::string name;
  if (node.IsMap() && node["name"] && node["name"].IsScalar()) name = node["name"].Scalar();
  const MapReader map = list.element(node, name.empty() ? "analyses" : name.c_str());
  if (!node.IsMap()) return;  // the reader has told
  auto analysis = read_analysis(map, recipe.settings);
  if (!analysis) return;
  const auto named = [&](const std::string& wanted) {
    return std::any_of(recipe.analyses.begin(), recipe.analyses.end(),
                       [&](const auto& other) { return other->name() == wanted; });
  };
  if (const auto at = map.get("name", false); at && named(analysis->name()))
    map.error(*at, fmt::format("two analyses are named '{}'", analysis->name()));
  for (const auto& [key, wanted] : analysis->refers())
    if (const auto at = map.get(key, false); at && !named(wanted))
      map.error(*at, fmt::format("'{}.{}': there is no analysis '{}' above it", map.name(), key, wanted),
                "analyses are worked through from top to bottom");
  recipe.analyses.push_back(std::move(analysis));
}

void read_formats(const MapReader& map, Recipe& recipe) {
  if (!map.has("formats")) return;
  recipe.formats.clear();
  map.list("formats", [&](const YAML::Node& node) {
    recipe.formats.push_back(node.IsScalar() ? node.Scalar() : "");
    const std::string& format = recipe.formats.back();
    if (format != "png" && format != "svg" && format != "pdf")
      map.error(node, fmt::format("'{}.formats' cannot be '{}'", map.name(), format),
                "they are png, svg and pdf");
  });
}

void read_folder(const MapReader& map, Recipe& recipe) {
  map.text("folder", recipe.folder);
  const std::filesystem::path folder = recipe.folder;
  if (folder.is_absolute() || recipe.folder.find("..") != std::string::npos || folder.empty())
    map.error(*map.get("folder", false), "'recipe.folder' must be a folder within the run's",
              "for example post");
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
  map.allow(
      {"case", "probes", "jump", "snapshots", "units", "up", "folder", "analyses", "figures", "formats"});
  map.text("case", recipe.case_name);
  const auto add_probe = [&](const YAML::Node& node) {
    recipe.probes.push_back(read_probe(map.element(node, "probes"), recipe.probes.size() + 1));
  };
  map.list("probes", add_probe);
  if (const auto jump = map.map("jump")) recipe.jump = read_jump(*jump);
  if (const auto snapshots = map.map("snapshots")) recipe.snapshots = read_snapshots(*snapshots);
  recipe.settings = read_settings(map);
  map.list("analyses", [&](const YAML::Node& node) { read_one_analysis(map, node, recipe); });
  map.list("figures", [&](const YAML::Node& node) { recipe.figures.push_back(read_figure(map, node)); });
  read_formats(map, recipe);
  read_folder(map, recipe);
  const bool empty = recipe.probes.empty() && !recipe.jump && !recipe.snapshots && recipe.analyses.empty();
  if (diagnostics.errors() == errors_before && empty)
    diagnostics.error({recipe.file, 1, 1}, "the recipe asks for nothing",
                      "add one of: probes, jump, snapshots, analyses");
  if (diagnostics.errors() > errors_before) return std::nullopt;
  return recipe;
}

}  // namespace courant
