#include "elements/beam/beam_frame.hpp"

#include <cmath>

#include "base/rotation.hpp"

namespace courant {

namespace {

using Quaternion = Eigen::Quaterniond;
using Ends = std::array<Quaternion, 2>;

/// Axis times angle, up to pi, of q.
Vec rotation_vector(Quaternion q) {
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Real n = q.vec().norm();
  return n > 0 ? Vec(2 * std::atan2(n, q.w()) / n * q.vec()) : Vec(2 * q.vec());
}

BeamFrame frame_of(const Vec& between, const Quaternion& end1, const Quaternion& end2) {
  BeamFrame out{between.norm(), Matrix::Identity()};
  const Vec r = between / out.length;
  Vec s = end1.toRotationMatrix().col(1) + end2.toRotationMatrix().col(1);
  s = (s - s.dot(r) * r).normalized();
  out.axes.col(0) = r, out.axes.col(1) = s, out.axes.col(2) = r.cross(s);
  return out;
}

/// Halfway between ends that transmit torsion; else as the end that does, of two that do not as end 1.
BeamFrame released_frame(const Vec& between, const BeamReleases& releases, const Ends& q) {
  const bool by_second = releases.turns[0][0] && !releases.turns[1][0];
  return releases.twist() ? frame_of(between, q[by_second], q[by_second]) : frame_of(between, q[0], q[1]);
}

Ends turned(const std::array<Vec, 2>& angle, const Ends& ends) {
  return {turned_by(angle[0], ends[0]), turned_by(angle[1], ends[1])};
}

std::array<Vec, 2> turns_against(const BeamFrame& frame, const Ends& ends) {
  const Quaternion back = Quaternion(frame.axes).conjugate();
  return {rotation_vector(back * ends[0]), rotation_vector(back * ends[1])};
}

}  // namespace

TurnedEnds turn_ends(const Vec& between, const std::array<Vec, 2>& angle, Ends& ends) {
  ends = turned(angle, ends);
  const BeamFrame frame = frame_of(between, ends[0], ends[1]);
  return {frame, turns_against(frame, ends)};
}

TurnedEnds turn_ends(const Vec& between, const std::array<Vec, 2>& angle, const BeamReleases& releases,
                     Ends& ends) {
  const Matrix before = released_frame(between, releases, ends).axes;
  std::array<Vec, 2> taken = angle;
  for (std::size_t c = 0; c < 2; ++c)
    for (int k = 0; k < 3; ++k)
      if (releases.turns[c][static_cast<std::size_t>(k)])
        taken[c] -= taken[c].dot(before.col(k)) * before.col(k);
  ends = turned(taken, ends);
  TurnedEnds out{released_frame(between, releases, ends), {}};
  out.turn = turns_against(out.frame, ends);
  for (std::size_t c = 0; c < 2; ++c) {
    if (releases.turns[c] == std::array<bool, 3>{}) continue;
    Vec& turn = out.turn[c];
    for (int k = 0; k < 3; ++k)
      if (releases.turns[c][static_cast<std::size_t>(k)]) turn[k] = 0;
    ends[c] = turned_by(out.frame.axes * turn, Quaternion(out.frame.axes));
  }
  return out;
}

}  // namespace courant
