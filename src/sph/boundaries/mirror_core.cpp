#include <algorithm>
#include <cmath>

#include "sph/core/fields.hpp"
#include "sph/core/view.hpp"
#include "sph/kernel/kernel.hpp"
#include "sph/sph.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// What a particle right at a mirror lacks. The slope of the kernel falls to nothing where a particle meets
/// its own image, so nothing would hold it off the mirror: water that hits one leaves a row of particles on
/// it, each in one position with its image, where the pressure is several times too high. Here the slope
/// towards one's own image stays as steep as it is at half a spacing, or where it is steepest (R = 2/3 for
/// the cubic spline), for all distances below (Thomas and Couchman 1992 do so for all pairs). Farther away
/// particles, and those of a flow along the mirror, notice nothing. Continuity takes the same slope as
/// pressure does, so that energy is kept. A kernel with a kink pushes most where particle and image meet, and
/// lacks nothing; but pair loops know one side of the kink only, which is wrong over the step in which a
/// particle goes through the mirror. What tension does behind the mirror the reflection takes back
/// (`mirror_pull`): it would make energy of each crossing.
class MirrorCore : public Rate {
 public:
  MirrorCore(const SphSettings& s, const World& world, std::vector<GhostPlane> mirrors)
      : dim_(s.dim), kernel_(s.kernel), mirrors_(std::move(mirrors)), core_(world.part_ids.size(), 1) {
    with_kernel(kernel_, [&](auto kernel) {
      using Kernel = decltype(kernel);
      C_ = Kernel::C(dim_), kink_ = Kernel::kink;
      if (!kink_) core_.assign(core_.size(), Kernel::steepest);
    });
    const Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i) {
      Real& R = core_[p.part[i]];
      R = std::min(R, 0.5 * std::pow(p.m[i] / p.rho[i], 1.0 / s.dim) / p.h[i]);
    }
    for (Index i = 0; i < p.size(); ++i) {
      const Real most = s.evolving_h ? s.h_max_factor[p.part[i]] : 1;
      reach_ = std::max(reach_, 0.5 * core_[p.part[i]] * most * p.h[i]);
    }
  }
  std::string name() const override { return "mirror core (rates)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x).reads(p.v).reads(p.m).reads(p.h).reads(p.part).updates(p.drhodt);
  }

  void block(World& world, const Clock& clock, Index begin, Index end) override {
    if (!(clock.dt_old > 0)) return;
    Particles& p = world.particles;
    // From where it was a step ago; on the other side,
    // which is the same, where it went through the mirror.
    for_each_at_mirror(p, begin, end, [&](Index i, const Vec& n, Real d) {
      const Real came_from = d - clock.dt_old * p.v.vec(i).dot(n), before = std::abs(came_from);
      if (!kink_)
        p.drhodt[i] -= 2 * p.m[i] * (missing_kernel(p, i, d) - missing_kernel(p, i, before)) / clock.dt_old;
      else if (came_from < 0)
        p.drhodt[i] += p.m[i] * fold(p, i, before) / clock.dt_old;
    });
  }

  /// Calls f(i, normal, distance) for what lacks something or may have lacked it a step ago.
  template <class F>
  void for_each_at_mirror(const Particles& p, Index begin, Index end, F&& f) const {
    for (const GhostPlane& plane : mirrors_) {
      if (!(depth_range(loops_, plane, p, begin, end).least < 2 * reach_)) continue;
      for (Index i = begin; i < end; ++i)
        if (const Real d = std::abs(depth(plane, p.x.vec(i))); d < 2 * reach_) f(i, plane.normal, d);
    }
  }
  /// By how much -dW/dr of particle i and its image falls short, the mirror at distance d. [1/L^(dim+1)]
  Real missing_slope(const Particles& p, Index i, Real d) const {
    const Real R = 2 * d / p.h[i], core = core_[p.part[i]];
    return R < core && !kink_ ? norm(p.h[i]) / p.h[i] * (steepness(core) - steepness(R)) : 0;
  }

 private:
  /// Half of its integral over the distance between them, from 0: grows with d. [1/L^dim]
  Real missing_kernel(const Particles& p, Index i, Real d) const {
    const Real core = core_[p.part[i]], R = std::min(2 * d / p.h[i], core);
    return 0.5 * norm(p.h[i]) * (steepness(core) * R - dip(R));
  }
  /// By how much the kernel as it would go on beyond the kink is larger than it is at distance d from the
  /// mirror. [1/L^dim]
  Real fold(const Particles& p, Index i, Real d) const {
    const Real R = 2 * d / p.h[i];
    return norm(p.h[i]) * (dip(R) - dip(-R));
  }
  Real dip(Real R) const {
    return with_kernel(kernel_, [R](auto kernel) { return decltype(kernel)::dip(R); });
  }
  Real steepness(Real R) const {
    return with_kernel(kernel_, [R](auto kernel) { return decltype(kernel)::steepness(R); });
  }
  Real norm(Real h) const { return C_ / (dim_ == 2 ? power<2>(h) : power<3>(h)); }

  int dim_;
  KernelChoice kernel_;
  Real C_ = 0;
  bool kink_ = false;
  std::vector<GhostPlane> mirrors_;
  std::vector<Real> core_;  ///< R of particle and image up to which the slope is kept, by part
  ParticleLoops loops_ = particle_loops();
  Real reach_ = 0;  ///< largest distance from a mirror where something lacks [L]
};

class MirrorCoreForce : public Force {
 public:
  MirrorCoreForce(const SphSettings& s, World& world, std::shared_ptr<MirrorCore> core)
      : core_(std::move(core)), pull_(shared_fields::mirror_pull.add(world.particles.fields)) {
    if (std::holds_alternative<BulkViscosity>(s.viscosity))
      total_pressure_ = &sph_fields::pressure_plus_q(world.particles);
  }
  std::string name() const override { return "mirror core"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x).reads(p.m).reads(p.rho).reads(p.h).reads(p.part);
    a.reads(total_pressure_ ? *total_pressure_ : p.p).updates(p.f).writes(pull_);
  }

  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    const Real* pressure = total_pressure_ ? total_pressure_->data() : p.p.data();
    for (Index i = begin; i < end; ++i) pull_[i] = 0;
    core_->for_each_at_mirror(p, begin, end, [&](Index i, const Vec& n, Real d) {
      const Real V = p.m[i] / p.rho[i];
      const Real push = 2 * V * V * pressure[i] * core_->missing_slope(p, i, d);
      pull_[i] += std::max(-push, Real(0)) / p.m[i];
      p.f.add(i, push * n);
    });
  }

 private:
  std::shared_ptr<MirrorCore> core_;
  Field<Real>& pull_;
  Field<Real>* total_pressure_ = nullptr;
};

}  // namespace

void add_mirror_core(const SphSettings& settings, const std::vector<GhostPlane>& planes, World& world) {
  std::vector<GhostPlane> mirrors;
  for (const GhostPlane& plane : planes)
    if (plane.kind == GhostPlane::Kind::mirror) mirrors.push_back(plane);
  if (mirrors.empty()) return;
  auto core = std::make_shared<MirrorCore>(settings, world, std::move(mirrors));
  world.passes.add(core);
  world.passes.add(std::make_shared<MirrorCoreForce>(settings, world, core));
}

}  // namespace courant
