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

/// s is that of the ends by `shares`.
TurnedEnds frame_of(const Vec& between, const Ends& q, const std::array<Real, 2>& shares) {
  TurnedEnds out;
  out.frame.length = between.norm();
  const std::array<Vec, 2> of_end{shares[0] * q[0].toRotationMatrix().col(1),
                                  shares[1] * q[1].toRotationMatrix().col(1)};
  const Vec r = between / out.frame.length, mean = of_end[0] + of_end[1];
  const Real along = mean.dot(r);
  Vec s = mean - along * r;
  const Real across = s.norm();
  s /= across;
  const Vec t = r.cross(s);
  out.frame.axes.col(0) = r, out.frame.axes.col(1) = s, out.frame.axes.col(2) = t;
  out.lean = along / across;
  for (std::size_t c = 0; c < 2; ++c) out.leads[c] = of_end[c].cross(t) / across;
  return out;
}

/// Halfway between ends that transmit torsion; else as the end that does, of two that do not as end 1.
TurnedEnds released_frame(const Vec& between, const BeamReleases& releases, const Ends& q) {
  if (!releases.twist()) return frame_of(between, q, {1, 1});
  const bool by_second = !releases.turns[1][0];
  return frame_of(between, q, by_second ? std::array<Real, 2>{0, 1} : std::array<Real, 2>{1, 0});
}

Ends turned(const std::array<Vec, 2>& angle, const Ends& ends) {
  return {turned_by(angle[0], ends[0]), turned_by(angle[1], ends[1])};
}

std::array<Vec, 2> turns_against(const BeamFrame& frame, const Ends& ends) {
  const Quaternion back = Quaternion(frame.axes).conjugate();
  return {rotation_vector(back * ends[0]), rotation_vector(back * ends[1])};
}

/// The moment that does the work of m on the change of an axis times angle: the inverse of the left Jacobian
/// of the exponential map, transposed (Crisfield 1990; Battini & Pacoste 2002, eq. 9).
Vec moment_of(const Vec& turn, const Vec& m) {
  const Real square = turn.squaredNorm(), half = 0.5 * std::sqrt(square);
  const Real c = half > 1e-3 ? (1 - half / std::tan(half)) / square : (1 + square / 60) / 12;
  const Vec once = turn.cross(m);
  return m + 0.5 * once + c * turn.cross(once);
}

}  // namespace

TurnedEnds turn_ends(const Vec& between, const std::array<Vec, 2>& angle, Ends& ends) {
  ends = turned(angle, ends);
  TurnedEnds out = frame_of(between, ends, {1, 1});
  out.turn = turns_against(out.frame, ends);
  return out;
}

TurnedEnds turn_ends(const Vec& between, const std::array<Vec, 2>& angle, const BeamReleases& releases,
                     Ends& ends) {
  const Matrix before = released_frame(between, releases, ends).frame.axes;
  std::array<Vec, 2> taken = angle;
  for (std::size_t c = 0; c < 2; ++c)
    for (int k = 0; k < 3; ++k)
      if (releases.turns[c][static_cast<std::size_t>(k)])
        taken[c] -= taken[c].dot(before.col(k)) * before.col(k);
  ends = turned(taken, ends);
  TurnedEnds out = released_frame(between, releases, ends);
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

// P = pull dL/dt + sum M_c . (w_c - w), w of the frame: w_s = -t . v/L, w_t = s . v/L, w_r by leads and lean.
NodalForces nodal_forces(const TurnedEnds& turned, const BeamReleases* releases, Real pull,
                         const std::array<Vec, 2>& moment) {
  const Matrix& axes = turned.frame.axes;
  std::array<Vec, 2> M;
  for (std::size_t c = 0; c < 2; ++c) {
    M[c] = moment_of(turned.turn[c], moment[c]);
    for (int k = 0; releases && k < 3; ++k)
      if (releases->turns[c][static_cast<std::size_t>(k)]) M[c][k] = 0;
  }
  const Vec both = M[0] + M[1];
  NodalForces out;
  out.force =
      (pull * axes.col(0) +
       ((turned.lean * both[0] + both[1]) * axes.col(2) - both[2] * axes.col(1)) / turned.frame.length);
  for (std::size_t c = 0; c < 2; ++c) out.moment[c] = both[0] * turned.leads[c] - axes * M[c];
  return out;
}

}  // namespace courant
