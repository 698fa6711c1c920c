// One particle against the facets near it: where it is pushed, and the forces that follow.
#include <cmath>

#include "contact/near.hpp"

namespace courant {
namespace {

/// Depths below this fraction of the contact distance are round-off: a particle pushed out to r is out.
constexpr Real depth_tolerance = 1e-9;

}  // namespace

void Contact::touch(World& world, const Clock& clock, Index s) {
  slots_[s].count = 0;
  slots_[s].crossed = false;
  slots_[s].stored_friction = 0;
  Pushes pushes;
  find_pushes(world, clock, s, pushes);
  if (pushes.count > 0) forces_of(world, clock, s, pushes);
  if (friction_on_) keep_friction(world, s);
}

void Contact::find_pushes(World& world, const Clock& clock, Index s, Pushes& pushes) {
  const Index i = slots_[s].particle;
  Near near;
  near.particle = i;
  near.begin = first_[s];
  near.end = first_[s + 1];
  near.side = side_.data();
  near.x = near.origin = world.particles.x.vec(i);
  bool changed = false;
  for (Index c = near.begin; c < near.end; ++c)
    changed = changed || side_of(plane_distance(facets_[candidate_[c]], near.x)) != near.side[c];
  const Vec offset = ghost_->vec(i);
  Vec u = Vec::Zero();
  bool behind = false;
  if (changed) {
    const Vec ghost = near.x - world.particles.v.vec(i) * clock.dt_old + offset;
    behind = pull_back(near, ghost, pushes, u);
    if (behind) {
      near.origin = ghost;
      slots_[s].crossed = true;
    } else {
      for (Index c = near.begin; c < near.end; ++c)
        near.side[c] = std::int8_t(side_of(plane_distance(facets_[candidate_[c]], near.x)));
    }
  }
  push_off(near, pushes, u);
  if (!behind) {
    if (!offset.isZero(0)) ghost_->set(i, Vec::Zero());
    return;
  }
  // The ghost follows to where the walls let the particle be, unless that is behind another wall.
  Pushes none;
  Vec ignore;
  Near there = near;
  there.x = near.x + u;
  if (pull_back(there, near.origin, none, ignore)) {
    ghost_->set(i, near.origin - near.x);
    return;
  }
  ghost_->set(i, u);
  for (Index c = near.begin; c < near.end; ++c)
    near.side[c] = std::int8_t(side_of(plane_distance(facets_[candidate_[c]], there.x)));
}

// Walls that stand between the ghost and where the particle is (after each wall found: where it would be
// pushed to). Returns whether there are any.
bool Contact::pull_back(Near& near, const Vec& ghost, Pushes& pushes, Vec& u) {
  while (pushes.count < Pushes::capacity) {
    const Vec y = near.x + u;
    Real soonest = 2;
    Index hit = -1;
    for (Index c = near.begin; c < near.end; ++c) {
      const Index k = candidate_[c];
      if (side_of(plane_distance(facets_[k], y)) == near.side[c] || pushes.has(k)) continue;
      Real t = 0;
      if (passes_through(facets_[k], before(k), near.side[c], ghost, y, t) && t < soonest) {
        soonest = t;
        hit = c;
      }
    }
    if (hit < 0) break;
    const Facet& f = facets_[candidate_[hit]];
    Push& p = pushes.at[pushes.count++];
    p.facet = candidate_[hit];
    p.n = near.side[hit] * f.n;
    p.depth = contact_distance(near.particle, f) - near.side[hit] * plane_distance(f, near.x);
    p.q = near.x - plane_distance(f, near.x) * f.n;
    p.face = true;
    u = share_pushes(pushes);
  }
  return pushes.count > 0;
}

// Adds the wall that the particle, pushed so far to y, is deepest in, until it is far enough from all. On a
// flat mesh the first push is all: neighbours, patches on top of each other and shared edges are then at
// distance r as well.
void Contact::push_off(Near& near, Pushes& pushes, Vec& u) const {
  while (pushes.count < Pushes::capacity) {
    const Vec y = near.x + u;
    Push worst;
    Real violation = 0;
    for (Index c = near.begin; c < near.end; ++c) consider(near, c, y, pushes, worst, violation);
    if (violation <= 0) return;
    pushes.at[pushes.count++] = worst;
    u = share_pushes(pushes);
  }
}

bool Contact::consider(const Near& near, Index c, const Vec& y, const Pushes& pushes, Push& worst,
                       Real& violation) const {
  const Index k = candidate_[c];
  const Facet& f = facets_[k];
  const Real r = contact_distance(near.particle, f);
  const Real a = near.side[c] * plane_distance(f, y);
  const Real least = violation + depth_tolerance * r;  // what would not be deeper than this does not matter
  if (r - a <= least) return false;
  if ((y - f.centre).squaredNorm() > (r + f.radius + std::abs(a)) * (r + f.radius + std::abs(a)))
    return false;
  if (pushes.has(k)) return false;
  bool face = is_over(f, y);
  Real t = 0;
  if (!face && a < 0) face = passes_through(f, f.x, near.side[c], near.origin, y, t);
  if (face) {
    violation = r - a;
    worst.n = near.side[c] * f.n;
    worst.depth = r - near.side[c] * plane_distance(f, near.x);
    worst.q = near.x - plane_distance(f, near.x) * f.n;
  } else {
    const Vec q = nearest_on_rim(f, y);
    const Real d = (y - q).norm();
    if (r - d <= least) return false;
    // An edge of a wall that already pushes, seen again by its neighbour
    for (int j = 0; j < pushes.count; ++j) {
      const Facet& g = facets_[pushes.at[j].facet];
      if (std::abs(plane_distance(g, q)) <= g.tolerance && is_over(g, q)) return false;
    }
    violation = r - d;
    worst.n = d > f.tolerance ? Vec((y - q) / d) : Vec(near.side[c] * f.n);
    worst.depth = r - worst.n.dot(near.x - q);
    worst.q = q;
  }
  worst.facet = k;
  worst.face = face;
  return true;
}

Vec Contact::wall_velocity(const World& world, const Facet& f, const Vec& q) const {
  if (!f.moves) return Vec::Zero();
  const auto N = shape_functions(f, q);
  Vec v = Vec::Zero();
  for (int e = 0; e < f.corners; ++e) v += N[e] * world.nodes.v.vec(f.node[e]);
  return v;
}

void Contact::forces_of(World& world, const Clock& clock, Index s, const Pushes& pushes) {
  const Index i = slots_[s].particle;
  const Real m = world.particles.m[i];
  for (int j = 0; j < pushes.count; ++j) {
    const Push& p = pushes.at[j];
    if (!(p.share > 0)) continue;
    const Facet& f = facets_[p.facet];
    Touch& a = touches_[s * Pushes::capacity + slots_[s].count++];
    a = {.facet = p.facet,
         .n = p.n,
         .q = p.q,
         .depth = p.depth,
         .share = p.share,
         .k = stiffness(i, f, world),
         .damping = 0,
         .friction = Vec::Zero(),
         .force = Vec::Zero()};
    const Vec v = world.particles.v.vec(i) - wall_velocity(world, f, p.q);
    Real fn = a.k * p.share;
    if (law_.vdc > 0) {
      // omega = sqrt(k (m_s + m_m)/(m_s m_m)), m = min(m_s, m_m); the smaller share where two walls say
      // nearly the same
      const Real omega = std::sqrt(a.k * (1 / m + 1 / f.m));
      const Real damping = -0.01 * law_.vdc * 2 * std::min(m, f.m) * omega * v.dot(p.n);
      a.damping = std::max(damping * std::clamp(p.share / p.depth, 0.0, 1.0), -fn);  // never pulls
      fn += a.damping;
    }
    if (friction_on_) a.friction = friction_force(world, clock, i, fn, v, p.n, a.k);
    if (world.dim == 2) a.friction.z() = 0;
    a.force = fn * p.n + a.friction;
    if (world.dim == 2) a.force.z() = 0;
    if (friction_on_) slots_[s].stored_friction += 0.5 * a.friction.squaredNorm() / a.k;
  }
}

// Elastic predictor: the spring of the last step, turned into the tangent plane, plus -k times the slip since
// then.
Vec Contact::friction_force(const World& world, const Clock& clock, Index i, Real fn, const Vec& v,
                            const Vec& n, Real k) const {
  Vec old = Vec::Zero();
  Real best = 0.7;  // a spring belongs to a wall that faces within 45 degrees of the one it was strained at
  for (int j = 0; j < 3; ++j) {
    const Vec was = friction_force_[j]->vec(i);
    const Real match = friction_normal_[j]->vec(i).dot(n);
    if (match <= best || was.isZero(0)) continue;
    best = match;
    const Vec turned = was - was.dot(n) * n;
    old = turned.norm() > 0 ? Vec(turned * (was.norm() / turned.norm())) : Vec::Zero();
  }
  const Vec slip = v - v.dot(n) * n;
  Vec trial = old - k * clock.dt_old * slip;
  Real most = (law_.fd + (law_.fs - law_.fd) * std::exp(-law_.dc * slip.norm())) * fn;
  if (law_.vc > 0) {
    const Real dx = std::pow(world.particles.m[i] / world.particles.rho[i], 1.0 / world.dim);
    most = std::min(most, law_.vc * (world.dim == 3 ? dx * dx : dx));
  }
  const Real size = trial.norm();
  return size > most ? Vec(trial * (most / size)) : trial;
}

void Contact::keep_friction(World&, Index s) {
  const Index i = slots_[s].particle;
  for (int j = 0; j < 3; ++j) {
    const bool on = j < slots_[s].count;
    const Touch& a = touches_[s * Pushes::capacity + (on ? j : 0)];
    friction_normal_[j]->set(i, on ? a.n : Vec(Vec::Zero()));
    friction_force_[j]->set(i, on ? a.friction : Vec(Vec::Zero()));
  }
}

}  // namespace courant
