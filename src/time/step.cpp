#include "time/step.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

void clear_forces(World& world) {
  for (int k = 0; k < 3; ++k) {
    std::fill_n(world.particles.f.data(k), world.particles.active, 0.0);
    std::fill_n(world.nodes.f.data(k), world.nodes.size(), 0.0);
    std::fill_n(world.segments.contact_force.data(k), world.segments.size(), 0.0);
  }
}

void choose_dt(World& world, Clock& clock, const StepRules& rules, std::string& who) {
  TimeLimit::Limit smallest{std::numeric_limits<Real>::infinity(), "nothing"};
  for (auto& limit : world.time_limits) {
    TimeLimit::Limit one = limit->limit(world, clock);
    // NaN is the smallest of all: the run must stop there
    if (!std::isnan(smallest.dt) && !(one.dt >= smallest.dt)) smallest = std::move(one);
  }
  if (clock.cycle == 0 && rules.dtinit > 0 && rules.dtinit < smallest.dt) smallest = {rules.dtinit, "DTINIT"};
  if (rules.dt_max) {
    const Real most = rules.dt_max(clock.t);
    if (most > 0 && most < smallest.dt) smallest = {most, "load curve"};
  }
  if (!(smallest.dt > 0))
    throw RunError(fmt::format("the step size became {} at time {:.6g}, cycle {}, set by {}", smallest.dt,
                               clock.t, clock.cycle, smallest.who));
  if (std::isinf(smallest.dt))
    throw RunError(fmt::format("nothing limits the step size at time {:.6g}, cycle {}: no particle is active",
                               clock.t, clock.cycle));
  clock.dt = smallest.dt;
  who = std::move(smallest.who);
}

}  // namespace

void evaluate(World& world, Clock& clock, Neighbours& neighbours, const StepRules& rules, PassTimer& timer,
              std::string& controlled_by) {
  timer.measure("neighbours", [&] { neighbours.refresh(world, clock); });
  for (auto& rate : world.rates) timer.measure(rate->name(), [&] { rate->evaluate(world, clock); });
  for (auto& material : world.materials)
    timer.measure(material->name(), [&] { material->update(world, clock); });
  timer.measure("clear forces", [&] { clear_forces(world); });
  for (auto& force : world.forces) timer.measure(force->name(), [&] { force->add(world, clock); });
  for (auto& constraint : world.constraints)
    timer.measure(constraint->name(), [&] { constraint->apply(world, clock); });
  timer.measure("time step", [&] { choose_dt(world, clock, rules, controlled_by); });
}

void step(World& world, Clock& clock, Neighbours& neighbours, const StepRules& rules, PassTimer& timer,
          const AtTimeLevel& at_time_level) {
  std::string controlled_by;
  evaluate(world, clock, neighbours, rules, timer, controlled_by);
  timer.measure("output", [&] { at_time_level(world, clock, controlled_by); });
  timer.measure("energy", [&] {
    for (auto& term : world.energy_terms) term->record(world, clock, world.energy);
  });
  timer.measure("motion", [&] {
    for (auto& motion : world.motions) motion->kick(world, clock);
    for (auto& motion : world.motions) motion->drift(world, clock);
  });
  clock.t += clock.dt;
  clock.dt_old = clock.dt;
  ++clock.cycle;
}

void sample_energy(World& world, const Clock& clock) {
  EnergyLedger& e = world.energy;
  e.kinetic = e.internal = e.potential = e.contact = 0;
  for (auto& term : world.energy_terms) term->sample(world, clock, e);
}

void PassTimer::add(const std::string& name, double seconds) {
  for (Row& row : table_)
    if (row.name == name) {
      row.seconds += seconds;
      ++row.calls;
      return;
    }
  table_.push_back({name, seconds, 1});
}

namespace {

class ParticleMotion : public Motion {
 public:
  std::string name() const override { return "particle motion"; }
  void kick(World& world, const Clock& clock) override {
    Particles& p = world.particles;
    const Real dt = clock.dt_mean();
    const Real* m = p.m.data();
    for (int k = 0; k < world.dim; ++k) {
      Real* v = p.v.data(k);
      const Real* f = p.f.data(k);
      for_each(p.active, [=](Index i) { v[i] += f[i] / m[i] * dt; });
    }
  }
  void drift(World& world, const Clock& clock) override {
    Particles& p = world.particles;
    const Real dt = clock.dt;
    for (int k = 0; k < world.dim; ++k) {
      Real* x = p.x.data(k);
      const Real* v = p.v.data(k);
      for_each(p.moving, [=](Index i) { x[i] += v[i] * dt; });
    }
  }
};

}  // namespace

std::shared_ptr<Motion> make_particle_motion() {
  return std::make_shared<ParticleMotion>();
}

}  // namespace courant
