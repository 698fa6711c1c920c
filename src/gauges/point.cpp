// Gauge at a point: sums with the run's kernel over the particles alone, so that walls and the air beyond a
// surface take no part.
// Pressure: Shepard's mean of what each particle has at the point if body loads alone change it in between,
//   p(x) = sum_i V_i W_i (p_i + rho_i g . (x - x_i)) / sum_i V_i W_i,
// exact for water at rest up to a wall. Rows at a wall are some per cent off by turns; a slope that is fitted
// to them carries that on to the wall, and more of it.
// Velocity and density: moving least squares, exact for linear fields up to a wall,
//   f(x) = sum_i w_i f_i, w_i = V_i W_i b . (1, (x_i - x)/h), b = A^-1 (1, 0, ...), A = sum V_i W_i q q^T
// Source: Belytschko, Krongauz, Organ, Fleming and Krysl, Comput. Methods Appl. Mech. Eng. 139 (1996), 2.2.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gauges/gauge.hpp"

namespace courant {

namespace {

/// A linear system of up to four equations with a symmetric positive matrix.
struct SmallSystem {
  int n = 0;
  std::array<std::array<Real, 4>, 4> A{};
  /// x of A x = (1, 0, ...); false where the particles lie (nearly) on a line or in a plane.
  bool solve(std::array<Real, 4>& x) {
    constexpr Real least_pivot = 5e-3;
    std::array<Real, 4> b{1, 0, 0, 0};
    const auto count = static_cast<std::size_t>(n);
    const Real scale = A[0][0];
    for (std::size_t k = 0; k < count; ++k) {
      if (!(A[k][k] > least_pivot * scale)) return false;
      for (std::size_t r = k + 1; r < count; ++r) {
        const Real f = A[r][k] / A[k][k];
        for (std::size_t c = k; c < count; ++c) A[r][c] -= f * A[k][c];
        b[r] -= f * b[k];
      }
    }
    for (std::size_t k = count; k-- > 0;) {
      for (std::size_t c = k + 1; c < count; ++c) b[k] -= A[k][c] * x[c];
      x[k] = b[k] / A[k][k];
    }
    return true;
  }
};

class PointGauge : public Gauge {
 public:
  PointGauge(GaugeLayout layout, Real interval, const Vec& point, int body, const RigidBodyMotion& start)
      : Gauge(std::move(layout), interval),
        point_(point),
        body_(body),
        local_(start.axes.transpose() * (point - start.x)) {}

  void cover(const GaugeView& view, std::vector<GaugeBox>& boxes) const override {
    const Vec x = position(view);
    boxes.push_back({x, x});
  }

  std::vector<Real> measure(const GaugeView& view, std::span<const NearParticle> near) const override {
    const Vec x = position(view);
    std::vector<Real> out(6, std::numeric_limits<Real>::quiet_NaN());
    bool wet = false;
    const std::vector<Seen> seen = look(view, near, x, wet);
    out[0] = wet ? 1 : 0;
    if (wet) sum_up(view, x, seen, out);
    if (body_ >= 0) out.insert(out.end(), {x.x(), x.y(), x.z()});
    return out;
  }

 private:
  struct Seen {
    Index i;
    Vec d;   ///< from the point to the particle [L]
    Real w;  ///< V W [-]
  };
  Vec position(const GaugeView& view) const {
    if (body_ < 0) return view.flat(point_);
    const RigidBodyMotion& body = view.bodies[static_cast<std::size_t>(body_)];
    return view.flat(body.x + body.axes * local_);
  }
  /// `wet`: whether the point is within the cell of some particle: half the diagonal of a cube, and a little
  /// for particles that are not on a lattice; or in a gap between particles that surround it: sum V W, 0.5
  /// at a surface, is larger there.
  static std::vector<Seen> look(const GaugeView& view, std::span<const NearParticle> near, const Vec& x,
                                bool& wet) {
    const Real half = 1.15 * 0.5 * std::sqrt(Real(view.world.dim));
    constexpr Real surrounded = 0.65;
    Real sum = 0;
    std::vector<Seen> seen;
    seen.reserve(near.size());
    for (const auto& [i, at] : near) {
      const Vec d = at - x;
      const Real r = d.norm();
      if (r >= view.reach(i)) continue;
      seen.push_back({i, d, view.volume(i) * view.weight(i, r)});
      sum += seen.back().w;
      wet = wet || r <= half * view.spacing(i);
    }
    wet = wet || sum > surrounded;
    return seen;
  }
  static void sum_up(const GaugeView& view, const Vec& x, const std::vector<Seen>& seen,
                     std::vector<Real>& out) {
    const Particles& p = view.world.particles;
    std::fill(out.begin() + 1, out.end(), Real(0));
    Real sum = 0;
    const std::array<Real, 4> b = coefficients(view, seen, sum);
    for (const auto& [i, d, w] : seen) {
      out[1] += w / sum * (p.p[i] - p.rho[i] * view.loads(x + d, p.part[i]).dot(d));
      const Real share = w * (b[0] + (b[1] * d.x() + b[2] * d.y() + b[3] * d.z()) / p.h[i]);
      for (int k = 0; k < 3; ++k) out[static_cast<std::size_t>(2 + k)] += share * p.v.data(k)[i];
      out[5] += share * p.rho[i];
    }
  }
  /// `sum`: of V W. Shepard's 1/sum where a linear base has too few particles.
  static std::array<Real, 4> coefficients(const GaugeView& view, const std::vector<Seen>& seen, Real& sum) {
    SmallSystem system{.n = view.world.dim + 1};
    for (const auto& [i, d, w] : seen) {
      const Real h = view.world.particles.h[i];
      const std::array<Real, 4> q{1, d.x() / h, d.y() / h, d.z() / h};
      for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) system.A[r][c] += w * q[r] * q[c];
    }
    std::array<Real, 4> b{};
    sum = system.A[0][0];
    if (!system.solve(b)) b = {1 / sum, 0, 0, 0};
    return b;
  }

  Vec point_;
  int body_;
  Vec local_;  ///< in the axes of the body [L]
};

}  // namespace

std::unique_ptr<Gauge> make_point_gauge(GaugeLayout layout, Real interval, const Vec& point, int body,
                                        const RigidBodyMotion& start) {
  layout.columns = {
      {"wet", "-", 1}, {"pressure", "M/LT2", 1}, {"velocity", "L/T", 3}, {"density", "M/L3", 1}};
  if (body >= 0) layout.columns.push_back({"position", "L", 3});
  return std::make_unique<PointGauge>(std::move(layout), interval, point, body, start);
}

}  // namespace courant
