#include "contact/nodes/face.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"

namespace courant {

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();
/// Within this beyond an edge, of a width, rounding decides.
constexpr Real edge_rounding = 1e-8;

Projection at(const FaceCorners& x, Real s, Real t) {
  Projection p;
  p.N = {0.25 * (1 - s) * (1 - t), 0.25 * (1 + s) * (1 - t), 0.25 * (1 + s) * (1 + t),
         0.25 * (1 - s) * (1 + t)};
  p.q = p.N[0] * x[0] + p.N[1] * x[1] + p.N[2] * x[2] + p.N[3] * x[3];
  const Vec xs = (1 - t) * (x[1] - x[0]) + (1 + t) * (x[2] - x[3]);
  const Vec xt = (1 - s) * (x[3] - x[0]) + (1 + s) * (x[2] - x[1]);
  p.n = xs.cross(xt).normalized();
  return p;
}

}  // namespace

Projection project_on_rim(const FaceCorners& x, int corners, const Vec& y) {
  Projection p;
  Real least = infinite;
  for (int e = 0; e < corners; ++e) {
    const auto a = static_cast<std::size_t>(e), b = static_cast<std::size_t>((e + 1) % corners);
    const Vec along = x[b] - x[a];
    const Real u = std::clamp((y - x[a]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec q = x[a] + u * along;
    const Real d2 = (y - q).squaredNorm();
    if (!(d2 < least)) continue;
    least = d2;
    p.q = q, p.N = {};
    p.N[a] = 1 - u, p.N[b] += u;
  }
  p.n = corners == 3 ? plane_normal(x)
                     : at(x, p.N[1] + p.N[2] - p.N[0] - p.N[3], p.N[2] + p.N[3] - p.N[0] - p.N[1]).n;
  return p;
}

namespace {

/// Newton's method for the nearest point of r(s, t): (r - y).r_s = (r - y).r_t = 0. Of a flat parallelogram
/// the first step is exact. Where it goes back and forth, on folded faces, far outside: they have no foot
/// there.
std::array<Real, 2> nearest_on_quadrilateral(const FaceCorners& x, const Vec& y) {
  const Vec mean = 0.25 * (x[0] + x[1] + x[2] + x[3]), a = 0.25 * (x[1] - x[0] + x[2] - x[3]),
            b = 0.25 * (x[3] - x[0] + x[2] - x[1]), c = 0.25 * (x[0] - x[1] + x[2] - x[3]);
  constexpr Real enough = 1e-7, wild = 4;  // the error is of the order of the last step squared
  constexpr int most = 12;
  constexpr Real lost = 0.01;  // the last step of what converges, if slowly, is less
  Real s = 0, t = 0;
  for (int it = 0; it < most; ++it) {
    const Vec w = mean + s * a + t * b + s * t * c - y, rs = a + t * c, rt = b + s * c;
    const Real g = w.dot(rs), h = w.dot(rt), ss = rs.squaredNorm(), tt = rt.squaredNorm();
    Real st = rs.dot(rt) + w.dot(c), det = ss * tt - st * st;
    if (!(det > 0.05 * ss * tt)) st = rs.dot(rt), det = ss * tt - st * st;  // far off a warped face
    const Real ds = (h * st - g * tt) / det, dt = (g * st - h * ss) / det;
    s = std::clamp(s + ds, -wild, wild), t = std::clamp(t + dt, -wild, wild);
    if (std::abs(ds) + std::abs(dt) < enough) break;
    if (it == most - 1 && !(std::abs(ds) + std::abs(dt) < lost)) return {2 * wild, 2 * wild};
  }
  return {s, t};
}

Projection on_plane_of_triangle(const FaceCorners& x, const Vec& y) {
  const Vec a = x[1] - x[0], b = x[2] - x[0], n = a.cross(b);
  const Real n2 = n.squaredNorm();
  const Vec w = y - x[0];
  const Real u = w.cross(b).dot(n) / n2, v = a.cross(w).dot(n) / n2;
  Projection p;
  p.N = {1 - u - v, u, v, 0};
  p.q = x[0] + u * a + v * b;
  p.n = n / std::sqrt(n2);
  return p;
}

}  // namespace

Projection project_over(const FaceCorners& x, int corners, const Vec& y) {
  if (corners == 3) {
    Projection p = on_plane_of_triangle(x, y);
    const Real least = std::min({p.N[0], p.N[1], p.N[2]});
    p.inside = least >= 0, p.within = least > edge_rounding, p.over = least >= -edge_margin;
    for (unsigned e = 0; p.over && e < 3; ++e)
      if (p.N[(e + 2) % 3] < -edge_rounding) p.beyond |= 1U << e;
    return p;
  }
  const auto [s, t] = nearest_on_quadrilateral(x, y);
  const Real most = std::max(std::abs(s), std::abs(t));
  if (!(most <= 1 + 2 * edge_margin)) return {};
  Projection p = at(x, s, t);
  p.over = true, p.inside = most <= 1, p.within = most < 1 - 2 * edge_rounding;
  const std::array<Real, 4> past{-t, s, t, -s};
  for (unsigned e = 0; e < 4; ++e)
    if (past[e] > 1 + 2 * edge_rounding) p.beyond |= 1U << e;
  return p;
}

Projection project(const FaceCorners& x, int corners, const Vec& y) {
  const Projection p = project_over(x, corners, y);
  return p.over ? p : project_on_rim(x, corners, y);
}

Vec project_beyond(const FaceCorners& x, int corners, const Vec& y, Projection& p) {
  p = project_on_rim(x, corners, y);
  p.n = plane_normal(x);
  const Vec w = y - p.q, aside = w - w.dot(p.n) * p.n;
  if (!(aside.dot(p.q - centre_of(x, corners)) > 0)) return Vec::Zero();
  const auto change = plane_change(x, corners, aside);
  for (std::size_t e = 0; e < 4; ++e) p.N[e] += change[e];
  p.q += aside;
  return aside;
}

std::array<Real, 4> plane_change(const FaceCorners& x, int corners, const Vec& along) {
  const Vec a = x[2] - x[0], b = corners == 3 ? Vec(x[1] - x[0]) : Vec(x[3] - x[1]);
  const Real aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b), det = aa * bb - ab * ab;
  const Real by_a = (along.dot(a) * bb - along.dot(b) * ab) / det,
             by_b = (along.dot(b) * aa - along.dot(a) * ab) / det;
  if (corners == 3) return {-by_a - by_b, by_b, by_a, 0};
  return {-by_a, -by_b, by_a, by_b};
}

std::vector<BoxGrid::Box> boxes_around(const std::vector<ContactFace>& faces, const Field<Real>& x,
                                       Real reach, Real least, Real part) {
  std::vector<BoxGrid::Box> out(faces.size());
  for_each(static_cast<Index>(faces.size()), [&](Index f) {
    const ContactFace& face = faces[static_cast<std::size_t>(f)];
    const FaceCorners c = corners_of(face, x);
    const Real around = reach + face.r + std::abs(face.lift) + std::max(part * face.depth - least, Real(0));
    BoxGrid::Box& box = out[static_cast<std::size_t>(f)];
    box.low = c[0].cwiseMin(c[1]).cwiseMin(c[2]).cwiseMin(c[3]).array() - around;
    box.high = c[0].cwiseMax(c[1]).cwiseMax(c[2]).cwiseMax(c[3]).array() + around;
  });
  return out;
}

Real area_of(const FaceCorners& x) {
  return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
}

Real longest_diagonal(const FaceCorners& x, int corners) {
  if (corners == 3) return std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
  return std::max((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
}

}  // namespace courant
