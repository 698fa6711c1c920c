#include "time/step.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "state/particle_loops.hpp"

namespace courant {

namespace {

class ClearForces : public Rate {
 public:
  std::string name() const override { return "clear forces"; }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (int k = 0; k < 3; ++k)
      std::fill(world.particles.f.data(k) + begin, world.particles.f.data(k) + end, 0.0);
  }
};

/// Returns what the passes allow.
TimeLimit::Limit choose_dt(World& world, Clock& clock, const StepRules& rules, std::string& who) {
  TimeLimit::Limit smallest{std::numeric_limits<Real>::infinity(), "nothing"};
  for (auto& limit : world.time_limits) {
    TimeLimit::Limit one = limit->limit(world, clock);
    // NaN is the smallest of all: the run must stop there
    if (!std::isnan(smallest.dt) && !(one.dt >= smallest.dt)) smallest = std::move(one);
  }
  TimeLimit::Limit computed = smallest;
  if (clock.cycle == 0 && rules.dtinit > 0 && rules.dtinit < smallest.dt) smallest = {rules.dtinit, "DTINIT"};
  if (rules.dt_max) {
    const Real most = rules.dt_max(clock.t);
    if (most > 0 && most < smallest.dt) smallest = {most, "load curve"};
  }
  if (!(smallest.dt > 0)) {
    Guard::stop_for_numbers(world, clock);  // mostly that is why; it names the quantity
    throw RunError(fmt::format("the step size became {} at time {:.6g}, cycle {}, set by {}", smallest.dt,
                               clock.t, clock.cycle, smallest.who),
                   StopCause::step_size);
  }
  if (std::isinf(smallest.dt))
    throw RunError(fmt::format("nothing limits the step size at time {:.6g}, cycle {}: no particle is active",
                               clock.t, clock.cycle),
                   StopCause::step_size);
  clock.dt = smallest.dt;
  who = std::move(smallest.who);
  return computed;
}

}  // namespace

Stepper::Stepper(World& world, Neighbours& neighbours, StepRules rules, PassTimer& timer)
    : world_(world),
      neighbours_(neighbours),
      rules_(std::move(rules)),
      timer_(timer),
      rates_(timer),
      forces_(timer),
      motion_(timer) {
  rates_.add(std::make_shared<ClearForces>());
  rates_.add_all(world.rates);
  rates_.add_all(world.materials);
  rates_.add_all(world.tallies);
  forces_.add_all(world.forces);
  forces_.add_all(world.constraints);
  motion_.add_all(world.motions);
  motion_.add(neighbours.watch());
}

void Stepper::evaluate(Clock& clock, std::string& controlled_by) {
  timer_.measure("neighbours", [&] { neighbours_.refresh(world_, clock); });
  for (auto& e : world_.exchangers) timer_.measure(e->name(), [&] { e->before_rates(world_); });
  rates_.run(world_, clock, world_.particles.active, world_.shares);
  for (auto& e : world_.exchangers) timer_.measure(e->name(), [&] { e->before_forces(world_); });
  forces_.run(world_, clock, world_.particles.active, world_.shares);
  timer_.measure("time step", [&] { computed_ = choose_dt(world_, clock, rules_, controlled_by); });
}

void Stepper::step(Clock& clock, const AtTimeLevel& at_time_level) {
  std::string controlled_by;
  evaluate(clock, controlled_by);
  stop_below_dtmin(clock);
  if (rules_.guard && clock.cycle % Guard::interval == 0)
    timer_.measure("guard", [&] { rules_.guard->look(world_, clock); });
  timer_.measure("output", [&] { at_time_level(world_, clock, controlled_by); });
  timer_.measure("energy", [&] {
    for (auto& term : world_.energy_terms) term->record(world_, clock, world_.energy);
  });
  motion_.run(world_, clock, world_.particles.moving, world_.moving_shares);
  clock.t += clock.dt;
  clock.dt_old = clock.dt;
  ++clock.cycle;
}

// What DTINIT and LCTM chose says nothing of the scene.
void Stepper::stop_below_dtmin(const Clock& clock) {
  if (first_dt_ == 0) first_dt_ = computed_.dt, first_tssfac_ = rules_.tssfac;
  const Real shorter = std::min(Real(1), rules_.tssfac / first_tssfac_);  // contact has a limit of its own
  const Real least = rules_.dtmin * first_dt_ * shorter;
  if (!(computed_.dt < least)) return;
  throw RunError(
      fmt::format(
          "the step size {:.4g} fell below DTMIN x first step = {:.4g} at time {:.6g}, cycle {}, set by {}",
          computed_.dt, least, clock.t, clock.cycle, computed_.who),
      StopCause::step_size);
}

void sample_energy(World& world, const Clock& clock) {
  EnergyLedger& e = world.energy;
  e.kinetic = e.internal = e.potential = e.contact = 0;
  for (auto& term : world.energy_terms) term->sample(world, clock, e);
}

namespace {

class ParticleMotion : public Motion {
 public:
  std::string name() const override { return "particle motion"; }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    const Real dt = clock.dt, dt_kick = clock.dt_mean();
    const Index active_end = std::min(end, p.active);
    for (int k = 0; k < world.dim; ++k) {
      loops_.kick(p.v.data(k), p.f.data(k), p.m.data(), dt_kick, begin, active_end);
      loops_.drift(p.x.data(k), p.v.data(k), dt, begin, end);
    }
  }

 private:
  ParticleLoops loops_ = particle_loops();
};

}  // namespace

std::shared_ptr<Motion> make_particle_motion() {
  return std::make_shared<ParticleMotion>();
}

}  // namespace courant
