#pragma once
#include "model/conditions/prescribed_motion.hpp"

namespace courant {

/// What a motor prescribes: how far B has turned about, or moved along, the joint's axis as seen from A.
struct JointDrive {
  PrescribedMotion::Kind kind = PrescribedMotion::Kind::velocity;
  Curve curve;          ///< over time; values of turns [-], [1/T], [1/T2], of ways [L], [L/T], [L/T2]
  Real sense = 1;       ///< -1: the file that holds it was mirrored
  Real start_rate = 0;  ///< of accelerations: the rate at t = 0 [1/T] or [L/T]

  /// From t = 0 to t; what a curve of displacements has at t = 0 does not count. [-] or [L]
  Real until(Real t) const;
  /// From t to t + dt, to round-off of that. [-] or [L]
  Real over(Real t, Real dt) const;
};

}  // namespace courant
