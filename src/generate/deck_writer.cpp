#include "generate/deck_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "generate/expression.hpp"
#include "generate/initial_state.hpp"
#include "generate/lattice.hpp"

namespace courant {
namespace {

struct PlacedShell {
  Id id;
  std::array<Id, 4> node;
};
/// Nodes and elements of one part. Particles have the ids of their nodes.
struct PlacedPart {
  std::vector<PlacedNode> nodes;
  std::vector<std::pair<Id, Real>> particles;  ///< id, MASS field
  std::vector<PlacedShell> shells;
};

void place_lattice(const SceneLattice& lattice, const std::vector<Vec>& points, Real density, Id first,
                   PlacedPart& out) {
  // MASS > 0 is a mass, < 0 a volume.
  const Real mass = density > 0 ? density * lattice.volume() : -lattice.volume();
  Id id = first;
  out.nodes.reserve(out.nodes.size() + points.size());
  out.particles.reserve(out.particles.size() + points.size());
  for (const Vec& x : points) {
    out.nodes.push_back({id, x});
    out.particles.emplace_back(id++, mass);
  }
}

/// Gives nodes of plates their ids; with `merge`, points closer than about 1e-6 mesh sizes get the same one.
class NodePlacer {
 public:
  NodePlacer(bool merge, Id first, PlacedPart& out) : merge_(merge), next_(first), out_(out) {}
  Id place(const Vec& x, Real grain) {
    if (!merge_) return add(x);
    const std::array<Id, 3> cell = {std::llround(x[0] / grain), std::llround(x[1] / grain),
                                    std::llround(x[2] / grain)};
    // A point may round to either side of a cell's border: look at the neighbours too.
    for (Id n = 0; n < 27; ++n) {
      const auto it = known_.find({cell[0] + n / 9 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n % 3 - 1});
      if (it != known_.end()) return it->second;
    }
    return known_[cell] = add(x);
  }
  Id next() const { return next_; }

 private:
  Id add(const Vec& x) {
    out_.nodes.push_back({next_, x});
    return next_++;
  }
  bool merge_;
  Id next_;
  PlacedPart& out_;
  std::map<std::array<Id, 3>, Id> known_;
};

void place_plate(const ScenePlate& plate, Real grain, NodePlacer& nodes, Id& element, PlacedPart& out) {
  std::vector<Id> ids;
  for (Id i = 0; i <= plate.n[0]; ++i) {
    for (Id j = 0; j <= plate.n[1]; ++j) {
      const Vec x = plate.origin + plate.edge1 * (Real(i) / Real(plate.n[0])) +
                    plate.edge2 * (Real(j) / Real(plate.n[1]));
      ids.push_back(nodes.place(x, grain));
    }
  }
  const Id row = plate.n[1] + 1;
  for (Id i = 0; i < plate.n[0]; ++i) {
    for (Id j = 0; j < plate.n[1]; ++j) {
      const Id a = i * row + j, b = a + row;
      out.shells.push_back({element++, {ids[a], ids[b], ids[b + 1], ids[a + 1]}});
    }
  }
}

/// Next free ids over the whole deck.
struct Ids {
  Id node = 1, shell = 1;
};

PlacedPart place_part(const ScenePart& part, Ids& ids, const Variables& variables, Diagnostics& diagnostics) {
  PlacedPart placed;
  if (part.first_id > 0) {
    if (part.first_id < ids.node || (!part.plates.empty() && part.first_id < ids.shell))
      diagnostics.error(
          part.where,
          fmt::format("part {}: ids from {} on are taken by the parts above", part.id, part.first_id),
          fmt::format("first_id: {} or more is free", std::max(ids.node, ids.shell)));
    ids.node = part.first_id;
    if (!part.plates.empty()) ids.shell = part.first_id;
  }
  Id stream = 1000 * part.id;
  for (const SceneLattice& lattice : part.lattices) {
    const std::vector<Vec> points = lattice_points(lattice, stream++, variables, diagnostics);
    place_lattice(lattice, points, part.density, ids.node, placed);
    ids.node += static_cast<Id>(points.size());
  }
  if (part.plates.empty() && placed.particles.empty() && diagnostics.ok())
    diagnostics.error(part.where, fmt::format("part {} has no particles: 'where' leaves none", part.id),
                      "a particle is kept where the expression is > 0");
  Real side = std::numeric_limits<Real>::max();
  for (const ScenePlate& p : part.plates)
    side = std::min({side, p.edge1.norm() / Real(p.n[0]), p.edge2.norm() / Real(p.n[1])});
  NodePlacer nodes(part.merge, ids.node, placed);
  for (const ScenePlate& plate : part.plates) place_plate(plate, 1e-6 * side, nodes, ids.shell, placed);
  if (!part.plates.empty()) ids.node = nodes.next();
  if (std::max(ids.node, ids.shell) - 1 > largest_i8)
    diagnostics.error(part.where, fmt::format("part {}: ids reach {}, the format ends at {}", part.id,
                                              std::max(ids.node, ids.shell) - 1, largest_i8));
  return placed;
}

/// Whether ten columns hold a number as exactly as matters.
bool fits(Real value) {
  const std::string text = number_text(value, 10);
  return !text.empty() && std::abs(std::stod(text) - value) <= 1e-6 * std::abs(value);
}

/// "$#      id      styp ...", each name at the right end of its field.
template <class Out>
void append_heading(Out put, std::initializer_list<const char*> names, int width) {
  int columns = width - 2;
  fmt::format_to(put, "$#");
  for (const char* name : names) {
    fmt::format_to(put, "{:>{}}", name, columns);
    columns = width;
  }
  fmt::format_to(put, "\n");
}

std::string parts_text(const Scene& scene) {
  std::string out;
  const auto put = std::back_inserter(out);
  for (const ScenePart& part : scene.parts) {
    fmt::format_to(put, "*PART\n$# heading\n{}\n", part.title);
    out += "$#     pid     secid       mid     eosid      hgid\n";
    fmt::format_to(put, "{:10}{:10}{:10}{:10}{:10}\n", part.id, part.section, part.material, part.eos,
                   part.hourglass);
  }
  for (const ScenePart& part : scene.parts) {
    if (!part.has_velocity) continue;
    const bool wide = !fits(part.velocity[0]) || !fits(part.velocity[1]) || !fits(part.velocity[2]);
    const int width = wide ? 20 : 10;  // + behind the keyword: fields of 20 columns
    fmt::format_to(put, "*INITIAL_VELOCITY_GENERATION{}\n", wide ? " +" : "");
    append_heading(put, {"id", "styp", "omega", "vx", "vy", "vz", "ivatn", "icid"}, width);
    fmt::format_to(put, "{:{w}}{:{w}}{:{w}}{:>{w}}{:>{w}}{:>{w}}{:{w}}{:{w}}\n", part.id, 2, 0,
                   number_text(part.velocity[0], width), number_text(part.velocity[1], width),
                   number_text(part.velocity[2], width), 0, 0, fmt::arg("w", width));
    append_heading(put, {"xc", "yc", "zc", "nx", "ny", "nz", "phase", "irigid"}, width);
    for (int k = 0; k < 8; ++k) fmt::format_to(put, "{:{}}", 0, width);
    out += '\n';
  }
  return out;
}

/// Numbers of one column as text. In a lattice most are those of the line above.
class Column {
 public:
  explicit Column(int width) : width_(width) {}
  const std::string& text(Real value) {
    if (text_.empty() || value != value_) text_ = number_text(value_ = value, width_);
    return text_;
  }

 private:
  int width_;
  Real value_ = 0;
  std::string text_;
};

void append_nodes(const std::vector<PlacedPart>& parts, std::string& out) {
  out += "*NODE\n$#   nid               x               y               z      tc      rc\n";
  const auto put = std::back_inserter(out);
  // 15 of 16 columns, so that neighbours stay apart; the error is below 1e-11 for |x| < 100.
  std::array<Column, 3> columns{Column(15), Column(15), Column(15)};
  const auto text = [&](const Vec& x, int k) -> const std::string& {
    return columns[static_cast<std::size_t>(k)].text(std::abs(x[k]) < 1e-15 ? 0 : x[k]);
  };
  for (const PlacedPart& part : parts)
    for (const PlacedNode& node : part.nodes)
      fmt::format_to(put, "{:8}{:>16}{:>16}{:>16}\n", node.id, text(node.x, 0), text(node.x, 1),
                     text(node.x, 2));
}

void append_elements(const std::vector<PlacedPart>& parts, const Scene& scene, std::string& out) {
  const auto put = std::back_inserter(out);
  const auto any = [&](auto member) {
    return std::any_of(parts.begin(), parts.end(), [&](const PlacedPart& p) { return !(p.*member).empty(); });
  };
  if (any(&PlacedPart::particles))
    out += "*ELEMENT_SPH\n$#   nid     pid            mass    nend   (mass < 0: volume)\n";
  Column masses(16);
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const auto& [id, mass] : parts[p].particles)
      fmt::format_to(put, "{:8}{:8}{:>16}\n", id, scene.parts[p].id, masses.text(mass));
  if (any(&PlacedPart::shells)) out += "*ELEMENT_SHELL\n$#   eid     pid      n1      n2      n3      n4\n";
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const PlacedShell& s : parts[p].shells)
      fmt::format_to(put, "{:8}{:8}{:8}{:8}{:8}{:8}\n", s.id, scene.parts[p].id, s.node[0], s.node[1],
                     s.node[2], s.node[3]);
}

/// Room for all lines of the mesh at once: a deck of 10 million particles takes a gigabyte.
void reserve_mesh(const std::vector<PlacedPart>& parts, std::string& out) {
  constexpr std::size_t node = 57, particle = 33, shell = 49, headings = 1000;
  std::size_t size = out.size() + headings;
  for (const PlacedPart& p : parts)
    size += node * p.nodes.size() + particle * p.particles.size() + shell * p.shells.size();
  out.reserve(size);
}

}  // namespace

std::string deck_text(const Scene& scene, const std::string& scene_name, Diagnostics& diagnostics) {
  std::string out = fmt::format(
      "$ Written by `courant generate {}`: change the scene, not this file.\n$ Parameters:\n", scene_name);
  for (const auto& [name, value] : scene.parameters)
    out += fmt::format("$   {} = {}\n", name, number_text(value));
  const int errors = diagnostics.errors();
  Ids ids;
  std::vector<PlacedPart> placed;
  out += "$ Parts:\n";
  for (const ScenePart& part : scene.parts) {
    placed.push_back(place_part(part, ids, scene.variables, diagnostics));
    const PlacedPart& p = placed.back();
    const bool particles = !p.particles.empty();
    out += fmt::format("$   {} {}: {} {}\n", part.id, part.title,
                       particles ? p.particles.size() : p.shells.size(), particles ? "particles" : "shells");
  }
  if (diagnostics.errors() > errors) return {};
  out += fmt::format("*KEYWORD\n*TITLE\n{}\n", scene.title);
  for (const std::string& block : scene.keywords) {
    out += block;
    if (!block.empty() && block.back() != '\n') out += '\n';
  }
  out += parts_text(scene);
  reserve_mesh(placed, out);
  append_nodes(placed, out);
  append_elements(placed, scene, out);
  for (std::size_t p = 0; p < placed.size(); ++p)
    append_initial_state(scene.parts[p], placed[p].nodes, scene.variables, out, diagnostics);
  out += "*END\n";
  return out;
}

}  // namespace courant
