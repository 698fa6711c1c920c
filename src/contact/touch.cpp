// One particle against the facets near it: where it is pushed, and the forces that follow.
#include <cmath>

#include "contact/near.hpp"

namespace courant {

void Contact::touch(World& world, const Clock& clock, Block& b, Slot& slot, Pushes& pushes) {
  const Index i = slot.particle;
  const Vec x = world.particles.x.vec(i);
  const std::size_t first_touch = b.touches.size();
  pushes.count = 0;
  const bool quick = slot.walls > 0 && !slot.behind && quick_touch(b, slot, x, pushes);
  if (!quick) {
    if (is_far(slot, x)) {
      slot.skipped = true;
      return;  // and nothing has changed since friction was kept last
    }
    if (slot.skipped) learn_sides(world, clock, b, slot);
    slot.skipped = false;
    pushes.count = 0;
    find_pushes(world, clock, b, slot, pushes);
  }
  if (pushes.count > 0) {
    slot.room = 0;
    forces_of(world, clock, b, slot, pushes);
  }
  if (friction_on_) keep_friction(b, i, first_touch);
}

// In most steps nothing is within reach; the distance to the nearest wall then tells for how long.
void Contact::find_pushes(World& world, const Clock& clock, Block& b, Slot& slot, Pushes& pushes) {
  const Index i = slot.particle;
  Near near;
  near.particle = i;
  near.candidate = {b.candidate.data() + slot.first, std::size_t(slot.last - slot.first)};
  near.side = {b.side.data() + slot.first, near.candidate.size()};
  near.x = near.origin = world.particles.x.vec(i);
  bool changed = false;
  Real nearest2 = std::numeric_limits<Real>::infinity();
  for (std::size_t c = 0; c < near.candidate.size(); ++c) {
    const Wall& w = walls_[near.candidate[c]];
    changed = changed || side_of(plane_distance(w, near.x)) != near.side[c];
    if (search_less_) nearest2 = std::min(nearest2, least_distance2(w, near.x));
  }
  const Vec offset = admissible_->vec(i);
  slot.room = 0;
  slot.joints = 0;
  if (search_less_ && !changed && !slot.behind) {
    slot.room = std::sqrt(nearest2) - (1 + clear_margin) * r_most_;
    slot.seen = near.x;
    slot.travel = travel_;
    if (slot.room > 0) return;
  }
  if (changed) slot.walls = 0;  // facets of one plane may now be seen from different sides
  Vec u = Vec::Zero();
  bool behind = false;
  const auto learn = [&](const Vec& y) {
    for (std::size_t c = 0; c < near.candidate.size(); ++c)
      near.side[c] = std::int8_t(side_of(plane_distance(walls_[near.candidate[c]], y)));
  };
  if (changed) {
    const Vec admissible = near.x - world.particles.v.vec(i) * clock.dt_old + offset;
    behind = pull_back(near, admissible, pushes, u);
    if (behind) {
      near.origin = admissible;
      b.crossed.push_back(i);
    } else {
      learn(near.x);
    }
  }
  push_off(near, pushes, u);
  slot.behind = behind;
  if (!behind) {
    if (!offset.isZero(0)) admissible_->set(i, Vec::Zero());
    return;
  }
  // The admissible position follows to where the walls let the particle be, unless that is behind another
  // wall.
  Pushes none;
  Vec ignore = Vec::Zero();
  Near there = near;
  there.x = near.x + u;
  if (pull_back(there, near.origin, none, ignore)) {
    admissible_->set(i, near.origin - near.x);
    return;
  }
  admissible_->set(i, u);
  learn(there.x);
}

// Walls that are between the admissible position and where the particle is (after each wall found: where it
// would be pushed to). Returns whether there are any.
bool Contact::pull_back(Near& near, const Vec& admissible, Pushes& pushes, Vec& u) const {
  while (pushes.count < Pushes::capacity) {
    const Vec y = near.x + u;
    Real soonest = 2;
    Index hit = -1;
    for (std::size_t c = 0; c < near.candidate.size(); ++c) {
      const Index k = near.candidate[c];
      if (side_of(plane_distance(walls_[k], y)) == near.side[c] || pushes.has(k)) continue;
      Real t = 0;
      if (passes_through(facets_[k], before(k), near.side[c], admissible, y, t) && t < soonest) {
        soonest = t;
        hit = Index(c);
      }
    }
    if (hit < 0) break;
    const Index k = near.candidate[hit];
    const Facet& f = facets_[k];
    Push& p = pushes.at[pushes.count++];
    p.facet = k;
    p.n = near.side[hit] * f.n;
    p.depth = contact_distance(near.particle, walls_[k]) - near.side[hit] * plane_distance(f, near.x);
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
    const Real surely = search_less_ ? surely_deepest(near, y, pushes) - clear_margin * r_most_ : 0;
    for (std::size_t c = 0; c < near.candidate.size(); ++c) {
      if (search_less_) {
        // Not as deep as another one, by far more than what the order of looking can make of it
        const Wall& w = walls_[near.candidate[c]];
        const Real r = contact_distance(near.particle, w), within = r - surely;
        const Real a = near.side[c] * plane_distance(w, y);
        if (r - a <= depth_tolerance * r || (a >= 0 && least_distance2(w, y) > within * within)) continue;
      }
      consider(near, Index(c), y, pushes, worst, violation);
    }
    if (violation <= 0) return;
    pushes.at[pushes.count++] = worst;
    u = share_pushes(pushes);
  }
}

// How deep y is in a facet that it is over, 0 if there is none. [L]
Real Contact::surely_deepest(const Near& near, const Vec& y, const Pushes& pushes) const {
  Real deepest = 0;
  for (std::size_t c = 0; c < near.candidate.size(); ++c) {
    const Wall& w = walls_[near.candidate[c]];
    const Real a = near.side[c] * plane_distance(w, y), depth = contact_distance(near.particle, w) - a;
    if (a >= 0 && depth > deepest && beyond_edges(w, y) <= 0 && !pushes.has(near.candidate[c]))
      deepest = depth;
  }
  return deepest;
}

bool Contact::consider(const Near& near, Index c, const Vec& y, const Pushes& pushes, Push& worst,
                       Real& violation) const {
  const Index k = near.candidate[c];
  const Facet& f = facets_[k];
  const Real r = contact_distance(near.particle, walls_[k]);
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
  for (int e = 0; e < node_count(f); ++e) v += N[e] * world.nodes.v.vec(f.node[e]);
  return v;
}

// Where several walls push, k |u|^2/2 is the potential of their forces, u the path out, and the share of a
// wall is what it grows by as the wall moves on below the position that u leads to, not below the particle.
// There the wall takes its force; else walls that fold around particles would do work on them that nobody
// pays.
void Contact::forces_of(World& world, const Clock& clock, Block& b, const Slot& slot, const Pushes& pushes) {
  const Index i = slot.particle;
  const Real m = world.particles.m[i];
  const Vec out = world.particles.x.vec(i) + way_out(pushes);
  Vec total = Vec::Zero();
  for (int j = 0; j < pushes.count; ++j) {
    Push p = pushes.at[j];
    if (!(p.share > 0)) continue;
    const Facet& f = facets_[p.facet];
    if (p.face && pushes.count > 1) p.q = out - plane_distance(f, out) * f.n;
    const Real k = stiffness(i, slot.k, f.k, f, world);
    b.touches.push_back(
        {.particle = i, .facet = p.facet, .share = p.share, .depth = p.depth, .k = k, .n = p.n, .q = p.q});
    b.deepest = std::max(b.deepest, p.depth);
    if (drag_on_) {
      const Vec v = world.particles.v.vec(i) - wall_velocity(world, f, p.q);
      Drag& drag = b.drags.emplace_back(Drag{.damping = 0, .friction = Vec::Zero(), .other = Vec::Zero()});
      Real fn = k * p.share;
      if (law_.vdc > 0) {
        // omega = sqrt(k (m_s + m_m)/(m_s m_m)), m = min(m_s, m_m); the smaller share where two walls say
        // nearly the same
        const Real omega = std::sqrt(k * (1 / m + 1 / f.m));
        const Real damping = -0.01 * law_.vdc * 2 * std::min(m, f.m) * omega * v.dot(p.n);
        drag.damping = std::max(damping * std::clamp(p.share / p.depth, 0.0, 1.0), -fn);  // never pulls
        fn += drag.damping;
      }
      if (friction_on_) drag.friction = friction_force(world, clock, i, p.facet, fn, v, p.n, k);
      for (const auto& law : laws_)
        drag.other += law->force(
            {.particle = i, .n = p.n, .velocity = v, .push = fn, .depth = p.depth, .stiffness = k, .mass = m},
            clock);
      if (dim_ == 2) drag.friction.z() = drag.other.z() = 0;
    }
    const Vec force = force_of(b, b.touches.size() - 1);
    total += force;
    if (f.moves) b.reactions.push_back({p.facet, -force, shape_functions(f, p.q), k});
  }
  world.particles.f.add(i, total);
}

/// On the particle
Vec Contact::force_of(const Block& b, std::size_t touch) const {
  const Touch& a = b.touches[touch];
  Vec f = (a.k * a.share + a.held) * a.n;
  if (drag_on_)
    f = (a.k * a.share + b.drags[touch].damping + a.held) * a.n + b.drags[touch].friction +
        b.drags[touch].other;
  if (dim_ == 2) f.z() = 0;
  return f;
}

// Elastic predictor: the spring of the last step, turned into the tangent plane, plus -k times the slip since
// then.
Vec Contact::friction_force(const World& world, const Clock& clock, Index i, Index facet, Real fn,
                            const Vec& v, const Vec& n, Real k) const {
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
  const Friction& mu = part_of_.empty()
                           ? law_
                           : law_.between(world.particles.part[i], part_of_[static_cast<std::size_t>(facet)]);
  Real area = 0;
  if (mu.vc > 0) {
    const Real dx = std::pow(world.particles.m[i] / world.particles.rho[i], 1.0 / world.dim);
    area = world.dim == 3 ? dx * dx : dx;
  }
  const Real most = mu.most(slip.norm(), fn, area);
  const Real size = trial.norm();
  return size > most ? Vec(trial * (most / size)) : trial;
}

void Contact::keep_friction(const Block& b, Index particle, std::size_t first_touch) {
  for (std::size_t j = 0; j < 3; ++j) {
    const bool on = first_touch + j < b.touches.size();
    friction_normal_[j]->set(particle, on ? b.touches[first_touch + j].n : Vec(Vec::Zero()));
    friction_force_[j]->set(particle, on ? b.drags[first_touch + j].friction : Vec(Vec::Zero()));
  }
}

}  // namespace courant
