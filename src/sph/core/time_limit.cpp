#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "parallel/parallel.hpp"
#include "sph/materials/dynamic_viscosity.hpp"
#include "sph/sph.hpp"
#include "state/particle_loops.hpp"

namespace courant {

namespace {

/// Eq. 18: dt = TSSFAC min h/(c + |v|), and with MU > 0 also dt <= 0.125 rho h^2 / MU (Morris et al. 1997). A
/// NaN anywhere comes out as the smallest, so that the run stops there.
class SphTimeLimit : public Reduction, public TimeLimit {
 public:
  SphTimeLimit(const SphSettings& s, const Model& model, World& world)
      : tssfac_(s.tssfac), viscosity_(s, world), region_(s.region) {
    for (const ModelPart& part : model.parts) part_ids_.push_back(part.id);
  }
  std::string name() const override { return "sph time step"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.h).reads(p.c).reads(p.v);
    viscosity_.declare(p, a);
    if (!viscosity_.none()) a.reads(p.rho);
  }
  void start(World& world, const Clock&) override { smallest_.resize(block_count(world.particles.active)); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Particles& p = world.particles;
    const Real* const v[3] = {p.v.data(0), p.v.data(1), p.v.data(2)};
    Real smallest = loops_.least_crossing(p.h.data(), p.c.data(), v, begin, end);
    if (!viscosity_.none())
      for (Index i = begin; i < end; ++i) smallest = std::min(smallest, viscous_limit(p, i));
    smallest_[begin / block_size] = smallest;
  }

  bool rings() const override { return false; }
  Limit limit(const World& world, const Clock&) override {
    const Particles& p = world.particles;
    std::size_t block = 0;
    for (std::size_t b = 1; b < smallest_.size(); ++b)
      if (!std::isnan(smallest_[block]) && !(smallest_[b] >= smallest_[block])) block = b;
    if (smallest_.empty()) return limit_of_waiting(p);
    const Real dt = smallest_[block];
    Index i = static_cast<Index>(block) * block_size;  // whose it is
    const Index end = std::min(i + block_size, p.active);
    const auto own = [&](Index k) {
      return std::min(p.h[k] / (p.c[k] + p.v.vec(k).norm()), viscous_limit(p, k));
    };
    while (i + 1 < end && !(own(i) <= dt * (1 + 1e-14)) && !std::isnan(own(i))) ++i;
    return {tssfac_ * dt, fmt::format("sph {} of part {}", p.id[i], part_ids_[p.part[i]])};
  }

 private:
  /// Nothing is active, but some may be on their way in: their own limit brings the run to them.
  Limit limit_of_waiting(const Particles& p) const {
    Limit out{std::numeric_limits<Real>::infinity(), "no active particle"};
    for (Index i = 0; i < p.size(); ++i)
      if (p.state[i] == particle_waiting || comes_in(p, i))
        out = {
            std::min(out.dt, tssfac_ * std::min(p.h[i] / (p.c[i] + p.v.vec(i).norm()), viscous_limit(p, i))),
            "entering particles"};
    return out;
  }
  bool comes_in(const Particles& p, Index i) const {
    return p.state[i] == particle_outside && region_ &&
           std::isfinite(region_->time_to_reach(p.x.vec(i), p.v.vec(i), 0));
  }
  Real viscous_limit(const Particles& p, Index i) const {
    if (viscosity_.none()) return std::numeric_limits<Real>::infinity();
    return 0.125 * p.rho[i] * p.h[i] * p.h[i] / viscosity_.of(p, i);
  }
  ParticleLoops loops_ = particle_loops();
  Real tssfac_;
  DynamicViscosity viscosity_;
  std::optional<Region> region_;
  std::vector<Id> part_ids_;
  std::vector<Real> smallest_;  ///< of each block [T]
};

/// MAXV: faster particles are switched off (> 0) or slowed to the limit (< 0); both are counted, and the
/// energy that slowing takes is dissipated.
class SpeedLimit : public Constraint {
 public:
  SpeedLimit(const SphSettings& s, std::shared_ptr<Neighbours> neighbours)
      : maxv_(s.maxv), neighbours_(std::move(neighbours)) {}
  std::string name() const override { return "speed limit MAXV"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.in_finish().reads(p.m).revises(p.v).revises(p.f).updates(p.state);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock&) override {
    Particles& p = world.particles;
    const Real limit = std::abs(maxv_);
    const Real fastest = maximum(p.active, [&](Index i) { return p.v.vec(i).squaredNorm(); });
    if (!(fastest > limit * limit)) return;
    for (Index i = 0; i < p.active; ++i) {
      const Real speed = p.v.vec(i).norm();
      if (!(speed > limit)) continue;
      if (maxv_ < 0) {
        const Real taken = 0.5 * p.m[i] * (speed * speed - limit * limit);
        world.energy.dissipated += taken;
        world.energy.throughput += taken;
        p.v.set(i, p.v.vec(i) * (limit / speed));
        ++world.counters["speed_clipped"];
      } else {
        p.state[i] = particle_deactivated;
        p.f.set(i, Vec::Zero());
        ++world.counters["deactivated_by_maxv"];
        neighbours_->force_refresh();
      }
    }
  }

 private:
  Real maxv_;
  std::shared_ptr<Neighbours> neighbours_;
};

}  // namespace

void add_sph_time_limit(const SphSettings& s, const Model& model, World& world) {
  world.passes.add(std::make_shared<SphTimeLimit>(s, model, world));
}
std::shared_ptr<Constraint> make_speed_limit(const SphSettings& s, std::shared_ptr<Neighbours> neighbours) {
  return std::make_shared<SpeedLimit>(s, std::move(neighbours));
}

}  // namespace courant
