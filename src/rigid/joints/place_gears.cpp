#include "rigid/joints/place_gears.hpp"

#include <fmt/format.h>

#include <cmath>

namespace courant {

namespace {

constexpr Real least = 1e-3;  // of lengths, and of angles that are 0

Vec across(const Vec& x, const Vec& axis) {
  return x - x.dot(axis) * axis;
}

bool parallel(const Vec& a, const Vec& b) {
  return a.cross(b).norm() <= least * a.norm() * b.norm();
}

void set_axis(Matrix& axes, const Vec& axis) {
  axes.col(2) = axis.normalized();
  axes.col(0) = Vec(axes.col(2)).unitOrthogonal();
  axes.col(1) = Vec(axes.col(2)).cross(Vec(axes.col(0)));
}

std::optional<JointFault> no_axis(const JointCard& card, const JointPlaces& places) {
  for (const std::size_t k : {std::size_t{2}, std::size_t{3}})
    if (!((places.x[k] - places.x[k - 2]).norm() > least * places.size))
      return JointFault{k,
                        fmt::format("nodes {} and {} are at the same position: the joint has no axis",
                                    card.nodes()[k - 2], card.nodes()[k]),
                        "N1 to N3 is the axis in the first body, N2 to N4 in the second"};
  return std::nullopt;
}

std::optional<JointFault> place_rack(const JointPlaces& places, Joint& joint) {
  const Vec e = (places.x[2] - places.x[0]).normalized(), u = (places.x[3] - places.x[1]).normalized();
  if (std::abs(e.dot(u)) > least)
    return JointFault{3, fmt::format("N2 to N4 is not at right angles to N1 to N3: cosine {:.4g}", e.dot(u)),
                      "N1 to N3 is the axis of the pinion, N2 to N4 the direction in which the rack moves"};
  if (places.sixth && !parallel(places.x[5] - places.x[1], e))
    return JointFault{5, "N2 to N6 is not parallel to N1 to N3",
                      "N2 to N6 is parallel to the axis of the pinion, or leave N6 out"};
  set_axis(joint.axes_a, e), set_axis(joint.axes_b, across(u, e));
  return std::nullopt;
}

/// Gears about axes that are not parallel: both move alike where they touch, at N5 and N6.
std::optional<JointFault> place_bevel(const Vec& r5, const Vec& r6, Joint& joint) {
  const Vec t_a = Vec(joint.axes_a.col(2)).cross(r5), t_b = Vec(joint.axes_b.col(2)).cross(r6);
  if (!parallel(t_a, t_b))
    return JointFault{5, "gears do not move in one direction at N5 and N6",
                      "N1 to N5 and N2 to N6 point to where the gears touch; worm gears are not supported"};
  joint.sense = t_a.dot(t_b) > 0 ? 1 : -1;
  return std::nullopt;
}

/// About parallel axes: against each other, unless N5 and N6 are on the same side.
std::optional<JointFault> place_spur(const Vec& line, const Vec& r5, const Vec& r6, Joint& joint) {
  for (const auto& [node, r] : {std::pair(std::size_t{4}, r5), std::pair(std::size_t{5}, r6)})
    if (!parallel(r, line))
      return JointFault{
          node, fmt::format("N{} to N{} does not point along the line between the axes", node - 3, node + 1),
          "N1 to N5 and N2 to N6 point to where the gears touch: so it is known whether both turn the same "
          "way"};
  joint.sense = r5.dot(r6) > 0 ? 1 : -1;
  return std::nullopt;
}

}  // namespace

std::optional<JointFault> place_gears(const JointCard& card, const JointPlaces& places, Joint& joint) {
  if (const auto fault = no_axis(card, places)) return fault;
  if (joint.kind == JointKind::rack_and_pinion) return place_rack(places, joint);
  const auto& x = places.x;
  set_axis(joint.axes_a, x[2] - x[0]), set_axis(joint.axes_b, x[3] - x[1]);
  const Vec e = joint.axes_a.col(2), other = joint.axes_b.col(2);
  const bool spur = parallel(e, other), belt = joint.kind == JointKind::pulley;
  joint.ratio = card.parm, joint.sense = 1, joint.carried = spur;
  if (belt && !spur)
    return JointFault{3, "the axes of pulleys are not parallel", "N1 to N3 and N2 to N4 are their axes"};
  const Vec line = across(x[1] - x[0], e);
  if (spur && !(line.norm() > least * places.size))
    return JointFault{1, "both axes are on one line: what carries the wheels between them is not known",
                      "give each pair of wheels whose axes are apart a joint of its own"};
  if (spur && other.dot(e) < 0) set_axis(joint.axes_b, -other);  // turns count about A's direction
  if (belt) return std::nullopt;
  const Vec r5 = across(x[4] - x[0], e), r6 = across(x[5] - x[1], other);
  for (const auto& [node, r] : {std::pair(std::size_t{4}, r5), std::pair(std::size_t{5}, r6)})
    if (!(r.norm() > least * places.size))
      return JointFault{node, fmt::format("node {} is on the axis of its gear", card.nodes()[node]),
                        "N5 and N6 are where the gears touch"};
  return spur ? place_spur(line, r5, r6, joint) : place_bevel(r5, r6, joint);
}

std::optional<JointFault> place_motor(const JointCard& card, const JointPlaces& places, Joint& joint) {
  if (const auto fault = no_axis(card, places)) return fault;
  const Vec axis = places.x[2] - places.x[0], other = places.x[3] - places.x[1];
  if (!parallel(axis, other) || axis.dot(other) < 0)
    return JointFault{3, "N2 to N4 has another direction than N1 to N3",
                      "both give the axis of the motor, once in each body"};
  set_axis(joint.axes_a, axis), joint.axes_b = joint.axes_a;
  if (joint.kind == JointKind::translational_motor)
    joint.start = Vec(joint.axes_a.col(2)).dot(places.x[1] - places.x[0]);
  return std::nullopt;
}

}  // namespace courant
