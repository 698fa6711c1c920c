#include "sph/options/drift.hpp"

#include <algorithm>
#include <cmath>

#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/sph.hpp"
#include "state/shared_fields.hpp"

namespace courant {

Drift::Drift(DriftRules rules, std::vector<GhostPlane> mirrors, BodyAcceleration loads, World& world)
    : rules_(std::move(rules)),
      mirrors_(std::move(mirrors)),
      loads_(std::move(loads)),
      velocity_(drift_velocity(world.particles, rules_.statistics)),
      drifted_(sph_fields::drifted(world.particles)),
      near_wall_(shared_fields::near_wall.add(world.particles.fields)) {
  Particles& p = world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    velocity_.set(i, Vec::Zero());
    drifted_.set(i, Vec::Zero());
    near_wall_[i] = 0;
  }
  if (rules_.correct) {
    for (int k = 0; k < 3; ++k) {
      velocity_gradient_[k] = &sph_fields::velocity_gradient(p, k);
      for (Index i = 0; i < p.size(); ++i) velocity_gradient_[k]->set(i, Vec::Zero());
    }
  }
  world.maxima.try_emplace(rules_.statistics + "_largest", 0);
  world.maxima.try_emplace(rules_.statistics + "_potential_energy", 0);
  if (std::isfinite(rules_.longest)) world.counters.try_emplace(rules_.statistics + "_shortened", 0);
}

void Drift::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.updates(p.x).reads(p.h).reads(p.m).reads(velocity_).reads(near_wall_);
  if (rules_.first)
    a.writes(drifted_);
  else
    a.updates(drifted_);
  for (const auto* field : {&shared_fields::held_axes, &shared_fields::prescribed_motion})
    if (const auto* there = field->find(p.fields)) a.reads(*there);
  if (!loads_.uniform()) a.reads(p.part);
  if (!rules_.correct) return;
  a.updates(p.v);
  for (const Field<Real>* gradient : velocity_gradient_) a.reads(*gradient);
}

void Drift::start(World& world, const Clock& clock) {
  const FieldSet& fields = world.particles.fields;
  fixed_ = shared_fields::held_axes.find(fields);
  driven_ = shared_fields::prescribed_motion.find(fields);
  now_ = loads_.at(clock.t + clock.dt);
  sums_.assign(static_cast<std::size_t>(block_count(world.particles.moving)), {});
}

void Drift::block(World& world, const Clock& clock, Index begin, Index end) {
  Particles& p = world.particles;
  Sums& sums = sums_[static_cast<std::size_t>(begin / block_size)];
  for (Index i = begin; i < end; ++i) {
    if (rules_.first) drifted_.set(i, Vec::Zero());
    if (i >= p.active || near_wall_[i] || (driven_ && (*driven_)[i] != 0)) continue;
    Vec shift = allowed(p, i, clock.dt * velocity_.vec(i));
    const Real length = shift.norm(), most = rules_.longest * p.h[i];
    if (length > most) {
      shift *= most / length;
      ++sums.shortened;
    }
    sums.potential += p.m[i] * now_.rise(p.x.vec(i), shift, loads_.uniform() ? 0 : p.part[i]);
    p.x.add(i, shift);
    drifted_.add(i, shift / clock.dt);
    sums.farthest = std::max(sums.farthest, shift.norm() / p.h[i]);
    if (rules_.correct) correct(p, i, shift, sums);
  }
}

void Drift::correct(Particles& p, Index i, const Vec& shift, Sums& sums) {
  Vec change = Vec::Zero();
  for (int k = 0; k < 3; ++k) change[k] = velocity_gradient_[k]->vec(i).dot(shift);
  change = where_free(i, change);
  sums.kinetic += p.m[i] * change.dot(p.v.vec(i) + 0.5 * change);
  p.v.add(i, change);
}

// What holds a particle off a mirror counts its path by its velocity (mirror_core.cpp).
Vec along_mirrors(const std::vector<GhostPlane>& mirrors, const Vec& x, Real h, Vec u) {
  for (const GhostPlane& plane : mirrors)
    if (depth(plane, x) < 0.5 * h) u -= u.dot(plane.normal) * plane.normal;
  return u;
}

Vec Drift::allowed(const Particles& p, Index i, const Vec& shift) const {
  return where_free(i, along_mirrors(mirrors_, p.x.vec(i), p.h[i], shift));
}

Vec Drift::where_free(Index i, Vec u) const {
  if (fixed_)
    for (int k = 0; k < 3; ++k)
      if ((*fixed_)[i] & (1 << k)) u[k] = 0;
  return u;
}

void Drift::finish(World& world, const Clock&) {
  Sums all;
  for (const Sums& s : sums_) {
    all.potential += s.potential, all.kinetic += s.kinetic;
    all.farthest = std::max(all.farthest, s.farthest);
    all.shortened += s.shortened;
  }
  world.energy.dissipated -= all.potential + all.kinetic;
  world.energy.throughput += std::abs(all.potential) + std::abs(all.kinetic);
  Real& most = world.maxima[rules_.statistics + "_largest"];
  most = std::max(most, all.farthest);
  world.maxima[rules_.statistics + "_potential_energy"] += all.potential;
  if (all.shortened > 0) world.counters[rules_.statistics + "_shortened"] += all.shortened;
}

void Drift::refreshed(World& world, const Clock&, std::span<const Index>) {
  const Particles& p = world.particles;
  std::fill_n(near_wall_.data(), p.moving, 0);
  for (Index i = p.active; i < p.moving; ++i) drifted_.set(i, Vec::Zero());
}

void note_farthest(World& world, const std::string& statistic, Real value) {
  Real& farthest = world.maxima[statistic];
  if (std::abs(value) > std::abs(farthest)) farthest = value;
}

void add_drifts(const SphSettings& s, const BodyAcceleration& loads, World& world) {
  const auto add = [&](DriftRules rules) {
    world.passes.add(std::make_shared<Drift>(std::move(rules), s.mirrors, loads, world));
  };
  constexpr Real longest_shift = 0.1;
  const bool shifts = s.shift.strength > 0;
  if (shifts)
    add({.name = "shifting",
         .statistics = shift_statistics,
         .correct = s.shift.correct,
         .longest = longest_shift});
  if (s.xsph > 0) add({.name = "XSPH motion", .statistics = xsph_statistics, .first = !shifts});
  if (s.velocity_smoothing > 0) add_velocity_smoothing(world);
}

DriftDensity::DriftDensity(World& world)
    : drifted_(sph_fields::drifted(world.particles)),
      rate_(sph_fields::drift_rate(world.particles)),
      pressure_(sph_fields::pressure_before(world.particles)) {}

void DriftDensity::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.rho).reads(p.drhodt).reads(p.p).reads(p.m).reads(pressure_).reads(rate_);
}

void DriftDensity::declare_rate(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(drifted_, Reach::others);
  a.reads_before(p.rho).updates(p.drhodt).writes(rate_).reads_before(p.p).writes(pressure_);
}

void DriftDensity::take_arrays(Particles& p, const Clock& clock, DriftArrays& a) {
  for (int k = 0; k < 3; ++k) a.x[k] = p.x.data(k), a.v[k] = p.v.data(k), a.drifted[k] = drifted_.data(k);
  a.rho = p.rho.data(), a.drhodt = p.drhodt.data(), a.drift_rate = rate_.data();
  a.half_step = 0.5 * clock.dt_old;
}

void DriftDensity::add(Particles& p, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) {
    p.drhodt[i] += rate_[i];
    pressure_[i] = p.p[i];
  }
}

void DriftDensity::start(World& world, const Clock&) {
  work_.resize(static_cast<std::size_t>(block_count(world.particles.active)));
}

void DriftDensity::block(World& world, const Clock& clock, Index begin, Index end) {
  const Particles& p = world.particles;
  Real work = 0;
  for (Index i = begin; i < end; ++i) {
    const Real before = p.rho[i] - p.drhodt[i] * clock.dt_old;
    work -= 0.5 * (pressure_[i] + p.p[i]) * p.m[i] / (before * p.rho[i]) * rate_[i];
  }
  work_[static_cast<std::size_t>(begin / block_size)] = work * clock.dt_old;
}

void DriftDensity::record(World&, const Clock&, EnergyLedger& ledger) {
  Real total = 0;
  for (const Real work : work_) total += work;
  ledger.dissipated += total;
  ledger.throughput += std::abs(total);
}

std::shared_ptr<DriftDensity> add_drift_density(World& world) {
  return world.passes.add(std::make_shared<DriftDensity>(world));
}

namespace {

class DriftRate : public Rate {
 public:
  DriftRate(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
            std::shared_ptr<PairVolumes> volumes)
      : loop_(drift_rate_loop(s.kernel, s.dim)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        density_(add_drift_density(world)) {
    a_.kernel = &any_kernel(s.kernel);
  }
  std::string name() const override { return "drift (density)"; }
  void declare(const World& world, Accesses& a) const override {
    density_->declare_rate(world, a);
    a.reads(world.particles.h).reads(volumes_->before(), Reach::others);
  }
  void start(World& world, const Clock& clock) override {
    a_.h = world.particles.h.data(), a_.V = volumes_->current();
    density_->take_arrays(world.particles, clock, a_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
    density_->add(world.particles, begin, end);
  }

 private:
  DriftLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  std::shared_ptr<DriftDensity> density_;
  DriftArrays a_{};
};

}  // namespace

void add_drift_rate(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                    std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<DriftRate>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
