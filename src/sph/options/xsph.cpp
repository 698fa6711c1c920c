// *COURANT_XSPH: particles go with the mean velocity of their neighbourhood, or take it on.
#include <cmath>

#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"
#include "sph/cards.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/options/drift.hpp"
#include "sph/options/drift_loops.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantXsph> xsph_keyword{
    {.names = {"COURANT_XSPH"},
     .purpose = "particles move with a velocity smoothed over their neighbours (XSPH)",
     .once = true,
     .many = false,
     .cards = {{.fields = {
                    {"EPS",
                     &CourantXsph::eps,
                     "-",
                     "share of the mean velocity of neighbours, usually 0.5, at most 1; 0: none",
                     {.check = Check::not_negative}},
                    {"NORM",
                     &CourantXsph::norm,
                     "-",
                     "1: the mean is over the sum of the kernel (Shepard), right at surfaces, too; 0: over 1",
                     {.allowed = {0, 1}}},
                    {"VEL",
                     &CourantXsph::vel,
                     "-",
                     "1: the smoothed velocity takes the place of the velocity in each step, which acts as a "
                     "viscosity; 0: it only moves particles",
                     {.allowed = {0, 1}}}}}}}};

/// u_i = EPS sum_j m_j/rho_ij (v_j - v_i) W_ij (NORM 1: over sum_j m_j/rho_ij W_ij), of the velocities and
/// places after the last motion; the next motion takes it.
class Xsph : public Rate {
 public:
  Xsph(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
       std::shared_ptr<PairVolumes> volumes)
      : eps_(s.xsph),
        loop_(xsph_loop(s.kernel, s.dim, s.uniform_h, s.xsph_normed)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        drift_(drift_velocity(world.particles, xsph_statistics)) {
    a_.kernel = &any_kernel(s.kernel);
  }
  std::string name() const override { return "XSPH"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.m, Reach::others).reads(p.h, Reach::others);
    a.reads(volumes_->before(), Reach::others).writes(drift_);
  }

  void start(World& world, const Clock&) override {
    const Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) a_.x[k] = p.x.data(k), a_.v[k] = p.v.data(k), a_.drift[k] = drift_.data(k);
    a_.m = p.m.data(), a_.h = p.h.data(), a_.V = volumes_->current();
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
    for (int k = 0; k < world.dim; ++k)
      for (Index i = begin; i < end; ++i) a_.drift[k][i] *= eps_;
  }

 private:
  Real eps_;
  DriftLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>& drift_;
  DriftArrays a_{};
};

/// EPS of the velocity that particles have against their neighbourhood goes in each step: as a force,
/// f_i = m_i EPS/dt sum_j m_j/rho_ij (v_j - v_i) W_ij (NORM 1: over sum_j m_j/rho_ij W_ij). Heat is counted
/// as that of viscosity between pairs.
class VelocitySmoothing : public Rate, public EnergyTerm {
 public:
  VelocitySmoothing(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                    std::shared_ptr<PairVolumes> volumes)
      : eps_(s.velocity_smoothing),
        loop_(xsph_loop(s.kernel, s.dim, s.uniform_h, s.xsph_normed)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        force_(world.particles.fields.add<Real>(
            {.name = "smoothing_force", .dimension = "ML/T2", .components = 3, .restart = false})) {
    force_.fill(0);  // loops in the plane leave z alone
    a_.kernel = &any_kernel(s.kernel);
  }
  std::string name() const override { return "velocity smoothing"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.m, Reach::others).reads(p.h, Reach::others);
    a.reads(volumes_->before(), Reach::others).updates(p.f).writes(force_);
  }

  void start(World& world, const Clock& clock) override {
    const Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) a_.x[k] = p.x.data(k), a_.v[k] = p.v.data(k), a_.drift[k] = force_.data(k);
    a_.m = p.m.data(), a_.h = p.h.data(), a_.V = volumes_->current();
    per_step_ = clock.dt_old > 0 ? eps_ / clock.dt_old : 0;
    heat_.resize(static_cast<std::size_t>(block_count(p.active)));
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    loop_(a_, lists_of(*neighbours_, begin, end));
    Real heat = 0;
    for (Index i = begin; i < end; ++i) {
      const Vec force = p.m[i] * per_step_ * force_.vec(i);
      force_.set(i, force);
      p.f.add(i, force);
      heat -= force.dot(p.v.vec(i));
    }
    heat_[static_cast<std::size_t>(begin / block_size)] = heat;
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Particles& p = world.particles;
    Real power = sum(
        p.active, [&](Index i) { return -0.5 * clock.dt_mean() / p.m[i] * force_.vec(i).dot(p.f.vec(i)); });
    for (const Real heat : heat_) power += heat;
    ledger.dissipated += power * clock.dt_mean();
    ledger.throughput += std::abs(power) * clock.dt_mean();
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Real eps_, per_step_ = 0;  ///< [-], [1/T]
  DriftLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>& force_;
  std::vector<Real> heat_;  ///< of each block, of the velocities before the kick [ML2/T3]
  DriftArrays a_{};
};

}  // namespace

void add_velocity_smoothing(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                            std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<VelocitySmoothing>(s, world, std::move(neighbours), std::move(volumes)));
}

void add_xsph(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
              std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<Xsph>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
