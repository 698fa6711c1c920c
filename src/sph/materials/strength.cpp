#include "sph/materials/strength.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "laws/most_history.hpp"
#include "laws/objective.hpp"
#include "laws/strength/strength.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_motion.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/materials/equation_of_state.hpp"
#include "sph/materials/strength_loops.hpp"

namespace courant {

namespace {

class Spin : public Rate {
 public:
  Spin(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
       std::shared_ptr<PairVolumes> volumes)
      : loop_(spin_loop(s.kernel, s.dim)),
        v_(PairMotion(world.particles).v),
        spin_(sph_fields::spin(world.particles)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)) {
    a_.kernel = &any_kernel(s.kernel);
  }
  std::string name() const override { return "spin"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(v_, Reach::others).reads(p.h);
    a.reads(volumes_->before(), Reach::others).writes(spin_);
  }
  void start(World& world, const Clock&) override {
    const Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) a_.x[k] = p.x.data(k), a_.v[k] = v_.data(k), a_.spin[k] = spin_.data(k);
    a_.h = p.h.data(), a_.V = volumes_->current();
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
  }

 private:
  StrengthLoop loop_;
  Field<Real>&v_, &spin_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  StrengthArrays a_{};
};

/// Points of a part in a row, as arrays that laws take.
struct Points64 {
  std::array<std::array<Real, block_size>, 6> rate;
  std::array<std::array<Real, block_size>, 3> spin;
  std::array<Real, block_size> mu, c, dv, work, cutoff;
};

/// s:D of the deviator of a stress; both xx yy zz xy yz zx
Real deviatoric_power(const std::array<Real*, 6>& stress, const Points64& points, Index k) {
  const auto& D = points.rate;
  const Real mean = (stress[0][k] + stress[1][k] + stress[2][k]) / 3;
  return (stress[0][k] - mean) * D[0][k] + (stress[1][k] - mean) * D[1][k] + (stress[2][k] - mean) * D[2][k] +
         2 * (stress[3][k] * D[3][k] + stress[4][k] * D[4][k] + stress[5][k] * D[5][k]);
}

/// Advances the stress of particles with strength over dt_old: turned by the spin of the middle of the step,
/// then by the law. Where the law gives all of the stress the density advances here, p = -tr/3, and the work
/// of p is as that of equations of state; the work of the deviator goes into E.
class StrengthStress : public Material {
 public:
  StrengthStress(const SphSettings& s, World& world)
      : laws_(s.strength),
        rate_(sph_fields::strain_rate(world.particles)),
        spin_(sph_fields::spin(world.particles)),
        kept_(sph_fields::law_stress(world.particles)) {
    if (!s.heat_in_internal.empty()) least_ = &sph_fields::least_pressure(world.particles);
    for (const auto& law : laws_) {
      history_.emplace_back();
      if (!law) continue;
      for (const HistoryVariable& h : law->history()) {
        history_.back().push_back(&world.particles.fields.add<Real>(
            {.name = h.name, .dimension = h.dimension, .components = h.components, .output = true}));
        if (h.name == element_size) lay_sizes(s, world, *history_.back().back());
      }
    }
  }
  std::string name() const override { return "strength"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(rate_).reads(spin_).reads(p.drhodt).reads(p.part);
    a.updates(p.rho).updates(p.p).updates(p.E).updates(p.c).updates(kept_);
    if (least_) a.updates(*least_);
    for (const auto& fields : history_)
      for (const Field<Real>* field : fields) a.updates(*field);
  }

  void start(World& world, const Clock&) override { broken_.assign(block_count(world.particles.active), 0); }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    const Index* part = p.part.data();
    for (Index i = begin, next = i; i < end; i = next) {  // particles of one part in a row
      while (next < end && part[next] == part[i]) ++next;
      if (laws_[part[i]]) advance(p, clock.dt_old, i, next);
    }
  }
  void finish(World& world, const Clock& clock) override {
    const ReadsForMessage unchecked;
    const Particles& p = world.particles;
    for (std::size_t b = 0; b < broken_.size(); ++b)
      for (Index i = static_cast<Index>(b) * block_size; broken_[b] && i < p.active; ++i)
        if (laws_[p.part[i]] && !(p.rho[i] > 0 && std::isfinite(p.rho[i])))
          stop_for_density(world, clock, i, std::numeric_limits<Real>::infinity());
  }

 private:
  /// Of a plane the width of a particle.
  static void lay_sizes(const SphSettings& s, const World& world, Field<Real>& size) {
    const Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i)
      if (s.strength[static_cast<std::size_t>(p.part[i])])
        size[i] = std::pow(p.m[i] / p.rho[i], Real(1) / world.dim);
  }
  void advance(Particles& p, Real dt, Index begin, Index end) {
    const StrengthLaw& law = *laws_[p.part[begin]];
    Points64 at;
    if (!law.deviator_only()) advance_density(p, dt, begin, end);
    find_rates(p, dt, law.ro, begin, end, at);

    PointBlock block;
    block.count = end - begin, block.dt = dt;
    for (int k = 0; k < 6; ++k) block.rate[k] = at.rate[k].data(), block.stress[k] = kept_.data(k) + begin;
    block.compression = at.mu.data(), block.energy = p.E.data() + begin, block.sound_speed = at.c.data();
    if (law.deviator_only()) {
      block.pressure = p.p.data() + begin;
      block.least_pressure = least_ ? least_->data() + begin : at.cutoff.data();
      std::fill_n(block.least_pressure, block.count, std::max(law.pressure_cutoff(), no_cutoff));
    }
    std::array<Real*, most_history> history{};
    const auto& fields = history_[p.part[begin]];
    const Real* const spin[3] = {at.spin[0].data(), at.spin[1].data(), at.spin[2].data()};
    std::size_t numbers = 0;
    for (Field<Real>* field : fields) {
      Real** const first = &history[numbers];
      for (int k = 0; k < field->info().components; ++k) history[numbers++] = field->data(k) + begin;
      if (field->info().components == 6) turn_stress(spin, dt, first, block.count);
    }
    block.history = {history.data(), numbers};

    turn_stress(spin, dt, block.stress.data(), block.count);
    for (Index k = 0; k < block.count; ++k) {  // of the volume at the start of the step
      const Real v = 1 / (1 + at.mu[k]) - at.dv[k];
      at.work[k] = 0.5 * dt * v * deviatoric_power(block.stress, at, k);
    }
    law.update(block);
    if (law.deviator_only())
      add_to_equation_of_state(p, begin, at, block);
    else
      take_pressure(p, begin, at, block);
    add_work(p, dt, begin, at, block);
  }

  void advance_density(Particles& p, Real dt, Index begin, Index end) {
    bool broken = false;
    for (Index i = begin; i < end; ++i) {
      p.rho[i] += p.drhodt[i] * dt;
      broken |= !(p.rho[i] > 0 && std::isfinite(p.rho[i]));
    }
    if (broken) broken_[begin / block_size] = 1;
  }

  /// Compression, change of relative volume, and rate and spin of the middle of the step, in the axes at its
  /// end. Pair sums give the gradient over the positions at the end, L: over those of the middle it is L (1 -
  /// L dt/2)^-1. The trace is that of the density; the rest of it is alike in all directions, in 2D, too, so
  /// that it does no work on the deviator: no force of the deviator belongs to it.
  void find_rates(const Particles& p, Real dt, Real rho0, Index begin, Index end, Points64& at) const {
    for (Index i = begin, k = 0; i < end; ++i, ++k) {
      const Real rho = p.rho[i], change = p.drhodt[i] * dt;
      at.mu[k] = rho / rho0 - 1;
      at.dv[k] = -rho0 * change / (rho * (rho - change));
      const Vec w = spin_.vec(i);
      Matrix L = rate_.tensor(i);
      L(1, 0) += w[2], L(0, 1) -= w[2], L(0, 2) += w[1], L(2, 0) -= w[1], L(2, 1) += w[0], L(1, 2) -= w[0];
      L = L * (Matrix::Identity() - 0.5 * dt * L).inverse();
      const Real divergence = -p.drhodt[i] / (rho - 0.5 * change);
      L += (divergence - L.trace()) / 3 * Matrix::Identity();
      store(L, dt, k, at);
    }
  }
  static void store(const Matrix& L, Real dt, Index k, Points64& at) {
    Real D[6] = {L(0, 0),
                 L(1, 1),
                 L(2, 2),
                 0.5 * (L(0, 1) + L(1, 0)),
                 0.5 * (L(1, 2) + L(2, 1)),
                 0.5 * (L(2, 0) + L(0, 2))};
    const Vec w(0.5 * (L(2, 1) - L(1, 2)), 0.5 * (L(0, 2) - L(2, 0)), 0.5 * (L(1, 0) - L(0, 1)));
    const Vec h = 0.5 * dt * w;
    turn_rate(h[0], h[1], h[2], D[0], D[1], D[2], D[3], D[4], D[5]);
    for (int c = 0; c < 6; ++c) at.rate[c][k] = D[c];
    for (int c = 0; c < 3; ++c) at.spin[c][k] = w[c];
  }

  /// The law's share of the sound speed, and tension that it no longer allows,
  /// with the work that it did.
  static void add_to_equation_of_state(Particles& p, Index begin, const Points64& at,
                                       const PointBlock& block) {
    for (Index k = 0; k < block.count; ++k) {
      Real &c = p.c[begin + k], &pressure = p.p[begin + k];
      c = std::sqrt(c * c + at.c[k] * at.c[k]);
      const Real lacks = block.least_pressure[k] - pressure;
      if (!(lacks > 0)) continue;
      pressure = block.least_pressure[k], p.E[begin + k] -= 0.5 * at.dv[k] * lacks;
    }
  }
  static void take_pressure(Particles& p, Index begin, const Points64& at, const PointBlock& block) {
    const auto& s = block.stress;
    for (Index k = 0; k < block.count; ++k) {
      const Index i = begin + k;
      const Real pressure = -(s[0][k] + s[1][k] + s[2][k]) / 3;
      p.E[i] -= 0.5 * at.dv[k] * (p.p[i] + pressure);
      p.p[i] = pressure;
      p.c[i] = at.c[k];
    }
  }
  static void add_work(Particles& p, Real dt, Index begin, const Points64& at, const PointBlock& block) {
    for (Index k = 0; k < block.count; ++k) {
      const Real v = 1 / (1 + at.mu[k]);
      p.E[begin + k] += at.work[k] + 0.5 * dt * v * deviatoric_power(block.stress, at, k);
    }
  }

  std::vector<std::shared_ptr<const StrengthLaw>> laws_;
  Field<Real>&rate_, &spin_, &kept_;
  Field<Real>* least_ = nullptr;                    ///< null: no equation of state uses energy
  std::vector<std::vector<Field<Real>*>> history_;  ///< of each part
  std::vector<char> broken_;                        ///< blocks with a density that is none
};

/// Gives the deviator to the stress that pair forces read; that of laws is 0 for liquids. Behind a viscous
/// stress, which needs the density that laws have advanced.
class StrengthDeviator : public Material {
 public:
  StrengthDeviator(const SphSettings& s, World& world)
      : adds_(s.has_viscous_stress()),
        kept_(sph_fields::law_stress(world.particles)),
        stress_(sph_fields::stress(world.particles)) {}
  std::string name() const override { return "strength (deviator)"; }
  void declare(const World&, Accesses& a) const override {
    a.reads(kept_);
    if (adds_)
      a.updates(stress_);
    else
      a.writes(stress_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {
      const Real mean = (kept_.data(0)[i] + kept_.data(1)[i] + kept_.data(2)[i]) / 3;
      for (int c = 0; c < 6; ++c) {
        Real& to = stress_.data(c)[i];
        to = (adds_ ? to : 0) + kept_.data(c)[i] - (c < 3 ? mean : 0);
      }
    }
  }

 private:
  bool adds_;  ///< to a viscous stress
  Field<Real>&kept_, &stress_;
};

/// Pressure, energy and sound speed at the start, without stress.
void set_initial_state(const SphSettings& s, World& world) {
  Particles& p = world.particles;
  for_each(p.size(), [&](Index i) {
    const auto& law = s.strength[static_cast<std::size_t>(p.part[i])];
    if (!law) return;
    const Real c = law->sound_speed() * std::sqrt(law->ro / p.rho[i]);
    p.c[i] = law->deviator_only() ? std::sqrt(p.c[i] * p.c[i] + c * c) : c;
  });
}

}  // namespace

void add_strength(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                  std::shared_ptr<PairVolumes> volumes) {
  set_initial_state(s, world);
  world.passes.add(std::make_shared<Spin>(s, world, neighbours, volumes));
  world.passes.add(std::make_shared<StrengthStress>(s, world));
  world.passes.add(std::make_shared<StrengthDeviator>(s, world));
  if (s.artificial_stress.eps > 0) add_artificial_stress(s, world, std::move(neighbours), std::move(volumes));
}

}  // namespace courant
