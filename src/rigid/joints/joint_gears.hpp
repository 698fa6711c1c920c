#pragma once
// Equations of gears, racks and pulleys: rates of turning about axes at different positions are in a fixed
// ratio. They cannot be written as c(x, q) = 0 alone; what a step leaves is summed in Joint::turned.
#include "rigid/joints/joint_rows.hpp"

namespace courant {

/// Gears (s = -1 where they turn against each other) and pulleys (s = 1): R2/R1 (omega_B.e_B - f) = s
/// (omega_A.e_A - f), f the rate at which the line from A's position to B's turns about parallel axes, 0
/// about others. So a carrier may turn, and what bearings pass to it is right.
struct PlacedGears {
  Vec arm_a, arm_b;  ///< from the centres to the positions of the axes
  Vec e_a, e_b;      ///< axes
  Vec across, t;     ///< the centre line across the axes [L], how B's position moves as it turns
  Real distance = 0;

  PlacedGears(const Joint& joint, const BodyPose& a, const BodyPose& b);
  JointRow row(const Joint& joint) const;
  Real change(const Joint& joint, const BodyStep& a, const BodyStep& b) const;
};

/// B is a rack that a pinion A moves along u: u.(v_B - v_A's place) = PARM omega_A.e, v_B where the two
/// touch.
struct PlacedRack {
  Vec arm_a, touch_b;  ///< from the centres to the pinion's axis, to where it touches the rack
  Vec e, u;

  PlacedRack(const Joint& joint, const BodyPose& a, const BodyPose& b);
  JointRow row(const Joint& joint) const;
  Real change(const Joint& joint, const BodyStep& a, const BodyStep& b) const;
};

/// By how much a turn changes a vector.
Vec turning(const Vec& angle, const Vec& r);

}  // namespace courant
