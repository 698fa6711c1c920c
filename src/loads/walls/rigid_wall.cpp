// Rigid walls: planes and bodies that particles and nodes do not enter.
#include "loads/walls/rigid_wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"
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

/// Perfectly plastic: a point that would be behind the wall at t + dt gets the force with which it is just
/// on it then, and so, a step later, has the velocity of the wall. A wall with a mass takes up the momentum
/// along its normal, so that with all points that it holds it goes on as one body: its speed w after the step
/// solves M (w - w_before) + sum m max(0, w - u) = 0, u the speed at which a point alone would come to the
/// plane, by Newton's method, which ends for such a sum of straight pieces. Friction: at most FRIC times the
/// normal force, and what stops the sliding. SPC hold some axes of a point: there the wall cannot push. A
/// body is taken for the plane through the position of its surface that is nearest to the point.
class RigidWall : public EnergyTerm, public RigidWallReporter, public Restartable {
 public:
  /// Of each set, the points that any wall may touch in a step.
  using Near = std::vector<std::vector<Index>>;

  explicit RigidWall(RigidWallAndPoints all)
      : wall_(std::move(all.wall)),
        sets_(std::move(all.sets)),
        bodies_(std::move(all.bodies)),
        speed_(wall_.speed),
        next_(wall_.speed) {}
  std::string name() const override { return fmt::format("rigid wall {}", wall_.id); }
  std::span<const HeldPoints> sets() const { return sets_; }

  /// Chooses its motion over the coming step; returns its speed.
  Real prepare(const World& world, const Clock& clock) {
    if (const auto [n1, n2] = wall_.ortho_nodes; wall_.ortho && n1 >= 0)
      wall_.ortho->d = world.nodes.x.vec(n2) - world.nodes.x.vec(n1);
    if (wall_.motion)
      drive_ = wall_.motion->velocity(clock.t, clock.dt, clock.dt_old, 0) * wall_.motion->direction;
    return std::abs(speed_) + drive_.norm();
  }

  /// Before a step: it has pushed nothing yet.
  void start(std::shared_ptr<const Near> near) {
    force_.setZero(), normal_ = 0, next_ = speed_, near_ = std::move(near);
    for (HeldPoints& set : sets_) {
      set.axes = shared_fields::held_axes.find(*set.points.set);
      set.driven.emplace(set.points);
    }
  }
  void clear(std::size_t set, Index begin, Index end) {
    for (int k = 0; k < 3; ++k)
      std::fill(sets_[set].push.data(k) + begin, sets_[set].push.data(k) + end, 0.0);
  }
  /// Whether a point that may go some way in a step may touch it. [L]
  bool is_near(std::size_t set, Index i, Real way) const {
    const HeldPoints& held = sets_[set];
    return held.state[i] == 2 || (held.state[i] != 0 && nearest(held.points.x->vec(i)).gap <= way);
  }

  const WallPenalty& bodies() const { return bodies_; }
  /// Once in a step, before points.
  void push_bodies(const World& world, const Clock& clock) {
    if (bodies_.empty()) return;
    if (!acts(clock)) {
      released_ = bodies_.release();
      return;
    }
    WallPenalty::Wall now{.shape = &wall_.shape,
                          .moved = moved_ + way_ * wall_.shape.n(),
                          .v = drive_ + speed_ * wall_.shape.n()};
    if (wall_.friction > 0 || wall_.ortho)
      now.friction = [this, dim = world.dim](const Vec& n, const Vec& slip, Real push, Real m, Real dt) {
        return friction(n, slip, push, m, dt, dim == 2);
      };
    bodies_.push(world, clock, now);
    force_ = bodies_.force(), normal_ = bodies_.normal();
  }

  /// Finds the forces again, whatever other walls have done to the points since; returns the sum of what has
  /// changed. [ML/T2]
  Real push(const World& world, const Clock& clock) {
    if (!acts(clock)) return 0;
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
            return Sums{a.force + b.force, a.normal + b.normal, a.change + b.change};
          });
    force_ = bodies_.force() - all.force, normal_ = bodies_.normal() + all.normal;
    return all.change;
  }

  /// What the forces take from the points and do not give to the wall.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Real dt = clock.dt_mean();
    const Real work = 0 - force_.dot(drive_) * dt;  // of what moves the wall
    Real lost = work - 0.5 * wall_.mass * (next_ * next_ - speed_ * speed_);
    if (!bodies_.empty()) {  // whose springs keep what they take
      const Vec v = drive_ + 0.5 * (speed_ + next_) * wall_.shape.n();
      lost += bodies_.force().dot(v) * dt + bodies_.friction_loss(world, clock, v) + released_;
      released_ = 0;
    }
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const MiddleVelocity v(sets_[s].points, clock);
      lost -= sum(static_cast<Index>((*near_)[s].size()), [&](Index k) {
        const Index i = point(s, k);
        return sets_[s].push.vec(i).dot(v(i)) * dt;
      });
    }
    lost_ += lost, impulse_ += force_ * dt;
    ledger.dissipated += lost, ledger.throughput += std::abs(lost);
    ledger.external_work += work, ledger.throughput += std::abs(work);
    speed_ = next_, way_ += speed_ * clock.dt, moved_ += drive_ * clock.dt;
  }
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    ledger.kinetic += 0.5 * wall_.mass * speed_ * speed_;
    ledger.contact += bodies_.stored();
  }

  RigidWallForce report_wall() const override {
    return {.id = wall_.id,
            .title = wall_.title,
            .normal = normal_,
            .force = force_,
            .impulse = impulse_,
            .v = speed_ * wall_.shape.n() + drive_,
            .displacement = way_ * wall_.shape.n() + moved_,
            .dissipated = lost_};
  }
  void keep(Archive& archive) override {
    archive("speed", speed_), archive("way", way_), archive("impulse", impulse_), archive("lost", lost_);
    archive("moved", moved_);
    archive("force", force_);  // sensors look before walls strike
    bodies_.keep(archive);
  }

 private:
  bool acts(const Clock& clock) const { return clock.t >= wall_.birth && clock.t < wall_.death; }
  Index point(std::size_t set, Index k) const { return (*near_)[set][static_cast<std::size_t>(k)]; }
  WallShape::Near nearest(const Vec& x) const {
    WallShape::Near near = wall_.shape.nearest(x - moved_);
    near.gap -= way_;
    return near;
  }

  /// What a point would do without this wall in this step.
  struct Approach {
    bool held = false;      ///< the wall may act on it
    bool welded = false;    ///< and pull, too
    bool confined = false;  ///< some axis is held
    Vec v, n;               ///< velocity after the step [L/T]; normal where it comes to the wall
    Vec along;              ///< of the normal what is free to move
    Real inertia = 0;       ///< of a force along the normal [M]
    Real u = 0;             ///< speed at which it just comes to the plane [L/T]
  };
  Approach approach(const HeldPoints& set, const Clock& clock, int dim, Index i) const {
    Approach a;
    const Index state = set.state[i];
    if (state == 0) return a;
    const Vec x = set.points.x->vec(i), others = set.points.f->vec(i) - set.push.vec(i);
    const WallShape::Near near = nearest(x);
    a.n = a.along = near.n;
    constexpr Real along_wall = 1e-9;  // cosine
    if (set.driven->any(i) && set.driven->along(i, near.n).norm() > along_wall) return a;
    for (int k = 0; k < 3; ++k)
      if ((set.axes && (*set.axes)[i] & (1 << k)) || k >= dim) a.along[k] = 0, a.confined = true;
    constexpr Real free_enough = 1e-12;
    const Real share = a.along.squaredNorm(), m = (*set.points.m)[i];
    if (share < free_enough) return a;
    a.v = set.driven->velocity_after(i, set.points.v->vec(i), others * (clock.dt_mean() / m), 1);
    a.welded = state == 2;
    a.held = a.welded || wall_.shape.meets(x + (a.v - drive_) * clock.dt - moved_, near.gap);
    a.inertia = m / share;
    a.u = a.v.dot(a.n) + std::max(near.gap, Real(0)) / clock.dt;  // behind it: no deeper, but not back
    return a;
  }
  /// Of the wall after the step, along the normal at a point.
  Real speed_at(const Approach& a) const { return next_ + drive_.dot(a.n); }

  /// The wall's speed after the step.
  Real common_speed(const World& world, const Clock& clock) const {
    if (wall_.mass == 0) return speed_;
    using Body = std::pair<Real, Real>;  // mass, momentum of what goes on with it
    const auto add = [](Body a, Body b) { return Body(a.first + b.first, a.second + b.second); };
    Real w = speed_;
    for (int round = 0; round < most_rounds; ++round) {
      const Real by_bodies = bodies_.force().dot(wall_.shape.n()) * clock.dt_mean();
      Body all{wall_.mass, wall_.mass * speed_ + by_bodies};
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
    Real normal = 0, change = 0;
  };
  void push(HeldPoints& set, const Clock& clock, int dim, Index i, Sums& out) const {
    if (set.state[i] == 0) return;
    const Approach a = approach(set, clock, dim, i);
    Vec force = Vec::Zero();
    const Real w = a.held ? speed_at(a) : 0;
    if (a.held && (a.welded || a.u < w)) {
      force = force_on(a, w, (*set.points.m)[i], clock.dt_mean());
      if (wall_.welds && w - a.v.dot(a.n) > wall_.weld_speed) set.state[i] = 2;
      out.normal += a.inertia * (w - a.u) / clock.dt_mean();
    }
    const Vec change = force - set.push.vec(i);
    set.push.set(i, force), set.points.f->add(i, change);
    out.force += force, out.change += change.norm();
    // the wall pushes along its normal; what supports take of that does not move the point
    if (!force.isZero(0)) out.force += a.inertia * (w - a.u) / clock.dt_mean() * (a.n - a.along);
  }
  Vec force_on(const Approach& a, Real w, Real m, Real dt) const {
    const Real normal = a.inertia * (w - a.u) / dt;
    Vec force = normal * a.along;
    if (wall_.friction == 0 && !wall_.ortho) return force;
    Vec slip = a.v + force * (dt / m) - drive_;
    slip -= slip.dot(a.along) / a.along.squaredNorm() * a.along;
    return force + friction(a.n, slip, std::abs(normal), m, dt, a.confined);
  }
  /// On a mass m that would slide so; it stops it at most.
  Vec friction(const Vec& n, const Vec& slip, Real normal, Real m, Real dt, bool confined) const {
    if (wall_.ortho) return wall_.ortho->force(n, slip, normal, m, dt, confined);
    const Real speed = slip.norm(), stops = m * speed / dt;
    if (!(speed > 0)) return Vec::Zero();
    return -std::min(wall_.friction * normal, stops) / speed * slip;
  }

  static constexpr int most_rounds = 100;  ///< of Newton's method: mostly two or three
  RigidWallSetup wall_;
  std::vector<HeldPoints> sets_;
  WallPenalty bodies_;
  std::shared_ptr<const Near> near_;
  Real speed_, next_;                                ///< along the normal now, and after the step [L/T]
  Real way_ = 0, lost_ = 0;                          ///< so far [L], [ML2/T2]
  Real released_ = 0;                                ///< by springs to bodies when the wall ended [ML2/T2]
  Real normal_ = 0;                                  ///< of the force on the wall, all along the normals
  Vec force_ = Vec::Zero(), impulse_ = Vec::Zero();  ///< on the wall
  Vec drive_ = Vec::Zero(), moved_ = Vec::Zero();    ///< prescribed: over the step [L/T], so far [L]
};

/// All walls: where a point touches several, each finds its forces again until they no longer change
/// (Gauss-Seidel).
class RigidWalls : public Impact {
 public:
  explicit RigidWalls(std::vector<std::shared_ptr<RigidWall>> walls) : walls_(std::move(walls)) {}
  std::string name() const override { return "rigid walls"; }
  void strike(World& world, const Clock& clock) override {
    const auto near = find_near(world, clock);
    for (const auto& wall : walls_) wall->start(near);
    for (const auto& wall : walls_) wall->push_bodies(world, clock);
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
  /// Nothing gets faster by being stopped: twice the path of a point and a wall is enough.
  std::shared_ptr<const RigidWall::Near> find_near(const World& world, const Clock& clock) const {
    Real fastest = 0;
    for (const auto& wall : walls_) fastest = std::max(fastest, wall->prepare(world, clock));
    const std::span<const HeldPoints> sets = walls_.front()->sets();
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

/// Of the springs between walls and bodies.
class WallSprings : public TimeLimit {
 public:
  explicit WallSprings(std::vector<std::shared_ptr<RigidWall>> walls) : walls_(std::move(walls)) {}
  std::string name() const override { return "rigid walls (penalty)"; }
  Limit limit(const World&, const Clock&) override {
    Limit out{std::numeric_limits<Real>::infinity(), name()};
    for (const auto& wall : walls_)
      if (wall->bodies().longest_step() < out.dt) out = {wall->bodies().longest_step(), wall->name()};
    return out;
  }

 private:
  std::vector<std::shared_ptr<RigidWall>> walls_;
};

}  // namespace

void add_wall_passes(std::vector<RigidWallAndPoints> all, World& world) {
  std::vector<std::shared_ptr<RigidWall>> walls;
  const bool springs =
      std::any_of(all.begin(), all.end(), [](const auto& one) { return !one.bodies.empty(); });
  for (RigidWallAndPoints& one : all)
    world.passes.add(walls.emplace_back(std::make_shared<RigidWall>(std::move(one))));
  if (springs) world.passes.add(std::make_shared<WallSprings>(walls));
  if (!walls.empty()) world.passes.add(std::make_shared<RigidWalls>(std::move(walls)));
}

}  // namespace courant
