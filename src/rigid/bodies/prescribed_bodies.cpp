// *BOUNDARY_PRESCRIBED_MOTION_RIGID.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/rotation.hpp"
#include "base/run_error.hpp"
#include "rigid/bodies/mat_rigid.hpp"
#include "rigid/bodies/nodal_bodies.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

namespace {

Real prescribed(const PrescribedMotion& motion, const Clock& clock, Real before) {
  return motion.velocity(clock.t, clock.dt, clock.dt_old, before);
}

/// Axes of the rotations of a body that are driven, and the angular velocities about them.
struct DrivenTurns {
  std::array<const PrescribedMotion*, 3> motion{};
  Vec wanted = Vec::Zero();
  int count = 0;
};
DrivenTurns driven_turns(const RigidBody& b, const Clock& clock) {
  DrivenTurns out;
  for (const PrescribedMotion& motion : b.motions)
    if (motion.turns && motion.drives(clock.t, clock.dt)) {
      out.motion[static_cast<std::size_t>(out.count)] = &motion;
      out.wanted[out.count++] = prescribed(motion, clock, b.omega.dot(b.direction_of(motion, b.q)));
    }
  return out;
}

/// Columns: the axes that are driven, in an orientation; 0 beyond their number.
Matrix axes_of(const DrivenTurns& turns, const RigidBody& b, const Eigen::Quaterniond& q) {
  Matrix out = Matrix::Zero();
  for (int k = 0; k < turns.count; ++k)
    out.col(k) = b.direction_of(*turns.motion[static_cast<std::size_t>(k)], q);
  return out;
}

/// The angular momenta along `pushed` that change the angular velocities about `axes` so, in an orientation.
Vec drives_for(const Matrix& axes, const Matrix& pushed, int count, const Vec& change, const RigidBody& b,
               const Eigen::Quaterniond& q) {
  Matrix response = Matrix::Identity();
  for (int k = 0; k < count; ++k) {
    const Vec omega = b.turning_by(pushed.col(k), q);
    for (int j = 0; j < count; ++j) response(j, k) = omega.dot(axes.col(j));
  }
  return pushed * (response.inverse() * change);
}

/// Angular momentum with which a body turns about the axes that are driven as they ask for. The angular
/// velocity is that of the middle of the step, where axes that turn with the body are looked at, too; the
/// moments are along the axes at t^n, in the middle of the time through which they act.
Vec driven_momentum(const RigidBody& b, Vec L, const Clock& clock) {
  const DrivenTurns turns = driven_turns(b, clock);
  if (turns.count == 0) return L;
  constexpr int most = 100;
  const Matrix pushed = axes_of(turns, b, b.q);
  // speeds are right to what the free body would do, too
  const Real fastest = std::max({turns.wanted.norm(), b.omega.norm(), turning_over(b, L, clock.dt).norm()});
  for (int it = 0; it < most; ++it) {
    const Vec omega = turning_over(b, L, clock.dt);
    const Eigen::Quaterniond middle = turned_by(0.5 * clock.dt * omega, b.q);
    const Matrix axes = axes_of(turns, b, middle);
    const Vec lacks = turns.wanted - axes.transpose() * omega;
    if (lacks.norm() <= 1e-14 * fastest) return L;
    if (it == most - 1 && !(lacks.norm() <= 1e-9 * fastest))
      throw RunError(
          fmt::format("{} does not follow its prescribed rotation at time {:.6g}: it turns by {:.3g} in a "
                      "step of {:.3g}",
                      b.name, clock.t, fastest * clock.dt, clock.dt),
          "take a shorter step (DT2MS, LCTM or TSSFAC of *CONTROL_TIMESTEP)");
    L += drives_for(axes, pushed, turns.count, lacks, b, middle);
  }
  return L;
}

class Follower {
 public:
  Follower(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics), of_nodes_(nodal_body_ids(deck, model)) {}

  void add(const PrescribedMotion& motion, std::vector<RigidBody>& bodies) {
    if (motion.part < 0 && !of_nodes_.contains(motion.body))
      return error(motion, "PID", fmt::format("part {} does not exist", motion.body),
                   "define it with *PART, or with *CONSTRAINED_NODAL_RIGID_BODY");
    for (RigidBody& body : bodies)
      if (body.part == motion.body)
        return add(motion, body);
      else if (motion.part >= 0 && body.has_part(motion.part))
        return error(
            motion, "PID", fmt::format("part {} is merged into part {}", motion.body, body.part),
            fmt::format("name part {}: the motion is that of the whole body and its centre", body.part));
    error(motion, "PID", fmt::format("part {} is no rigid body", motion.body),
          "it needs elements and a *MAT_RIGID; drive particles and nodes by _NODE or _SET");
  }

 private:
  static const char* holder(const RigidBody& body) {
    return body.parts.empty() ? "*CONSTRAINED_NODAL_RIGID_BODY_SPC" : "*MAT_RIGID";
  }
  void error(const PrescribedMotion& motion, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, motion.card, field, std::move(message), std::move(hint));
  }

  void add(PrescribedMotion motion, RigidBody& body) {
    if (motion.local && !to_body(motion, body)) return;
    const auto& held = motion.turns ? body.no_turn : body.held;
    for (std::size_t k = 0; k < 3; ++k)
      if (held[k] && motion.direction[static_cast<Eigen::Index>(k)] != 0)
        return error(motion, "DOF",
                     fmt::format("{} cannot {} {}, because {} of its {}, or the plane of a 2D scene, "
                                 "holds it",
                                 body.name, motion.turns ? "turn about" : "move along", "xyz"[k],
                                 motion.turns ? "CON2" : "CON1", holder(body)),
                     "free the direction that is to be driven");
    for (const PrescribedMotion& other : body.motions)
      if (const std::string why = clash(other, motion); !why.empty())
        return error(motion, "DOF", fmt::format("of {}, {} {}", body.name, deck_.place(other.card), why),
                     "let one end (DEATH) before the other starts (BIRTH), or leave it out");
    body.motions.push_back(std::move(motion));
  }

  /// Gives a local motion its direction at the start.
  bool to_body(PrescribedMotion& motion, const RigidBody& body) {
    const MatRigid* const material =
        body.part_index < 0
            ? nullptr
            : mat_rigid_of(deck_, model_.parts[static_cast<std::size_t>(body.part_index)].mid);
    const std::optional<Matrix> axes = material ? axes_of_material(*material, model_) : std::nullopt;
    if (!axes) {
      error(motion, "PID", fmt::format("{} has no axes of its own", body.name),
            "give them by LCO (a coordinate system) or A1 to V3 of its *MAT_RIGID");
      return false;
    }
    const auto& held = motion.turns ? body.no_turn : body.held;
    if (held[0] || held[1] || held[2]) {
      error(motion, "DOF",
            fmt::format("{} is held along global axes, and the axes of this motion turn with it", body.name),
            fmt::format("free it (CON1, CON2 of {}), or drive it by *BOUNDARY_PRESCRIBED_MOTION_RIGID",
                        holder(body)));
      return false;
    }
    motion.direction = *axes * motion.direction;
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::set<Id> of_nodes_;
};

}  // namespace

HalfStep next_half_step(const RigidBody& b, const Clock& clock) {
  return next_half_step(b, b.force, b.moment, clock);
}

HalfStep next_half_step(const RigidBody& b, const Vec& force, const Vec& moment, const Clock& clock) {
  HalfStep next{b.v + force / b.m * clock.dt_mean(), b.L + moment * clock.dt_mean()};
  if (b.motions.empty()) return next;
  next.L = driven_momentum(b, next.L, clock);
  Eigen::Quaterniond middle = b.q;
  for (const PrescribedMotion& motion : b.motions)
    if (motion.local && !motion.turns) {
      middle = turned_by(0.5 * clock.dt * turning_over(b, next.L, clock.dt), b.q);
      break;
    }
  for (const PrescribedMotion& motion : b.motions) {
    if (motion.turns || !motion.drives(clock.t, clock.dt)) continue;
    const Vec d = b.direction_of(motion, middle);
    next.v += (prescribed(motion, clock, b.v.dot(b.direction_of(motion, b.q))) - next.v.dot(d)) * d;
  }
  return next;
}

Vec RigidBody::turning_beside_drives(const Vec& change, const Clock* clock) const {
  const Vec free = turning_by(change, q);
  Matrix axes = Matrix::Zero();
  int count = 0;
  for (const PrescribedMotion& motion : motions)
    if (motion.turns && count < 3 && (!clock || motion.drives(clock->t, clock->dt))) {
      const Vec d = direction_of(motion, q);
      if ((axes.transpose() * d).norm() < 0.5)
        axes.col(count++) = d;  // one axis may be driven twice, in turn
    }
  if (count == 0) return free;
  return turning_by(change + drives_for(axes, axes, count, -axes.transpose() * free, *this, q), q);
}

// The force of the drives makes m dv = (force + drive) dt; its work is drive . (v + dv/2) dt. Rotations
// alike.
Real work_of_drives(const RigidBody& b, const Clock& clock) {
  const auto drives = [&](const PrescribedMotion& motion) { return motion.drives(clock.t, clock.dt); };
  if (std::none_of(b.motions.begin(), b.motions.end(), drives)) return 0;
  const HalfStep next = next_half_step(b, clock);
  const Real dt = clock.dt_mean();
  return (b.m * (next.v - b.v) - b.force * dt).dot(0.5 * (b.v + next.v)) +
         (next.L - b.L - b.moment * dt).dot(b.turning_by(0.5 * (b.L + next.L), b.q));
}

BoundaryForce force_of_drives(const RigidBody& b, const Clock& clock) {
  const HalfStep next = next_half_step(b, clock);
  const Real dt = clock.dt_mean();
  return {BoundaryForce::Kind::driven_body, b.part, b.m * (next.v - b.v) / dt - b.force,
          (next.L - b.L) / dt - b.moment, b.drive_work};
}

void RigidBodies::follow(const std::vector<PrescribedMotion>& motions, const Deck& deck, const Model& model,
                         Diagnostics& diagnostics) {
  for (const MatRigid& m : deck.all<MatRigid>()) {
    const bool used = std::any_of(motions.begin(), motions.end(), [&](const PrescribedMotion& motion) {
      return motion.local && motion.part >= 0 &&
             model.parts[static_cast<std::size_t>(motion.part)].mid == m.mid;
    });
    const auto& orientations = deck.all<PrescribedOrientation>();
    const bool oriented =
        std::any_of(orientations.begin(), orientations.end(), [&](const PrescribedOrientation& card) {
          const auto part = model.part_of_id.find(card.pidb);
          return part != model.part_of_id.end() &&
                 model.parts[static_cast<std::size_t>(part->second)].mid == m.mid;
        });
    if (m.lco != 0 && !used && !oriented)
      deck.warning(
          diagnostics, m, "LCO",
          "has no effect: results are written along global axes, and no motion _LOCAL is along these",
          "leave it out");
  }
  Follower follower(deck, model, diagnostics);
  for (const PrescribedMotion& motion : motions)
    if (motion.body != 0) follower.add(motion, bodies_);
}

void RigidBodies::turn(std::size_t body, const MotionSource& source, Real birth, Real death,
                       const Entry& card) {
  for (int axis = 0; axis < 3; ++axis) {
    PrescribedMotion motion;
    motion.turns = true, motion.direction = Vec::Unit(axis), motion.birth = birth, motion.death = death;
    motion.source = &source, motion.component = 3 + axis, motion.card = card;
    bodies_[body].motions.push_back(std::move(motion));
  }
}

void RigidBodies::drive(std::size_t body, const MotionSource& source) {
  RigidBody& b = bodies_[body];
  for (int component = 0; component < 6; ++component) {
    const bool turns = component >= 3;
    const int axis = component % 3;
    if ((turns ? b.no_turn : b.held)[static_cast<std::size_t>(axis)]) continue;
    PrescribedMotion motion;
    motion.turns = turns, motion.direction = Vec::Unit(axis);
    motion.source = &source, motion.component = component;
    b.motions.push_back(std::move(motion));
  }
}

}  // namespace courant
