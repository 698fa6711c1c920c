// Gauges of a run: the particles near each of them, from the cells of the neighbour search, and their values.
#include <algorithm>
#include <cmath>

#include "gauges/gauge.hpp"
#include "parallel/parallel.hpp"

namespace courant {

Real GaugeView::weight(Index i, Real r) const {
  const Real h = world.particles.h[i];
  if (r >= reach(i)) return 0;
  return with_kernel(kernel, [&](auto k) {
    return decltype(k)::C(world.dim) * k.shape(Real(r / h)) / (world.dim == 2 ? h * h : h * h * h);
  });
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

}  // namespace

std::vector<NearParticle> particles_near(const GaugeView& view, const Neighbours& neighbours,
                                         std::span<const GaugeBox> boxes) {
  std::vector<NearParticle> near;
  for (const Vec& shift : shifts_of(view.periodic)) {
    const auto first = static_cast<std::ptrdiff_t>(near.size());
    for (const GaugeBox& box : boxes)
      neighbours.active_near(box.low - shift, box.high - shift, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
          if (const Vec x = view.position(i) + shift; box.distance(x) < view.reach(i)) near.push_back({i, x});
      });
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
  const GaugeView view{world, kernel_, bodies, forces, loads_.at(clock.t), periodic_};
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
