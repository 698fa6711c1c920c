#include "elements/beam/beam_frame.hpp"

#include <algorithm>
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

/// Whether s follows an end, of beams that twist without resistance.
bool leads(const BeamReleases& releases, std::size_t end) {
  return end == (releases.turns[1][0] ? 0 : 1);
}

/// Halfway between ends that transmit torsion; else as the end that does, of two that do not as end 1.
TurnedEnds released_frame(const Vec& between, const BeamReleases& releases, const Ends& q) {
  if (!releases.twist()) return frame_of(between, q, {1, 1});
  return frame_of(between, q, {leads(releases, 0) ? 1.0 : 0.0, leads(releases, 1) ? 1.0 : 0.0});
}

Ends turned(const std::array<Vec, 2>& angle, const Ends& ends) {
  return {turned_by(angle[0], ends[0]), turned_by(angle[1], ends[1])};
}

std::array<Vec, 2> turns_against(const Quaternion& frame, const Ends& ends) {
  const Quaternion back = frame.conjugate();
  return {rotation_vector(back * ends[0]), rotation_vector(back * ends[1])};
}

/// Of rotations about r, s, t gives the change of an axis times angle: the inverse of the left Jacobian of
/// the exponential map (Crisfield 1990; Battini & Pacoste 2002, eq. 9). Its transpose gives moments that do
/// the work of what answers this change.
Matrix turn_by_rotation(const Vec& turn) {
  const Real square = turn.squaredNorm(), half = 0.5 * std::sqrt(square);
  const Real c = half > 1e-3 ? (1 - half / std::tan(half)) / square : (1 + square / 60) / 12;
  Matrix cross;
  cross << 0, -turn[2], turn[1], turn[2], 0, -turn[0], -turn[1], turn[0], 0;
  return Matrix::Identity() - 0.5 * cross + c * cross * cross;
}

/// x, of which released components are such that those of A x are 0.
Vec released_part(const std::array<bool, 3>& released, const Matrix& A, Vec x) {
  Matrix B = Matrix::Identity();
  for (int k = 0; k < 3; ++k)
    if (released[static_cast<std::size_t>(k)]) B.row(k) = A.row(k), x[k] = 0;
  return B.inverse() * x;
}

}  // namespace

TurnedEnds turn_ends(const Vec& between, const std::array<Vec, 2>& angle, Ends& ends) {
  ends = turned(angle, ends);
  TurnedEnds out = frame_of(between, ends, {1, 1});
  out.turn = turns_against(Quaternion(out.frame.axes), ends);
  return out;
}

TurnedEnds turn_ends(const Vec& between, const Vec& between_before, const std::array<Vec, 2>& angle,
                     const BeamReleases& releases, Ends& ends) {
  const Ends last = ends;
  const Quaternion before(released_frame(between_before, releases, ends).frame.axes);
  const std::array<Vec, 2> turn_before = turns_against(before, last);
  std::array<Vec, 2> taken = angle;
  // twice, since the frame turns with ends that turn with it about axes in the middle of the step
  for (int pass = 0; pass < 2; ++pass) {
    const Quaternion now(released_frame(between, releases, turned(taken, last)).frame.axes);
    const Vec of_frame = rotation_vector(now * before.conjugate());
    const Matrix middle = turned_by(0.5 * of_frame, before).toRotationMatrix();
    for (std::size_t c = 0; c < 2; ++c) {
      const Vec against = middle.transpose() * (angle[c] - of_frame);
      taken[c] =
          of_frame + middle * released_part(releases.turns[c], turn_by_rotation(turn_before[c]), against);
    }
  }
  ends = turned(taken, last);
  TurnedEnds out = released_frame(between, releases, ends);
  out.turn = turns_against(Quaternion(out.frame.axes), ends);
  for (std::size_t c = 0; c < 2; ++c) {
    if (releases.turns[c] == std::array<bool, 3>{}) continue;
    Vec& turn = out.turn[c];
    for (int k = 0; k < 3; ++k)
      if (releases.turns[c][static_cast<std::size_t>(k)]) turn[k] = 0;
    ends[c] = turned_by(out.frame.axes * turn, Quaternion(out.frame.axes));
  }
  return out;
}

// The square of the frequency as found for elements of 0.1 to 1 thickness per length, bent to S and C about
// s, t and both, with and without twist, from the second derivatives of their energy.
Real bent_step(const TurnedEnds& turned, Real thickness2) {
  const Real turn = std::sqrt(std::max(turned.turn[0].squaredNorm(), turned.turn[1].squaredNorm()));
  const Real stocky = 1 + 0.7 * turn * thickness2;
  const Real twisted = 0.8 * (turned.leads[0].squaredNorm() + turned.leads[1].squaredNorm());
  return 1 / std::sqrt(std::max(stocky, twisted));
}

// P = axial force dL/dt + sum M_c . (w_c - w), w of the frame: w_s = -t . v/L, w_t = s . v/L, w_r by leads
// and lean.
NodalForces nodal_forces(const TurnedEnds& turned, const BeamReleases* releases, Real pull,
                         const std::array<Vec, 2>& moment) {
  const Matrix& axes = turned.frame.axes;
  std::array<Vec, 2> M;
  for (std::size_t c = 0; c < 2; ++c) {
    const Matrix A = turn_by_rotation(turned.turn[c]).transpose();
    M[c] = A * (releases ? released_part(releases->turns[c], A, moment[c]) : moment[c]);
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
