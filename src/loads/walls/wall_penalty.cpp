#include "loads/walls/wall_penalty.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "parallel/parallel.hpp"

namespace courant {

WallPenalty::WallPenalty(std::vector<BodyNode> nodes, WallBodies bodies, Real scale)
    : nodes_(std::move(nodes)),
      bodies_(std::move(bodies)),
      scale_(std::min(scale, most_scale)),
      near_(nodes_.size()),
      state_(nodes_.size(), unknown),
      allowed_(nodes_.size(), 0),
      longest_(std::numeric_limits<Real>::infinity()) {
  Index most = -1;
  for (const BodyNode& n : nodes_) most = std::max(most, n.body);
  stiffness_.assign(static_cast<std::size_t>(most + 1), 0);
}

// Joints only make a body heavier: without them the trace is an upper bound.
Real WallPenalty::mobility(Index body, const World& world) const {
  Real trace = 0;
  for (const BodyNode& n : nodes_)
    for (int k = 0; n.body == body && k < 3; ++k)
      trace += bodies_.give_alone(body, world.nodes.x.vec(n.node), Vec::Unit(k));
  return trace;
}

Real WallPenalty::stiffness_of(Index body, const World& world, Real dt) {
  Real& k = stiffness_[static_cast<std::size_t>(body)];
  if (k > 0) return k;
  const Real trace = mobility(body, world);
  if (!(trace > 0)) return 0;
  k = scale_ / (trace * dt * dt);
  constexpr Real margin = 0.95;
  longest_ = std::min(longest_, margin * 2 * dt / std::sqrt(scale_));
  return k;
}

void WallPenalty::look(const World& world, const Wall& wall) {
  const WallShape& shape = *wall.shape;
  for_each(static_cast<Index>(nodes_.size()), [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec x = world.nodes.x.vec(nodes_[k].node) - wall.moved;
    near_[k] = shape.nearest(x);
    const Real depth = -near_[k].gap;
    if (!(depth > 0))
      state_[k] = outside, allowed_[k] = 0;
    else if (state_[k] == unknown)
      state_[k] = shape.has_edges() ? beside : touching, allowed_[k] = depth;
    else if (state_[k] == outside)
      state_[k] = shape.meets(x, 0) ? touching : beside;
    allowed_[k] = std::min(allowed_[k], std::max(depth, Real(0)));
  });
}

void WallPenalty::push(const World& world, const Clock& clock, const Wall& wall) {
  force_.setZero(), normal_ = stored_ = 0, rubs_.clear();
  if (nodes_.empty()) return;
  look(world, wall);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Real depth = -near_[k].gap - allowed_[k];
    if (state_[k] != touching || !(depth > 0)) continue;
    const auto [node, body] = nodes_[k];
    const Real stiffness = stiffness_of(body, world, clock.dt), push = stiffness * depth;
    if (!(push > 0)) continue;
    bodies_.push(body, world.nodes.x.vec(node), push * near_[k].n);
    force_ -= push * near_[k].n, normal_ += push, stored_ += 0.5 * push * depth;
    if (wall.friction) rub(world, clock, wall, k, push);
  }
}

void WallPenalty::rub(const World& world, const Clock& clock, const Wall& wall, std::size_t k, Real push) {
  const auto [node, body] = nodes_[k];
  const Vec x = world.nodes.x.vec(node), &n = near_[k].n;
  Vec slip = world.nodes.v.vec(node) + bodies_.change(body, x, clock) - wall.v;
  slip -= slip.dot(n) * n;
  const Real speed = slip.norm();
  if (!(speed > 0)) return;
  const Real give = bodies_.give(body, x, slip / speed);
  if (!(give > 0)) return;
  const Vec force = wall.friction(n, slip, push, 1 / give, clock.dt_mean());
  bodies_.push(body, x, force);
  force_ -= force;
  rubs_.push_back({k, force});
}

Real WallPenalty::friction_loss(const World& world, const Clock& clock, const Vec& v) const {
  Real lost = 0;
  for (const Rub& rub : rubs_) {
    const auto [node, body] = nodes_[rub.k];
    const Vec x = world.nodes.x.vec(node);
    const Vec slip = world.nodes.v.vec(node) + 0.5 * bodies_.change(body, x, clock) - v;
    lost -= rub.force.dot(slip) * clock.dt_mean();
  }
  return lost;
}

Real WallPenalty::release() {
  force_.setZero(), normal_ = 0, rubs_.clear();
  std::fill(state_.begin(), state_.end(), char(unknown));
  return std::exchange(stored_, 0);
}

void WallPenalty::keep(Archive& archive) {
  if (nodes_.empty()) return;
  archive("body_state", state_), archive("body_allowed", allowed_), archive("body_stiffness", stiffness_);
  archive("body_stored", stored_), archive("body_longest_step", longest_);
}

}  // namespace courant
