#include "post/water_body.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "post/free_surface.hpp"

namespace courant {
namespace {

/// Union-find with halved paths.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

Real distance(const Point& a, const Point& b, int dim) {
  return std::hypot(a[0] - b[0], a[1] - b[1], dim == 3 ? a[2] - b[2] : 0);
}

}  // namespace

ParticleGrid water_body(const ParticleGrid& all, const SprayRule& rule) {
  const auto& p = all.particles();
  Groups groups(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    all.near(p[i].x, [&](std::size_t j) {
      if (j > i && distance(p[i].x, p[j].x, all.dim()) < rule.link * 0.5 * (p[i].h + p[j].h))
        groups.join(i, j);
    });
  std::vector<Real> volume(p.size(), 0);
  Real total = 0;
  for (std::size_t i = 0; i < p.size(); ++i) volume[groups.find(i)] += p[i].V, total += p[i].V;
  const Real largest = p.empty() ? 0 : *std::max_element(volume.begin(), volume.end());
  const Real least = std::min(largest, rule.share * total);
  std::vector<char> taken(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) taken[i] = volume[groups.find(i)] >= least;
  return ParticleGrid(all, taken);
}

std::vector<WaterInterval> water_on_line(const ParticleGrid& water, const Point& x, std::size_t axis,
                                         Real* filled) {
  if (filled) *filled = 0;
  std::vector<std::pair<std::size_t, Real>> near;  // particle, distance from the line
  Real low = 0, high = 0;
  water.near_line(x, axis, [&](std::size_t k) {
    const ParticleGrid::Particle& p = water.particles()[k];
    Point foot = p.x;
    foot[axis] = x[axis];
    const Real aside = distance(foot, x, axis == 2 ? 3 : water.dim());
    if (aside >= 2 * p.h) return;
    if (near.empty()) low = high = p.x[axis];
    low = std::min(low, p.x[axis]), high = std::max(high, p.x[axis]);
    near.emplace_back(k, aside);
  });
  if (near.empty()) return {};

  const Real dy = water.largest_h() / 16, start = low - 2 * water.largest_h() - dy;
  std::vector<Real> C(static_cast<std::size_t>(std::ceil((high - start + 2 * water.largest_h()) / dy)) + 2,
                      0.0);
  for (const auto& [k, aside] : near) {
    const ParticleGrid::Particle& p = water.particles()[k];
    const Real reach = std::sqrt(4 * p.h * p.h - aside * aside), at = p.x[axis] - start;
    const auto first = static_cast<std::size_t>(std::ceil((at - reach) / dy));
    const auto last = std::min(C.size() - 1, static_cast<std::size_t>(std::floor((at + reach) / dy)));
    for (std::size_t s = first; s <= last; ++s)
      C[s] += p.V * cubic_spline(std::hypot(aside, static_cast<Real>(s) * dy - at), p.h, water.dim());
  }

  if (filled) *filled = dy * std::accumulate(C.begin(), C.end(), Real(0));
  std::vector<WaterInterval> out;
  const auto crossing = [&](std::size_t s) {  // between s - 1 and s
    return start + (static_cast<Real>(s - 1) + (0.5 - C[s - 1]) / (C[s] - C[s - 1])) * dy;
  };
  for (std::size_t s = 1; s < C.size(); ++s) {
    if (C[s - 1] < 0.5 && C[s] >= 0.5) out.push_back({crossing(s), 0});
    if (C[s - 1] >= 0.5 && C[s] < 0.5) {
      out.back().high = crossing(s);
      if (out.back().high - out.back().low < 0.5 * water.largest_h()) out.pop_back();
    }
  }
  return out;
}

}  // namespace courant
