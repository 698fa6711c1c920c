#include "generate/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <string_view>

#include "generate/expression.hpp"

namespace courant {
namespace {

constexpr Real most_entities = 5e7;  // a typing error in a spacing should not fill the memory
constexpr Real most_jitter = 0.5;    // from there on two particles may meet

void report_yaml_fault(const std::string& path, const YAML::Exception& fault, Diagnostics& diagnostics) {
  const bool somewhere = !fault.mark.is_null();
  diagnostics.error({path, somewhere ? fault.mark.line + 1 : 0, somewhere ? fault.mark.column + 1 : 0},
                    fmt::format("not valid YAML: {}", fault.msg));
}

class SceneReader {
 public:
  SceneReader(std::string path, const std::map<std::string, std::string>& overrides, Diagnostics& diagnostics)
      : path_(std::move(path)), overrides_(overrides), diagnostics_(diagnostics) {}

  Scene read() {
    Scene scene;
    if (std::filesystem::is_directory(path_)) throw YAML::BadFile(path_);
    const YAML::Node root = YAML::LoadFile(path_);
    if (!root.IsMap()) {
      diagnostics_.error({path_, 1, 1}, "a scene is a YAML map", "start with 'title: ...'");
      return scene;
    }
    check_keys(root, "the scene", {"title", "base", "parameters", "parts", "keywords"});
    load_bases(root["base"]);
    scene.files = {path_};
    for (const Base& base : bases_) scene.files.push_back(base.path);
    read_parameters(root["parameters"], scene);
    scene.title = root["title"] ? text(root["title"]) : std::string("untitled scene");
    if (scene.title.size() > 80) error(root["title"], "title: a deck's title has at most 80 characters");
    scene.variables = variables_;
    read_parts(root, scene);
    for_each_base([&](const YAML::Node& base) { read_keywords(base["keywords"], scene); });
    read_keywords(root["keywords"], scene);
    return scene;
  }

 private:
  Location at(const YAML::Node& node, int extra_lines = 0) const {
    const YAML::Mark mark = node.Mark();
    if (mark.is_null()) return {path_, 0, 0};
    return {path_, mark.line + 1 + extra_lines, extra_lines ? 0 : mark.column + 1};
  }
  void error(const YAML::Node& node, std::string message, std::string hint = {}) {
    diagnostics_.error(at(node), std::move(message), std::move(hint));
  }

  // Unknown and repeated keys: both would otherwise be ignored in silence.
  void check_keys(const YAML::Node& map, std::string_view what,
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

  /// What many scenes have in common: files with parameters and keywords.
  void load_bases(const YAML::Node& node) {
    if (!node) return;
    if (!node.IsSequence()) return load_base(node);
    for (const auto& one : node) load_base(one);
  }
  void load_base(const YAML::Node& node) {
    const std::string path = (std::filesystem::path(path_).parent_path() / text(node)).string();
    try {
      if (std::filesystem::is_directory(path)) throw YAML::BadFile(path);
      bases_.push_back({path, YAML::LoadFile(path)});
    } catch (const YAML::BadFile&) {
      return error(node, fmt::format("base: the file '{}' cannot be read", path));
    } catch (const YAML::Exception& fault) {
      return report_yaml_fault(path, fault, diagnostics_);
    }
    std::swap(path_, bases_.back().path);
    check_keys(bases_.back().node, "a base", {"parameters", "keywords"});
    std::swap(path_, bases_.back().path);
  }
  /// Messages name the base's file meanwhile.
  template <class Visit>
  void for_each_base(Visit visit) {
    for (Base& base : bases_) {
      std::swap(path_, base.path);
      visit(base.node);
      std::swap(path_, base.path);
    }
  }

  void read_parameters(const YAML::Node& node, Scene& scene) {
    std::set<std::string> unused;
    for (const auto& [name, value] : overrides_) unused.insert(name);
    // The base's first, but for those that need the scene's own; these stand above the base's of the same
    // name.
    std::set<std::string> own;
    std::set<std::pair<std::string, int>> done;  // entries of bases: file and place in it
    if (node && node.IsMap())
      for (const auto& entry : node)
        if (entry.first.IsScalar()) own.insert(entry.first.Scalar());
    bool all = false;
    const auto read_base = [&](const YAML::Node& name, const YAML::Node& value) {
      const std::string key = name.IsScalar() ? name.Scalar() : "";
      const bool ready = all || (value.IsScalar() && evaluate(value.Scalar(), variables_).ok());
      if (!ready || own.contains(key) || !done.emplace(path_, name.Mark().pos).second) return;
      read_parameter(name, value, unused, scene);
    };
    for_each_base([&](const YAML::Node& base) { for_each_entry(base["parameters"], read_base); });
    for_each_entry(node, [&](const YAML::Node& name, const YAML::Node& value) {
      read_parameter(name, value, unused, scene);
    });
    all = true;
    for_each_base([&](const YAML::Node& base) { for_each_entry(base["parameters"], read_base); });
    std::vector<std::string> names;
    for (const auto& p : scene.parameters) names.push_back(p.first);
    for (const std::string& name : unused)
      diagnostics_.error({path_, 0, 0}, fmt::format("--param {}: the scene has no such parameter", name),
                         fmt::format("its parameters: {}", fmt::join(names, ", ")));
  }

  template <class Visit>
  void for_each_entry(const YAML::Node& map, Visit visit) {
    if (!map) return;
    if (!map.IsMap()) return error(map, "parameters: expected a map of NAME: VALUE");
    for (const auto& entry : map) visit(entry.first, entry.second);
  }

  void read_parameter(const YAML::Node& key, const YAML::Node& node, std::set<std::string>& unused,
                      Scene& scene) {
    if (!key.IsScalar() || !node.IsScalar()) {
      error(key, "parameters: expected NAME: VALUE with a number or an expression");
      return;
    }
    const std::string& name = key.Scalar();
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ||
        !std::all_of(name.begin(), name.end(), is_word))
      error(key, fmt::format("parameters: '{}' is not a name", name), "use letters, digits and _");
    if (name == "pi")
      error(key, "parameters: 'pi' is there already, 3.14159...");
    else if (variables_.count(name))
      error(key, fmt::format("parameters: '{}' stands twice", name));
    const auto override = overrides_.find(name);
    unused.erase(name);
    const bool overridden = override != overrides_.end();
    const Evaluation value = evaluate(overridden ? override->second : node.Scalar(), variables_);
    if (!value.ok())
      error(node,
            fmt::format("{}{}: {}, got '{}'", overridden ? "--param " : "parameter ", name, value.error,
                        overridden ? override->second : node.Scalar()),
            "an expression may use the parameters above it");
    variables_[name] = value.ok() ? value.value : 1;  // go on, so that all faults are reported at once
    scene.parameters.emplace_back(name, variables_[name]);
  }

  std::string text(const YAML::Node& node) {
    if (!node.IsScalar()) {
      error(node, "expected text");
      return {};
    }
    const Substitution filled = substitute(node.Scalar(), variables_);
    if (!filled.ok()) error(node, filled.error);
    if (filled.text.find('\n') != std::string::npos) error(node, "expected one line of text");
    return filled.text;
  }

  Real number(const YAML::Node& node, std::string_view what) {
    if (!node.IsScalar()) {
      error(node, fmt::format("{}: expected a number", what));
      return 0;
    }
    const Evaluation value = evaluate(node.Scalar(), variables_);
    if (!value.ok()) error(node, fmt::format("{}: {}, got '{}'", what, value.error, node.Scalar()));
    return value.ok() ? value.value : 0;
  }

  Id id(const YAML::Node& map, const char* key, bool required) {
    const YAML::Node node = map[key];
    if (!node) {
      if (required) error(map, fmt::format("'{}' is missing", key));
      return 0;
    }
    const Real value = number(node, key);
    if (value < 0 || value > static_cast<Real>(largest_i8) || value != std::floor(value) ||
        (required && value == 0)) {
      error(node, fmt::format("{}: expected a whole number from {} to 99999999, got {}", key,
                              required ? 1 : 0, value));
      return 0;
    }
    return static_cast<Id>(value);
  }

  // A point or vector; the number of its components goes to `dim`.
  Vec vector(const YAML::Node& map, const char* key, int& dim) {
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
  Vec vector(const YAML::Node& map, const char* key) {
    int dim = 0;
    return vector(map, key, dim);
  }

  // x, y, z are the place; a parameter of that name would be hidden.
  PlaceExpression of_place(const YAML::Node& node, std::string_view what) {
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

  void read_velocity(const YAML::Node& map, bool particles, ScenePart& part) {
    const YAML::Node node = map["velocity"];
    bool of_places = false;
    if (node.IsSequence())
      for (const auto& component : node) {
        const auto named = component.IsScalar() ? named_places(component.Scalar()) : std::array<bool, 3>{};
        of_places = of_places || named[0] || named[1] || named[2];
      }
    if (of_places && !particles)
      error(node, "velocity: x, y, z are the place of a particle, and the part has none",
            "parts of shells move with one velocity");
    if (!of_places || node.size() < 2 || node.size() > 3) {
      part.has_velocity = true;
      part.velocity = vector(map, "velocity");
      return;
    }
    part.velocity_of_place[2] = {"0", at(node)};
    for (std::size_t k = 0; k < node.size(); ++k) part.velocity_of_place[k] = of_place(node[k], "velocity");
  }

  Real length(const YAML::Node& map, const char* key) {
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

  void read_parts(const YAML::Node& root, Scene& scene) {
    const YAML::Node node = root["parts"];
    if (!node || !node.IsSequence() || node.size() == 0) {
      error(node ? node : root, "the scene has no parts", "give a list under 'parts:'");
      return;
    }
    std::set<Id> ids;
    for (const auto& entry : node) {
      if (!entry.IsMap()) {
        error(entry, "a part is a map", "- id: 1");
        continue;
      }
      scene.parts.push_back(read_part(entry));
      const Id part = scene.parts.back().id;
      if (part > 0 && !ids.insert(part).second)
        error(entry["id"], fmt::format("part {} is there already", part));
    }
  }

  ScenePart read_part(const YAML::Node& node) {
    check_keys(node, "a part",
               {"id", "title", "section", "material", "eos", "hourglass", "velocity", "pressure", "density",
                "merge", "first_id", "lattices", "plates"});
    ScenePart part;
    part.where = at(node);
    part.id = id(node, "id", true);
    part.title = node["title"] ? text(node["title"]) : fmt::format("part {}", part.id);
    if (part.title.size() > 70) error(node["title"], "title: a part's heading has at most 70 characters");
    part.section = id(node, "section", true);
    part.material = id(node, "material", true);
    part.eos = id(node, "eos", false);
    part.hourglass = id(node, "hourglass", false);
    part.first_id = id(node, "first_id", false);
    if (node["density"] && (part.density = number(node["density"], "density")) <= 0)
      error(node["density"], fmt::format("density: expected a number > 0, got {}", part.density));
    if (const YAML::Node merge = node["merge"]; merge && !YAML::convert<bool>::decode(merge, part.merge))
      error(merge, "merge: expected true or false");
    const bool particles = static_cast<bool>(node["lattices"]);
    if (particles == static_cast<bool>(node["plates"])) {
      error(node, "a part has either 'lattices' (SPH particles) or 'plates' (shells)");
      return part;
    }
    if (node["velocity"]) read_velocity(node, particles, part);
    if (node["pressure"]) part.pressure = of_place(node["pressure"], "pressure");
    if (part.pressure.given() && !particles)
      error(node["pressure"], "pressure: only particles have one, and the part has none");
    const YAML::Node list = node[particles ? "lattices" : "plates"];
    if (!list.IsSequence() || list.size() == 0) error(list, "expected a list that is not empty");
    for (const auto& entry : list) {
      if (!entry.IsMap()) {
        error(entry, "expected a map");
      } else if (particles) {
        part.lattices.push_back(read_lattice(entry));
      } else {
        part.plates.push_back(read_plate(entry));
      }
    }
    return part;
  }

  SceneLattice read_lattice(const YAML::Node& node) {
    check_keys(node, "a lattice", {"low", "high", "spacing", "where", "jitter"});
    SceneLattice lattice;
    const int before = diagnostics_.errors();
    int dim_high = 0;
    lattice.low = vector(node, "low", lattice.dim);
    const Vec high = vector(node, "high", dim_high);
    lattice.spacing = length(node, "spacing");
    if (node["where"]) lattice.where = of_place(node["where"], "where");
    if (node["jitter"]) lattice.jitter = number(node["jitter"], "jitter");
    if (!(lattice.jitter >= 0 && lattice.jitter < most_jitter))
      error(node["jitter"],
            fmt::format("jitter: expected a fraction of the spacing from 0 to below {}, got {}", most_jitter,
                        lattice.jitter));
    if (lattice.dim != dim_high && lattice.dim && dim_high)
      error(node, "low and high of a lattice need the same number of components");
    if (dim_ == 0) dim_ = lattice.dim;
    if (lattice.dim != dim_ && lattice.dim)
      error(node, fmt::format("a lattice of {} dimensions beside one of {}", lattice.dim, dim_),
            "give low and high as many components in all lattices of a scene");
    if (diagnostics_.errors() > before) return lattice;
    Real total = 1;
    for (int k = 0; k < lattice.dim; ++k) {
      const Real cells = (high[k] - lattice.low[k]) / lattice.spacing, n = std::round(cells);
      if (n < 1) {
        error(node, fmt::format("the lattice is empty: its extent along {} is {}", "xyz"[k],
                                high[k] - lattice.low[k]));
        return lattice;
      }
      if (std::abs(cells - n) > 1e-6)
        error(node, fmt::format("the extent {} along {} is {:.9g} spacings, not a whole number",
                                high[k] - lattice.low[k], "xyz"[k], cells));
      if ((total *= n) > most_entities) {
        error(node, fmt::format("the lattice would have {:.3g} particles or more; {:.0e} are the limit",
                                total, most_entities));
        return lattice;
      }
      lattice.n[k] = static_cast<Id>(n);
    }
    add_entities(node, total);
    return lattice;
  }

  ScenePlate read_plate(const YAML::Node& node) {
    check_keys(node, "a plate", {"origin", "edge1", "edge2", "mesh"});
    ScenePlate plate;
    const int before = diagnostics_.errors();
    plate.origin = vector(node, "origin");
    plate.edge1 = vector(node, "edge1");
    plate.edge2 = vector(node, "edge2");
    const Real mesh = length(node, "mesh");
    if (diagnostics_.errors() > before) return plate;
    const Real l1 = plate.edge1.norm(), l2 = plate.edge2.norm();
    if (!(plate.edge1.cross(plate.edge2).norm() > 1e-9 * l1 * l2)) {
      error(node, "the plate has no area: edge1 and edge2 are zero or parallel");
      return plate;
    }
    // `mesh` is the largest side of a shell; 1e-6 forgives round-off.
    const Real n1 = std::max(1.0, std::ceil(l1 / mesh - 1e-6)),
               n2 = std::max(1.0, std::ceil(l2 / mesh - 1e-6));
    if (n1 * n2 > most_entities) {
      error(node,
            fmt::format("the plate would have {:.3g} shells; {:.0e} are the limit", n1 * n2, most_entities));
      return plate;
    }
    plate.n = {static_cast<Id>(n1), static_cast<Id>(n2)};
    add_entities(node, n1 * n2);
    return plate;
  }

  void add_entities(const YAML::Node& node, Real more) {
    const bool told = entities_ > most_entities;
    entities_ += more;
    if (entities_ > most_entities && !told)
      error(node,
            fmt::format("up to here the scene has room for {:.3g} particles and shells; {:.0e} are the limit",
                        entities_, most_entities));
  }

  void read_keywords(const YAML::Node& node, Scene& scene) {
    if (!node) return;
    if (node.IsScalar()) {
      add_keywords(node, scene);
    } else if (node.IsSequence()) {
      for (const auto& entry : node) add_keywords(entry, scene);
    } else {
      error(node, "keywords: expected deck text or a list of deck texts");
    }
  }

  void add_keywords(const YAML::Node& node, Scene& scene) {
    if (!node.IsScalar()) {
      error(node, "keywords: expected deck text");
      return;
    }
    const Substitution filled = substitute(node.Scalar(), variables_);
    // The text of a block scalar starts on the line below its mark.
    if (!filled.ok()) diagnostics_.error(at(node, filled.line + 1), filled.error);
    scene.keywords.push_back(filled.text);
  }

  struct Base {
    std::string path;
    YAML::Node node;
  };
  std::string path_;
  std::vector<Base> bases_;
  int dim_ = 0;        // of all lattices
  Real entities_ = 0;  // so far
  const std::map<std::string, std::string>& overrides_;
  Diagnostics& diagnostics_;
  Variables variables_{{"pi", pi}};
};

}  // namespace

Scene read_scene(const std::string& path, const std::map<std::string, std::string>& overrides,
                 Diagnostics& diagnostics) {
  try {
    return SceneReader(path, overrides, diagnostics).read();
  } catch (const YAML::BadFile&) {
    diagnostics.error({path, 0, 0}, "the scene cannot be read", "check the name and the permissions");
  } catch (const YAML::Exception& fault) {
    report_yaml_fault(path, fault, diagnostics);
  }
  return {};
}

}  // namespace courant
