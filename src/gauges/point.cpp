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
    const Sums sums = with_kernel(view.kernel, [&](auto kernel) {
      return view.world.dim == 2 ? summed<2>(kernel, view, near, x) : summed<3>(kernel, view, near, x);
    });
    out[0] = sums.wet ? 1 : 0;
    if (sums.wet) finish(sums, view.world.dim, out);
    if (body_ >= 0) out.insert(out.end(), {x.x(), x.y(), x.z()});
    return out;
  }

 private:
  /// Over particles, w = V W and q = (1, d/h) with d from the point to the particle. A field is linear in the
  /// coefficients of its base, so one loop has the sums for both.
  struct Sums {
    bool wet = false;
    std::array<std::array<Real, 4>, 4> A{};  ///< w q q^T, its lower part
    std::array<std::array<Real, 4>, 4> f{};  ///< w q times velocity (0 to 2) and density (3)
    Real pressure = 0;                       ///< w (p - rho g . d)
  };
  Vec position(const GaugeView& view) const {
    if (body_ < 0) return view.flat(point_);
    const RigidBodyMotion& body = view.bodies[static_cast<std::size_t>(body_)];
    return view.flat(body.x + body.axes * local_);
  }
  /// Wet: the point is within the cell of some particle: half the diagonal of a cube, and a little for
  /// particles that are not on a lattice; or in a gap between particles that surround it: sum V W, 0.5 at a
  /// surface, is larger there.
  template <int dim, class Kernel>
  static Sums summed(Kernel kernel, const GaugeView& view, std::span<const NearParticle> near, const Vec& x) {
    const Real half = 1.15 * 0.5 * std::sqrt(Real(dim));            // of the spacing
    const Real cell = dim == 2 ? half * half : half * half * half;  // of the volume
    constexpr Real surrounded = 0.65;
    const Particles& p = view.world.particles;
    const Real *m = p.m.data(), *rho = p.rho.data(), *h = p.h.data(), *pressure = p.p.data();
    const std::array v{p.v.data(0), p.v.data(1), p.v.data(2)};
    const Vec everywhere = view.loads.everywhere();
    Sums sums;
    for (const auto& [i, at] : near) {
      const Vec d = at - x;
      const Real r = d.norm(), V = m[i] / rho[i], w = V * view.weight_of(kernel, i, r);
      if (w == 0) continue;
      sums.wet = sums.wet || (dim == 2 ? r * r : r * r * r) <= cell * V;
      const Vec g = view.uniform_loads ? everywhere : view.loads(at, p.part[i]);
      sums.pressure += w * (pressure[i] - rho[i] * g.dot(d));
      const Real per_h = 1 / h[i];
      std::array<Real, dim + 1> q{1};
      for (int k = 0; k < dim; ++k) q[static_cast<std::size_t>(k + 1)] = d[k] * per_h;
      for (std::size_t k = 0; k <= dim; ++k) {
        const Real wq = w * q[k];
        for (std::size_t c = 0; c <= k; ++c) sums.A[k][c] += wq * q[c];
        for (std::size_t c = 0; c < 3; ++c) sums.f[c][k] += wq * v[c][i];
        sums.f[3][k] += wq * rho[i];
      }
    }
    sums.wet = sums.wet || sums.A[0][0] > surrounded;
    return sums;
  }
  /// Shepard's 1/sum where a linear base has too few particles.
  static void finish(const Sums& sums, int dim, std::vector<Real>& out) {
    const auto n = static_cast<std::size_t>(dim + 1);
    SmallSystem system{.n = dim + 1, .A = sums.A};
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = r + 1; c < n; ++c) system.A[r][c] = sums.A[c][r];
    std::array<Real, 4> b{};
    if (!system.solve(b)) b = {1 / sums.A[0][0], 0, 0, 0};
    out[1] = sums.pressure / sums.A[0][0];
    for (std::size_t k = 0; k < 4; ++k) {
      out[2 + k] = 0;
      for (std::size_t r = 0; r < n; ++r) out[2 + k] += b[r] * sums.f[k][r];
    }
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
