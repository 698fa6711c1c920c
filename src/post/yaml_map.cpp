#include "post/yaml_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <vector>

#include "base/nearest_word.hpp"

namespace courant {

std::optional<YAML::Node> load_yaml(const std::string& file, const std::string& what, const std::string& hint,
                                    Diagnostics& diagnostics) {
  try {
    if (std::filesystem::is_directory(file)) throw YAML::BadFile(file);
    return YAML::LoadFile(file);
  } catch (const YAML::BadFile&) {
    diagnostics.error({file}, "cannot read the " + what, "check the path; " + hint);
  } catch (const YAML::ParserException& e) {
    diagnostics.error({file, e.mark.line + 1, e.mark.column + 1}, "not valid YAML: " + e.msg);
  }
  return std::nullopt;
}

MapReader::MapReader(const YAML::Node& node, std::string name, const std::string& file,
                     Diagnostics& diagnostics)
    : node_(node), name_(std::move(name)), file_(file), diagnostics_(diagnostics) {
  if (!node.IsMap())
    error(node, fmt::format("'{}' must be a map of keys and values", name_), "write 'key: value' lines");
}

void MapReader::allow(std::initializer_list<const char*> keys) const {
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : std::string();
    if (!seen.insert(key).second) error(entry.first, fmt::format("'{}.{}' stands twice", name_, key));
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const std::string near = nearest_word(key, std::vector<std::string>(keys.begin(), keys.end()));
    error(entry.first, fmt::format("'{}' does not know the key '{}'", name_, key),
          fmt::format("{}known keys: {}", near.empty() ? "" : fmt::format("did you mean {}? ", near),
                      fmt::join(keys, ", ")));
  }
}

void MapReader::number(const char* key, Real& value, bool required) const {
  if (const auto node = get(key, required)) scalar(*node, key, value);
}

void MapReader::positive(const char* key, Real& value, bool required) const {
  const auto node = get(key, required);
  if (node && scalar(*node, key, value) && !(value > 0))
    error(*node, fmt::format("'{}.{}' must be greater than 0, got {}", name_, key, value));
}

void MapReader::text(const char* key, std::string& value, bool required) const {
  const auto node = get(key, required);
  if (!node) return;
  if (node->IsScalar())
    value = node->Scalar();
  else
    error(*node, fmt::format("'{}.{}' must be a text", name_, key));
}

bool MapReader::scalar(const YAML::Node& node, const char* key, Real& value) const {
  Real read = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, read) || !std::isfinite(read)) {
    error(node, fmt::format("'{}.{}' must be a number, got '{}'", name_, key,
                            node.IsScalar() ? node.Scalar() : "a list"));
    return false;
  }
  value = read;
  return true;
}

std::optional<MapReader> MapReader::map(const char* key) const {
  const auto node = get(key, false);
  if (!node) return std::nullopt;
  return MapReader(*node, name_ == "recipe" ? key : name_ + "." + key, file_, diagnostics_);
}

std::optional<YAML::Node> MapReader::get(const char* key, bool required) const {
  if (!node_.IsMap()) return std::nullopt;
  if (const YAML::Node found = node_[key]; found && !found.IsNull()) return found;
  if (required) error(node_, fmt::format("'{}' lacks the key '{}'", name_, key));
  return std::nullopt;
}

void MapReader::error(const YAML::Node& node, const std::string& message, const std::string& hint) const {
  diagnostics_.error(where(node), message, hint);
}

Location MapReader::where(const YAML::Node& node) const {
  const YAML::Mark mark = node.Mark();
  if (mark.is_null()) return {file_};
  return {file_, mark.line + 1, mark.column + 1};
}

}  // namespace courant
