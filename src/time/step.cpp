#include "time/step.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "time/inner_schedule.hpp"

namespace courant {

namespace {

constexpr Real none = std::numeric_limits<Real>::infinity();

double cpu_of_this_thread() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Of work on all threads, in parts too many to be timed one by one: while this thread does not compute it
/// waits for the others, and the table shall not blame the work for that.
template <class F>
void measure_with_waits(PassTimer& timer, const std::string& name, F&& f) {
  if (threads() == 1) return timer.measure(name, f);
  const double start = PassTimer::now(), cpu = cpu_of_this_thread();
  f();
  const double seconds = PassTimer::now() - start;
  const double computed = std::min(cpu_of_this_thread() - cpu, seconds);
  timer.add(timer.row(name), computed);
  timer.add(timer.row("waiting for threads"), seconds - computed);
}

}  // namespace

Stepper::Stepper(World& world, Neighbours* neighbours, StepRules rules, PassTimer& timer)
    : world_(world),
      neighbours_(neighbours),
      rules_(std::move(rules)),
      timer_(timer),
      exchangers_(world.passes.all<Exchanger>()),
      limits_(world.passes.all<TimeLimit>()),
      impacts_(world.passes.all<Impact>()),
      terms_(world.passes.all<EnergyTerm>()),
      subcycle_(Subcycle::of(world)),
      springs_(world.passes.all<Springs>()) {
  if (neighbours && !world.passes.contains(*neighbours->watch())) world.passes.add(neighbours->watch());
  Schedule schedule = make_schedule(world);
  stages_ = text_of(schedule);
  for (StagePlan& plan : schedule.forces) forces_.emplace_back(std::move(plan), world, timer);
  for (StagePlan& plan : schedule.motion) motion_.emplace_back(std::move(plan), world, timer);
  if (!subcycle_) return;
  if (std::string why = conflict_with_slow(world, *subcycle_); !why.empty())
    subcycle_->switch_off(std::move(why));
  for (StagePlan& plan : make_inner_forces(world)) inner_forces_.emplace_back(std::move(plan), world, timer);
}

void Stepper::evaluate(Clock& clock, std::string& controlled_by) {
  if (subcycle_) subcycle_->make_outer();
  evaluate_step(clock, controlled_by);
}

void Stepper::evaluate_step(Clock& clock, std::string& controlled_by) {
  bool rebuilt = false;
  if (neighbours_)
    measure_with_waits(timer_, "neighbours", [&] { rebuilt = neighbours_->refresh(world_, clock); });
  if (rebuilt)
    for (Exchanger* e : exchangers_) timer_.measure(e->name(), [&] { e->exchange_all(world_); });
  const bool outer = !subcycle_ || subcycle_->begin(clock);
  for (Stage& stage : outer ? forces_ : inner_forces_) stage.run(world_, clock);
  timer_.measure("time step", [&] { computed_ = choose_dt(clock, controlled_by); });
  for (Impact* impact : impacts_) timer_.measure(impact->name(), [&] { impact->strike(world_, clock); });
}

void Stepper::step(Clock& clock, const AtTimeLevel& at_time_level) {
  std::string controlled_by;
  evaluate_step(clock, controlled_by);
  stop_below_dtmin(clock);
  if (rules_.guard && clock.cycle % Guard::interval == 0)
    timer_.measure("guard", [&] { rules_.guard->look(world_, clock); });
  timer_.measure("output", [&] { at_time_level(world_, clock, controlled_by); });
  timer_.measure("energy", [&] {
    for (EnergyTerm* term : terms_)
      if (!subcycle_ || !subcycle_->is_slow(*term))
        term->record(world_, clock, world_.energy);
      else if (subcycle_->outer())
        term->record(world_, subcycle_->slow(), world_.energy);
  });
  for (Stage& stage : motion_) stage.run(world_, clock);
  if (subcycle_) {
    if (subcycle_->outer()) ++world_.counters["pair_force_steps"];
    subcycle_->end(clock);
  }
  clock.t += clock.dt;
  clock.dt_old = clock.dt;
  ++clock.cycle;
}

// Slow passes limit the intervals between outer steps, and no step is longer than such a limit.
TimeLimit::Limit Stepper::choose_dt(Clock& clock, std::string& who) {
  TimeLimit::Limit smallest{none, "nothing"};
  Real ringing = none, others = none, slow = none;
  const bool inner = subcycle_ && !subcycle_->outer();
  for (TimeLimit* limit : limits_) {
    const bool is_slow = subcycle_ && subcycle_->is_slow(*limit);
    TimeLimit::Limit one = is_slow && inner ? TimeLimit::Limit{subcycle_->limit() / rules_.share, "particles"}
                                            : limit->limit(world_, clock);
    if (is_slow) slow = std::min(slow, rules_.share * one.dt);
    Real& of_its_kind = limit->rings() ? ringing : others;
    of_its_kind = std::min(of_its_kind, rules_.share * one.dt);
    // NaN is the smallest of all: the run must stop there
    if (!std::isnan(smallest.dt) && !(one.dt >= smallest.dt)) smallest = std::move(one);
  }
  smallest.dt *= rules_.share;
  const TimeLimit::Limit computed = smallest;
  if (smallest.dt > 0 && smallest.dt < none)
    smallest = steady_.next(ringing, others, std::move(smallest.who));
  if (clock.cycle == 0 && rules_.dtinit > 0 && rules_.dtinit < smallest.dt)
    smallest = {rules_.dtinit, "DTINIT"};
  if (rules_.dt_max) {
    const Real most = rules_.dt_max(clock.t);
    if (most > 0 && most < smallest.dt) smallest = {most, "load curve"};
  }
  if (!(smallest.dt > 0)) {
    Guard::stop_for_numbers(world_, clock);  // mostly that is why; it names the quantity
    throw RunError(fmt::format("the step size became {} at time {:.6g}, cycle {}, set by {}", smallest.dt,
                               clock.t, clock.cycle, smallest.who),
                   StopCause::step_size);
  }
  if (std::isinf(smallest.dt))
    throw RunError(
        fmt::format("nothing limits the step size at time {:.6g}, cycle {}: no particle is active, and "
                    "there are no elements",
                    clock.t, clock.cycle),
        StopCause::step_size);
  clock.dt = inner ? std::min(smallest.dt, subcycle_->left()) : smallest.dt;
  if (subcycle_ && !inner) {
    Real between = none;
    for (const Springs* springs : springs_)
      between = std::min(between, springs->between_kicks(world_, clock));
    subcycle_->chosen(clock, slow, between);
  }
  who = std::move(smallest.who);
  return computed;
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
  e.kinetic = e.internal = e.discrete = e.potential = e.contact = e.hourglass = e.assumed_bending =
      e.bulk_viscosity = e.half_step = e.below = 0;
  for (EnergyTerm* term : world.passes.all<EnergyTerm>()) term->sample(world, clock, e);
}

}  // namespace courant
