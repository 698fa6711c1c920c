#include "post/free_surface.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

Real cubic_spline(Real r, Real h, int dim) {
  const Real q = r / h;
  const Real norm = dim == 2 ? 10 / (7 * pi * h * h) : 1 / (pi * h * h * h);
  if (q >= 2) return 0;
  return norm * (q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : 0.25 * (2 - q) * (2 - q) * (2 - q));
}

FreeSurface::FreeSurface(const ParticleFrame& frame, Real x_from, Real x_to) : frame_(frame) {
  for (Real h : frame.h) h_max_ = std::max(h_max_, h);
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.x[i] > x_from - 2 * h_max_ && frame.x[i] < x_to + 2 * h_max_) by_x_.push_back(i);
  std::sort(by_x_.begin(), by_x_.end(), [&](std::size_t a, std::size_t b) {
    return frame.x[a] != frame.x[b] ? frame.x[a] < frame.x[b] : frame.y[a] < frame.y[b];
  });
}

Real FreeSurface::depth(Real x, Real bed, Real z) const {
  const ParticleFrame& f = frame_;
  const auto less = [&](std::size_t i, Real at) { return f.x[i] < at; };
  const auto begin = std::lower_bound(by_x_.begin(), by_x_.end(), x - 2 * h_max_, less);
  const auto end = std::lower_bound(begin, by_x_.end(), x + 2 * h_max_, less);
  if (begin == end) return 0;
  Real top = bed;
  for (auto i = begin; i != end; ++i) top = std::max(top, f.y[*i]);

  const Real dy = h_max_ / 16;
  std::vector<Real> C(static_cast<std::size_t>(std::ceil((top + 2 * h_max_ - bed) / dy)) + 2, 0.0);
  for (auto i = begin; i != end; ++i) {
    const Real dz = f.dim == 3 ? f.z[*i] - z : 0;
    const Real aside = std::hypot(f.x[*i] - x, dz), h = f.h[*i];
    if (aside >= 2 * h) continue;
    const auto first =
        static_cast<std::ptrdiff_t>(std::max<Real>(0, std::ceil((f.y[*i] - 2 * h - bed) / dy)));
    const auto last = static_cast<std::ptrdiff_t>(std::floor((f.y[*i] + 2 * h - bed) / dy));
    for (std::ptrdiff_t k = first; k <= last; ++k)
      C[static_cast<std::size_t>(k)] +=
          f.V[*i] * cubic_spline(std::hypot(aside, bed + static_cast<Real>(k) * dy - f.y[*i]), h, f.dim);
  }

  std::size_t k = 0;
  while (k <= 32 && k < C.size() && C[k] < 0.5) ++k;  // into the water, at most 2h above the bed
  if (k > 32 || k >= C.size()) return 0;
  while (C[k] >= 0.5) ++k;  // ends: the last two are 0, above all particles
  const Real part = (C[k - 1] - 0.5) / (C[k - 1] - C[k]);
  return (static_cast<Real>(k - 1) + part) * dy;
}

}  // namespace courant
