#include "generate/node_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "generate/scene.hpp"

namespace courant {

void report_yaml_fault(const std::string& path, const YAML::Exception& fault, Diagnostics& diagnostics) {
  const bool somewhere = !fault.mark.is_null();
  diagnostics.error({path, somewhere ? fault.mark.line + 1 : 0, somewhere ? fault.mark.column + 1 : 0},
                    fmt::format("not valid YAML: {}", fault.msg));
}

Location NodeReader::at(const YAML::Node& node, int extra_lines) const {
  const YAML::Mark mark = node.Mark();
  if (mark.is_null()) return {path_, 0, 0};
  return {path_, mark.line + 1 + extra_lines, extra_lines ? 0 : mark.column + 1};
}

void NodeReader::error(const YAML::Node& node, std::string message, std::string hint) {
  diagnostics_.error(at(node), std::move(message), std::move(hint));
}

void NodeReader::check_keys(const YAML::Node& map, std::string_view what,
                            std::initializer_list<std::string_view> known) {
  std::set<std::string> seen;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) {
      error(entry.first, fmt::format("{}: a key must be a word", what));
      continue;
    }
    const std::string& key = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), key) == known.end())
      error(entry.first, fmt::format("{}: unknown key '{}'", what, key),
            fmt::format("known keys: {}", fmt::join(known, ", ")));
    if (!seen.insert(key).second) error(entry.first, fmt::format("{}: '{}' stands twice", what, key));
  }
}

std::string NodeReader::text(const YAML::Node& node) {
  if (!node.IsScalar()) {
    error(node, "expected text");
    return {};
  }
  const Substitution filled = substitute(node.Scalar(), variables_);
  if (!filled.ok()) error(node, filled.error);
  if (filled.text.find('\n') != std::string::npos) error(node, "expected one line of text");
  return filled.text;
}

Real NodeReader::number(const YAML::Node& node, std::string_view what) {
  if (!node.IsScalar()) {
    error(node, fmt::format("{}: expected a number", what));
    return 0;
  }
  const Evaluation value = evaluate(node.Scalar(), variables_);
  if (!value.ok()) error(node, fmt::format("{}: {}, got '{}'", what, value.error, node.Scalar()));
  return value.ok() ? value.value : 0;
}

Id NodeReader::id(const YAML::Node& map, const char* key, bool required) {
  const YAML::Node node = map[key];
  if (!node) {
    if (required) error(map, fmt::format("'{}' is missing", key));
    return 0;
  }
  const Real value = number(node, key);
  if (value < 0 || value > static_cast<Real>(largest_i8) || value != std::floor(value) ||
      (required && value == 0)) {
    error(node, fmt::format("{}: expected a whole number from {} to 99999999, got {}", key, required ? 1 : 0,
                            value));
    return 0;
  }
  return static_cast<Id>(value);
}

Vec NodeReader::vector(const YAML::Node& map, const char* key, int& dim) {
  Vec value = Vec::Zero();
  const YAML::Node node = map[key];
  dim = 0;
  if (!node) {
    error(map, fmt::format("'{}' is missing", key));
  } else if (!node.IsSequence() || node.size() < 2 || node.size() > 3) {
    error(node, fmt::format("{}: expected [x, y] or [x, y, z]", key));
  } else {
    dim = static_cast<int>(node.size());
    for (int k = 0; k < dim; ++k) value[k] = number(node[k], key);
  }
  return value;
}

Vec NodeReader::vector(const YAML::Node& map, const char* key) {
  int dim = 0;
  return vector(map, key, dim);
}

PlaceExpression NodeReader::of_place(const YAML::Node& node, std::string_view what) {
  if (!node.IsScalar()) {
    error(node, fmt::format("{}: expected an expression of x, y, z", what));
    return {};
  }
  const auto named = named_places(node.Scalar());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string name(1, "xyz"[k]);
    if (named[k] && variables_.count(name))
      error(node,
            fmt::format("{}: {} is the place of a particle here, and a parameter of the scene", what, name),
            "give the parameter another name");
  }
  if (node.Scalar().empty()) error(node, fmt::format("{}: the expression is missing", what));
  return {node.Scalar(), at(node)};
}

Real NodeReader::length(const YAML::Node& map, const char* key) {
  const YAML::Node node = map[key];
  if (!node) {
    error(map, fmt::format("'{}' is missing", key));
    return 0;
  }
  const int before = diagnostics_.errors();
  const Real value = number(node, key);
  if (diagnostics_.errors() > before) return 0;
  if (!(value > 0)) error(node, fmt::format("{}: expected a length > 0, got {}", key, value));
  return value > 0 ? value : 0;
}

}  // namespace courant
