#pragma once
// What all parts of a scene are read with: values of YAML nodes with their checks, and messages with the
// place.
#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "generate/expression.hpp"
#include "generate/place_expression.hpp"

namespace courant {

void report_yaml_fault(const std::string& path, const YAML::Exception& fault, Diagnostics& diagnostics);

/// Faults become errors with their line, and a value that goes on, so that all are reported at once.
class NodeReader {
 public:
  NodeReader(std::string path, Diagnostics& diagnostics)
      : path_(std::move(path)), diagnostics_(diagnostics) {}

  Location at(const YAML::Node& node, int extra_lines = 0) const;
  void error(const YAML::Node& node, std::string message, std::string hint = {});
  /// Unknown and repeated keys: both would otherwise be ignored in silence.
  void check_keys(const YAML::Node& map, std::string_view what,
                  std::initializer_list<std::string_view> known);
  std::string text(const YAML::Node& node);
  Real number(const YAML::Node& node, std::string_view what);
  Id id(const YAML::Node& map, const char* key, bool required);
  /// A point or vector; the number of its components goes to `dim`.
  Vec vector(const YAML::Node& map, const char* key, int& dim);
  Vec vector(const YAML::Node& map, const char* key);
  /// x, y, z are the place; a parameter of that name would be hidden.
  PlaceExpression of_place(const YAML::Node& node, std::string_view what);
  /// A number > 0 under that key.
  Real length(const YAML::Node& map, const char* key);

 protected:
  std::string path_;
  Diagnostics& diagnostics_;
  Variables variables_{{"pi", pi}};
};

}  // namespace courant
