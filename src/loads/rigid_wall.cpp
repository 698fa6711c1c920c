// *RIGIDWALL_PLANAR: planes that particles and nodes do not pass.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "loads/loads.hpp"
#include "loads/rigid_wall_card.hpp"
#include "parallel/parallel.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// reduce(), which wakes no threads for a few points: a step may ask for it many times.
template <class T, class Body, class Combine>
T add_up(Index n, T start, const Body& body, const Combine& combine) {
  constexpr Index few = 4096;
  if (n > few) return reduce(n, start, body, combine);
  for (Index begin = 0; begin < n; begin += block_size)
    start = combine(start, body(begin, std::min(n, begin + block_size)));
  return start;
}

/// A plane: what it is made of, and where it is.
struct Plane {
  Id id = 0;
  std::string title;
  Vec tail = Vec::Zero(), n = Vec::UnitX();  ///< normal, of length 1
  Vec l = Vec::Zero(), m = Vec::Zero();      ///< edges of a finite one, of length 1
  Real length_l = 0, length_m = 0;           ///< 0: without an end [L]
  Real birth = 0, death = 1e20, mass = 0;    ///< mass 0: it does not give way
  Real friction = 0, weld_speed = 0;         ///< friction: infinite where nothing slides
  bool welds = false;
  bool ends() const { return length_l > 0 || length_m > 0; }
};

/// Perfectly plastic: a point that would be beyond the plane at t + dt gets the force with which it is just
/// on it then, and so, a step later, has the velocity of the wall. A wall with a mass takes up the momentum
/// along its normal, so that with all points that it holds it goes on as one body: its speed w after the step
/// solves M (w - w_before) + sum m max(0, w - u) = 0, u the speed at which a point alone would come to the
/// plane, by Newton's method, which ends for such a sum of straight pieces. Friction: at most FRIC times the
/// normal force, and what stops the sliding. SPC hold some axes of a point: there the wall cannot push.
class RigidWall : public EnergyTerm, public RigidWallReporter, public Restartable {
 public:
  /// A set of points, and which of them it holds.
  struct Held {
    Points points;
    Field<Index>& state;  ///< 0 not held, 1 held, 2 welded
    Field<Real>& push;    ///< force of the wall in this step [ML/T2]
    const Field<Index>*axes = nullptr, *driven = nullptr;
  };
  /// Of each set, the points that any wall may touch in a step.
  using Near = std::vector<std::vector<Index>>;

  RigidWall(Plane plane, Real speed, std::vector<Held> sets)
      : plane_(std::move(plane)), sets_(std::move(sets)), speed_(speed), next_(speed) {}
  std::string name() const override { return fmt::format("rigid wall {}", plane_.id); }
  Real speed() const { return speed_; }
  std::span<const Held> sets() const { return sets_; }

  /// Before a step: it has pushed nothing yet.
  void start(std::shared_ptr<const Near> near) {
    force_.setZero(), next_ = speed_, near_ = std::move(near);
    for (Held& set : sets_) {
      set.axes = shared_fields::held_axes.find(*set.points.set);
      set.driven = shared_fields::prescribed_motion.find(*set.points.set);
    }
  }
  void clear(std::size_t set, Index begin, Index end) {
    for (int k = 0; k < 3; ++k)
      std::fill(sets_[set].push.data(k) + begin, sets_[set].push.data(k) + end, 0.0);
  }
  /// Whether a point that may go some way in a step may touch it. [L]
  bool is_near(std::size_t set, Index i, Real way) const {
    const Held& held = sets_[set];
    return held.state[i] == 2 || (held.state[i] != 0 && gap(held.points.x->vec(i)) <= way);
  }

  /// Finds the forces anew, whatever other walls have done to the points since; returns the sum of what has
  /// changed. [ML/T2]
  Real push(const World& world, const Clock& clock) {
    if (clock.t < plane_.birth || clock.t >= plane_.death) return 0;
    next_ = common_speed(world, clock);
    Sums all;
    for (std::size_t s = 0; s < sets_.size(); ++s)
      all = add_up(
          static_cast<Index>((*near_)[s].size()), all,
          [&](Index begin, Index end) {
            Sums some;
            for (Index k = begin; k < end; ++k) push(sets_[s], clock, world.dim, point(s, k), some);
            return some;
          },
          [](const Sums& a, const Sums& b) {
            return Sums{a.force + b.force, a.change + b.change};
          });
    force_ = Vec::Zero() - all.force;
    return all.change;
  }

  /// What the forces take from the points and do not give to the wall.
  void record(World&, const Clock& clock, EnergyLedger& ledger) override {
    const Real dt = clock.dt_mean();
    Real lost = -0.5 * plane_.mass * (next_ * next_ - speed_ * speed_);
    for (std::size_t s = 0; s < sets_.size(); ++s)
      lost -= sum(static_cast<Index>((*near_)[s].size()), [&](Index k) {
        const Index i = point(s, k);
        const Points& p = sets_[s].points;
        const Vec v = p.v->vec(i) + p.f->vec(i) * (0.5 * dt / (*p.m)[i]);
        return sets_[s].push.vec(i).dot(v) * dt;
      });
    lost_ += lost, impulse_ += force_ * dt;
    ledger.dissipated += lost, ledger.throughput += std::abs(lost);
    speed_ = next_, way_ += speed_ * clock.dt;
  }
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    ledger.kinetic += 0.5 * plane_.mass * speed_ * speed_;
  }

  RigidWallForce report_wall() const override {
    return {.id = plane_.id,
            .title = plane_.title,
            .normal = 0 - force_.dot(plane_.n),
            .force = force_,
            .impulse = impulse_,
            .v = speed_ * plane_.n,
            .displacement = way_ * plane_.n,
            .dissipated = lost_};
  }
  void keep(Archive& archive) override {
    archive("speed", speed_), archive("way", way_), archive("impulse", impulse_), archive("lost", lost_);
  }

 private:
  Index point(std::size_t set, Index k) const { return (*near_)[set][static_cast<std::size_t>(k)]; }
  Real gap(const Vec& x) const { return (x - plane_.tail).dot(plane_.n) - way_; }

  /// What a point would do without this wall in this step.
  struct Approach {
    bool held = false;    ///< the wall may act on it
    bool welded = false;  ///< and pull, too
    Vec v, along;         ///< velocity after the step [L/T]; direction of the normal that is free to move
    Real inertia = 0;     ///< of a force along the normal [M]
    Real u = 0;           ///< speed at which it just comes to the plane [L/T]
  };
  Approach approach(const Held& set, const Clock& clock, int dim, Index i) const {
    Approach a;
    const Index state = set.state[i];
    if (state == 0 || (set.driven && (*set.driven)[i] != 0)) return a;
    a.along = plane_.n;
    for (int k = 0; k < 3; ++k)
      if ((set.axes && (*set.axes)[i] & (1 << k)) || k >= dim) a.along[k] = 0;
    constexpr Real free_enough = 1e-12;
    const Real share = a.along.squaredNorm(), m = (*set.points.m)[i];
    if (share < free_enough) return a;
    const Vec x = set.points.x->vec(i), others = set.points.f->vec(i) - set.push.vec(i);
    a.v = set.points.v->vec(i) + others * (clock.dt_mean() / m);
    const Real distance = gap(x);
    a.welded = state == 2;
    a.held = a.welded || meets(x + a.v * clock.dt, distance);
    a.inertia = m / share;
    a.u = a.v.dot(plane_.n) + std::max(distance, Real(0)) / clock.dt;  // behind it: no deeper, but not back
    return a;
  }
  bool meets(const Vec& x, Real gap) const {
    if (!plane_.ends()) return true;
    constexpr Real behind = 1e-6;  // what came there beside the wall
    if (gap < -behind * std::max(plane_.length_l, plane_.length_m)) return false;
    const auto within = [](Real s, Real length) { return length == 0 || (s >= 0 && s <= length); };
    const Vec r = x - plane_.tail;
    return within(r.dot(plane_.l), plane_.length_l) && within(r.dot(plane_.m), plane_.length_m);
  }

  /// The wall's speed after the step.
  Real common_speed(const World& world, const Clock& clock) const {
    if (plane_.mass == 0) return speed_;
    using Body = std::pair<Real, Real>;  // mass, momentum of what goes on with it
    const auto add = [](Body a, Body b) { return Body(a.first + b.first, a.second + b.second); };
    Real w = speed_;
    for (int round = 0; round < most_rounds; ++round) {
      Body all{plane_.mass, plane_.mass * speed_};
      for (std::size_t s = 0; s < sets_.size(); ++s)
        all = add_up(
            static_cast<Index>((*near_)[s].size()), all,
            [&](Index begin, Index end) {
              Body some{};
              for (Index k = begin; k < end; ++k)
                if (const Approach a = approach(sets_[s], clock, world.dim, point(s, k));
                    a.held && (a.welded || a.u < w))
                  some.first += a.inertia, some.second += a.inertia * a.u;
              return some;
            },
            add);
      const Real better = all.second / all.first;
      if (better == w) break;
      w = better;
    }
    return w;
  }

  struct Sums {
    Vec force = Vec::Zero();
    Real change = 0;
  };
  void push(Held& set, const Clock& clock, int dim, Index i, Sums& out) const {
    if (set.state[i] == 0) return;
    const Approach a = approach(set, clock, dim, i);
    Vec force = Vec::Zero();
    if (a.held && (a.welded || a.u < next_)) {
      force = force_on(a, next_, (*set.points.m)[i], clock.dt_mean());
      if (plane_.welds && next_ - a.v.dot(plane_.n) > plane_.weld_speed) set.state[i] = 2;
    }
    const Vec change = force - set.push.vec(i);
    set.push.set(i, force), set.points.f->add(i, change);
    out.force += force, out.change += change.norm();
    // the wall pushes along its normal; what supports take of that does not move the point
    if (!force.isZero(0)) out.force += a.inertia * (next_ - a.u) / clock.dt_mean() * (plane_.n - a.along);
  }
  Vec force_on(const Approach& a, Real w, Real m, Real dt) const {
    const Real normal = a.inertia * (w - a.u) / dt;
    Vec force = normal * a.along;
    if (plane_.friction == 0) return force;
    Vec slip = a.v + force * (dt / m);
    slip -= slip.dot(a.along) / a.along.squaredNorm() * a.along;
    const Real speed = slip.norm(), stops = m * speed / dt;
    if (speed > 0) force -= std::min(plane_.friction * std::abs(normal), stops) / speed * slip;
    return force;
  }

  static constexpr int most_rounds = 100;  ///< of Newton's method: mostly two or three
  Plane plane_;
  std::vector<Held> sets_;
  std::shared_ptr<const Near> near_;
  Real speed_, next_;                                ///< along the normal now, and after the step [L/T]
  Real way_ = 0, lost_ = 0;                          ///< so far [L], [ML2/T2]
  Vec force_ = Vec::Zero(), impulse_ = Vec::Zero();  ///< on the wall
};

/// All walls: where a point touches several, each finds its forces anew until they no longer change
/// (Gauss-Seidel).
class RigidWalls : public Impact {
 public:
  explicit RigidWalls(std::vector<std::shared_ptr<RigidWall>> walls) : walls_(std::move(walls)) {}
  std::string name() const override { return "rigid walls"; }
  void strike(World& world, const Clock& clock) override {
    const auto near = find_near(world, clock);
    for (const auto& wall : walls_) wall->start(near);
    constexpr int most_sweeps = 100;
    constexpr Real settled = 1e-13;
    Real first = 0;
    for (int k = 0; k < most_sweeps; ++k) {
      Real change = 0;
      for (const auto& wall : walls_) change += wall->push(world, clock);
      if (k == 0) first = change;
      if (walls_.size() == 1 || !(change > settled * first)) return;
    }
  }

 private:
  /// Nothing gets faster by being stopped: twice the way of a point and a wall is enough.
  std::shared_ptr<const RigidWall::Near> find_near(const World& world, const Clock& clock) const {
    Real fastest = 0;
    for (const auto& wall : walls_) fastest = std::max(fastest, std::abs(wall->speed()));
    const std::span<const RigidWall::Held> sets = walls_.front()->sets();
    auto near = std::make_shared<RigidWall::Near>(sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const Points& p = sets[s].points;
      collect(loaded_points(p, world), (*near)[s], [&](Index begin, Index end, std::vector<Index>& out) {
        for (const auto& wall : walls_) wall->clear(s, begin, end);
        for (Index i = begin; i < end; ++i) {
          const Vec v = p.v->vec(i) + p.f->vec(i) * (clock.dt_mean() / (*p.m)[i]);
          const Real way = 2 * clock.dt * (v.norm() + fastest);
          if (std::any_of(walls_.begin(), walls_.end(),
                          [&](const auto& wall) { return wall->is_near(s, i, way); }))
            out.push_back(i);
        }
      });
    }
    return near;
  }

  std::vector<std::shared_ptr<RigidWall>> walls_;
};

class RigidWallReader {
 public:
  RigidWallReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (const RigidWallPlanar& card : deck.all<RigidWallPlanar>()) taken_.insert(card.id);
  }

  void add(const RigidWallPlanar& card) {
    ++number_;
    Plane plane{.id = card.id > 0 ? card.id : free_id(), .title = card.title, .tail = card.tail()};
    if (!read_plane(card, plane) || !read_friction(card, plane) || !read_nodes(card)) return;
    std::vector<RigidWall::Held> sets;
    Count count;
    for (const Points& points : {points_of(world_.particles), points_of(world_.nodes)}) {
      auto& state = points.set->add<Index>({.name = fmt::format("rigid_wall_{}", number_), .dimension = "-"});
      auto& push = points.set->add<Real>({.name = fmt::format("rigid_wall_{}_push", number_),
                                          .dimension = "ML/T2",
                                          .components = 3,
                                          .restart = false});
      choose(card, plane, points, state, count);
      sets.push_back({points, state, push});
    }
    warn(card, count);
    if (diagnostics_.ok())
      walls_.push_back(std::make_shared<RigidWall>(std::move(plane), card.moving() ? card.v0 : 0, sets));
  }
  /// Adds the passes; false: there is no wall.
  bool finish() {
    if (walls_.empty()) return false;
    for (const auto& wall : walls_) world_.passes.add(wall);
    world_.passes.add(std::make_shared<RigidWalls>(std::move(walls_)));
    return true;
  }

 private:
  struct Count {
    Index held = 0, behind = 0, driven = 0, rigid = 0;
    Real deepest = 0;
    Id driven_id = 0, rigid_id = 0;
  };

  /// Its number in the deck, unless another wall has that as its id.
  Id free_id() {
    Id id = number_;
    while (!taken_.insert(id).second) ++id;
    return id;
  }

  bool error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  bool read_plane(const RigidWallPlanar& card, Plane& plane) {
    const Vec normal = Vec(card.xh, card.yh, card.zh) - plane.tail;
    if (!(normal.norm() > 0))
      return error(card, "XH", "tail and head of the normal are the same point",
                   "give a head on the side of what the wall holds");
    plane.n = normal.normalized();
    if (world_.dim == 2 && plane.n[2] != 0)
      return error(card, "ZH", "in 2D nothing moves along z, as the normal of the wall would ask for",
                   "give head and tail the same z");
    plane.birth = card.birth, plane.death = card.death, plane.mass = card.mass;
    if (!card.finite()) return true;
    const Vec edge = Vec(card.xhev, card.yhev, card.zhev) - plane.tail;
    const Vec along = edge - edge.dot(plane.n) * plane.n;
    constexpr Real least_sine = 1e-6;
    if (!(along.norm() > least_sine * edge.norm()))
      return error(card, "XHEV", "the edge of the wall has no direction in its plane",
                   "give a head of the edge that is neither the tail nor on the normal");
    plane.l = along.normalized(), plane.m = plane.n.cross(plane.l);
    plane.length_l = card.lenl, plane.length_m = card.lenm;
    return true;
  }

  bool read_friction(const RigidWallPlanar& card, Plane& plane) {
    const bool welds = card.fric == 2 || card.fric == 3;
    if (!welds && card.fric > 1)
      return error(card, "FRIC",
                   fmt::format("expected a number from 0 to 1, or 2 or 3, got '{:g}'", card.fric),
                   "0 slides, up to 1 is Coulomb's coefficient, 1 does not slide, 2 and 3 weld");
    const bool sticks = card.fric == 1 || card.fric == 3;
    plane.friction = sticks ? std::numeric_limits<Real>::infinity() : welds ? 0 : card.fric;
    plane.welds = welds, plane.weld_speed = card.wvel;
    return true;
  }

  /// Which of the model's nodes the sets and the box of a card name.
  bool read_nodes(const RigidWallPlanar& card) {
    chosen_.assign(model_.nodes.size(), card.nsid == 0 ? 1 : 0);
    for (const auto& [field, id, chosen] :
         {std::tuple("NSID", card.nsid, char(1)), std::tuple("NSIDEX", card.nsidex, char(0))}) {
      if (id == 0) continue;
      const auto set = model_.node_sets.find(id);
      if (set == model_.node_sets.end())
        return error(card, field, fmt::format("node set {} does not exist", id), "define it with *SET_NODE");
      for (const Index n : set->second) chosen_[static_cast<std::size_t>(n)] = chosen;
    }
    if (card.boxid == 0) return true;
    const auto box = model_.boxes.find(card.boxid);
    if (box == model_.boxes.end())
      return error(card, "BOXID", fmt::format("box {} does not exist", card.boxid),
                   "define it with *DEFINE_BOX");
    for (std::size_t n = 0; n < chosen_.size(); ++n)
      chosen_[n] = chosen_[n] && box->second.contains(model_.nodes[n].x);
    return true;
  }

  void choose(const RigidWallPlanar& card, const Plane& plane, const Points& points, Field<Index>& state,
              Count& count) const {
    const std::vector<Index> node = model_nodes(model_, world_, points);
    const auto* driven = shared_fields::prescribed_motion.find(*points.set);
    const bool particles = points.set == &world_.particles.fields;
    for (Index i = 0; i < points.set->size(); ++i) {
      const Index n = node[static_cast<std::size_t>(i)];  // -1: not of the model, as particles of inlets
      state[i] = n >= 0 ? chosen_[static_cast<std::size_t>(n)] : card.nsid == 0 && card.boxid == 0;
      const Real gap = (points.x->vec(i) - plane.tail).dot(plane.n);
      if (card.offset > 0 && std::abs(gap) > card.offset) state[i] = 0;
      if (state[i] == 0) continue;
      if (!particles && world_.nodes.follow[i]) {
        state[i] = 0;
        if (!world_.nodes.held[i] && count.rigid++ == 0) count.rigid_id = world_.nodes.id[i];
      } else if (driven && (*driven)[i] != 0) {
        if (count.driven++ == 0) count.driven_id = (*points.id)[i];
      } else {
        ++count.held;
        constexpr Real round_off = 1e-9;
        if (gap < -round_off * (points.x->vec(i).norm() + plane.tail.norm()))
          ++count.behind, count.deepest = std::max(count.deepest, -gap);
      }
    }
  }

  void warn(const RigidWallPlanar& card, const Count& count) {
    if (count.rigid > 0 && card.nsid != 0)
      error(card, "NSID",
            fmt::format("node {} belongs to a rigid body, which rigid walls do not hold", count.rigid_id),
            "leave it out, or use a held rigid plate as the wall, with *CONTACT");
    else if (count.rigid > 0)
      deck_.warning(diagnostics_, card, "NSID",
                    fmt::format("the wall does not hold rigid bodies that can move: {} of their nodes go "
                                "through it, as node {}",
                                count.rigid, count.rigid_id),
                    "leave them out by NSIDEX");
    if (count.driven > 0)
      deck_.warning(diagnostics_, card, "NSID",
                    fmt::format("the wall does not hold {} points whose motion is prescribed, as {}",
                                count.driven, count.driven_id),
                    "leave them out by NSIDEX");
    if (count.behind > 0)
      deck_.warning(
          diagnostics_, card, "",
          fmt::format("{} points start behind the wall, by up to {:.4g}: {}", count.behind, count.deepest,
                      card.finite() ? "they are free until they come out"
                                    : "they get no deeper, but are not pushed back"),
          "turn the normal round, or leave them out by NSID, NSIDEX, BOXID or OFFSET");
    if (count.held == 0)
      deck_.warning(diagnostics_, card, "", "the wall holds nothing", "name particles or nodes of solids");
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  Id number_ = 0;
  std::set<Id> taken_;
  std::vector<char> chosen_;  ///< of the model's nodes
  std::vector<std::shared_ptr<RigidWall>> walls_;
};

}  // namespace

bool add_rigid_walls(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  RigidWallReader reader(deck, model, world, diagnostics);
  for (const RigidWallPlanar& card : deck.all<RigidWallPlanar>()) reader.add(card);
  return diagnostics.ok() && reader.finish();
}

}  // namespace courant
