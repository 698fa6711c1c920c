// *DAMPING_GLOBAL and *DAMPING_PART_MASS on rigid bodies.
#include <algorithm>

#include <fmt/format.h>

#include "rigid/bodies/rigid.hpp"

namespace courant {

void RigidBodies::set_damping(std::vector<Damping> damping, const Model& model, Diagnostics& diagnostics) {
  damping_ = std::move(damping);
  for (const RigidBody& b : bodies_)
    for (const Index part : b.parts)
      for (const Damping& d : damping_) {
        const auto is_equal = [&](const Damping& other) {
          return other.acts_on(b.parts.front()) && other.sf == d.sf && other.scale == d.scale &&
                 other.turn_scale == d.turn_scale && other.curve.abscissa == d.curve.abscissa &&
                 other.curve.ordinate == d.curve.ordinate;
        };
        if (b.fixed() || !d.acts_on(part) || std::any_of(damping_.begin(), damping_.end(), is_equal))
          continue;
        const ModelPart& merged = model.parts[static_cast<std::size_t>(part)];
        diagnostics.error(merged.where,
                          fmt::format("*PART {}: it is merged into the rigid body of part {}, and "
                                      "*DAMPING_PART_MASS gives the two parts different damping",
                                      merged.id, b.part),
                          fmt::format("let it name part {}, whose damping is that of the body", b.part));
      }
}

void RigidBodies::damp(const Clock& clock) {
  if (damping_.empty()) return;
  damped_.assign(bodies_.size(), {Vec::Zero(), Vec::Zero()});
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    RigidBody& b = bodies_[k];
    if (b.fixed()) continue;
    Vec D = Vec::Zero(), of_turns = Vec::Zero();
    for (const Damping& d : damping_) {
      if (d.acts_on(b.parts.empty() ? -1 : b.parts.front()))
        D += d.at(clock.t) * d.scale, of_turns += d.at(clock.t) * d.turn_scale;
    }
    const Vec force = b.force, moment = b.moment, half = Vec::Constant(0.5 * clock.dt_old);
    b.force = (force - b.m * D.cwiseProduct(b.v)).cwiseQuotient(Vec::Ones() + D.cwiseProduct(half));
    b.moment = (moment - of_turns.cwiseProduct(b.L)).cwiseQuotient(Vec::Ones() + of_turns.cwiseProduct(half));
    damped_[k] = {force - b.force, moment - b.moment};
  }
}

Real RigidBodies::lost_to_damping(std::size_t body, const Clock& clock) const {
  const RigidBody& b = bodies_[body];
  if (damped_.empty() || b.fixed()) return 0;
  const HalfStep next = next_half_step(b, clock);
  const Vec v = 0.5 * (b.v + next.v), omega = 0.5 * (b.omega + b.turning_by(next.L, b.q));
  return (damped_[body][0].dot(v) + damped_[body][1].dot(omega)) * clock.dt_mean();
}

}  // namespace courant
