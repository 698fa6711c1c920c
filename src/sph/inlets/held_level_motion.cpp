// Inlets with a held level: the velocity that follows from the flow inside, and the particles that wait.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/run_error.hpp"
#include "sph/inlets/held_level.hpp"
#include "sph/inlets/injection.hpp"
#include "sph/materials/initial_stress.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

/// The water before an inlet, weighted by 2 sin^2(pi s/(2 DIST)) over the distances s from 0 to 2 DIST: a
/// mean of 1, with its centre at DIST, to which single particles come and go without a jump.
struct Measured {
  Real volume = 0, flow = 0;  ///< [L3], [L4/T]
  std::int64_t back = 0;      ///< particles that went a spacing upstream of the plane in this step
  void add(const Measured& other) { volume += other.volume, flow += other.flow, back += other.back; }
};

/// What an inlet needs from one step to the next.
struct InletState {
  Real u = 0;               ///< velocity along the normal [L/T]
  Real slow = 0;            ///< its running mean [L/T]
  Real depth = 0;           ///< measured [L]
  Real mean = 0;            ///< velocity, measured [L/T]
  std::vector<Real> due{};  ///< by position: share of a particle that is due
};

class HeldLevels : public Motion, public Refresh, public Restartable {
 public:
  HeldLevels(const Injections& injections, const std::vector<PartMaterial>& materials,
             std::shared_ptr<InletFlow> flow, World& world)
      : inlets_(injections.inlets),
        materials_(materials),
        flow_(std::move(flow)),
        inlet_(shared_fields::inlet.add(world.particles.fields)),
        start_(*flow_->start),
        position_(held_level_fields::position.add(world.particles.fields)),
        reference_volume_(shared_fields::reference_volume.add(world.particles.fields)) {
    for (const Injection& inlet : inlets_)
      states_.push_back({.due = std::vector<Real>(inlet.positions.size(), 0.5)});
  }
  std::string name() const override { return "held levels"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.m).reads(p.rho).reads(p.state).reads(inlet_).reads(start_).reads(position_);
    a.reads(*flow_->path).revises(p.x).revises(p.v);
  }

  void start(World& world, const Clock& clock) override {
    for (std::size_t k = 0; k < inlets_.size(); ++k) {
      if (!inlets_[k].held.on) continue;
      advance(k, world, clock.t, clock.dt);
      flow_->displacement[k] += states_[k].u * clock.dt;
    }
    measured_.assign(static_cast<std::size_t>(block_count(world.particles.moving)) * inlets_.size(), {});
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    measure(p, clock.dt, begin, std::min(end, p.active));
    for (Index i = std::max(begin, p.active); i < end; ++i)
      if (p.state[i] == particle_waiting && position_[i] != 0) move(p, i);
  }
  void finish(World& world, const Clock&) override { reduce(world); }

  /// Waiting particles that have just woken.
  void refreshed(World& world, const Clock& clock, std::span<const Index>) override {
    Particles& p = world.particles;
    if (!started_) begin_flow(world, clock.t);
    std::vector<Index> undecided;
    for (Index i = p.active; i < p.moving; ++i) {
      if (p.state[i] != particle_waiting || position_[i] == 0) continue;
      const Injection& inlet = inlets_[static_cast<std::size_t>(inlet_[i])];
      p.v.set(i, flow_->path->vec(i) * states_[static_cast<std::size_t>(inlet_[i])].u);
      if (position_[i] < 0)
        set_pressure(world, i, std::max(clock.t, inlet.begin));
      else if ((inlet.plane.point - p.x.vec(i)).dot(inlet.plane.normal) <= inlet.reach)
        undecided.push_back(i);
    }
    std::sort(undecided.begin(), undecided.end(), [&](Index a, Index b) { return p.id[a] < p.id[b]; });
    for (const Index i : undecided)
      decide(world, i, std::max(clock.t, inlets_[static_cast<std::size_t>(inlet_[i])].begin));
  }

  void keep(Archive& archive) override {
    archive("started", started_);
    archive("displacement", flow_->displacement);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const Archive::Group inside(archive, fmt::format("inlet {}", k + 1));
      InletState& s = states_[k];
      archive("velocity", s.u);
      archive("slow", s.slow);
      archive("depth", s.depth);
      archive("mean", s.mean);
      archive("due", s.due);
      if (s.due.size() != inlets_[k].positions.size()) archive.stop("due", "has another length");
    }
    if (flow_->displacement.size() != inlets_.size()) archive.stop("displacement", "has another length");
  }

 private:
  /// Of the held surface or energy head above the lower edge. [L]
  Real level(const Injection& inlet, Real t) const {
    const HeldLevel& held = inlet.held;
    const Vec& x = inlet.plane.point;
    const Vec edge = x + (held.low - x.dot(held.upright)) * held.upright;
    return inlet.surface.depth(edge, t) / inlet.surface.up.dot(held.upright);
  }
  Real gravity(const Injection& inlet, Real t) const {
    const FreeSurface& s = inlet.surface;
    return s.gravity(inlet.plane.point, t, inlet.part).norm() * s.up.dot(inlet.held.upright);
  }
  /// Energy head at the inlet. Where the surface is held, waves still find an energy head, of the running
  /// mean of the flow: a surface held at each moment gives them energy, and they grow before a gate.
  Real head(std::size_t k, Real t) const {
    const Injection& inlet = inlets_[k];
    const Real slow = states_[k].slow, g = gravity(inlet, t);
    return level(inlet, t) + (inlet.held.energy || !(g > 0) ? 0 : slow * slow / (2 * g));
  }
  /// By which the surface at the inlet is below the level. [L]
  Real drop(std::size_t k, Real t) const {
    const Injection& inlet = inlets_[k];
    const Real g = gravity(inlet, t);
    return g > 0 ? level(inlet, t) - depth_at_inlet(head(k, t), states_[k].u, g) : 0;
  }

  Real wanted(std::size_t k, Real t) const {
    const Injection& inlet = inlets_[k];
    return velocity_at_head(states_[k].mean, states_[k].depth, head(k, t), gravity(inlet, t));
  }

  /// The velocity at t, towards that of the invariant within the relaxation time.
  void advance(std::size_t k, World& world, Real t, Real dt) {
    const Injection& inlet = inlets_[k];
    Real& u = states_[k].u;
    if (t < inlet.begin || t >= inlet.end || !(gravity(inlet, t) > 0)) {
      u = 0;
      return;
    }
    u += (wanted(k, t) - u) * -std::expm1(-dt / inlet.held.tau);
    limit(k, world, t);
    constexpr Real waves = 20;  // times sqrt(depth/g), as the level outlet
    states_[k].slow +=
        (u - states_[k].slow) * -std::expm1(-dt / (waves * std::sqrt(level(inlet, t) / gravity(inlet, t))));
  }
  /// From 0, as an inlet lets nothing out, to critical flow and the greatest discharge; both are counted.
  void limit(std::size_t k, World& world, Real t) {
    const Injection& inlet = inlets_[k];
    const Real g = gravity(inlet, t), energy = head(k, t);
    Real& u = states_[k].u;
    if (u < 0) u = 0, ++world.counters["inlet_held_back"];
    const Real critical = critical_velocity(energy, g),
               depth = depth_at_inlet(energy, std::min(u, critical), g);
    const Real most =
        std::min({critical, inlet.held.fastest, inlet.held.most / (inlet.held.width(world.dim) * depth)});
    if (u > most) u = most, ++world.counters["inlet_at_its_limit"];
  }

  /// The velocity from which it starts is that of the water inside.
  void begin_flow(World& world, Real t) {
    const Index active = world.particles.active;
    measured_.assign(static_cast<std::size_t>(block_count(world.particles.moving)) * inlets_.size(), {});
    for_each_block(active, [&](Index begin, Index end) { measure(world.particles, 0, begin, end); });
    reduce(world);
    for (std::size_t k = 0; k < inlets_.size(); ++k) {
      if (!inlets_[k].held.on || t < inlets_[k].begin || !(gravity(inlets_[k], t) > 0)) continue;
      states_[k].slow = states_[k].mean;
      states_[k].u = wanted(k, t);
      limit(k, world, t);
    }
    started_ = true;
  }

  void measure(const Particles& p, Real dt, Index begin, Index end) {
    for (std::size_t k = 0; k < inlets_.size() && begin < end; ++k) {
      if (!inlets_[k].held.on) continue;
      const HeldLevel& held = inlets_[k].held;
      const InletPlane& plane = inlets_[k].plane;
      const Real far = 2 * held.distance, behind = -inlets_[k].cell;
      Measured sum;
      for (Index i = begin; i < end; ++i) {
        const Vec x = p.x.vec(i);
        const Real s = (x - plane.point).dot(plane.normal);
        if (s >= far || (s <= 0 && s >= behind)) continue;
        const Real across = x.dot(held.side), v = p.v.vec(i).dot(plane.normal);
        if (across < held.left || across > held.right) continue;
        if (s < 0) {
          sum.back += s - v * dt >= behind && dt > 0;
          continue;
        }
        const Real root = std::sin(pi * s / far), volume = 2 * root * root * p.m[i] / p.rho[i];
        sum.volume += volume, sum.flow += volume * v;
      }
      measured_[static_cast<std::size_t>(begin / block_size) * inlets_.size() + k] = sum;
    }
  }
  void reduce(World& world) {
    for (std::size_t k = 0; k < inlets_.size(); ++k) {
      const HeldLevel& held = inlets_[k].held;
      if (!held.on) continue;
      Measured all;
      for (std::size_t b = k; b < measured_.size(); b += inlets_.size()) all.add(measured_[b]);
      states_[k].depth = all.volume / (2 * held.distance * held.width(world.dim));
      states_[k].mean = all.volume > 0 ? all.flow / all.volume : 0;
      if (all.back > 0) world.counters["inlet_backflow"] += all.back;
    }
  }

  void move(Particles& p, Index i) {
    const auto k = static_cast<std::size_t>(inlet_[i]);
    const Vec path = flow_->path->vec(i);
    p.x.set(i, start_.vec(i) + path * flow_->displacement[k]);
    p.v.set(i, path * states_[k].u);
  }

  const Vec& position_in_plane(Index i) const {
    const Index n = std::abs(position_[i]) - 1;
    return inlets_[static_cast<std::size_t>(inlet_[i])].positions[static_cast<std::size_t>(n)];
  }

  /// Of a cell that the surface cuts as many come in as its share below the surface. The others are switched
  /// off, and fill nothing.
  void decide(World& world, Index i, Real t) {
    Particles& p = world.particles;
    const auto k = static_cast<std::size_t>(inlet_[i]);
    const Injection& inlet = inlets_[k];
    Real& due = states_[k].due[static_cast<std::size_t>(position_[i] - 1)];
    due += inlet.surface.filled(position_in_plane(i), t, inlet.cell, inlet.plane.normal, drop(k, t));
    position_[i] = -position_[i];
    if (due >= 1) {
      due -= 1;
      return set_pressure(world, i, t);
    }
    p.state[i] = particle_deactivated;
    p.m[i] = reference_volume_[i] = 0;
    p.v.set(i, Vec::Zero());
  }

  void set_pressure(World& world, Index i, Real t) {
    Particles& p = world.particles;
    const auto k = static_cast<std::size_t>(inlet_[i]);
    const PartMaterial& m = materials_[static_cast<std::size_t>(p.part[i])];
    const Real pressure = m.ro * inlets_[k].surface.head(position_in_plane(i), t, p.part[i], drop(k, t));
    const auto mu = compression_at(*m.eos, m.ro, pressure);
    if (!mu)
      throw RunError(fmt::format("*COURANT_INFLOW: the equation of state of part {} has no density with the "
                                 "pressure {:g} below the level",
                                 world.part_ids[static_cast<std::size_t>(p.part[i])], pressure),
                     "check the level and its units");
    const Real rho = m.ro * (1 + *mu), ratio = rho / p.rho[i];
    p.m[i] *= ratio, reference_volume_[i] *= ratio;
    p.rho[i] = rho, p.p[i] = pressure;
    p.c[i] = std::sqrt(m.eos->sound_speed2(m.ro, *mu, m.eos->E0));
  }

  const std::vector<Injection>& inlets_;
  const std::vector<PartMaterial>& materials_;
  std::shared_ptr<InletFlow> flow_;
  Field<Index>& inlet_;
  const Field<Real>& start_;
  Field<Index>& position_;
  Field<Real>& reference_volume_;
  std::vector<InletState> states_;
  std::vector<Measured> measured_;  ///< by block and inlet
  bool started_ = false;
};

}  // namespace

void add_held_levels(const Injections& injections, const std::vector<PartMaterial>& materials,
                     std::shared_ptr<InletFlow> flow, World& world) {
  if (flow) world.passes.add(std::make_shared<HeldLevels>(injections, materials, std::move(flow), world));
}

}  // namespace courant
