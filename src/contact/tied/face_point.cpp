#include "contact/tied/face_point.hpp"

#include <algorithm>

#include "base/rotation.hpp"

namespace courant {

namespace {

/// Directions of the map at the point, and the normal.
struct FaceFrame {
  Vec q = Vec::Zero(), s = Vec::Zero(), t = Vec::Zero(), n = Vec::Zero();
  Real area = 0;  ///< length of s x t [L2]
};

/// `at`: of each corner [L]
template <class Place>
FaceFrame frame_at(const FacePoint& p, const Place& at) {
  FaceFrame out;
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e) {
    const Vec corner = at(e);
    out.q += p.N[e] * corner, out.s += p.by_s[e] * corner, out.t += p.by_t[e] * corner;
  }
  const Vec c = out.s.cross(out.t);
  out.area = c.norm(), out.n = c / out.area;
  return out;
}
FaceFrame frame_of(const FacePoint& p, const Field<Real>& x) {
  return frame_at(p, [&](std::size_t e) { return x.vec(p.node[e]); });
}

}  // namespace

FacePoint face_point(const ContactFace& face, const Projection& at, Real gap) {
  FacePoint out{.node = face.node, .corners = face.corners, .N = at.N, .gap = gap};
  if (face.corners == 3) {
    out.by_s = {-1, 1, 0, 0}, out.by_t = {-1, 0, 1, 0};
    return out;
  }
  const auto& N = at.N;
  const Real s = -N[0] + N[1] + N[2] - N[3], t = -N[0] - N[1] + N[2] + N[3];
  out.by_s = {-0.25 * (1 - t), 0.25 * (1 - t), 0.25 * (1 + t), -0.25 * (1 + t)};
  out.by_t = {-0.25 * (1 - s), -0.25 * (1 + s), 0.25 * (1 + s), 0.25 * (1 - s)};
  return out;
}

Vec place_of(const FacePoint& p, const Field<Real>& x) {
  const FaceFrame now = frame_of(p, x);
  return now.q + p.gap * now.n;
}

Vec normal_of(const FacePoint& p, const Field<Real>& x) {
  return frame_of(p, x).n;
}

// n = c/|c|, c = s x t: n' = (1 - n n^T) c'/|c|.
Vec velocity_of(const FacePoint& p, const Field<Real>& x, const Field<Real>& v) {
  const FaceFrame now = frame_of(p, x);
  Vec out = Vec::Zero(), change = Vec::Zero();
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e) {
    const Vec corner = v.vec(p.node[e]);
    out += p.N[e] * corner;
    change += p.by_s[e] * corner.cross(now.t) + p.by_t[e] * now.s.cross(corner);
  }
  return out + p.gap / now.area * (change - change.dot(now.n) * now.n);
}

std::array<Matrix, 4> rates_of(const FacePoint& p, const Field<Real>& x) {
  std::array<Matrix, 4> out;
  for (std::size_t e = 0; e < 4; ++e) out[e] = p.N[e] * Matrix::Identity();
  if (p.gap == 0) return out;
  const FaceFrame now = frame_of(p, x);
  const Matrix across = p.gap / now.area * (Matrix::Identity() - now.n * now.n.transpose());
  const Matrix by_s = across * skew(now.t), by_t = across * skew(now.s);
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e)
    out[e] += p.by_t[e] * by_t - p.by_s[e] * by_s;
  return out;
}

PointStep step_of(const FacePoint& p, std::span<const Vec> x, std::span<const Vec> v, Real dt) {
  PointStep out;
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e)
    out.x += p.N[e] * x[e], out.v += p.N[e] * v[e];
  if (p.gap == 0) return out;
  const Vec before = frame_at(p, [&](std::size_t e) -> Vec { return x[e] - dt * v[e]; }).n,
            after = frame_at(p, [&](std::size_t e) -> Vec { return x[e]; }).n;
  out.x += p.gap * after, out.v += p.gap / dt * (after - before);
  return out;
}

std::array<Vec, 4> on_corners(const FacePoint& p, const Field<Real>& x, const Vec& force) {
  std::array<Vec, 4> out{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e) out[e] = p.N[e] * force;
  if (p.gap == 0) return out;
  const FaceFrame now = frame_of(p, x);
  const Vec g = p.gap / now.area * (force - force.dot(now.n) * now.n);
  const Vec by_s = now.t.cross(g), by_t = g.cross(now.s);
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e)
    out[e] += p.by_s[e] * by_s + p.by_t[e] * by_t;
  return out;
}

std::array<Real, 4> largest_shares(const FacePoint& p, const Field<Real>& x) {
  const FaceFrame now = frame_of(p, x);
  const Real arm = std::abs(p.gap) / now.area;
  std::array<Real, 4> out{};
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e)
    out[e] =
        std::abs(p.N[e]) + arm * (std::abs(p.by_s[e]) * now.t.norm() + std::abs(p.by_t[e]) * now.s.norm());
  return out;
}

std::array<Real, 4> mass_shares(const FacePoint& p) {
  std::array<Real, 4> out{};
  Real sum = 0;
  for (std::size_t e = 0; e < static_cast<std::size_t>(p.corners); ++e)
    sum += out[e] = std::max(p.N[e], Real(0));
  for (Real& one : out) one /= sum;
  return out;
}

}  // namespace courant
