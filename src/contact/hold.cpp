// What a penalty cannot hold: particles so fast, or under such a pressure, that they would be through the
// wall within the step. The step is shortened until each is seen in front of the wall, and there the wall
// takes the velocity that would carry it on, as in a plastic impact. Slow scenes are not touched by it, to
// the last bit.
#include <cmath>

#include "contact/near.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

/// No particle comes nearer to a mid-surface, of the contact distance.
constexpr Real closest = 0.1;
/// Of a step over the last one, where particles touch walls.
constexpr Real growth = 1.2;

}  // namespace

// Nobody may come from out of reach to a wall within one step.
void Contact::look_further(const World& world) {
  const Particles& p = world.particles;
  const Real fastest = std::sqrt(maximum(p.active, [&](Index i) { return p.v.vec(i).squaredNorm(); }));
  const Real wanted = r_most_ + 1.1 * soft_dt_ * (fastest + wall_speed_) + options_.reach_margin;
  Real reach = 1.5 * r_most_ + options_.reach_margin;
  while (hold_ && reach < wanted) reach *= 1.5;  // in leaps, so that the grid is seldom made anew
  if (reach == reach_ && moving_.empty()) return;
  reach_ = reach;
  grid_.build(facets_, reach_);
}

// Between two looks at it, nobody gets further than half the contact distance towards a wall.
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

// The force along n that leaves the particle in front of the wall after the coming step, where that is as
// long as the last one. `force`: on the particle so far. Contact::limit sees to it that the step is not
// longer where particles are held, or would be if it grew as it may.
Contact::Holding Contact::holding(Index i, const Push& p, const Facet& f, const Vec& relative,
                                  const Vec& force, const World& world, Real dt) const {
  const Real r = contact_distance(i, walls_[p.facet]), m = world.particles.m[i];
  const Real room = std::max(r - p.depth - closest * r, Real(0));
  const Real v = relative.dot(p.n), a = force.dot(p.n) / m, longer = growth * dt;
  const Real too_fast = -room / dt - (v + a * dt);
  if (!(too_fast > 0)) return {0, -room / longer > v + a * longer};
  // a body is shared by all that touch it, or many light blows at once would throw it back
  const Real wall = f.body > 0 ? f.body / std::max(touching_, Index(1)) : f.m;
  return {too_fast / dt / (1 / m + 1 / wall), true};
}

// The step may grow by so much where particles touch walls, and not at all where one is held.
Real Contact::longest_step(Real dt_old) const {
  if (!hold_ || !(dt_old > 0) || touching_ == 0) return std::numeric_limits<Real>::infinity();
  return tight_ ? dt_old : growth * dt_old;
}

// Over the same walls once more: what one gives, the next one sees.
void Contact::hold(World& world, const Clock& clock, Block& b, Index i, const Pushes& pushes,
                   std::size_t first_touch, Vec& total) {
  if (!hold_ || !(clock.dt_old > 0)) return;
  std::size_t touch = first_touch;
  for (int j = 0; j < pushes.count; ++j) {
    const Push& p = pushes.at[j];
    if (!(p.share > 0)) continue;
    Touch& a = b.touches[touch++];
    const Facet& f = facets_[p.facet];
    const Vec relative = world.particles.v.vec(i) - wall_velocity(world, f, p.q);
    const Vec before = world.particles.f.vec(i) + total;
    const Holding holding_now = holding(i, p, f, relative, before, world, clock.dt_old);
    b.tight = b.tight || holding_now.tight;
    a.held = holding_now.force;
    if (!(a.held > 0)) continue;
    ++b.held;
    Vec more = a.held * a.n;
    if (dim_ == 2) more.z() = 0;
    total += more;
    if (f.moves) b.reactions.push_back({p.facet, -more, shape_functions(f, p.q)});
  }
}

// As in Contact::record.
void Contact::record_held(World& world, const Clock& clock, EnergyLedger& ledger) {
  if (held_now_ == 0) return;
  const Particles& p = world.particles;
  Real work = 0;
  for (const Block& b : blocks_) {
    if (b.held == 0) continue;
    for (const Touch& a : b.touches) {
      if (!(a.held > 0)) continue;
      const Vec v = p.v.vec(a.particle) + 0.5 * clock.dt_mean() / p.m[a.particle] * p.f.vec(a.particle) -
                    wall_velocity(world, facets_[a.facet], a.q);
      work -= a.held * a.n.dot(v) * clock.dt_mean();
    }
  }
  world.maxima["contact_held_energy"] += work;
  ledger.dissipated += work;
  ledger.throughput += std::abs(work);
}

}  // namespace courant
