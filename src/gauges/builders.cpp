// What *COURANT_GAUGE_... bring into a world.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "extension/builders.hpp"
#include "gauges/gauge.hpp"
#include "gauges/gauge_cards.hpp"
#include "keyword/registry.hpp"
#include "rigid/bodies/rigid.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<PointGaugeCard> point_gauge{courant_gauge_point_table()};
const RegisterKeyword<LevelGaugeCard> level_gauge{courant_gauge_level_table()};
const RegisterKeyword<RunupGaugeCard> runup_gauge{courant_gauge_runup_table()};
const RegisterKeyword<FluxGaugeCard> flux_gauge{courant_gauge_flux_table()};
const RegisterKeyword<ForceGaugeCard> force_gauge{courant_gauge_force_table()};

class GaugeBuilder {
 public:
  GaugeBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
               const RigidBodies* bodies)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics), bodies_(bodies) {
    find_scene();
  }

  std::vector<std::unique_ptr<Gauge>> build() {
    for (const PointGaugeCard& card : deck_.all<PointGaugeCard>()) build_point(card);
    for (const LevelGaugeCard& card : deck_.all<LevelGaugeCard>())
      build_line(card, [&](GaugeLayout layout, const GaugeLine& line) {
        return make_level_gauge(std::move(layout), card.dt, line);
      });
    for (const RunupGaugeCard& card : deck_.all<RunupGaugeCard>())
      build_line(card, [&](GaugeLayout layout, const GaugeLine& line) {
        return make_runup_gauge(std::move(layout), card.dt, line);
      });
    for (const FluxGaugeCard& card : deck_.all<FluxGaugeCard>()) build_flux(card);
    for (const ForceGaugeCard& card : deck_.all<ForceGaugeCard>()) build_force(card);
    return std::move(gauges_);
  }

 private:
  Vec point(Real x, Real y, Real z) const { return {x, y, world_.dim == 2 ? 0 : z}; }

  /// The box around all particles and nodes at the start.
  void find_scene() {
    scene_ = {Vec::Constant(std::numeric_limits<Real>::infinity()),
              Vec::Constant(-std::numeric_limits<Real>::infinity())};
    const auto take = [&](const Field<Real>& x, Index n) {
      for (Index i = 0; i < n; ++i)
        scene_.low = scene_.low.cwiseMin(x.vec(i)), scene_.high = scene_.high.cwiseMax(x.vec(i));
    };
    take(world_.particles.x, world_.particles.size());
    take(world_.nodes.x, world_.nodes.size());
    if (world_.particles.size() > 0)
      margin_ = maximum(world_.particles.size(), [&](Index i) { return world_.particles.h[i]; });
  }
  bool is_inside(const GaugeBox& box) const {
    for (int k = 0; k < world_.dim; ++k)
      if (box.high[k] < scene_.low[k] - margin_ || box.low[k] > scene_.high[k] + margin_) return false;
    return true;
  }

  template <class Card>
  GaugeLayout layout(const Card& card) {
    GaugeLayout out{.name = card.title.empty() ? std::to_string(card.gid) : card.title, .title = card.title};
    for (char& c : out.name)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') c = '_';
    if (out.name.front() == '.') out.name.front() = '_';
    if (!ids_.insert(card.gid).second)
      error(card, "GID", fmt::format("gauge {} is there already", card.gid),
            "give each gauge its own number");
    else if (!names_.insert(out.name).second)
      error(card, "GID", fmt::format("two gauges have the name '{}'", out.name),
            "its file and its datasets have it: give each gauge a title of its own");
    return out;
  }
  template <class Card>
  void error(const Card& card, const char* field, const std::string& what, const std::string& hint) {
    deck_.error(diagnostics_, card, field, what, hint);
  }
  template <class Card>
  void check_particles(const Card& card) {
    if (world_.particles.size() == 0)
      error(card, "GID", "the gauge measures particles, and the deck has none",
            "*COURANT_GAUGE_FORCE measures parts without particles");
  }
  template <class Card>
  void check_position(const Card& card, const char* field, const GaugeBox& box) {
    if (world_.particles.size() == 0 || is_inside(box)) return;
    deck_.warning(diagnostics_, card, field,
                  fmt::format("gauge {} is outside the scene: particles and nodes are at {:g} to {:g}, {:g} "
                              "to {:g}, {:g} to {:g}",
                              card.gid, scene_.low.x(), scene_.high.x(), scene_.low.y(), scene_.high.y(),
                              scene_.low.z(), scene_.high.z()),
                  "it is dry as long as no particle comes there");
  }

  void build_point(const PointGaugeCard& card) {
    GaugeLayout made = layout(card);
    check_particles(card);
    const Vec x = point(card.x, card.y, card.z);
    check_position(card, "X", {x, x});
    int body = -1;
    RigidBodyMotion start;
    if (card.pid != 0) {
      const auto motions = bodies_ ? bodies_->motions(Clock{}) : std::vector<RigidBodyMotion>();
      const auto at = std::find_if(motions.begin(), motions.end(),
                                   [&](const RigidBodyMotion& one) { return one.part == card.pid; });
      const auto part = model_.part_of_id.find(card.pid);
      const bool is_fixed =
          part != model_.part_of_id.end() && model_.parts[static_cast<std::size_t>(part->second)].rigid;
      if (at == motions.end() && part == model_.part_of_id.end())
        return error(card, "PID", fmt::format("part {} does not exist", card.pid), "define it with *PART");
      if (at == motions.end() && !is_fixed)
        return error(card, "PID", fmt::format("part {} is no rigid body", card.pid),
                     "a gauge moves with a part of *MAT_RIGID, or its number is 0");
      if (at != motions.end()) body = static_cast<int>(at - motions.begin()), start = *at;
    }
    gauges_.push_back(make_point_gauge(std::move(made), card.dt, x, body, start));
  }

  template <class Card, class Make>
  void build_line(const Card& card, const Make& make) {
    GaugeLayout made = layout(card);
    check_particles(card);
    const GaugeLine line{point(card.x1, card.y1, card.z1), point(card.x2, card.y2, card.z2)};
    if (!(line.length() > 0))
      return error(card, "X2", "the line of the gauge has no length",
                   "its end is another point than its start");
    check_position(card, "X1", {line.begin.cwiseMin(line.end), line.begin.cwiseMax(line.end)});
    gauges_.push_back(make(std::move(made), line));
  }

  void build_flux(const FluxGaugeCard& card) {
    GaugeLayout made = layout(card);
    check_particles(card);
    const Vec first = point(card.x1, card.y1, card.z1), second = point(card.x2, card.y2, card.z2),
              third = point(card.x3, card.y3, card.z3);
    const Vec across = world_.dim == 2 ? Vec(Vec::UnitZ()) : Vec(third - first);
    constexpr Real least_sine = 1e-6;
    const Real area = (second - first).cross(across).norm();
    if (!(area > least_sine * (second - first).norm() * across.norm()))
      return error(card, world_.dim == 2 ? "X2" : "X3", "the area of the gauge is 0",
                   world_.dim == 2 ? "give two points" : "give three corners that are not on a line");
    Vec low = first.cwiseMin(second), high = first.cwiseMax(second);
    if (world_.dim == 3) low = low.cwiseMin(third), high = high.cwiseMax(third);
    check_position(card, "X1", {low, high});
    gauges_.push_back(make_flux_gauge(std::move(made), card.dt, world_.dim, first, second, third));
  }

  void build_force(const ForceGaugeCard& card) {
    GaugeLayout made = layout(card);
    const bool exists = card.stype == 0   ? model_.segment_sets.contains(card.sid)
                        : card.stype == 2 ? model_.part_sets.contains(card.sid)
                                          : model_.part_of_id.contains(card.sid);
    if (!exists)
      return error(card, "SID",
                   fmt::format("{} {} does not exist",
                               card.stype == 0   ? "segment set"
                               : card.stype == 2 ? "part set"
                                                 : "part",
                               card.sid),
                   "define it, or look at STYPE: 0 segment set, 2 part set, 3 part");
    std::vector<char> faces = faces_of(card);
    if (std::none_of(faces.begin(), faces.end(), [](char one) { return one != 0; }))
      return error(card, "SID", "there are no faces here that anything can touch",
                   "the parts have shells or solids that a contact or *COURANT_WALL_SUPPORT names");
    if (world_.passes.all<PointForceReporter>().empty())
      deck_.warning(diagnostics_, card, "SID", fmt::format("nothing acts on the faces of gauge {}", card.gid),
                    "contact and *COURANT_WALL_SUPPORT do");
    gauges_.push_back(
        make_force_gauge(std::move(made), card.dt, std::move(faces), point(card.x, card.y, card.z), world_));
  }

  std::vector<char> faces_of(const ForceGaugeCard& card) const {
    const Segments& segments = world_.segments;
    std::vector<char> out(static_cast<std::size_t>(segments.size()), 0);
    if (card.stype == 0) return faces_of_segments(card.sid);
    std::set<Index> parts;
    if (card.stype == 3) {
      if (const auto at = model_.part_of_id.find(card.sid); at != model_.part_of_id.end())
        parts.insert(at->second);
    } else if (const auto at = model_.part_sets.find(card.sid); at != model_.part_sets.end()) {
      parts.insert(at->second.begin(), at->second.end());
    }
    for (Index s = 0; s < segments.size(); ++s)
      out[static_cast<std::size_t>(s)] = parts.contains(segments.part[s]) ? 1 : 0;
    return out;
  }

  /// Faces whose corners are those of a segment of the set, in any order.
  std::vector<char> faces_of_segments(Id sid) const {
    const Segments& segments = world_.segments;
    std::vector<char> out(static_cast<std::size_t>(segments.size()), 0);
    const auto at = model_.segment_sets.find(sid);
    if (at == model_.segment_sets.end()) return out;
    std::set<std::set<Id>> wanted;
    for (const Index k : at->second) {
      std::set<Id> corners;
      for (const Index n : model_.segments[static_cast<std::size_t>(k)].node)
        corners.insert(model_.nodes[static_cast<std::size_t>(n)].id);
      wanted.insert(std::move(corners));
    }
    for (Index s = 0; s < segments.size(); ++s) {
      std::set<Id> corners;
      for (const Index n : segments.nodes(s)) corners.insert(world_.nodes.id[n]);
      out[static_cast<std::size_t>(s)] = wanted.contains(corners) ? 1 : 0;
    }
    return out;
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  const RigidBodies* bodies_;
  GaugeBox scene_;
  Real margin_ = 0;
  std::set<Id> ids_;
  std::set<std::string> names_;
  std::vector<std::unique_ptr<Gauge>> gauges_;
};

void build_gauges(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                  const SphSettings& settings, const std::shared_ptr<RigidBodies>& bodies,
                  const std::shared_ptr<Neighbours>& neighbours) {
  if (deck.all<PointGaugeCard>().empty() && deck.all<LevelGaugeCard>().empty() &&
      deck.all<RunupGaugeCard>().empty() && deck.all<FluxGaugeCard>().empty() &&
      deck.all<ForceGaugeCard>().empty())
    return;
  auto gauges = GaugeBuilder(deck, model, world, diagnostics, bodies.get()).build();
  if (gauges.empty()) return;
  std::vector<GhostPlane> periodic;
  for (const GhostPlane& plane : settings.walls.planes)
    if (plane.kind == GhostPlane::Kind::periodic) periodic.push_back(plane);
  world.passes.add(std::make_shared<Gauges>(
      std::move(gauges), settings.kernel, acceleration_of_particles(model), neighbours, std::move(periodic)));
}

const RegisterBuilder gauges(BuildPhase::checks, "gauges", build_gauges);

}  // namespace

}  // namespace courant
