// Which particles are near which gauges: one walk over all particles, whatever the number of gauges.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

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

/// Cells of a grid, each with the gauges that some box of theirs touches.
class GaugeCells {
 public:
  GaugeCells(const std::vector<std::vector<GaugeBox>>& boxes, Real reach, int dim) : dim_(dim) {
    Vec high = Vec::Constant(-std::numeric_limits<Real>::infinity());
    low_ = -high;
    for (const auto& of_gauge : boxes)
      for (const GaugeBox& box : of_gauge)
        low_ = low_.cwiseMin(grown(box, reach).low), high = high.cwiseMax(grown(box, reach).high);
    if (!(low_.array() <= high.array()).all()) return;
    choose_size(high - low_, reach);
    gauges_.resize(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]));
    for (std::size_t g = 0; g < boxes.size(); ++g)
      for (const GaugeBox& box : boxes[g]) note(g, grown(box, reach));
  }
  bool empty() const { return gauges_.empty(); }
  const std::vector<std::size_t>& at(const Vec& x) const {
    static const std::vector<std::size_t> none;
    std::array<std::int64_t, 3> c{0, 0, 0};
    for (int k = 0; k < dim_; ++k) {
      const Real at = (x[k] - low_[k]) / size_;
      if (!(at >= 0 && at < static_cast<Real>(n_[static_cast<std::size_t>(k)]))) return none;
      c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(at);
    }
    return gauges_[index(c)];
  }

 private:
  static GaugeBox grown(const GaugeBox& box, Real by) {
    return {box.low - Vec::Constant(by), box.high + Vec::Constant(by)};
  }
  // Many cells where gauges are close together; coarser ones where they are spread over a large scene.
  void choose_size(const Vec& extent, Real reach) {
    constexpr Real most = 1 << 20;
    Real cells = 0;
    for (size_ = 0.5 * reach;; size_ *= 1.5) {
      cells = 1;
      for (int k = 0; k < dim_; ++k) cells *= std::floor(extent[k] / size_) + 1;
      if (cells <= most) break;
    }
    for (int k = 0; k < dim_; ++k)
      n_[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(extent[k] / size_)) + 1;
  }
  std::size_t index(const std::array<std::int64_t, 3>& c) const {
    return static_cast<std::size_t>((c[2] * n_[1] + c[1]) * n_[0] + c[0]);
  }
  void note(std::size_t gauge, const GaugeBox& box) {
    std::array<std::int64_t, 3> from{0, 0, 0}, to{0, 0, 0};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim_); ++k) {
      const auto a = static_cast<Index>(k);
      from[k] = std::clamp<std::int64_t>(cell(box.low[a] - low_[a]), 0, n_[k] - 1);
      to[k] = std::clamp<std::int64_t>(cell(box.high[a] - low_[a]), 0, n_[k] - 1);
    }
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
        for (std::int64_t x = from[0]; x <= to[0]; ++x) {
          auto& here = gauges_[index({x, y, z})];
          if (here.empty() || here.back() != gauge) here.push_back(gauge);
        }
  }
  std::int64_t cell(Real distance) const { return static_cast<std::int64_t>(std::floor(distance / size_)); }

  int dim_;
  Vec low_ = Vec::Zero();
  Real size_ = 1;
  std::array<std::int64_t, 3> n_{1, 1, 1};
  std::vector<std::vector<std::size_t>> gauges_;
};

std::vector<std::vector<Index>> NearParticles::find(const GaugeView& view,
                                                    std::vector<std::vector<GaugeBox>> boxes) {
  std::vector<std::vector<Index>> near(boxes.size());
  const Index n = view.world.particles.active;
  if (n == 0) return near;
  const Real reach = maximum(n, [&](Index i) { return view.reach(i); });
  if (!cells_ || boxes != boxes_ || reach != reach_) {
    boxes_ = std::move(boxes), reach_ = reach;
    cells_ = std::make_shared<const GaugeCells>(boxes_, reach_, view.world.dim);
  }
  const GaugeCells& cells = *cells_;
  if (cells.empty()) return near;
  std::vector<std::pair<std::size_t, Index>> found;
  collect(n, found, [&](Index begin, Index end, std::vector<std::pair<std::size_t, Index>>& to) {
    for (Index i = begin; i < end; ++i)
      for (const std::size_t gauge : cells.at(view.world.particles.x.vec(i))) to.emplace_back(gauge, i);
  });
  for (const auto& [gauge, i] : found) near[gauge].push_back(i);
  return near;
}

std::vector<GaugeSample> Gauges::measure(World& world, const Clock& clock,
                                         const std::vector<RigidBodyMotion>& bodies,
                                         const std::vector<std::size_t>& which) const {
  std::vector<PointForce> forces;
  if (std::any_of(which.begin(), which.end(), [&](std::size_t k) { return gauges_[k]->takes_forces(); }))
    for (auto* reporter : world.passes.all<PointForceReporter>())
      reporter->report_point_forces(world, [&](const PointForce& one) { forces.push_back(one); });
  const GaugeView view{world, kernel_, bodies, forces, loads_.at(clock.t)};
  std::vector<std::vector<GaugeBox>> boxes(which.size());
  for (std::size_t k = 0; k < which.size(); ++k) gauges_[which[k]]->cover(view, boxes[k]);
  const auto near = near_.find(view, std::move(boxes));
  std::vector<GaugeSample> out(which.size());
  for_each(static_cast<Index>(which.size()), [&](Index k) {
    const auto n = static_cast<std::size_t>(k);
    out[n] = {which[n], gauges_[which[n]]->measure(view, near[n])};
  });
  return out;
}

}  // namespace courant
