// *BOUNDARY_PRESCRIBED_MOTION_RIGID.
#include <fmt/format.h>

#include <cmath>

#include "rigid/nodal_bodies.hpp"
#include "rigid/rigid.hpp"

namespace courant {

namespace {

/// The global axis about which a motion turns.
int axis_of(const PrescribedMotion& motion) {
  Eigen::Index k = 0;
  motion.direction.cwiseAbs().maxCoeff(&k);
  return static_cast<int>(k);
}

/// A body that turns about one global axis alone keeps its inertia about it.
Real inertia(const RigidBody& b, int axis) {
  return b.J0(axis, axis);
}

Real prescribed(const PrescribedMotion& motion, const Clock& clock, Real before) {
  return motion.velocity(clock.t, clock.dt, clock.dt_old, before);
}

class Follower {
 public:
  Follower(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics), of_nodes_(nodal_body_ids(deck)) {}

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

  void add(const PrescribedMotion& motion, RigidBody& body) {
    const auto& held = motion.turns ? body.no_turn : body.held;
    for (std::size_t k = 0; k < 3; ++k)
      if (held[k] && motion.direction[static_cast<Eigen::Index>(k)] != 0)
        return error(motion, "DOF",
                     fmt::format("{} cannot {} {}, because {} of its {}, or the plane of a 2D scene, "
                                 "holds it",
                                 body.name, motion.turns ? "turn about" : "move along", "xyz"[k],
                                 motion.turns ? "CON2" : "CON1", holder(body)),
                     "free the direction that is to be driven");
    if (motion.turns)
      for (std::size_t k = 0; k < 3; ++k)
        if (static_cast<int>(k) != axis_of(motion) && !body.no_turn[k])
          return error(motion, "DOF",
                       fmt::format("{} may turn about {}, too: a prescribed rotation is supported where the "
                                   "other two are held",
                                   body.name, "xyz"[k]),
                       fmt::format("hold the other rotations by CON2 of {}", holder(body)));
    for (const PrescribedMotion& other : body.motions)
      if (const std::string why = clash(other, motion); !why.empty())
        return error(motion, "DOF", fmt::format("of {}, {} {}", body.name, deck_.place(other.card), why),
                     "let one end (DEATH) before the other starts (BIRTH), or leave it out");
    body.motions.push_back(motion);
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
  for (const PrescribedMotion& motion : b.motions) {
    if (!motion.drives(clock.t, clock.dt)) continue;
    if (motion.turns) {
      const int k = axis_of(motion);
      next.L[k] = inertia(b, k) * prescribed(motion, clock, b.L[k] / inertia(b, k));
    } else {
      const Vec& d = motion.direction;
      next.v += (prescribed(motion, clock, b.v.dot(d)) - next.v.dot(d)) * d;
    }
  }
  return next;
}

// The force of the drive makes m dv = (force + drive) dt; its work is drive . (v + dv/2) dt. Rotations alike.
Real work_of_drives(const RigidBody& b, const Clock& clock) {
  const HalfStep next = next_half_step(b, clock);
  const Real dt = clock.dt_mean();
  Real work = 0;
  for (const PrescribedMotion& motion : b.motions) {
    if (!motion.drives(clock.t, clock.dt)) continue;
    if (motion.turns) {
      const int k = axis_of(motion);
      work += (next.L[k] - b.L[k] - b.moment[k] * dt) * 0.5 * (b.L[k] + next.L[k]) / inertia(b, k);
    } else {
      const Vec& d = motion.direction;
      work += (b.m * (next.v - b.v) - b.force * dt).dot(d) * 0.5 * (b.v + next.v).dot(d);
    }
  }
  return work;
}

BoundaryForce force_of_drives(const RigidBody& b, const Clock& clock) {
  BoundaryForce out{BoundaryForce::Kind::driven_body, b.part, Vec::Zero(), Vec::Zero(), b.drive_work};
  const HalfStep next = next_half_step(b, clock);
  const Real dt = clock.dt_mean();
  for (const PrescribedMotion& motion : b.motions) {
    if (!motion.drives(clock.t, clock.dt)) continue;
    const Vec& d = motion.direction;
    if (motion.turns)
      out.moment[axis_of(motion)] = ((next.L - b.L) / dt - b.moment)[axis_of(motion)];
    else
      out.force += (b.m * (next.v - b.v) / dt - b.force).dot(d) * d;
  }
  return out;
}

void RigidBodies::follow(const std::vector<PrescribedMotion>& motions, const Deck& deck, const Model& model,
                         Diagnostics& diagnostics) {
  Follower follower(deck, model, diagnostics);
  for (const PrescribedMotion& motion : motions)
    if (motion.body != 0) follower.add(motion, bodies_);
}

}  // namespace courant
