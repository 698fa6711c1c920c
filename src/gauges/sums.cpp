// Gauges that are sums: what flows through an area, and what acts on faces.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gauges/gauge.hpp"

namespace courant {

namespace {

/// Each particle whose projection is within the area counts with its flow, times the run's kernel in one
/// dimension across the area:
///   Q = sum_i V_i (v_i . n) W1(d_i), d_i the distance from the plane.
/// The integral of W1 over the path of a particle is 1, so the sum over time is the volume of the particles
/// that went through, whatever the lattice.
class FluxGauge : public Gauge {
 public:
  FluxGauge(GaugeLayout layout, Real interval, int dim, const Vec& corner, const Vec& edge1, const Vec& edge2)
      : Gauge(std::move(layout), interval),
        corner_(corner),
        edge1_(edge1),
        edge2_(dim == 2 ? Vec::UnitZ() : edge2),
        normal_(edge1_.cross(edge2_).normalized()),
        in_plane_(dim == 2) {
    Matrix columns;
    columns << edge1_, edge2_, normal_;
    local_ = columns.inverse();
  }

  void cover(const GaugeView& view, std::vector<GaugeBox>& boxes) const override {
    const Index n = view.world.particles.active;
    const Real piece = n > 0 ? 2 * view.reach(0) : edge1_.norm();
    const auto pieces = [&](const Vec& edge) {
      return std::clamp<Real>(std::ceil(edge.norm() / piece), 1, 1000);
    };
    const Real a = pieces(edge1_), b = in_plane_ ? 1 : pieces(edge2_);
    for (Real i = 0; i < a; i += 1)
      for (Real j = 0; j < b; j += 1) {
        GaugeBox box{Vec::Constant(std::numeric_limits<Real>::infinity()),
                     Vec::Constant(-std::numeric_limits<Real>::infinity())};
        for (const Real u : {i / a, (i + 1) / a})
          for (const Real v : {j / b, (j + 1) / b}) {
            const Vec x = corner_ + u * edge1_ + (in_plane_ ? Vec(Vec::Zero()) : Vec(v * edge2_));
            box.low = box.low.cwiseMin(x), box.high = box.high.cwiseMax(x);
          }
        boxes.push_back(box);
      }
  }

  std::vector<Real> measure(const GaugeView& view, std::span<const NearParticle> near) const override {
    const Particles& p = view.world.particles;
    Real area = 0, volume = 0, mass = 0, pressure = 0, energy = 0;
    Vec momentum = Vec::Zero();
    for (const auto& [i, x] : near) {
      const Vec at = local_ * (x - corner_);
      if (!(at[0] >= 0 && at[0] < 1) || (!in_plane_ && !(at[1] >= 0 && at[1] < 1))) continue;
      const Real across = weight_across(view, i, std::abs(at[2]));
      if (across == 0) continue;
      const Vec v = p.v.vec(i);
      const Real part = view.volume(i) * across, speed = v.dot(normal_);
      area += part;
      volume += part * speed;
      mass += p.m[i] * across * speed;
      momentum += p.m[i] * across * speed * v;
      pressure += part * p.p[i];
      energy += (0.5 * p.m[i] * across * v.squaredNorm() + part * p.p[i]) * speed;
    }
    return {area, volume, mass, momentum.x(), momentum.y(), momentum.z(), pressure, energy};
  }

 private:
  static Real weight_across(const GaugeView& view, Index i, Real distance) {
    const Real h = view.world.particles.h[i];
    return with_kernel(view.kernel,
                       [&](auto k) { return decltype(k)::C(1) * k.shape(Real(distance / h)) / h; });
  }

  Vec corner_, edge1_, edge2_, normal_;
  bool in_plane_;
  Matrix local_;  ///< position less `corner_` to shares of the edges and the distance from the plane
};

class ForceGauge : public Gauge {
 public:
  ForceGauge(GaugeLayout layout, Real interval, std::vector<char> faces, const Vec& centre,
             const World& world)
      : Gauge(std::move(layout), interval),
        faces_(std::move(faces)),
        nodes_(static_cast<std::size_t>(world.nodes.size()), 0),
        centre_(centre) {
    for (Index s = 0; s < world.segments.size(); ++s)
      if (faces_[static_cast<std::size_t>(s)])
        for (const Index n : world.segments.nodes(s)) nodes_[static_cast<std::size_t>(n)] = 1;
  }
  void cover(const GaugeView&, std::vector<GaugeBox>&) const override {}
  bool takes_forces() const override { return true; }
  std::vector<Real> measure(const GaugeView& view, std::span<const NearParticle>) const override {
    Vec force = Vec::Zero(), moment = Vec::Zero();
    for (const PointForce& one : view.forces) {
      const bool counts = one.segment >= 0 ? faces_[static_cast<std::size_t>(one.segment)] != 0
                                           : nodes_[static_cast<std::size_t>(one.node)] != 0;
      if (!counts) continue;
      force += one.force;
      moment += view.flat(one.point - centre_).cross(one.force);
    }
    return {force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z()};
  }

 private:
  std::vector<char> faces_, nodes_;  ///< whether each counts
  Vec centre_;
};

}  // namespace

std::unique_ptr<Gauge> make_flux_gauge(GaugeLayout layout, Real interval, int dim, const Vec& first,
                                       const Vec& second, const Vec& third) {
  layout.columns = {{"area", "L2", 1},        {"volume", "L3/T", 1},          {"mass", "M/T", 1},
                    {"momentum", "ML/T2", 3}, {"pressure_force", "ML/T2", 1}, {"energy", "ML2/T3", 1}};
  return std::make_unique<FluxGauge>(std::move(layout), interval, dim, first, second - first, third - first);
}

std::unique_ptr<Gauge> make_force_gauge(GaugeLayout layout, Real interval, std::vector<char> faces,
                                        const Vec& centre, const World& world) {
  layout.columns = {{"force", "ML/T2", 3}, {"moment", "ML2/T2", 3}};
  return std::make_unique<ForceGauge>(std::move(layout), interval, std::move(faces), centre, world);
}

}  // namespace courant
