#include "app/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/run_error.hpp"
#include "output/file.hpp"
#include "output/result_names.hpp"
#include "parallel/parallel.hpp"
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

}  // namespace

RelaxationEnd relax(Simulation& s, const std::function<bool()>& stop,
                    const std::function<void(const std::string&)>& line) {
  const Relaxation& rules = s.relaxation();
  RelaxationEnd out;
  Real peak = 0, recent = 0;
  s.slow_down(0);
  while (!out.converged && !out.stopped && s.clock().t < rules.end) {
    s.step([](World&, const Clock&, const std::string&) {});
    s.slow_bodies(rules.factor);
    const Real kinetic = kinetic_energy(s);
    peak = std::max(peak, kinetic), recent = std::max(recent, kinetic);
    out.stopped = stop();
    if (s.clock().cycle % rules.check_every != 0) continue;
    out.ratio = peak > 0 ? recent / peak : 0;
    line(fmt::format("{:14.6e}{:14.6e}{:14.6e}\n", s.clock().t, kinetic, out.ratio));
    out.converged = out.ratio < rules.tolerance && s.clock().t >= rules.ramp;
    recent = 0;
  }
  std::string who;
  s.evaluate(who);  // stresses of the last step
  s.guard().look(s.world(), s.clock());
  out.time = s.clock().t, out.steps = s.clock().cycle;
  return out;
}

RelaxationEnd relax_before(Simulation& run, const RunOptions& options,
                           const std::function<void(const std::string&)>& tell) {
  if (!run.relaxation().asked) return {.converged = true};
  if (!options.relaxing) throw RunError("the deck asks for a relaxation, and no simulation of it was given");
  TextFile file(result_path(options.dir, result_names::relaxation));
  file.write(relaxation_head);
  tell(" dynamic relaxation");
  const RelaxationEnd end = relax(
      *options.relaxing, [&] { return options.stop && *options.stop; },
      [&](const std::string& line) { file.write(line); });
  tell(fmt::format(" {} at time {:.6g}, cycle {}: kinetic energy {:.3e} of its largest",
                   end.converged ? "converged"
                   : end.stopped ? "stopped"
                                 : "*** Warning: the dynamic relaxation has not converged",
                   end.time, end.steps, end.ratio));
  run.start_from(*options.relaxing);
  if (!end.converged) run.world().maxima["relaxation_ratio"] = end.ratio;
  return end;
}

void Simulation::slow_down(Real factor) {
  Nodes& nodes = world_.nodes;
  for (Field<Real>* field : {&nodes.v, shared_fields::angular_velocity.find(nodes.fields)})
    for (int k = 0; field && k < 3; ++k)
      for (Index i = 0; i < nodes.size(); ++i) field->data(k)[i] *= factor;
  slow_bodies(factor);
}

void Simulation::slow_bodies(Real factor) {
  if (bodies_) bodies_->slow_down(factor);
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
  if (bodies_)
    for (const RigidBody& b : bodies_->bodies()) of_bodies.push_back({b.v, b.omega});
  SavedState state;
  Archive save = Archive::saver(state);
  relaxed.keep(save);
  Archive load = Archive::loader(state);
  keep(load);
  clock_ = {};
  world_.energy = {};
  for (std::size_t i = 0; i < v.size(); ++i) nodes.v.set(static_cast<Index>(i), v[i]);
  for (std::size_t i = 0; i < w.size(); ++i) turning->set(static_cast<Index>(i), w[i]);
  if (bodies_) bodies_->start_moving(of_bodies, world_);
  for (const char* work : {"drive_work", "drive_work_of_rotations"})
    if (auto* field = dynamic_cast<Field<Real>*>(nodes.fields.find(work))) field->fill(0);
  stepper_->forget_first_step();
}

}  // namespace courant
