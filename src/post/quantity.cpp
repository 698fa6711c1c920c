#include "post/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace courant {
namespace {

struct Variable {
  const char* name;
  const char* array;  // of the field file; nullptr: read anyway
  int component;
  Dimension dimension;
};
constexpr std::array<Variable, 17> variables{{{"x", nullptr, 0, {0, 1, 0}},
                                              {"y", nullptr, 0, {0, 1, 0}},
                                              {"z", nullptr, 0, {0, 1, 0}},
                                              {"vx", "velocity", 0, {0, 1, -1}},
                                              {"vy", "velocity", 1, {0, 1, -1}},
                                              {"vz", "velocity", 2, {0, 1, -1}},
                                              {"speed", "velocity", -1, {0, 1, -1}},
                                              {"p", "pressure", 0, {1, -1, -2}},
                                              {"rho", "density", 0, {1, -3, 0}},
                                              {"h", nullptr, 0, {0, 1, 0}},
                                              {"m", "mass", 0, {1, 0, 0}},
                                              {"V", nullptr, 0, {0, 3, 0}},
                                              {"e", "internal_energy", 0, {1, -1, -2}},
                                              {"part", "part", 0, {}},
                                              {"id", "id", 0, {}},
                                              {"active", "active", 0, {}},
                                              {"t", nullptr, 0, {0, 0, 1}}}};

int components(const Variable& v) {
  return std::string_view(v.array) == "velocity" ? 3 : 1;
}

Real value(const Variable& v, std::size_t k, const ParticleFrame& f, std::size_t i) {
  if (v.array) {
    const std::vector<Real>& a = f.arrays.at(v.array);
    if (v.component < 0) return std::hypot(a[3 * i], a[3 * i + 1], a[3 * i + 2]);
    return a[static_cast<std::size_t>(components(v)) * i + static_cast<std::size_t>(v.component)];
  }
  switch (k) {
    case 0:
      return f.x[i];
    case 1:
      return f.y[i];
    case 2:
      return f.z[i];
    case 9:
      return f.h[i];
    case 11:
      return f.V[i];
    default:
      return f.t;
  }
}

std::string plain_name(const std::string& text) {
  std::string out;
  for (char c : text)
    if (!std::isspace(static_cast<unsigned char>(c))) out += c == ',' ? ';' : c;
  return out;
}

}  // namespace

const std::vector<std::string>& quantity_variables() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Variable& v : variables) out.emplace_back(v.name);
    return out;
  }();
  return names;
}

CompiledExpression read_expression(const MapReader& map, const YAML::Node& node, const char* key,
                                   const std::vector<std::string>& names) {
  if (!node.IsScalar()) {
    map.error(node, fmt::format("'{}.{}' must be an expression", map.name(), key));
    return {};
  }
  CompiledExpression out(node.Scalar(), names);
  if (!out.ok())
    map.error(node, fmt::format("'{}.{}': {}", map.name(), key, out.error()),
              out.hint().empty() ? fmt::format("it may use {}", fmt::join(names, ", ")) : out.hint());
  return out;
}

Quantity read_quantity(const MapReader& map, const YAML::Node& node, const char* key,
                       const PostUnits& units) {
  Quantity out;
  const auto with_unit = [&](const std::string& text) {
    for (const Variable& v : variables)
      if (text == v.name) return units.of(v.dimension);
    return std::string("?");
  };
  if (node.IsMap()) {
    const MapReader entry = map.element(node, key);
    entry.allow({"name", "of", "unit"});
    std::string text;
    entry.text("of", text, true);
    out.unit = with_unit(text);
    entry.text("unit", out.unit);
    entry.text("name", out.name, true);
    if (const auto of = entry.get("of", false))
      out.of = read_expression(entry, *of, "of", quantity_variables());
  } else {
    out.of = read_expression(map, node, key, quantity_variables());
    if (node.IsScalar()) out.name = node.Scalar(), out.unit = with_unit(node.Scalar());
  }
  out.name = plain_name(out.name);
  return out;
}

void note_arrays(const CompiledExpression& of, std::vector<ParticleArray>& arrays) {
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const Variable& v = variables[k];
    if (!v.array || !of.uses(k)) continue;
    const auto same = [&](const ParticleArray& a) { return a.name == v.array; };
    if (std::none_of(arrays.begin(), arrays.end(), same)) arrays.push_back({v.array, components(v)});
  }
}

std::vector<Real> evaluate(const CompiledExpression& of, const ParticleFrame& frame) {
  std::vector<Real> out(frame.size());
  std::array<Real, variables.size()> row{};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    for (std::size_t k = 0; k < variables.size(); ++k)
      if (of.uses(k)) row[k] = value(variables[k], k, frame, i);
    out[i] = of(row.data());
  }
  return out;
}

}  // namespace courant
