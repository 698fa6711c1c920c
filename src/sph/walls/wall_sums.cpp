// Sums over walls: closed form for sub-domains, else sums over points.
#include <algorithm>
#include <array>
#include <cmath>

#include "sph/walls/wall_support.hpp"

namespace courant {

namespace {

Vec normal(const WallSubDomain& domain, int wall) {
  return Vec(domain.n[wall][0], domain.n[wall][1], domain.n[wall][2]);
}

/// Distances from the walls of a sub-domain, in h, at least 0.
struct Depths {
  std::array<Real, 3> of{};
  int walls;
  Real operator[](int k) const { return of[static_cast<std::size_t>(k)]; }
  Depths(const WallSubDomain& domain, const Vec& x, Real h) : walls(domain.walls) {
    for (int k = 0; k < walls; ++k)
      of[static_cast<std::size_t>(k)] = std::max((normal(domain, k).dot(x) - domain.offset[k]) / h, Real(0));
  }
  /// The other walls, if there are three.
  int next(int k) const { return (k + 1) % walls; }
  int last(int k) const { return (k + walls - 1) % walls; }
};

/// int W dS over a wall, h = 1: the whole plane less the parts beyond the other walls.
Real whole(const WallTables& planes, const WallCornerTables& corners, const Depths& d, int k) {
  Real out = planes.plane(d[k]);
  if (!(out > 0) || d.walls == 1) return out;
  out -= corners.plane(d[k], d[d.next(k)]);
  if (d.walls == 3)
    out += corners.plane(d[k], d[d.next(k)], d[d.last(k)]) - corners.plane(d[k], d[d.last(k)]);
  return out;
}

/// int s W dS over a wall, s along the normal of another one.
Real lever(const WallCornerTables& corners, const Depths& d, int k, int other) {
  const Real out = corners.moment(d[k], d[other]);
  return d.walls < 3 ? out : out - corners.moment(d[k], d[other], d[3 - k - other]);
}

/// int W dV behind the walls.
Real behind(const WallTables& planes, const WallCornerTables& corners, const Depths& d) {
  Real out = 0;
  for (int k = 0; k < d.walls; ++k) out += planes.behind(d[k]);
  for (int k = 0; k < d.walls; ++k)
    for (int l = k + 1; l < d.walls; ++l) out -= corners.behind(d[k], d[l]);
  return d.walls < 3 ? out : out + corners.behind(d[0], d[1], d[2]);
}

}  // namespace

Real WallSupport::friction_coefficient(const Particles& p, Index i, Index face, const Vec& wall) const {
  const WallFriction& law = friction_of(face);
  if (!law.log_law) return law.cf;
  const Vec n = surface_->away(face, p.x.vec(i)), u = p.v.vec(i) - wall, along = u - u.dot(n) * n;
  const Real speed = along.norm(), nu = mu_.empty() ? 0 : mu_[p.part[i]] / p.rho[i];
  const Real y = std::max(surface_->distance(face, p.x.vec(i)), least_y_);
  const Real u_star = friction_velocity(speed, y, nu, law.ks);
  return speed > 0 ? 2 * power<2>(u_star / speed) : 0;
}

WallSupport::Sums WallSupport::sums_over_points(const Particles& p, Index i, Real half_step) const {
  const Real h = p.h[i];
  const Vec x = p.x.vec(i), v = p.v.vec(i);
  Sums s;
  // including walls in sight half a step ago
  const Real within = any_moves_ ? surface_->reach() : sight(p, i) + std::abs(half_step) * v.norm();
  for_each_seen(p, i, within, [&](const WallPoint& q, const Vec& away) {
    const Vec d = q.x - x, u = v - q.v;
    const Real W = kernel(h, d), before = kernel(h, d + half_step * u), behind = volume_behind(h, d, away);
    s.slope += away * W;
    s.squeeze += u.dot(away) * before;
    s.fill += behind;
    const Vec slide = slide_ ? belt_velocity(q) : Vec(Vec::Zero()), wall = q.v + slide;
    const Real rubbing = rubs_ ? friction_coefficient(p, i, q.face, wall) * away.norm() * W : 0;
    s.rubbing += rubbing;
    if (velocity_) s.wall_velocity += rubbing * wall;
    if (slide_) s.wall_slide += rubbing * slide;
    if (!moment_) return;
    s.moment += W * d * away.transpose();
    s.gradient += before * (u * away.transpose() + away * u.transpose());
  });
  if (s.rubbing > 0) s.wall_velocity /= s.rubbing, s.wall_slide /= s.rubbing;
  if (moment_) s.moment = 0.5 * (s.moment + s.moment.transpose().eval()) + s.fill * Matrix::Identity();
  return s;
}

WallSupport::Sums WallSupport::sums_over_plane(const Particles& p, Index i, Index face,
                                               Real half_step) const {
  const Real h = p.h[i];
  const Vec x = p.x.vec(i), v = p.v.vec(i);
  const Vec away = surface_->away(face, x);
  const Real d = surface_->distance(face, x), W = table_.plane(d / h) / h;
  const Real before = table_.plane(surface_->distance(face, x - half_step * v) / h) / h;
  Sums s{.slope = W * away,
         .squeeze = before * v.dot(away),
         .fill = table_.behind(d / h),
         .rubbing = rubs_ ? friction_coefficient(p, i, face, Vec::Zero()) * W : 0};
  if (!moment_) return s;
  s.moment = d * W * away * away.transpose() + s.fill * Matrix::Identity();
  s.gradient = before * (v * away.transpose() + away * v.transpose());
  return s;
}

/// Part of the kernel's integral in the shadow of a wall point. Closer than the point spacing, r is
/// measured to the edge of the piece.
Real WallSupport::volume_behind(Real h, const Vec& d, const Vec& away) const {
  const Real r = std::max(d.norm(), 0.3 * h / points_per_h), R = r / h;
  return away.dot(d) / power<2>(r) * table_.tail(R) / (dim_ == 2 ? 1 : r);
}

WallSupport::Sums WallSupport::sums_in_sub_domain(const Particles& p, Index i, const WallSubDomain& domain,
                                                  Real half_step) const {
  const Real h = p.h[i];
  const Vec x = p.x.vec(i), v = p.v.vec(i);
  const Depths now(domain, x, h), earlier(domain, x - half_step * v, h);
  Sums s;
  s.fill = behind(table_, *corners_, now);
  for (int k = 0; k < domain.walls; ++k) {
    const Vec away = -normal(domain, k);
    const Real W = whole(table_, *corners_, now, k) / h, before = whole(table_, *corners_, earlier, k) / h;
    s.slope += W * away;
    s.squeeze += before * v.dot(away);
    if (rubs_) s.rubbing += friction_coefficient(p, i, domain.face[k], Vec::Zero()) * W;
    if (!moment_) continue;
    s.moment += now[k] * h * W * away * away.transpose();
    for (int l = 0; l < domain.walls; ++l)
      if (l != k) s.moment += lever(*corners_, now, k, l) * normal(domain, l) * away.transpose();
    s.gradient += before * (v * away.transpose() + away * v.transpose());
  }
  if (moment_) s.moment = 0.5 * (s.moment + s.moment.transpose().eval()) + s.fill * Matrix::Identity();
  return s;
}

/// Shear stress over viscosity and velocity by all no-slip walls of the sub-domain.
Real WallSupport::hold_in_sub_domain(const Particles& p, Index i, const WallSubDomain& domain) const {
  const Depths depths(domain, p.x.vec(i), p.h[i]);
  Real out = 0;
  for (int k = 0; k < domain.walls; ++k)
    if (friction_of(domain.face[k]).no_slip)
      out += 2 * whole(table_, *corners_, depths, k) / (p.h[i] * std::max(depths[k] * p.h[i], least_y_));
  return out;
}

}  // namespace courant
