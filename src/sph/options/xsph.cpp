// *COURANT_XSPH: particles go with the mean velocity of their neighbourhood, or take it on.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/deck.hpp"
#include "keyword/registry.hpp"
#include "loads/middle_velocity.hpp"
#include "parallel/parallel.hpp"
#include "sph/cards.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/options/drift.hpp"
#include "sph/options/drift_loops.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/sph.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantXsph> xsph_keyword{courant_xsph_table()};

/// u_i = EPS sum_j m_j/rho_ij (v_j - v_i) W_ij (NORM 1: over sum_j m_j/rho_ij W_ij), of the velocities and
/// places after the last motion; the next motion takes it, with VEL 1 its kick.
class Xsph : public Rate {
 public:
  Xsph(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
       std::shared_ptr<PairVolumes> volumes)
      : eps_(s.xsph + s.velocity_smoothing),  // one of them is 0
        loop_(xsph_loop(s.kernel, s.dim, s.uniform_h, s.xsph_normed)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        drift_(drift_velocity(world.particles, xsph_statistics)) {
    drift_.fill(0);  // loops in the plane leave z alone
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

/// The smoothed velocity replaces the velocity: once the step is known, the force that makes the
/// kick bring u_i as well, m_i u_i/dt. Particles that are held or driven keep their velocity. Heat is counted
/// as that of viscosity between pairs.
class VelocitySmoothing : public Impact, public EnergyTerm {
 public:
  explicit VelocitySmoothing(World& world) : change_(drift_velocity(world.particles, xsph_statistics)) {}
  std::string name() const override { return "velocity smoothing"; }

  void strike(World& world, const Clock& clock) override {
    Particles& p = world.particles;
    const Field<Index>* held = shared_fields::held_axes.find(p.fields);
    const Field<Index>* driven = shared_fields::prescribed_motion.find(p.fields);
    for_each(p.active, [&](Index i) {
      Vec change = change_.vec(i);
      for (int k = 0; k < 3; ++k)
        if ((held && ((*held)[i] & (1 << k)) != 0) || (driven && (*driven)[i] != 0)) change[k] = 0;
      change_.set(i, change);
      p.f.add(i, p.m[i] / clock.dt_mean() * change);
    });
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    Particles& p = world.particles;
    const Points points = points_of(p);
    const MiddleVelocity v(points, clock);
    const Real gained = sum(p.active, [&](Index i) { return p.m[i] * change_.vec(i).dot(v(i)); });
    ledger.dissipated -= gained;
    ledger.throughput += std::abs(gained);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Field<Real>& change_;  ///< u [L/T]
};

}  // namespace

void read_xsph(const Deck& deck, SphSettings& s, Diagnostics& diagnostics) {
  const auto* c = deck.last<CourantXsph>();
  if (c == nullptr) return;
  const bool smooths = c->vel == 1;
  (smooths ? s.velocity_smoothing : s.xsph) = c->eps;
  s.xsph_normed = c->norm == 1;
  if (c->eps > 1)
    deck.error(diagnostics, *c, "EPS", fmt::format("expected at most 1, got '{:g}'", c->eps),
               smooths ? "0.01 is usual with VEL 1"
                       : "0.5 is usual; with 1 particles move with the mean velocity of their neighbours");
  else if (smooths && c->eps > 0.1)
    deck.warning(
        diagnostics, *c, "EPS",
        fmt::format("{:g} of the velocities against the neighbourhood goes in each step: a viscosity of "
                    "about {:.2g} h c",
                    c->eps, c->eps / 6),
        "0.01 is usual with VEL 1; 0.5 is with VEL 0, which moves particles and smooths no velocities");
  if (smooths && c->eps > 0 && !s.heat_in_internal.empty())
    deck.error(
        diagnostics, *c, "VEL",
        "velocities are smoothed beside an equation of state that uses E, which would not get the heat",
        "use VEL 0, or artificial viscosity (*HOURGLASS), whose heat E gets");
}

void add_velocity_smoothing(World& world) {
  world.passes.add(std::make_shared<VelocitySmoothing>(world));
}

void add_xsph(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
              std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<Xsph>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
