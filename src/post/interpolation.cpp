#include "post/interpolation.hpp"

#include <cmath>
#include <Eigen/LU>

#include "post/free_surface.hpp"

namespace courant {
namespace {

/// Turns V W into V W (a . p), p = (1, (x_j - x)/h, ...), so that sums of linear fields are exact. Returns
/// false where the moments do not allow it.
template <int n>
bool make_linear(const ParticleGrid& grid, const Point& x, PointWeights& weights) {
  using Moments = Eigen::Matrix<Real, n, n>;
  using Base = Eigen::Matrix<Real, n, 1>;
  const Real scale = 1 / grid.largest_h();
  const auto base = [&](std::size_t k) {
    Base p;
    p[0] = 1;
    for (int a = 1; a < n; ++a)
      p[a] = (grid.particles()[k].x[static_cast<std::size_t>(a - 1)] - x[static_cast<std::size_t>(a - 1)]) *
             scale;
    return p;
  };
  Moments M = Moments::Zero();
  for (const auto& [k, w] : weights.of) {
    const Base p = base(k);
    M += w * p * p.transpose();
  }
  constexpr Real least_rcond = 1e-4;  // particles in a line, or on one side only of a thin sheet
  const Moments inverse = M.inverse();
  const auto norm = [](const Moments& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); };
  if (!(norm(M) * norm(inverse) < 1 / least_rcond)) return false;
  const Base a = inverse.col(0);
  for (auto& [k, w] : weights.of) w *= a.dot(base(k));
  return true;
}

}  // namespace

PointWeights interpolate(const ParticleGrid& grid, const Point& x, Interpolation kind) {
  PointWeights out;
  grid.near(x, [&](std::size_t k) {
    const ParticleGrid::Particle& p = grid.particles()[k];
    const Real dz = grid.dim() == 3 ? p.x[2] - x[2] : 0;  // in the plane, z does not matter
    const Real r = std::hypot(p.x[0] - x[0], p.x[1] - x[1], dz);
    if (r >= 2 * p.h) return;
    const Real w = p.V * cubic_spline(r, p.h, grid.dim());
    if (!(w > 0)) return;
    out.of.emplace_back(k, w);
    out.colour += w;
  });
  if (out.of.empty()) return out;
  if (kind == Interpolation::mls) {
    if (grid.dim() == 2 ? make_linear<3>(grid, x, out) : make_linear<4>(grid, x, out)) return out;
    out.fallback = true;
  }
  for (auto& [k, w] : out.of) w /= out.colour;
  return out;
}

Real weighted(const ParticleGrid& grid, const PointWeights& weights, const std::vector<Real>& values) {
  Real sum = 0;
  for (const auto& [k, w] : weights.of) sum += w * values[grid.particles()[k].row];
  return sum;
}

}  // namespace courant
