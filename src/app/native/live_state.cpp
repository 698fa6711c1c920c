#include "app/native/live_state.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "app/report/run_summary.hpp"
#include "search/ghosts.hpp"

namespace courant::native {

LiveState::LiveState(Simulation& simulation)
    : t(simulation.clock().t),
      dt(simulation.clock().dt),
      cycle(simulation.clock().cycle),
      simulation_(&simulation) {}

void LiveState::end() {
  lent_.close();
  simulation_ = nullptr;
}

Simulation& LiveState::now() const {
  if (simulation_) return *simulation_;
  throw std::runtime_error("the run has gone on: take what is needed of a state while it is there");
}

FieldSet& LiveState::set_of(const std::string& name) const {
  for (FieldSet* set : now().world().sets())
    if (set->name() == name) return *set;
  throw pybind11::key_error(fmt::format("the run has no set '{}'", name));
}

int LiveState::dim() {
  return now().world().dim;
}

std::vector<std::string> LiveState::units() {
  const auto found = units_of(now());
  return found ? std::vector<std::string>{found->mass, found->length, found->time}
               : std::vector<std::string>{};
}

std::vector<std::string> LiveState::sets() {
  std::vector<std::string> out;
  for (const FieldSet* set : now().world().sets()) out.push_back(set->name());
  return out;
}

Index LiveState::size(const std::string& set) {
  return set_of(set).size();
}

Index LiveState::active() {
  return now().world().particles.active;
}

std::vector<std::tuple<std::string, std::string, int>> LiveState::fields(const std::string& set) {
  std::vector<std::tuple<std::string, std::string, int>> out;
  for (const auto& field : set_of(set).all())
    out.emplace_back(field->info().name, field->info().dimension, field->info().components);
  return out;
}

pybind11::array LiveState::array(const std::string& set, const std::string& field, int component) {
  FieldSet& of = set_of(set);
  FieldBase* found = of.find(field);
  if (!found || component < 0 || component >= found->info().components)
    throw pybind11::key_error(fmt::format("{} have no field '{}'", set, field));
  Index ghosts = 0;
  if (found->info().exchange)
    for (const auto* behind : now().world().passes.all<Ghosts>()) ghosts += behind->count();
  return lent_.get(*found, component, of.size(), ghosts);
}

std::map<Id, RigidBodyReport> LiveState::bodies() {
  std::map<Id, RigidBodyReport> out;
  if (const RigidBodies* bodies = now().bodies())
    for (const RigidBodyReport& one : bodies->reports()) out[one.part] = one;
  return out;
}

PointChanges& LiveState::changes_of(const std::string& set) const {
  const ProgramForces& forces = now().get<ProgramForces>();
  PointChanges* const found = set == "particles" ? forces.on_particles.get()
                              : set == "nodes"   ? forces.on_nodes.get()
                                                 : nullptr;
  if (found) return *found;
  throw std::invalid_argument(fmt::format("{} of this run do not move by forces of their own", set));
}

void LiveState::check(const std::string& set, const std::vector<Index>& at,
                      const std::vector<Real>& values) const {
  if (values.size() != 3 * at.size()) throw std::invalid_argument("expected three components for each point");
  const PointChanges& changes = changes_of(set);
  const World& world = now().world();
  const Index n = set_of(set).size();
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k] < 0 || at[k] >= n)
      throw std::invalid_argument(fmt::format("{} have no index {}: there are {}", set, at[k], n));
    if (const std::string why = changes.why_not(world, at[k]); !why.empty()) throw std::invalid_argument(why);
    for (std::size_t c = 0; c < 3; ++c)
      if (!std::isfinite(values[3 * k + c])) throw std::invalid_argument("expected finite numbers");
    if (world.dim == 2 && values[3 * k + 2] != 0)
      throw std::invalid_argument("in 2D nothing moves along z: its component must be 0");
  }
}

void LiveState::set_forces(const std::string& set, const std::vector<Index>& at,
                           const std::vector<Real>& values) {
  check(set, at, values);
  PointChanges& changes = changes_of(set);
  for (std::size_t k = 0; k < at.size(); ++k)
    changes.set_force(at[k], Vec(values[3 * k], values[3 * k + 1], values[3 * k + 2]));
}

void LiveState::set_velocities(const std::string& set, const std::vector<Index>& at,
                               const std::vector<Real>& values) {
  check(set, at, values);
  PointChanges& changes = changes_of(set);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Vec v(values[3 * k], values[3 * k + 1], values[3 * k + 2]);
    if (const std::string why = changes.set_velocity(now().world(), at[k], v); !why.empty())
      throw std::invalid_argument(why);
  }
}

std::size_t LiveState::body_of(Id part) const {
  if (const RigidBodies* bodies = now().bodies())
    for (std::size_t k = 0; k < bodies->bodies().size(); ++k)
      if (bodies->bodies()[k].part == part) return k;
  throw pybind11::key_error(fmt::format("part {} is no rigid body", part));
}

void LiveState::push_body(Id part, const Vec& force, const Vec& moment) {
  const std::size_t body = body_of(part);
  if (!force.allFinite() || !moment.allFinite()) throw std::invalid_argument("expected finite numbers");
  now().get<std::shared_ptr<RigidBodies>>()->set_program_load(body, force, moment);
}

void LiveState::move_body(Id part, const Vec& v, const Vec& omega) {
  const std::size_t body = body_of(part);
  if (!v.allFinite() || !omega.allFinite()) throw std::invalid_argument("expected finite numbers");
  const std::string why = now().get<std::shared_ptr<RigidBodies>>()->set_program_motion(body, v, omega);
  if (!why.empty()) throw std::invalid_argument(why);
}

}  // namespace courant::native
