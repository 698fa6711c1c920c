#include "rigid/joints/joint_gears.hpp"

#include <cmath>

namespace courant {

Vec turning(const Vec& angle, const Vec& r) {
  const Real half = 0.5 * angle.norm();
  if (half == 0) return Vec::Zero();
  const Real sine = std::sin(half) / half;
  const Vec first = angle.cross(r);
  return sine * std::cos(half) * first + 0.5 * sine * sine * angle.cross(first);
}

PlacedGears::PlacedGears(const Joint& joint, const BodyPose& a, const BodyPose& b) {
  arm_a = a.q * joint.at_a, arm_b = b.q * joint.at_b;
  e_a = a.q * Vec(joint.axes_a.col(2)), e_b = b.q * Vec(joint.axes_b.col(2));
  const Vec d = (b.x - a.x) + (arm_b - arm_a);
  across = d - d.dot(e_a) * e_a, distance = across.norm();
  t = joint.carried ? Vec(e_a.cross(across) / distance) : Vec(Vec::Zero());
}

JointRow PlacedGears::row(const Joint& joint) const {
  JointRow out{.c = joint.turned, .w_a = -joint.sense * e_a, .w_b = joint.ratio * e_b, .angle = true};
  if (!joint.carried) return out;
  const Vec k = (joint.ratio - joint.sense) / distance * t;
  out.v_a = k, out.w_a += arm_a.cross(k), out.v_b = -k, out.w_b -= arm_b.cross(k);
  return out;
}

// About an axis that is fixed in a body the angle of its turn counts exactly, and so does the turn of the
// centre line.
Real PlacedGears::change(const Joint& joint, const BodyStep& a, const BodyStep& b) const {
  const Real out = joint.ratio * e_b.dot(b.angle) - joint.sense * e_a.dot(a.angle);
  if (!joint.carried) return out;
  const Vec dd = (b.way - a.way) + (turning(b.angle, arm_b) - turning(a.angle, arm_a));
  return out - (joint.ratio - joint.sense) * std::atan2(t.dot(dd), distance + across.dot(dd) / distance);
}

PlacedRack::PlacedRack(const Joint& joint, const BodyPose& a, const BodyPose& b) {
  arm_a = a.q * joint.at_a;
  e = a.q * Vec(joint.axes_a.col(2)), u = b.q * Vec(joint.axes_b.col(2));
  touch_b = (a.x + arm_a + joint.advance * u.cross(e)) - b.x;
}

JointRow PlacedRack::row(const Joint& joint) const {
  return {joint.turned, Vec(-u), Vec(-arm_a.cross(u) - joint.advance * e), u, touch_b.cross(u)};
}

Real PlacedRack::change(const Joint& joint, const BodyStep& a, const BodyStep& b) const {
  return u.dot((b.way - a.way) + (turning(b.angle, touch_b) - turning(a.angle, arm_a))) -
         joint.advance * e.dot(a.angle);
}

}  // namespace courant
