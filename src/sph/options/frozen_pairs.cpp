#include "sph/options/frozen_pairs.hpp"

#include <cmath>

#include "parallel/copy.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_fields.hpp"
#include "sph/core/pair_passes.hpp"
#include "state/particle_loops.hpp"
#include "state/restartable.hpp"

namespace courant {

bool Window::open(Real h, Real dt, Real room) {
  if (open_) return false;
  // rates hold in the middle of a step, forces at its end: the mean of both, over the steps to come
  const Real steps = std::floor(std::min(0.5 * eps_ * h, std::max(room, Real(0))) /
                                std::max(fastest_ * dt, tiny_distance2 * h));
  ahead_ = fastest_ > 0 ? (0.5 * steps - 0.25) * dt : 0;
  moved_ = 0;
  return open_ = true;
}

void Window::moved(Real fastest, Real h, Real dt) {
  fastest_ = fastest;
  moved_ += fastest * dt;
  if (2 * moved_ > eps_ * h) close();
}

void Window::keep(Archive& archive) {
  archive("moved", moved_);
  archive("fastest", fastest_);
  archive("ahead", ahead_);
  archive("open", open_);
}

FrozenPairs::FrozenPairs(const SphSettings& s, std::shared_ptr<Neighbours> neighbours,
                         const FrozenChoice& choice)
    : window(s.geometry_eps),
      neighbours_(with_whole_lists(std::move(neighbours))),
      kernel_(s.kernel),
      dim_(s.dim) {
  shape_.viscous = choice.viscous, shape_.quadratic = choice.quadratic, shape_.diffusion = choice.diffusion;
  shape_.factor_count = int(choice.viscous) + int(choice.quadratic) + int(choice.diffusion);
  shape_.scale = largest_fixed16 / steepest_gradient(kernel_);
}

bool FrozenPairs::open(Real h, const Clock& clock) {
  return window.open(h, clock.dt_old, neighbours_->room(clock));
}

void FrozenPairs::prepare(const PairArrays& a) {
  blocks_.resize(static_cast<std::size_t>(neighbours_->blocks()));
  shape_.ahead = window.ahead();
  shape_.norm = -gradient_norm(kernel_, dim_, a.h0) / shape_.scale;
  shape_.mV = std::exp2(std::floor(std::log2(a.m[0] * a.V[0])));  // the same bits whichever particle gives it
}

FrozenLists FrozenPairs::lists(Index begin, Index end) {
  const Index b = begin / block_size;
  note_access(gradients_);
  Block& block = blocks_[static_cast<std::size_t>(b)];
  const auto entries = static_cast<std::size_t>(neighbours_->entries(b));
  FrozenLists out = shape_;
  out.all = neighbours_->list(b), out.all_start = neighbours_->starts(b);
  out.list = block.list.grow_to(entries), out.start = block.start.data();
  out.gradients = block.gradients.grow_to(entries * static_cast<std::size_t>(dim_) * Neighbours::lanes);
  out.factors =
      block.factors.grow_to(entries * static_cast<std::size_t>(shape_.factor_count) * Neighbours::lanes);
  out.begin = begin, out.end = end;
  return out;
}

namespace {

class FrozenRates : public Rate, public Restartable {
 public:
  FrozenRates(const SphSettings& s, const FrozenChoice& choice, RateFields fields,
              std::shared_ptr<FrozenPairs> pairs, std::shared_ptr<PairVolumes> volumes)
      : name_(rates_name(s)),
        pairs_(std::move(pairs)),
        volumes_(std::move(volumes)),
        q_(s.q),
        fields_(fields),
        fix_(fix_loop(s.kernel, s.dim)),
        loop_(frozen_rates_loop(choice)) {}
  std::string name() const override { return name_; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    fields_.declare_pairs(p, *volumes_, a);
    a.writes(pairs_->gradients()).reads(p.part).reads(p.c);
    if (fields_.viscous()) a.in_start().writes(fields_.viscous_speed());
  }

  void start(World& world, const Clock& clock) override {
    Particles& p = world.particles;
    a_ = fields_.arrays(p, *volumes_);
    opens_ = pairs_->open(a_.h0, clock);
    if (!opens_) return;
    ++world.counters["pair_geometry_windows"];
    if (fields_.viscous()) {
      const Field<Real>& speed = sph_fields::viscous_speed(p);
      Real* qc = sph_fields::viscous_speed(p).data();
      for_each_block(p.moving,
                     [&](Index begin, Index end) { work_out_viscous_speed(q_, p, begin, end, qc); });
      const FieldBase* changed[] = {&speed};
      for (Exchanger* e : world.passes.all<Exchanger>()) e->exchange(world, changed);
    }
    pairs_->prepare(a_);
    copy(a_.V, p.moving, V_);
    if (fields_.viscous()) copy(a_.qc, p.moving, qc_);
    for (int k = 0; k < 3; ++k) copy(p.x.data(k), p.moving, x_[k]), copy(p.v.data(k), p.moving, v_[k]);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    const FrozenLists lists = pairs_->lists(begin, end);
    if (opens_) fix_(a_, lists);
    loop_(a_, lists);
  }

  // Not the gradients and factors: they follow from the state in which the window opened.
  void keep(Archive& archive) override {
    pairs_->window.keep(archive);
    if (!pairs_->window.is_open()) return;
    archive("window_volume", V_);
    if (fields_.viscous()) archive("window_viscous_speed", qc_);
    for (int k = 0; k < 3; ++k) {
      archive(std::string("window_") + "xyz"[k], x_[k]);
      archive(std::string("window_v") + "xyz"[k], v_[k]);
    }
  }
  // Rates load before materials, so the volumes are themselves again afterwards.
  void loaded(World& world) override {
    if (!pairs_->window.is_open()) return;
    volumes_->pretend(V_);
    exchange(world);
    a_ = fields_.arrays(world.particles, *volumes_);
    pairs_->prepare(a_);
    for_each_block(world.particles.active,
                   [&](Index begin, Index end) { fix_(a_, pairs_->lists(begin, end)); });
    exchange(world);
  }

 private:
  /// Moving particles and their ghosts are as they were when the window opened, or back.
  void exchange(World& world) {
    Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) {
      std::swap_ranges(x_[k].begin(), x_[k].end(), p.x.data(k));
      std::swap_ranges(v_[k].begin(), v_[k].end(), p.v.data(k));
    }
    if (fields_.viscous()) std::swap_ranges(qc_.begin(), qc_.end(), sph_fields::viscous_speed(p).data());
    for (Exchanger* e : world.passes.all<Exchanger>()) e->exchange_all(world);
  }

  std::string name_;
  std::shared_ptr<FrozenPairs> pairs_;
  std::shared_ptr<PairVolumes> volumes_;
  std::vector<PartViscosity> q_;
  RateFields fields_;
  FrozenLoop fix_, loop_;
  PairArrays a_{};
  bool opens_ = false;
  Array<Real> x_[3], v_[3], V_, qc_;  ///< when the window opened [L], [L/T], [L3], [L/T]
};

class FrozenForces : public Force {
 public:
  FrozenForces(const FrozenChoice& choice, ForceFields fields, std::shared_ptr<FrozenPairs> pairs,
               std::shared_ptr<PairVolumes> volumes)
      : pairs_(std::move(pairs)),
        volumes_(std::move(volumes)),
        fields_(fields),
        loop_(frozen_forces_loop(choice)) {}
  std::string name() const override { return "sph forces"; }
  void declare(const World& world, Accesses& a) const override {
    fields_.declare_pairs(world.particles, *volumes_, a);
    a.reads(pairs_->gradients());
  }
  void start(World& world, const Clock&) override { a_ = fields_.arrays(world.particles, *volumes_); }
  void block(World&, const Clock&, Index begin, Index end) override { loop_(a_, pairs_->lists(begin, end)); }

 private:
  std::shared_ptr<FrozenPairs> pairs_;
  std::shared_ptr<PairVolumes> volumes_;
  ForceFields fields_;
  FrozenLoop loop_;
  PairArrays a_{};
};

/// Closes the window when particles have moved too far, or their order changes.
class WindowWatch : public Preparation, public Refresh {
 public:
  WindowWatch(const SphSettings& s, World& world, std::shared_ptr<FrozenPairs> pairs)
      : pairs_(std::move(pairs)) {
    if (s.xsph > 0 || s.shift.strength > 0) drifted_ = &sph_fields::drifted(world.particles);
  }
  std::string name() const override { return "frozen gradients"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.particles.v);
    if (drifted_) a.reads(*drifted_);
    a.in_finish().reads(world.particles.h);
  }
  void start(World& world, const Clock&) override {
    fastest_.assign(static_cast<std::size_t>(block_count(world.particles.moving)), 0);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const auto fastest = [&](const Field<Real>& f) {
      const Real* const v[3] = {f.data(0), f.data(1), f.data(2)};
      return std::sqrt(loops_.fastest2(v, begin, end));
    };
    fastest_[static_cast<std::size_t>(begin / block_size)] =
        fastest(world.particles.v) + (drifted_ ? fastest(*drifted_) : 0);
  }
  void finish(World& world, const Clock& clock) override {
    Real most = 0;
    for (const Real v : fastest_) most = std::max(most, v);
    if (world.particles.active > 0) pairs_->window.moved(most, world.particles.h[0], clock.dt);
  }
  void refreshed(World&, const Clock&, std::span<const Index>) override { pairs_->window.close(); }

 private:
  std::shared_ptr<FrozenPairs> pairs_;
  ParticleLoops loops_ = particle_loops();
  const Field<Real>* drifted_ = nullptr;  ///< where particles drift
  std::vector<Real> fastest_;             ///< in each block [L/T]
};

}  // namespace

PairPasses make_frozen_passes(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                              std::shared_ptr<PairVolumes> volumes) {
  const RateFields rates(s, world.particles);
  const ForceFields forces(s, world.particles);
  const FrozenChoice choice{s.dim,           rates.viscous(),    rates.gradient(),
                            forces.stress(), forces.diffusion(), rates.quadratic()};
  const auto pairs = std::make_shared<FrozenPairs>(s, std::move(neighbours), choice);
  world.passes.add(std::make_shared<WindowWatch>(s, world, pairs));
  if (!rates.viscous()) add_viscous_speed(s, world);  // rates of a window look after their own
  return {{std::make_shared<FrozenRates>(s, choice, rates, pairs, volumes)},
          {std::make_shared<FrozenForces>(choice, forces, pairs, volumes)}};
}

}  // namespace courant
