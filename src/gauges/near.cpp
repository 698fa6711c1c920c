// Gauges of a run: the particles near each of them, from the cells of the neighbour search, and their values.
#include <algorithm>
#include <array>
#include <cmath>

#include "gauges/gauge.hpp"
#include "parallel/parallel.hpp"

namespace courant {

Real GaugeView::weight(Index i, Real r) const {
  return with_kernel(kernel, [&](auto k) { return weight_of(k, i, r); });
}

Real GaugeView::spacing(Index i) const {
  const Real V = volume(i);
  return world.dim == 2 ? std::sqrt(V) : std::cbrt(V);
}

void GaugeLine::cover(Real piece, std::vector<GaugeBox>& boxes) const {
  constexpr Real most = 10000;
  const Real pieces = std::clamp<Real>(std::ceil(length() / piece), 1, most);
  for (Real k = 0; k < pieces; k += 1) {
    const Vec a = at(k / pieces * length()), b = at((k + 1) / pieces * length());
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
}

namespace {

/// By which particles are moved to be beside a gauge: none, and those of periodic planes.
std::vector<Vec> shifts_of(std::span<const GhostPlane> periodic) {
  std::vector<Vec> out{Vec::Zero()};
  for (const GhostPlane& plane : periodic)
    for (std::size_t k = out.size(); k-- > 0;)
      for (const Real side : {-1.0, 1.0}) out.push_back(out[k] + side * plane.period * plane.normal);
  return out;
}

/// Appends those of [begin, end), moved by `shift`, whose kernels reach the box. The distances of a pack are
/// found in one loop over plain arrays, as few particles of the cells are near enough.
void add_near(const GaugeView& view, const GaugeBox& box, const Vec& shift, Index begin, Index end,
              std::vector<NearParticle>& near) {
  constexpr Index pack = 64;
  const Particles& p = view.world.particles;
  const auto *x = p.x.data(0), *y = p.x.data(1), *z = p.x.data(view.world.dim == 2 ? 1 : 2), *h = p.h.data();
  const Real flat = view.world.dim == 2 ? 0 : 1, support = kernel_support(view.kernel);
  const Vec low = box.low - shift, high = box.high - shift;
  const auto beyond = [&](Real at, int axis) { return at - std::min(std::max(at, low[axis]), high[axis]); };
  std::array<Real, pack> left;  // squares of what the reach has beyond the distance [L2]
  for (Index first = begin; first < end; first += pack) {
    const Index n = std::min(pack, end - first);
    for (Index k = 0; k < n; ++k) {
      const Index i = first + k;
      const Real dx = beyond(x[i], 0), dy = beyond(y[i], 1), dz = beyond(flat * z[i], 2);
      const Real reach = support * h[i];
      left[static_cast<std::size_t>(k)] = reach * reach - dx * dx - dy * dy - dz * dz;
    }
    for (Index k = 0; k < n; ++k)
      if (left[static_cast<std::size_t>(k)] > 0)
        near.push_back({first + k, view.position(first + k) + shift});
  }
}

}  // namespace

std::vector<NearParticle> particles_near(const GaugeView& view, const Neighbours& neighbours,
                                         std::span<const GaugeBox> boxes) {
  constexpr std::size_t usual = 128;  // particles
  std::vector<NearParticle> near;
  near.reserve(usual);
  for (const Vec& shift : shifts_of(view.periodic)) {
    const auto first = static_cast<std::ptrdiff_t>(near.size());
    for (const GaugeBox& box : boxes)
      neighbours.active_near(box.low - shift, box.high - shift,
                             [&](Index begin, Index end) { add_near(view, box, shift, begin, end, near); });
    const auto before = [](const NearParticle& a, const NearParticle& b) { return a.i < b.i; };
    if (boxes.size() == 1 && std::is_sorted(near.begin() + first, near.end(), before)) continue;
    std::sort(near.begin() + first, near.end(), before);
    near.erase(std::unique(near.begin() + first, near.end(),
                           [](const NearParticle& a, const NearParticle& b) { return a.i == b.i; }),
               near.end());
  }
  return near;
}

std::vector<GaugeSample> Gauges::measure(World& world, const Clock& clock,
                                         const std::vector<RigidBodyMotion>& bodies,
                                         const std::vector<std::size_t>& which) const {
  std::vector<PointForce> forces;
  if (std::any_of(which.begin(), which.end(), [&](std::size_t k) { return gauges_[k]->takes_forces(); }))
    for (auto* reporter : world.passes.all<PointForceReporter>())
      reporter->report_point_forces(world, [&](const PointForce& one) { forces.push_back(one); });
  const GaugeView view{world, kernel_, bodies, forces, loads_.at(clock.t), loads_.uniform(), periodic_};
  std::vector<GaugeSample> out(which.size());
  constexpr std::size_t of_thread = 8;  // gauges that are worth a thread
  const auto shares = std::min(static_cast<std::size_t>(threads()), 1 + which.size() / of_thread);
  on_threads(static_cast<int>(shares), [&](int t) {
    std::vector<GaugeBox> boxes;
    for (auto k = static_cast<std::size_t>(t); k < which.size(); k += shares) {
      const Gauge& gauge = *gauges_[which[k]];
      boxes.clear();
      gauge.cover(view, boxes);
      const auto near = neighbours_ ? particles_near(view, *neighbours_, boxes) : std::vector<NearParticle>();
      out[k] = {which[k], gauge.measure(view, near)};
    }
  });
  return out;
}

}  // namespace courant
