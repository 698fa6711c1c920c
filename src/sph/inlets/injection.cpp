// What the cards of inlets mean, and what is refused of them.
#include "sph/inlets/injection.hpp"
#include "model/definitions/named_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "sph/cards.hpp"
#include "sph/inlets/injection_cards.hpp"
#include "sph/inlets/inlet_shape.hpp"

namespace courant {

namespace {

constexpr Real in_plane = 1e-6;         // cosine
constexpr Real most_stretch = 1.1;      // of the spacing along the flow over that across, without a warning
constexpr Real support_and_skin = 3.4;  // how far a particle looks at most, in h: quintic spline, most skin

class Reader {
 public:
  Reader(const Deck& deck, const Model& model, int dim, Diagnostics& diagnostics)
      : deck_(deck), model_(model), dim_(dim), diagnostics_(diagnostics) {}

  std::vector<Injection> read() {
    for (const auto& card : deck_.all<DefineSphInjection>()) add(card);
    for (const auto& card : deck_.all<DefineSphInjectionSimplified>()) add(card, "VEL");
    for (const auto& card : deck_.all<DefineSphInjectionFlowrate>()) add(card, "FLWRT");
    read_inflows(deck_, model_, out_, diagnostics_);
    return std::move(out_);
  }

 private:
  void add(const DefineSphInjection& c) {
    const int errors = diagnostics_.errors();
    Injection inlet{.card = c};
    if (c.vmag < 0) inlet.rate = rate_of(c, "VMAG", -c.vmag);
    inlet.v = Vec(c.vx, c.vy, c.vz) * (c.vmag > 0 ? static_cast<Real>(c.vmag) : 1);
    if (!(inlet.v.norm() > 0)) error(c, "VX", "the particles have no velocity", "give VX, VY or VZ");
    const CoordinateSystem* system = c.cid == 0 ? nullptr : find_system(c, c.cid);
    if (diagnostics_.errors() > errors) return;
    Vec normal = system ? Vec(system->axes.col(2)) : Vec(inlet.v.normalized());
    if (std::abs(inlet.v.dot(normal)) < in_plane * inlet.v.norm())
      return error(c, "VX", "the velocity lies in the plane of the inlet, whose normal is the z axis of CID",
                   "leave CID blank: then the normal is along the velocity");
    if (inlet.v.dot(normal) < 0) normal = -normal;  // downstream, whichever way z points
    if (!is_upright(c, normal)) return;
    inlet.plane.normal = normal;
    const InletShape shape =
        c.radius > 0 || c.xlen > 0 || c.ylen > 0 ? drawn_shape(c, system, normal) : shape_of_nodes(c, normal);
    if (diagnostics_.errors() > errors) return;
    finish(c, std::move(inlet), shape, c.pid, c.tbeg, c.tend);
  }

  void add(const DefineSphInjectionSimplified& c, const char* flow) {
    const int errors = diagnostics_.errors();
    Injection inlet{.card = c};
    if (c.vel < 0) inlet.rate = rate_of(c, flow, static_cast<Id>(-c.vel));
    Vec centre(c.xc, c.yc, c.zc), normal(c.dnx, c.dny, c.dnz);
    if (c.cid != 0)
      if (const CoordinateSystem* system = find_system(c, c.cid))
        centre = system->origin, normal = system->axes.col(2);
    if (diagnostics_.errors() > errors) return;
    if (!(normal.norm() > 0))
      return error(c, "CID", "the normal of the inlet is not defined", "give CID, or DNX, DNY and DNZ");
    normal.normalize();
    if (!is_upright(c, normal)) return;
    centre += c.offst * normal;
    const auto [e1, e2] = axes_across(normal);
    const InletShape shape = circle(centre, e1, e2, c.radius, c.psize, dim_);
    const bool by_volume = flow == std::string_view("FLWRT");
    if (by_volume && dim_ == 2 && !has_own_units(c, flow)) return;
    inlet.plane.normal = normal;
    const Real flows = c.vel < 0 ? 1 : c.vel;  // times the rate
    inlet.v = normal * (by_volume ? flows / (shape.area * static_cast<Real>(shape.places.size())) : flows);
    finish(c, std::move(inlet), shape, c.pid, c.tbeg, c.tend);
  }

  /// Of a curve over time.
  template <class Card>
  InletRate rate_of(const Card& c, const char* field, Id id) {
    const Curve* curve = curve_named(deck_, model_, c, field, id, diagnostics_);
    if (!curve) return {};
    InletRate rate(*curve);
    if (rate.least() < 0)
      error(c, field, fmt::format("curve {} falls below 0: water would flow out", id),
            "an inlet lets water in; let the curve end at 0, and the outflow be an outlet of its own");
    return rate;
  }

  InletShape drawn_shape(const DefineSphInjection& c, const CoordinateSystem* system, const Vec& normal) {
    const bool round = c.radius > 0;
    if (c.nsid != 0)
      error(c, "NSID", fmt::format("expected nothing beside {}", round ? "RADIUS" : "XLEN and YLEN"),
            "define the inlet by nodes or by its size");
    if (round && (c.xlen > 0 || c.ylen > 0))
      error(c, "XLEN", "expected nothing beside RADIUS", "an inlet is a circle or a rectangle");
    if (!system)
      error(c, "CID", "an inlet that is given by its size needs a system: its origin is the centre");
    if (!(c.psize > 0)) error(c, "PSIZE", "expected a spacing > 0 beside RADIUS or XLEN");
    if (!round && dim_ == 3 && !(c.xlen > 0 && c.ylen > 0))
      error(c, c.xlen > 0 ? "YLEN" : "XLEN", "a rectangle needs both XLEN and YLEN");
    if (!system || !(c.psize > 0)) return {};
    const Vec &centre = system->origin, x = system->axes.col(0), y = system->axes.col(1);
    InletShape shape;
    if (dim_ == 2) {
      const Vec along = axes_across(normal).first;
      const Real length = round ? 2 * c.radius : std::abs(x.dot(along)) > 0.5 ? c.xlen : c.ylen;
      if (!(length > 0))
        error(c, "XLEN", "the axis of CID that lies in the plane z = constant has no length");
      else
        shape = rectangle(centre, along, Vec::Zero(), length, 0, c.psize, 2);
    } else {
      shape = round ? circle(centre, x, y, c.radius, c.psize, 3)
                    : rectangle(centre, x, y, c.xlen, c.ylen, c.psize, 3);
    }
    if (c.area > 0 && has_own_units(c, "AREA") && !shape.places.empty())
      shape.area = c.area / static_cast<Real>(shape.places.size());
    return shape;
  }

  InletShape shape_of_nodes(const DefineSphInjection& c, const Vec& normal) {
    if (c.nsid == 0) {
      error(c, "NSID", "the position of the inlet is not defined",
            "name a set of nodes, or give RADIUS or XLEN and YLEN on the second card");
      return {};
    }
    const auto found = model_.node_sets.find(c.nsid);
    if (found == model_.node_sets.end() || found->second.empty()) {
      error(c, "NSID",
            fmt::format("node set {} {}", c.nsid,
                        found == model_.node_sets.end() ? "does not exist" : "is empty"),
            "define it with *SET_NODE_LIST");
      return {};
    }
    InletShape shape;
    for (const Index n : found->second) shape.places.push_back(model_.nodes[static_cast<std::size_t>(n)].x);
    const std::optional<Real> side = lattice_side(shape.places, normal, dim_);
    if (!nodes_are_sound(c, found->second, normal, side)) return {};
    if (c.area > 0 && !has_own_units(c, "AREA")) return {};
    shape.spacing = side.value_or(0);
    shape.area =
        c.area > 0 ? c.area / static_cast<Real>(shape.places.size()) : (dim_ == 2 ? *side : *side * *side);
    return shape;
  }

  bool nodes_are_sound(const DefineSphInjection& c, const std::vector<Index>& nodes, const Vec& normal,
                       const std::optional<Real>& side) {
    const auto node = [&](Index n) -> const ModelNode& { return model_.nodes[static_cast<std::size_t>(n)]; };
    Real width = 0;
    for (const Index n : nodes) width = std::max(width, (node(n).x - node(nodes[0]).x).norm());
    std::unordered_set<Index> particles;
    for (const ModelSph& s : model_.sph) particles.insert(s.node);
    for (const Index n : nodes) {
      const Real off = (node(n).x - node(nodes[0]).x).dot(normal);
      if (std::abs(off) > 1e-3 * width) {
        error(c, "NSID",
              fmt::format("node {} of set {} is {:.4g} [L] off the plane through node {} with normal ({:g}, "
                          "{:g}, {:g})",
                          node(n).id, c.nsid, off, node(nodes[0]).id, normal[0], normal[1], normal[2]),
              c.cid == 0 ? "without CID the plane is normal to the velocity" : "");
        return false;
      }
      if (particles.contains(n)) {
        error(c, "NSID", fmt::format("node {} of set {} is a particle", node(n).id, c.nsid),
              "give the inlet nodes of its own: particles enter there");
        return false;
      }
    }
    if (side || c.area > 0) return true;
    error(c, "AREA",
          nodes.size() == 1
              ? fmt::format("set {} has one node, which defines no area", c.nsid)
              : fmt::format("the nodes of set {} are not on a square lattice{}, which would define the area",
                            c.nsid, dim_ == 2 ? " (in 2D: at equal distances on a line)" : ""),
          "give AREA, of which each node gets the same share");
    return false;
  }

  /// What does not depend on the shape.
  template <class Card>
  void finish(const Card& c, Injection inlet, const InletShape& shape, Id pid, Real tbeg, Real tend) {
    const auto part = model_.part_of_id.find(pid);
    if (part == model_.part_of_id.end())
      return error(c, "PID", fmt::format("part {} does not exist", pid), "define it with *PART");
    if (model_.parts[static_cast<std::size_t>(part->second)].has_shell)
      return error(c, "PID", fmt::format("part {} has shells", pid),
                   "give the particles a part of their own");
    if (tend <= tbeg)
      return error(c, "TEND", fmt::format("expected a time behind TBEG = {:g}, got '{:g}'", tbeg, tend));
    inlet.part = part->second;
    inlet.places = shape.places;
    inlet.plane.point = shape.places.front();
    inlet.area = shape.area * static_cast<Real>(shape.places.size());
    inlet.spacing = dim_ == 2 ? shape.area : std::sqrt(shape.area);
    inlet.begin = tbeg, inlet.end = tend;
    inlet.cell = shape.spacing > 0 ? shape.spacing : inlet.spacing;
    inlet.reach = support_and_skin * largest_h(model_.parts[static_cast<std::size_t>(part->second)],
                                               std::max(inlet.spacing, shape.spacing));
    if (!reaches_the_box(c, inlet)) return;
    const Real ratio = shape.spacing > 0 ? inlet.spacing / shape.spacing : 1;
    if (std::max(ratio, 1 / ratio) > most_stretch)
      deck_.warning(diagnostics_, c, "AREA",
                    fmt::format("nodes are {:.4g} [L] apart, but the share of AREA makes layers {:.4g} apart",
                                shape.spacing, inlet.spacing),
                    "leave AREA blank where nodes are on a square lattice");
    out_.push_back(std::move(inlet));
  }

  /// What h may grow to. [L]
  Real largest_h(const ModelPart& part, Real spacing) const {
    for (const SectionSph& s : deck_.all<SectionSph>())
      if (s.secid == part.secid) return std::max(s.cslh * spacing, s.sphini) * std::max(s.hmax, Real(1));
    return spacing;  // the deck is refused for that
  }

  template <class Card>
  bool reaches_the_box(const Card& c, const Injection& inlet) {
    const ControlSph* control = deck_.last<ControlSph>();
    if (!control || control->boxid == 0) return true;
    const auto found = model_.boxes.find(control->boxid);
    if (found == model_.boxes.end() || found->second.local) return true;  // refused elsewhere
    const Neighbours::Region region{found->second.low, found->second.high};
    for (const Vec& place : inlet.places)
      if (std::isfinite(region.time_to_reach(place, inlet.v, 0))) return true;
    error(
        c, "PID",
        fmt::format("none of the particles that enter ever reaches box {}, which BOXID of *CONTROL_SPH names",
                    control->boxid),
        "turn the velocity towards the box, or move the inlet");
    return false;
  }

  const CoordinateSystem* find_system(const Entry& card, Id cid) {
    const auto found = model_.coordinate_systems.find(cid);
    if (found == model_.coordinate_systems.end()) {
      error(card, "CID", fmt::format("coordinate system {} does not exist", cid),
            "define it with *DEFINE_COORDINATE_SYSTEM");
      return nullptr;
    }
    if (!found->second.moves) return &found->second;
    error(card, "CID",
          fmt::format("coordinate system {} moves with nodes, which an inlet cannot follow", cid),
          "define a fixed one");
    return nullptr;
  }

  /// In 2D the plane of an inlet is normal to that of the particles.
  bool is_upright(const Entry& card, const Vec& normal) {
    if (dim_ == 3 || std::abs(normal[2]) < in_plane) return true;
    error(card, "CID", "in 2D the normal of the inlet must lie in the plane z = constant",
          "the normal is the z axis of CID, or without CID the velocity");
    return false;
  }

  /// Unit vectors in the plane; in 2D the first lies in the plane z = constant, too.
  static std::pair<Vec, Vec> axes_across(const Vec& normal) {
    const Vec other = std::abs(normal[2]) < 0.9 ? Vec::UnitZ() : Vec::UnitX();
    const Vec e1 = other.cross(normal).normalized();
    return {e1, normal.cross(e1)};
  }

  /// As with masses: per unit of depth, whose unit is unknown.
  bool has_own_units(const Entry& card, const char* field) {
    if (dim_ == 3 || deck_.files[static_cast<std::size_t>(card.file)].conversion.units.length == 1)
      return true;
    error(card, field, "in 2D it is per unit of depth, and the file has another unit of length",
          "give it in the deck's own unit of length");
    return false;
  }

  void error(const Entry& card, const char* field, std::string message, std::string hint = {}) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  const Deck& deck_;
  const Model& model_;
  int dim_;
  Diagnostics& diagnostics_;
  std::vector<Injection> out_;
};

}  // namespace

const Entry* first_injection(const Deck& deck) {
  if (!deck.all<DefineSphInjection>().empty()) return &deck.all<DefineSphInjection>().front();
  if (!deck.all<DefineSphInjectionSimplified>().empty())
    return &deck.all<DefineSphInjectionSimplified>().front();
  if (!deck.all<DefineSphInjectionFlowrate>().empty()) return &deck.all<DefineSphInjectionFlowrate>().front();
  return nullptr;
}

std::vector<Injection> read_injections(const Deck& deck, const Model& model, int dim,
                                       Diagnostics& diagnostics) {
  return Reader(deck, model, dim, diagnostics).read();
}

}  // namespace courant
