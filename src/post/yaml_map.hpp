#pragma once
// Values out of YAML maps, with every fault reported at its place. Recipes and suites are read with it.
#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

/// The content of a YAML file. Faults go to `diagnostics`; then there is no value. `what`: "recipe", for the
/// message; `hint`: what such a file is.
std::optional<YAML::Node> load_yaml(const std::string& file, const std::string& what, const std::string& hint,
                                    Diagnostics& diagnostics);

/// One map of a file. A fault of the map as a whole is reported by the constructor.
class MapReader {
 public:
  /// `name`: how messages call the map. `file` and `diagnostics` must outlive the reader.
  MapReader(const YAML::Node& node, std::string name, const std::string& file, Diagnostics& diagnostics);

  /// Reports all other keys, and keys that stand twice. Call it once with all keys that the map may have.
  void allow(std::initializer_list<const char*> keys) const;

  bool has(const char* key) const { return get(key, false).has_value(); }
  // Each leaves `value` as it is where the key is not there or its value is wrong.
  void number(const char* key, Real& value, bool required = false) const;
  void positive(const char* key, Real& value, bool required = false) const;
  void text(const char* key, std::string& value, bool required = false) const;
  bool scalar(const YAML::Node& node, const char* key, Real& value) const;  ///< false: it is no number

  /// Calls `use(element)` for each element of a list.
  template <class Use>
  void list(const char* key, const Use& use, bool required = false) const {
    const auto node = get(key, required);
    if (!node) return;
    if (!node->IsSequence())
      return error(*node, "'" + name_ + "." + key + "' must be a list", "write [a, b, ...]");
    for (const auto& element : *node) use(element);
  }
  std::optional<MapReader> map(const char* key) const;
  MapReader element(const YAML::Node& node, const char* key) const {
    return {node, key, file_, diagnostics_};
  }
  /// The value of a key, none if it is missing or null.
  std::optional<YAML::Node> get(const char* key, bool required) const;

  void error(const YAML::Node& node, const std::string& message, const std::string& hint = {}) const;
  Location where(const YAML::Node& node) const;
  const YAML::Node& node() const { return node_; }
  const std::string& name() const { return name_; }

 private:
  const YAML::Node node_;  // const: looking up a key must not add it
  std::string name_;
  const std::string& file_;
  Diagnostics& diagnostics_;
};

}  // namespace courant
