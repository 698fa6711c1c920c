// SURF 3 of *COURANT_INFLOW: what the card means, and what is refused of it.
#include "sph/inlets/held_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyword/deck.hpp"
#include "sph/boundaries/boundary_cards.hpp"
#include "sph/cards.hpp"
#include "sph/inlets/injection.hpp"

namespace courant {

namespace {

/// Coordinates of positions along an axis: how many differ, and the edges of their cells.
struct Extent1 {
  std::size_t count = 0;
  Real low = 0, high = 0;
};

Extent1 extent_along(const std::vector<Vec>& positions, const Vec& axis, Real cell) {
  std::vector<Real> at;
  for (const Vec& x : positions) at.push_back(x.dot(axis));
  std::sort(at.begin(), at.end());
  Extent1 out{.count = 1, .low = at.front(), .high = at.back()};
  for (std::size_t k = 1; k < at.size(); ++k) out.count += at[k] - at[k - 1] > 0.1 * cell;
  const Real half =
      out.count > 1 ? 0.5 * (out.high - out.low) / static_cast<Real>(out.count - 1) : 0.5 * cell;
  out.low -= half, out.high += half;
  return out;
}

/// Times of a run at which curves may have their extremes.
std::vector<Real> times_of(const FreeSurface& surface, Real begin, Real end) {
  constexpr int samples = 64;  // of a gravity that changes
  std::vector<Real> out;
  for (int k = 0; k <= samples; ++k) out.push_back(begin + (end - begin) * k / samples);
  for (const Real t : surface.level.abscissa)
    if (t > begin && t < end) out.push_back(t);
  return out;
}

class HeldLevelReader {
 public:
  HeldLevelReader(const Deck& deck, const Model& model, const CourantInflow& card, Injection& inlet,
                  Diagnostics& diagnostics)
      : deck_(deck), model_(model), card_(card), inlet_(inlet), diagnostics_(diagnostics) {
    const ControlSph* control = deck.last<ControlSph>();
    if (control && control->idim == 3) dim_ = 3;
  }

  void read() {
    HeldLevel& held = inlet_.held;
    held.card = card_;
    held.energy = card_.head == 1;
    if (!inlet_.rate.steady())
      return refuse("SURF",
                    fmt::format("curve {} prescribes the velocity of the inlet, which SURF 3 derives",
                                inlet_.rate.curve()),
                    "give the inlet a number > 0 as its velocity: it is used as a direction only");
    if (read_shape(held) && read_limits(held)) held.on = true;
  }

 private:
  bool read_shape(HeldLevel& held) {
    constexpr Real steepest = 0.1;  // slope of the bed
    const Vec &up = inlet_.surface.up, &normal = inlet_.plane.normal;
    if (std::abs(up.dot(normal)) > steepest)
      return error("SURF", "the plane of the inlet is not upright, as that of a level to hold must be",
                   "let water come in along the bed, across the direction of gravity");
    held.upright = (up - up.dot(normal) * normal).normalized();
    held.side = dim_ == 3 ? Vec(normal.cross(held.upright)) : Vec(Vec::Zero());
    const Extent1 rows = extent_along(inlet_.positions, held.upright, inlet_.cell),
                  columns = extent_along(inlet_.positions, held.side, inlet_.cell);
    const std::size_t across = dim_ == 3 ? columns.count : 1;
    const Real area = (rows.high - rows.low) * (dim_ == 3 ? columns.high - columns.low : 1);
    if (rows.count * across != inlet_.positions.size() || std::abs(area - inlet_.area) > 0.02 * area)
      return error(
          "SURF", "the positions of the inlet do not fill an upright rectangle",
          "give XLEN and YLEN, in 2D a line, or a node set in level rows: its width must be the same "
          "at any depth");
    held.low = rows.low, high_ = rows.high;
    held.left = columns.low, held.right = columns.high;
    return true;
  }

  /// Of the surface at a time above the lower edge. [L]
  Real depth(Real t) const {
    const HeldLevel& held = inlet_.held;
    const Vec edge = inlet_.plane.point + (held.low - inlet_.plane.point.dot(held.upright)) * held.upright;
    return inlet_.surface.depth(edge, t) / inlet_.surface.up.dot(held.upright);
  }

  bool read_limits(HeldLevel& held) {
    const Real height = high_ - held.low, last = std::max(inlet_.begin, std::min(inlet_.end, model_.endtim));
    Real least = depth(inlet_.begin), most = least, g = 0;
    for (const Real t : times_of(inlet_.surface, inlet_.begin, last)) {
      least = std::min(least, depth(t)), most = std::max(most, depth(t));
      g = std::max(g, inlet_.surface.gravity(inlet_.plane.point, t, inlet_.part).norm());
    }
    const char* field = card_.lclev != 0 ? "LCLEV" : "SURF";
    if (!(least > 0))
      return error(field,
                   fmt::format("the level is {:.4g} [L] below the lower edge of the inlet, its bed", -least),
                   "give XS, YS, ZS on the surface of the water that is held");
    if (most > height * (1 + 1e-6) + 1e-3 * inlet_.cell)
      return error(field,
                   fmt::format("the level is {:.4g} [L] above the upper edge of the inlet, through which no "
                               "water would come in",
                               most - height),
                   "let the inlet reach up to the highest level; positions above the level stay closed");
    if (dim_ == 2 && card_.qmax > 0 &&
        deck_.files[static_cast<std::size_t>(card_.file)].conversion.units.length != 1)
      return error("QMAX", "in 2D it is per unit of depth, and the file has another unit of length",
                   "give it in the deck's own unit of length");
    held.distance = card_.dist > 0 ? card_.dist : depth(inlet_.begin);
    if (held.distance < inlet_.cell)
      return error("DIST",
                   fmt::format("{:.4g} [L] is less than the spacing {:.4g} of the particles", held.distance,
                               inlet_.cell),
                   "measure at least a few spacings downstream, or leave it blank");
    held.tau = card_.tau > 0 ? card_.tau : held.distance / std::sqrt(g * most);
    held.most = card_.qmax > 0 ? card_.qmax : std::numeric_limits<Real>::infinity();
    const Real lowest = 2 * least / 3;                     // depth at the inlet, in critical flow
    const Real highest = held.energy ? most : 1.5 * most;  // energy head, in critical flow
    held.fastest = std::min(critical_velocity(highest, g), held.most / (held.width(dim_) * lowest));
    return true;
  }

  bool error(const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card_, field, std::move(message), std::move(hint));
    return false;
  }
  void refuse(const char* field, std::string message, std::string hint) {
    error(field, std::move(message), std::move(hint));
  }

  const Deck& deck_;
  const Model& model_;
  const CourantInflow& card_;
  Injection& inlet_;
  Diagnostics& diagnostics_;
  int dim_ = 2;
  Real high_ = 0;  ///< upper edge, along `upright` [L]
};

/// Whether the segment from `x` along `step` meets a triangle.
bool meets(const Vec& x, const Vec& step, const Vec& a, const Vec& b, const Vec& c) {
  constexpr Real edge = 1e-6;
  const Vec e1 = b - a, e2 = c - a, across = step.cross(e2);
  const Real det = e1.dot(across);
  if (std::abs(det) < 1e-12 * e1.norm() * e2.norm() * step.norm()) return false;
  const Vec from = x - a, q = from.cross(e1);
  const Real u = from.dot(across) / det, v = step.dot(q) / det, t = e2.dot(q) / det;
  return u >= -edge && v >= -edge && u + v <= 1 + edge && t >= 0 && t <= 1;
}

class HeldLevelCheck {
 public:
  HeldLevelCheck(const Deck& deck, std::span<const GhostPlane> planes, const SphSettings& settings,
                 const World& world, Diagnostics& diagnostics)
      : deck_(deck), planes_(planes), settings_(settings), world_(world), diagnostics_(diagnostics) {}

  void check(const Injection& inlet, const PartMaterial& material) {
    const HeldLevel& held = inlet.held;
    if (!material.holds_cold())
      return refuse(held,
                    fmt::format("part {} is a gas, which has no level",
                                world_.part_ids[static_cast<std::size_t>(inlet.part)]),
                    "SURF 3 is for liquids");
    for (const GhostPlane& plane : planes_)
      if (plane.kind == GhostPlane::Kind::periodic && std::abs(plane.normal.dot(inlet.plane.normal)) > 1e-6)
        return refuse(held, "water comes in across periodic planes",
                      "beside periodic planes water must come in along them");
    const Vec middle = middle_of_lower_edge(inlet), flow = inlet.plane.normal;
    const Vec far = middle + 2 * held.distance * flow + 0.5 * inlet.cell * held.upright;
    if (settings_.region && !settings_.region->contains(far[0], far[1], far[2]))
      return refuse(
          held,
          fmt::format("depth and velocity are measured up to {:.4g} [L] downstream, twice DIST, out "
                      "of the computational box",
                      2 * held.distance),
          "make DIST smaller, or the box longer");
    for (const Real s : {0.5, 1.0, 1.5})
      if (!has_bed(middle + s * held.distance * flow, inlet))
        return refuse(
            held,
            fmt::format("there is no bed at the lower edge of the inlet {:.4g} [L] downstream, so "
                        "the depth cannot be measured",
                        s * held.distance),
            "let the inlet begin on a wall of shells or solids, or on a symmetry plane, that goes on "
            "for twice DIST");
  }

 private:
  void refuse(const HeldLevel& held, const std::string& message, const char* hint) {
    diagnostics_.error(deck_.where(held.card), fmt::format("{}: {}", deck_.keyword(held.card), message),
                       hint);
  }

  static Vec middle_of_lower_edge(const Injection& inlet) {
    const HeldLevel& held = inlet.held;
    const Vec& x = inlet.plane.point;
    return x + (held.low - x.dot(held.upright)) * held.upright +
           (0.5 * (held.left + held.right) - x.dot(held.side)) * held.side;
  }

  bool has_bed(const Vec& x, const Injection& inlet) const {
    const Vec& up = inlet.held.upright;
    for (const auto& [name, use] : deck_.keywords)
      if (name.starts_with("RIGIDWALL_")) return true;  // any of them may be one
    for (const GhostPlane& plane : planes_)
      if (const Real d = depth(plane, x); plane.normal.dot(up) > 0.7 && std::abs(d) < 1.5 * inlet.cell)
        return true;
    const Segments& g = world_.segments;
    const auto corner = [&](const Field<Index>& node, Index s) { return world_.nodes.x.vec(node[s]); };
    const Vec from = x + inlet.cell * up, step = -2.5 * inlet.cell * up;
    for (Index s = 0; s < g.size(); ++s) {
      const Vec a = corner(g.node0, s), b = corner(g.node1, s), c = corner(g.node2, s),
                d = corner(g.node3, s);
      if (meets(from, step, a, b, c) || meets(from, step, a, c, d)) return true;
    }
    return false;
  }

  const Deck& deck_;
  std::span<const GhostPlane> planes_;
  const SphSettings& settings_;
  const World& world_;
  Diagnostics& diagnostics_;
};

}  // namespace

Real critical_velocity(Real head, Real g) {
  return std::sqrt(Real(2) / 3 * g * std::max(Real(0), head));
}

Real depth_at_inlet(Real head, Real u, Real g) {
  return head - u * u / (2 * g);
}

Real velocity_at_head(Real u, Real h, Real head, Real g) {
  const Real leaving = u - 2 * std::sqrt(g * std::max(Real(0), h)), held = g * std::max(Real(0), head);
  // c^2 + (leaving + 2 c)^2/2 = held; without a solution the water inside is far too high or supercritical
  const Real root = 3 * held - 0.5 * leaving * leaving;
  const Real c = root > 0 && leaving < 0 ? (std::sqrt(root) - leaving) / 3 : std::sqrt(held);
  return std::min(leaving + 2 * c, critical_velocity(head, g));
}

void read_held_level(const Deck& deck, const Model& model, const CourantInflow& card, Injection& inlet,
                     Diagnostics& diagnostics) {
  HeldLevelReader(deck, model, card, inlet, diagnostics).read();
}

void check_held_levels(const Deck& deck, const Injections& injections, std::span<const GhostPlane> planes,
                       const std::vector<PartMaterial>& materials, const SphSettings& settings,
                       const World& world, Diagnostics& diagnostics) {
  HeldLevelCheck check(deck, planes, settings, world, diagnostics);
  for (const Injection& inlet : injections.inlets)
    if (inlet.held.on) check.check(inlet, materials[static_cast<std::size_t>(inlet.part)]);
}

}  // namespace courant
