#include "generate/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <string_view>
#include <utility>

#include "generate/basin.hpp"
#include "generate/expression.hpp"
#include "generate/node_reader.hpp"

namespace courant {
namespace {

constexpr Real most_entities = 5e7;  // a typing error in a spacing should not fill the memory
constexpr Real most_jitter = 0.5;    // from there on two particles may meet

class SceneReader : private NodeReader {
 public:
  SceneReader(std::string path, const std::map<std::string, std::string>& overrides, Diagnostics& diagnostics)
      : NodeReader(std::move(path), diagnostics), overrides_(overrides) {}

  Scene read() {
    Scene scene;
    if (std::filesystem::is_directory(path_)) throw YAML::BadFile(path_);
    const YAML::Node root = YAML::LoadFile(path_);
    if (!root.IsMap()) {
      diagnostics_.error({path_, 1, 1}, "a scene is a YAML map", "start with 'title: ...'");
      return scene;
    }
    check_keys(
        root, "the scene",
        {"title", "base", "parameters", "water", "box", "gravity", "end", "output", "parts", "keywords"});
    loading_.push_back(std::filesystem::path(path_).lexically_normal().string());
    load_bases(root["base"], with_names(root["parameters"], {}));
    scene.files = {path_};
    for (const Base& base : bases_) scene.files.push_back(base.path);
    read_parameters(root["parameters"], scene);
    scene.title = root["title"] ? text(root["title"]) : std::string("untitled scene");
    if (scene.title.size() > 80) error(root["title"], "title: a deck's title has at most 80 characters");
    scene.variables = variables_;
    read_basin(root, scene);
    for_each_base([&](const YAML::Node& base) {
      if (base["parts"]) read_parts(base, scene);
    });
    if (root["parts"] || scene.parts.empty()) read_parts(root, scene);
    for_each_base([&](const YAML::Node& base) { read_keywords(base["keywords"], scene); });
    read_keywords(root["keywords"], scene);
    return scene;
  }

 private:
  /// What many scenes have in common: files with parameters, parts and keywords, and bases of their own,
  /// which come before them, each once. `above`: names of parameters of the files that this one is a base of.
  void load_bases(const YAML::Node& node, const std::set<std::string>& above) {
    if (!node) return;
    if (!node.IsSequence()) return load_base(node, above);
    for (const auto& one : node) load_base(one, above);
  }
  void load_base(const YAML::Node& node, const std::set<std::string>& above) {
    std::string path = (std::filesystem::path(path_).parent_path() / text(node)).lexically_normal().string();
    if (std::find(loading_.begin(), loading_.end(), path) != loading_.end())
      return error(node, fmt::format("base: '{}' is a base of itself", path));
    const auto known =
        std::find_if(bases_.begin(), bases_.end(), [&](const Base& b) { return b.path == path; });
    if (known != bases_.end()) return known->above.insert(above.begin(), above.end());
    Base base{path, {}, above};
    try {
      if (std::filesystem::is_directory(path)) throw YAML::BadFile(path);
      base.node = YAML::LoadFile(path);
    } catch (const YAML::BadFile&) {
      return error(node, fmt::format("base: the file '{}' cannot be read", path));
    } catch (const YAML::Exception& fault) {
      return report_yaml_fault(path, fault, diagnostics_);
    }
    loading_.push_back(path);
    std::swap(path_, path);
    check_keys(base.node, "a base", {"base", "parameters", "parts", "keywords"});
    if (base.node.IsMap()) load_bases(base.node["base"], with_names(base.node["parameters"], above));
    std::swap(path_, path);
    loading_.pop_back();
    bases_.push_back(std::move(base));
  }
  static std::set<std::string> with_names(const YAML::Node& parameters, std::set<std::string> names) {
    if (parameters && parameters.IsMap())
      for (const auto& entry : parameters)
        if (entry.first.IsScalar()) names.insert(entry.first.Scalar());
    return names;
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
    // Those of bases as soon as all that they need is there, the scene's own one after the other; of several
    // of the same name that of the file which has the others as bases.
    std::set<std::pair<std::string, int>> done;  // entries of bases: file and place in it
    const auto read_bases = [&](bool all) {
      bool more = false;
      for (const Base& base : bases_) {
        const std::string in_scene = std::exchange(path_, base.path);
        for_each_entry(base.node["parameters"], [&](const YAML::Node& name, const YAML::Node& value) {
          const bool ready = all || (value.IsScalar() && evaluate(value.Scalar(), variables_).ok());
          if (!ready || (name.IsScalar() && base.above.contains(name.Scalar()))) return;
          if (!done.emplace(path_, name.Mark().pos).second) return;
          read_parameter(name, value, unused, scene);
          more = true;
        });
        path_ = in_scene;
      }
      return more;
    };
    const auto read_ready = [&] {
      while (read_bases(false)) {
      }
    };
    read_ready();
    for_each_entry(node, [&](const YAML::Node& name, const YAML::Node& value) {
      read_parameter(name, value, unused, scene);
      read_ready();
    });
    read_bases(true);
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

  /// Water in a box with all its cards, where the scene gives `water`.
  void read_basin(const YAML::Node& root, Scene& scene) {
    const YAML::Node water = root["water"];
    if (!water) {
      for (const char* key : {"box", "gravity", "end", "output"})
        if (root[key]) error(root[key], fmt::format("'{}' goes with 'water', which the scene has not", key));
      return;
    }
    const int before = diagnostics_.errors();
    Basin basin = read_water(water);
    if (root["gravity"]) basin.gravity = number(root["gravity"], "gravity");
    if (basin.gravity < 0) error(root["gravity"], "gravity: expected its size, >= 0; it acts downwards");
    basin.end = length(root, "end");
    basin.output = root["output"] ? length(root, "output") : basin.end / 100;
    if (root["box"]) read_box(root["box"], basin);
    if (diagnostics_.errors() > before) return;
    const std::string fault = basin.complete();
    if (!fault.empty()) error(water, fault);
    if (diagnostics_.errors() == before) add_basin(basin, scene);
  }

  Basin read_water(const YAML::Node& node) {
    Basin basin;
    if (!node.IsMap()) {
      error(node, "water: expected a map", "water: {spacing: 0.01, blocks: [{low: [0, 0], high: [1, 1]}]}");
      return basin;
    }
    check_keys(node, "water",
               {"spacing", "blocks", "density", "sound_speed", "viscosity", "tension", "velocity"});
    if (node["density"]) basin.density = length(node, "density");
    if (node["sound_speed"]) basin.sound_speed = length(node, "sound_speed");
    if (node["viscosity"]) basin.viscosity = number(node["viscosity"], "viscosity");
    if (basin.viscosity < 0) error(node["viscosity"], "viscosity: expected a number >= 0");
    if (node["tension"] && !YAML::convert<bool>::decode(node["tension"], basin.tension))
      error(node["tension"], "tension: expected true or false");
    basin.water.where = at(node);
    if (node["velocity"]) read_velocity(node, true, basin.water);
    basin.spacing = length(node, "spacing");
    const YAML::Node blocks = node["blocks"];
    if (!blocks || !blocks.IsSequence() || blocks.size() == 0) {
      error(blocks ? blocks : node, "water: 'blocks' is a list of {low: [x, y], high: [x, y]}, in 3D with z");
      return basin;
    }
    for (const auto& entry : blocks)
      if (entry.IsMap())
        basin.water.lattices.push_back(read_lattice(entry, basin.spacing));
      else
        error(entry, "expected a map");
    basin.dim = dim_;
    return basin;
  }

  void read_box(const YAML::Node& node, Basin& basin) {
    if (!node.IsMap())
      return error(node, "box: expected a map", "box: {low: [0, 0], high: [2, 1], open: [top]}");
    check_keys(node, "box", {"low", "high", "open"});
    basin.has_box = true;
    int low = 0, high = 0;
    basin.low = vector(node, "low", low), basin.high = vector(node, "high", high);
    if (low != basin.dim || high != basin.dim)
      error(node, fmt::format("box: the water has {} dimensions, and so must low and high", basin.dim));
    const YAML::Node open = node["open"];
    if (open && !open.IsSequence()) error(open, "open: expected a list of sides", "open: [top]");
    for (const auto& side : open) {
      const std::string name = text(side);
      const std::vector<std::string> known = basin.sides();
      if (std::find(known.begin(), known.end(), name) == known.end())
        error(side, fmt::format("open: '{}' is no side of the box", name),
              fmt::format("its sides: {}", fmt::join(known, ", ")));
      basin.open.insert(name);
    }
  }

  void read_parts(const YAML::Node& root, Scene& scene) {
    const YAML::Node node = root["parts"];
    if (!node || !node.IsSequence() || node.size() == 0) {
      error(node ? node : root, "the scene has no parts", "give a list under 'parts:'");
      return;
    }
    std::set<Id> ids;
    for (const ScenePart& part : scene.parts) ids.insert(part.id);  // of the water and its box, and of bases
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

  /// `spacing`: of blocks, which have none of their own.
  SceneLattice read_lattice(const YAML::Node& node, Real spacing = 0) {
    if (spacing > 0)
      check_keys(node, "a block", {"low", "high", "where", "jitter"});
    else
      check_keys(node, "a lattice", {"low", "high", "spacing", "where", "jitter"});
    SceneLattice lattice;
    const int before = diagnostics_.errors();
    int dim_high = 0;
    lattice.low = vector(node, "low", lattice.dim);
    const Vec high = vector(node, "high", dim_high);
    lattice.spacing = spacing > 0 ? spacing : length(node, "spacing");
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

  /// Along edge1 and edge2: two numbers, or one for both. [L]
  std::array<Real, 2> mesh_of(const YAML::Node& plate) {
    if (const YAML::Node mesh = plate["mesh"]; mesh && mesh.IsSequence() && mesh.size() == 2) {
      std::array<Real, 2> out{};
      for (std::size_t k = 0; k < 2; ++k) {
        YAML::Node each;
        each["mesh"] = mesh[k];
        out[k] = length(each, "mesh");
      }
      return out;
    }
    const Real both = length(plate, "mesh");
    return {both, both};
  }

  ScenePlate read_plate(const YAML::Node& node) {
    check_keys(node, "a plate", {"origin", "edge1", "edge2", "mesh"});
    ScenePlate plate;
    const int before = diagnostics_.errors();
    plate.origin = vector(node, "origin");
    plate.edge1 = vector(node, "edge1");
    plate.edge2 = vector(node, "edge2");
    const auto [mesh1, mesh2] = mesh_of(node);
    if (diagnostics_.errors() > before) return plate;
    const Real l1 = plate.edge1.norm(), l2 = plate.edge2.norm();
    if (!(plate.edge1.cross(plate.edge2).norm() > 1e-9 * l1 * l2)) {
      error(node, "the plate has no area: edge1 and edge2 are zero or parallel");
      return plate;
    }
    // `mesh` is the largest side of a shell; 1e-6 forgives round-off.
    const Real n1 = std::max(1.0, std::ceil(l1 / mesh1 - 1e-6)),
               n2 = std::max(1.0, std::ceil(l2 / mesh2 - 1e-6));
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
    std::set<std::string> above;  ///< parameters that other files give in its place
  };
  std::vector<Base> bases_;           ///< each after its own
  std::vector<std::string> loading_;  ///< the scene and the bases on the way to the file that is read
  int dim_ = 0;                       // of all lattices
  Real entities_ = 0;                 // so far
  const std::map<std::string, std::string>& overrides_;
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
