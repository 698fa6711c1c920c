// What a penalty cannot hold: particles so fast, or under such a pressure, that they would be through the
// wall within the step. The step is shortened until each is seen in front of the wall, and there the wall
// takes the velocity that would carry it on, as in a plastic impact.
#include <algorithm>
#include <cmath>

#include "contact/near.hpp"
#include "parallel/parallel.hpp"
#include "state/driven_points.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// No particle comes nearer to a mid-surface, of the contact distance.
constexpr Real closest = 0.1;

}  // namespace

struct Contact::Supports {
  /// What is left of a force on nodes or particles that is known after their supports: none along what they
  /// hold, nor along the directions in which curves drive it.
  class FreeAxes {
   public:
    explicit FreeAxes(const FieldSet& fields)
        : held_(shared_fields::held_axes.find(fields)), driven_(fields) {}
    bool is_driven(Index i) const { return driven_.any(i); }
    Vec part_of(Vec force, Index i) const {
      force = driven_.across(i, force);
      for (int k = 0; held_ && k < 3; ++k)
        if ((*held_)[i] & (1 << k)) force[k] = 0;
      return force;
    }

   private:
    const Field<Index>* held_;
    DrivenPoints driven_;
  };
  FreeAxes particles, nodes;

  explicit Supports(const World& world) : particles(world.particles.fields), nodes(world.nodes.fields) {}
  /// The largest part of n^2 along which a corner of a facet can yield. [-]
  Real free_share(const Facet& f, const Vec& n) const {
    Real out = 0;
    for (int e = 0; e < node_count(f); ++e) out = std::max(out, nodes.part_of(n, f.node[e]).squaredNorm());
    return out;
  }
};

// Nobody may come from out of reach to a wall within one step: particles make no step longer than h, walls as
// they please.
void Contact::look_further(const World& world) {
  const Particles& p = world.particles;
  const Real fastest = std::sqrt(maximum(p.active, [&](Index i) { return p.v.vec(i).squaredNorm(); }));
  const Real h = maximum(p.active, [&](Index i) { return p.h[i]; });
  const Real wanted =
      r_most_ + 1.1 * (std::min(soft_dt_ * fastest, h) + soft_dt_ * wall_speed_) + options_.reach_margin;
  Real reach = 1.5 * r_most_ + options_.reach_margin;
  while (hold_ && reach < wanted) reach *= 1.5;  // in leaps, so that the grid is seldom made again
  if (reach == reach_ && moving_.empty()) return;
  reach_ = reach;
  grid_.build(facets_, reach_);
}

// Between two checks of it, no particle moves further than half the contact distance towards a wall.
void Contact::note_approach(const World& world, Block& b, const Slot& slot, Real dt) const {
  const Index i = slot.particle;
  const Vec x = world.particles.x.vec(i), v = world.particles.v.vec(i);
  for (Index c = slot.first; c < slot.last; ++c) {
    const Index k = b.candidate[c];
    const Wall& w = walls_[k];
    const Real d = plane_distance(w, x), side = d < 0 ? -1 : 1, r = contact_distance(i, w);
    const Vec relative = v - wall_velocity(world, facets_[k], x - d * w.n);
    const Real closing = -side * w.n.dot(relative), reach = r + 2 * dt * relative.norm();
    const Real longest = 0.5 * r / closing;
    if (closing <= 0 || dt <= longest || least_distance2(w, x) > reach * reach) continue;
    if (longest < b.approach_dt) b.approach_dt = longest, b.approaching = i;
  }
}

// Now that the step is known. Where no wall belongs to a body, particles are held each alone, by all threads;
// else one after the other and again, as what one gives a body the others see.
void Contact::strike(World& world, const Clock& clock) {
  held_now_ = 0;
  if (!hold_ || asleep_) return;
  const bool bodies =
      std::any_of(moving_.begin(), moving_.end(), [&](Index s) { return facets_[s].body >= 0; });
  const Supports supports(world);
  for_each_block(listed_, [&](Index begin, Index) {
    Block& b = blocks_[begin / block_size];
    for (Touch& a : b.touches) a.held = 0;
    if (bodies) return;
    for (Touch& a : b.touches) correct(world, clock, supports, a);
  });
  for (bool more = bodies; more && balance(world, clock, supports);) {
    more = false;
    for (Block& b : blocks_) more = join_struck(world, clock, b) || more;
  }
  for (const Block& b : blocks_)
    for (const Touch& a : b.touches) {
      if (!(a.held > 0)) continue;
      ++held_now_;
      const Facet& f = facets_[a.facet];
      if (!f.moves) continue;
      const auto share = shape_functions(f, a.q);
      for (int e = 0; e < node_count(f); ++e) {
        const Vec force = supports.nodes.part_of(-share[e] * a.held * in_plane(a.n), f.node[e]);
        if (const Index body = options_.bodies.body(f.node[e]); f.body < 0 && body >= 0)
          options_.bodies.push(body, world.nodes.x.vec(f.node[e]), force);
        else
          world.nodes.f.add(f.node[e], force);
      }
    }
  if (held_now_ > 0) world.counters["contact_held"] += held_now_;
}

// Whether any touch is held.
bool Contact::balance(World& world, const Clock& clock, const Supports& supports) {
  constexpr int most_sweeps = 200;
  constexpr Real enough = 1e-4;  // of the largest force
  Real largest = 0;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    Real changed = 0;
    largest = 0;
    for (Block& b : blocks_)
      for (Touch& a : b.touches) {
        changed = std::max(changed, std::abs(correct(world, clock, supports, a)));
        largest = std::max(largest, a.held);
      }
    if (changed <= enough * largest) break;
  }
  return largest > 0;
}

// A body that takes a blow may turn, within this very step, towards particles that it did not touch: they
// join. Whether any did.
bool Contact::join_struck(const World& world, const Clock& clock, Block& b) const {
  const Particles& p = world.particles;
  const Real dt = clock.dt, kick = clock.dt_mean();
  bool any = false;
  for (const Slot& slot : b.slots) {
    const Index i = slot.particle;
    const Vec x = p.x.vec(i), v = p.v.vec(i) + kick / p.m[i] * p.f.vec(i);
    for (Index c = slot.first; c < slot.last; ++c) {
      const Index k = b.candidate[c];
      const Facet& f = facets_[k];
      if (f.body < 0) continue;
      const Real d = plane_distance(f, x), r = contact_distance(i, walls_[k]);
      const bool over = is_over(f, x);
      const Vec q = over ? Vec(x - d * f.n) : nearest_on_rim(f, x);
      const Vec relative =
          in_plane(v - wall_velocity(world, f, q) - options_.bodies.change(f.body, q, clock));
      const Real gap = (x - q).norm(), side = d < 0 ? -1 : 1;
      if (gap <= f.tolerance || gap < r) continue;
      const Real end = gap_at_end(world, clock, i, f, side);
      const Vec n = (x - q) / gap;
      if (over ? end >= closest * r : end >= 0 || dt * relative.dot(n) >= closest * r - gap) continue;
      const auto same = [&](const Touch& a) { return a.particle == i && a.facet == k; };
      if (std::any_of(b.touches.begin(), b.touches.end(), same)) continue;
      b.touches.push_back({.particle = i, .facet = k, .share = 0, .depth = r - gap, .k = 0, .n = n, .q = q});
      if (drag_on_) b.drags.push_back({.damping = 0, .friction = Vec::Zero(), .other = Vec::Zero()});
      any = true;
    }
  }
  return any;
}

Vec Contact::in_plane(Vec v) const {
  if (dim_ == 2) v.z() = 0;
  return v;
}

// How far from the plane of a face of a body a particle is at the end of the coming step, on that side.
// The face turns on the way, so a particle that slides along it comes nearer by more than the velocities
// along n say. [L]
Real Contact::gap_at_end(const World& world, const Clock& clock, Index i, const Facet& f, Real side) const {
  const Particles& p = world.particles;
  Corners x{};
  Vec centre = Vec::Zero();
  for (int e = 0; e < f.corners; ++e) {
    const Vec v = at_corner(f, e, [&](Index n) { return world.nodes.v.vec(n); });
    x[e] = f.x[e] + clock.dt * (v + options_.bodies.change(f.body, f.x[e], clock));
    centre += x[e] / f.corners;
  }
  const Vec n =
      f.corners == 4 ? Vec((x[2] - x[0]).cross(x[3] - x[1])) : Vec((x[1] - x[0]).cross(x[2] - x[0]));
  const Vec y = p.x.vec(i) + clock.dt * (p.v.vec(i) + clock.dt_mean() / p.m[i] * p.f.vec(i));
  return side * in_plane(y - centre).dot(n) / n.norm();
}

// Makes the held force what the coming step needs of it, given all others; returns by how much it changed.
// What is driven, or held along an axis, is not moved there. [ML/T2]
Real Contact::correct(World& world, const Clock& clock, const Supports& supports, Touch& a) const {
  Particles& p = world.particles;
  const Index i = a.particle;
  const Facet& f = facets_[a.facet];
  const Real dt = clock.dt, kick = clock.dt_mean(), r = contact_distance(i, walls_[a.facet]), m = p.m[i];
  const Real room = std::max(r - a.depth - closest * r, Real(0));
  Real v = p.v.vec(i).dot(a.n) + kick / m * p.f.vec(i).dot(a.n);
  if (f.moves) v -= wall_velocity(world, f, a.q).dot(a.n);
  if (f.body < 0 && a.held == 0 && v * dt > -0.5 * room) return 0;  // far from it
  if (f.body >= 0) v -= options_.bodies.change(f.body, a.q, clock).dot(a.n);
  Real too_fast = -room / dt - v;
  if (f.body >= 0 && is_over(f, p.x.vec(i))) {
    const Real side = f.n.dot(a.n) < 0 ? -1 : 1;
    const Real least = std::min(closest * r, r - a.depth);  // deeper particles are not ejected
    too_fast = std::max(too_fast, (least - gap_at_end(world, clock, i, f, side)) / dt);
  }
  if (!(too_fast > 0) && a.held == 0) return 0;
  if (supports.particles.is_driven(i)) return 0;
  const Vec along = supports.particles.part_of(in_plane(a.n), i);
  const Real give = !f.moves      ? 0
                    : f.body >= 0 ? options_.bodies.give(f.body, a.q, a.n)
                                  : supports.free_share(f, a.n) / f.m;
  const Real mobility = along.squaredNorm() / m + give;
  if (!(mobility > 1e-6 / m)) return 0;
  const Real change = std::max(too_fast / kick / mobility, -a.held);
  a.held += change;
  p.f.add(i, change * along);
  if (f.body >= 0) options_.bodies.push(f.body, a.q, -change * in_plane(a.n));
  return change;
}

/// By how much the forces on its corners change the velocity of a facet at q within a time.
Vec Contact::wall_kick(const World& world, const Facet& f, const Vec& q, Real time) const {
  const auto N = shape_functions(f, q);
  Vec out = Vec::Zero();
  for (int e = 0; e < node_count(f); ++e)
    if (f.body >= 0 || options_.bodies.body(f.node[e]) < 0)
      out += N[e] * time / world.nodes.m[f.node[e]] * world.nodes.f.vec(f.node[e]);
  return out;
}

// Work on the mean velocities of particle and wall over the step, as in Contact::record.
void Contact::record_held(World& world, const Clock& clock, EnergyLedger& ledger) {
  if (held_now_ == 0) return;
  const Particles& p = world.particles;
  const Real dt = clock.dt_mean();
  Real work = 0;
  for (const Block& b : blocks_)
    for (const Touch& a : b.touches) {
      if (!(a.held > 0)) continue;
      const Facet& f = facets_[a.facet];
      Vec v = p.v.vec(a.particle) + 0.5 * dt / p.m[a.particle] * p.f.vec(a.particle) -
              wall_velocity(world, f, a.q);
      if (f.body >= 0) v -= 0.5 * options_.bodies.change(f.body, a.q, clock);
      if (f.moves && f.body < 0) v -= wall_kick(world, f, a.q, 0.5 * dt);
      work -= a.held * a.n.dot(v) * dt;
    }
  world.maxima["contact_held_energy"] += work;
  ledger.dissipated += work;
  ledger.throughput += std::abs(work);
}

}  // namespace courant
