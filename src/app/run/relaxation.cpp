#include "app/run/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/run/interface_impulses.hpp"
#include "base/run_error.hpp"
#include "output/file.hpp"
#include "output/result_names.hpp"
#include "parallel/parallel.hpp"
#include "state/points.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

Real energy_of(const Points& points) {
  return sum(points.set->size(), [&](Index i) -> Real {
    if (points.follow && (*points.follow)[i]) return 0;
    return 0.5 * (*points.m)[i] * points.v->vec(i).squaredNorm();
  });
}

Real kinetic_energy(Simulation& s) {
  Nodes& nodes = s.world().nodes;
  Real out = energy_of(points_of(nodes));
  if (has_rotations(nodes)) out += energy_of(rotations_of(nodes));
  return out + (s.bodies() ? s.bodies()->kinetic_energy() : 0);
}

/// How nodes come to rest: from look to look.
class Settling {
 public:
  explicit Settling(const Nodes& nodes)
      : nodes_(nodes), start_(values(nodes.x)), x_(start_), f_(values(nodes.f)) {}
  /// Looks, and estimates the share of the way that is ahead: each look brings less than that before it by a
  /// factor, and will. Until there are two looks, and while changes grow, it is all. [-]
  Real ahead() {
    const std::vector<Vec> x = values(nodes_.x), f = values(nodes_.f);
    Real way = 0, change = 0, pull = 0;  // weighed by mass: what is light counts little
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec d = x[i] - x_[i];
      const Real m = nodes_.m[static_cast<Index>(i)];
      way += m * (x[i] - start_[i]).squaredNorm(), change += m * d.squaredNorm();
      if (m > 0) pull -= d.dot(f[i] - f_[i]);
    }
    frequency_ = pull > 0 && change > 0 ? std::sqrt(pull / change) : 0;
    way = std::sqrt(way), change = std::sqrt(change);
    const Real before = std::exchange(change_, change);
    x_ = x, f_ = f;
    if (!(change > settled * way)) return 0;
    return change < before ? change * change / (before - change) / way : 1;
  }
  /// Of the last change, by Rayleigh's quotient; 0: none. [1/T]
  Real frequency() const { return frequency_; }

 private:
  static constexpr Real settled = 1e-6;
  std::vector<Vec> values(const Field<Real>& field) const {
    std::vector<Vec> out(static_cast<std::size_t>(nodes_.size()));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = field.vec(static_cast<Index>(i));
    return out;
  }
  const Nodes& nodes_;
  std::vector<Vec> start_, x_, f_;
  Real change_ = 0, frequency_ = 0;
};

/// Largest plastic strain of all points of elements.
Real most_plastic_strain(const World& world) {
  Real most = 0;
  for (const auto& group : world.groups)
    for (const auto& field : group->fields.all())
      if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get());
          reals && reals->info().name.find("plastic_strain") != std::string::npos)
        for (int k = 0; k < reals->info().components; ++k)
          for (Index e = 0; e < group->size(); ++e) most = std::max(most, reals->data(k)[e]);
  return most;
}

}  // namespace

RelaxationEnd relax(Simulation& s, const std::function<bool()>& stop,
                    const std::function<void(const std::string&)>& line) {
  const Relaxation& rules = s.relaxation();
  RelaxationEnd out;
  constexpr Real near = 1e-3;      // of the way
  constexpr int most_looks = 200;  // of a system at rest by its energy, parts of which drift without an end
  int drifts = 0;
  Real peak = 0, recent = 0;
  s.slow_down(0);
  Settling settling(s.world().nodes);
  while (!out.converged && !out.stopped && s.clock().t < rules.end) {
    s.step([](World&, const Clock&, const std::string&) {});
    s.slow_bodies(rules.factor);
    const Real kinetic = kinetic_energy(s);
    peak = std::max(peak, kinetic), recent = std::max(recent, kinetic);
    out.stopped = stop();
    if (s.clock().cycle % rules.check_every != 0) continue;
    out.ratio = peak > 0 ? recent / peak : 0;
    out.ahead = settling.ahead();
    if (const Real w = settling.frequency(); w * s.clock().dt < 0.5) out.factor = 1 - 2 * w * s.clock().dt;
    line(fmt::format("{:14.6e}{:14.6e}{:14.6e}{:14.6e}{:16.9f}\n", s.clock().t, kinetic, out.ratio, out.ahead,
                     out.factor));
    const bool at_rest = out.ratio < rules.tolerance && s.clock().t >= rules.ramp;
    drifts = at_rest && !(out.ahead < 1) ? drifts + 1 : 0;
    out.creeps = drifts >= most_looks;
    out.converged = at_rest && (out.ahead < near || out.creeps);
    recent = 0;
  }
  if (!out.stopped && peak == 0) out.converged = true;  // nothing moved, however short it was
  if (!out.converged && recent > 0 && out.ratio == 0)
    out.ratio = recent / peak;  // it ended before the first look
  std::string who;
  s.evaluate(who);  // stresses of the last step
  s.guard().look(s.world(), s.clock());
  out.time = s.clock().t, out.steps = s.clock().cycle;
  if (rules.at_once) out.yielded = most_plastic_strain(s.world());
  return out;
}

std::optional<RunEnd> relax_before(Simulation& run, const RunOptions& options,
                                   const std::function<std::optional<RunEnd>()>& stop,
                                   const std::function<void(const std::string&)>& tell) {
  if (!run.relaxation().asked) return std::nullopt;
  if (!options.relaxing) throw RunError("the deck asks for a relaxation, and no simulation of it was given");
  TextFile file(result_path(options.dir, result_names::relaxation));
  file.write(relaxation_head);
  tell(" dynamic relaxation");
  std::optional<RunEnd> stopped;
  const RelaxationEnd end = relax(
      *options.relaxing, [&] { return (stopped = stop()).has_value(); },
      [&](const std::string& line) { file.write(line); });
  tell(fmt::format(" {} at time {:.6g}, cycle {}: kinetic energy {:.3e} of its largest",
                   end.converged ? "converged"
                   : end.stopped ? "stopped"
                                 : "*** Warning: the dynamic relaxation has not converged",
                   end.time, end.steps, end.ratio));
  run.start_from(*options.relaxing);
  if (!end.converged) run.world().maxima["relaxation_ratio"] = end.ratio;
  if (!end.converged && end.factor > 0) run.world().maxima["relaxation_factor"] = end.factor;
  if (end.creeps) run.world().maxima["relaxation_ahead"] = end.ahead;
  if (end.yielded > 0) run.world().maxima["relaxation_plastic_strain"] = end.yielded;
  if (!stopped) return std::nullopt;
  return RunEnd{.reason = stopped->reason + ", in the relaxation before it", .interrupted = true};
}

void Simulation::slow_down(Real factor) {
  Nodes& nodes = world_.nodes;
  for (Field<Real>* field : {&nodes.v, shared_fields::angular_velocity.find(nodes.fields)})
    for (int k = 0; field && k < 3; ++k)
      for (Index i = 0; i < nodes.size(); ++i) field->data(k)[i] *= factor;
  slow_bodies(factor);
}

void Simulation::slow_bodies(Real factor) {
  if (const auto& bodies = get<std::shared_ptr<RigidBodies>>()) bodies->slow_down(factor);
}

void Simulation::start_from(Simulation& relaxed) {
  Nodes& nodes = world_.nodes;
  Field<Real>* const turning = shared_fields::angular_velocity.find(nodes.fields);
  const auto velocities = [&](Field<Real>* field) {
    std::vector<Vec> out;
    for (Index i = 0; field && i < nodes.size(); ++i) out.push_back(field->vec(i));
    return out;
  };
  const std::vector<Vec> v = velocities(&nodes.v), w = velocities(turning);
  std::vector<std::array<Vec, 2>> of_bodies;
  const auto& bodies = get<std::shared_ptr<RigidBodies>>();
  if (bodies)
    for (const RigidBody& b : bodies->bodies()) of_bodies.push_back({b.v, b.omega});
  SavedState state;
  Archive save = Archive::saver(state);
  relaxed.keep(save);
  Archive load = Archive::loader(state);
  keep(load);
  clock_ = {};
  world_.energy = {};
  for (auto* impulses : world_.passes.all<InterfaceImpulses>()) impulses->begin();
  for (std::size_t i = 0; i < v.size(); ++i) nodes.v.set(static_cast<Index>(i), v[i]);
  for (std::size_t i = 0; i < w.size(); ++i) turning->set(static_cast<Index>(i), w[i]);
  if (bodies) bodies->start_moving(of_bodies, world_);
  for (const char* work : {"drive_work", "drive_work_of_rotations"})
    if (auto* field = dynamic_cast<Field<Real>*>(nodes.fields.find(work))) field->fill(0);
  stepper_->forget_first_step();
}

}  // namespace courant
