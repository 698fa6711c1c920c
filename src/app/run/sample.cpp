// What the histories print, taken from the world at t^n.
#include <algorithm>
#include <unordered_map>

#include "app/run/interface_impulses.hpp"
#include "app/run/momentum_watch.hpp"
#include "app/run/simulation.hpp"
#include "elements/shape_watch.hpp"
#include "extension/additions.hpp"
#include "gauges/gauge.hpp"
#include "state/force_of_now.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// Where the entities of the named ids stand now: few among many.
template <class Ids>
std::unordered_map<Id, Index> places_of(const Ids& wanted, const Field<Id>& id, Index n) {
  std::unordered_map<Id, Index> index;
  for (const auto& one : wanted) index[one] = -1;
  if (index.empty()) return index;
  for (Index i = 0; i < n; ++i)
    if (const auto at = index.find(id[i]); at != index.end()) at->second = i;
  return index;
}

Vec force_on(const std::vector<BoundaryForce>& forces, Id particle) {
  Vec sum = Vec::Zero();
  for (const BoundaryForce& force : forces)
    if (force.kind == BoundaryForce::Kind::driven_point && force.id == particle) sum += force.force;
  return sum;
}

ParticleSample particle_sample(const World& world, const Neighbours& neighbours, const Clock& clock,
                               Index i) {
  const Particles& p = world.particles;
  const bool active = i < p.active;
  ParticleSample out{p.id[i], active, p.place(i, clock.t), p.v.vec(i), p.p[i], p.rho[i], p.E[i]};
  out.part = world.part_id(i);
  out.h = p.h[i];
  if (active) out.neighbours = static_cast<std::int64_t>(neighbours.of(p, i).size());
  if (const auto* tau = shared_fields::stress.find(p.fields); tau && active)
    for (int k = 0; k < 6; ++k) out.tau[static_cast<std::size_t>(k)] = tau->data(k)[i];
  return out;
}

/// A node of shells and beams turns by its moments.
void turn(const World& world, Index n, const std::vector<BoundaryForce>& forces, NodeSample& node) {
  const Field<Index>* none = shared_fields::no_rotation.find(world.nodes.fields);
  if (!none || (*none)[n] != 0) return;
  const auto& set = world.nodes.fields;
  node.turns = true;
  node.rotation = shared_fields::rotation.find(set)->vec(n);
  node.omega = shared_fields::angular_velocity.find(set)->vec(n);
  Vec moment = shared_fields::moment.find(set)->vec(n);
  for (const BoundaryForce& force : forces)
    if (force.kind == BoundaryForce::Kind::driven_rotation && force.id == node.id) moment += force.moment;
  node.angular_a = moment / (*shared_fields::rotary_inertia.find(set))[n];
}

/// The nodes of a rigid body move with it: v + omega x r, a + alpha x r + omega x (omega x r).
void follow(const RigidBodyMotion& body, NodeSample& node) {
  const Vec r = node.x - body.x;
  node.turns = true;
  node.a = body.a + body.angular_a.cross(r) + body.omega.cross(body.omega.cross(r));
  node.rotation = body.rotation, node.omega = body.omega, node.angular_a = body.angular_a;
}

/// Rows: the axes of an accelerometer.
Matrix local_axes(const HistoryNode& one, const Vec& x, const World& world) {
  std::array<Vec, 2> to{Vec::UnitX(), Vec::UnitY()};
  for (Index n = 0; n < world.nodes.size(); ++n)
    for (std::size_t k = 0; k < 2; ++k)
      if (world.nodes.id[n] == one.axes[k]) to[k] = world.nodes.x.vec(n) - x;
  Matrix axes;
  axes.row(0) = to[0].normalized();
  axes.row(2) = to[0].cross(to[1]).normalized();
  axes.row(1) = Vec(axes.row(2)).cross(Vec(axes.row(0)));
  return axes;
}
void turn_to(const Matrix& axes, NodeSample& node) {
  for (Vec* v : {&node.v, &node.a, &node.omega, &node.angular_a}) *v = axes * *v;
}

void sample_nodes(const std::vector<HistoryNode>& wanted, const World& world, const RigidBodies* bodies,
                  const Clock& clock, Sample& s) {
  if (wanted.empty()) return;
  std::vector<Id> ids;
  for (const HistoryNode& one : wanted) ids.push_back(one.id);
  const Particles& p = world.particles;
  const Field<Real>& force = force_of_now(p);
  const auto particle = places_of(ids, p.id, p.size()),
             shell_node = places_of(ids, world.nodes.id, world.nodes.size());
  std::unordered_map<Index, const RigidBodyMotion*> body_of;
  if (bodies)
    for (std::size_t b = 0; b < s.body_motions.size(); ++b)
      for (const Index n : bodies->bodies()[b].nodes) body_of[n] = &s.body_motions[b];
  for (const HistoryNode& one : wanted) {
    NodeSample node{.id = one.id, .x = one.X};
    if (const Index i = particle.at(one.id); i >= 0) {
      node.x = p.place(i, clock.t);
      node.v = p.v.vec(i);
      if (i < p.active) node.a = (force.vec(i) + force_on(s.boundary_forces, one.id)) / p.m[i];
    } else if (const Index n = shell_node.at(one.id); n >= 0) {
      node.x = world.nodes.x.vec(n);
      node.v = world.nodes.v.vec(n);
      if (const auto body = body_of.find(n); body != body_of.end())
        follow(*body->second, node);
      else
        turn(world, n, s.boundary_forces, node);
      if (!body_of.contains(n) && !world.nodes.follow[n] && world.nodes.m[n] > 0)
        node.a = (world.nodes.f.vec(n) + force_on(s.boundary_forces, one.id)) / world.nodes.m[n];
    }
    node.displacement = node.x - one.X;
    if (one.axes[0] != 0) turn_to(local_axes(one, node.x, world), node);
    s.nodes.push_back(node);
  }
}

void sample_elements(const World& world, Sample& s) {
  std::vector<PartSums> sums(s.parts.size());
  for (const auto* reporter : world.passes.all<const PartReporter>()) reporter->report_part(world, sums);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    PartSample& part = s.parts[k];
    part.mass += sums[k].mass, part.momentum += sums[k].momentum;
    part.internal += sums[k].internal, part.kinetic += sums[k].kinetic, part.hourglass += sums[k].hourglass;
    part.added_mass += sums[k].added_mass;
    part.eroded_internal += sums[k].eroded_internal, part.eroded_hourglass += sums[k].eroded_hourglass;
  }
}

/// Of particles, bodies, what moves by itself and what that carries: a node of a body may have elements of
/// another part, whose masses count with both.
void sum_masses(const World& world, Sample& s) {
  Vec momentum = Vec::Zero();
  const auto add = [&](Real m, const Vec& v) { s.mass += m, momentum += m * v; };
  for (Index i = 0; i < world.particles.active; ++i) add(world.particles.m[i], world.particles.v.vec(i));
  const Field<Real>* carried = shared_fields::tied_mass.find(world.nodes.fields);
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (world.nodes.follow[n] != 1)
      add(world.nodes.m[n] - (carried ? (*carried)[n] : 0), world.nodes.v.vec(n));
  for (const RigidBodyReport& body : s.bodies) add(body.mass, body.v);
  if (s.mass > 0) s.velocity = momentum / s.mass;
}

void sample_parts(const World& world, const Model& model, Sample& s) {
  const Particles& p = world.particles;
  const auto* volume = shared_fields::reference_volume.find(p.fields);
  for (const ModelPart& part : model.parts) s.parts.push_back({.id = part.id, .title = part.title});
  for (Index i = 0; i < p.active; ++i) {
    PartSample& part = s.parts[p.part[i]];
    const Real m = p.m[i];
    const Vec v = p.v.vec(i);
    part.mass += m;
    part.momentum += m * v;
    part.kinetic += 0.5 * m * v.squaredNorm();
    part.internal += p.E[i] * (*volume)[i];
  }
  sample_elements(world, s);
  for (PartSample& part : s.parts)
    if (part.mass > 0) part.rigid_velocity = part.momentum / part.mass;
  for (const RigidBodyReport& body : s.bodies) {
    const auto at = model.part_of_id.find(body.part);
    if (at == model.part_of_id.end()) continue;  // of nodes, whose mass counts with their elements
    PartSample& part = s.parts[at->second];
    part.mass = body.mass;
    part.momentum = body.mass * body.v;
    part.kinetic = body.kinetic_energy;
    part.rigid_velocity = body.v;
  }
  sum_masses(world, s);
}

void sample_boundary_forces(const World& world, const Clock& clock, std::vector<BoundaryForce>& out) {
  const auto report = [&](const BoundaryForceReporter& one) { one.report_forces(world, clock, out); };
  for (const auto* reporter : world.passes.all<const BoundaryForceReporter>()) report(*reporter);
  // particles are in an order of their own, which changes
  std::sort(out.begin(), out.end(), [](const BoundaryForce& a, const BoundaryForce& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.id < b.id;
  });
}

AddedSample added_sample(const AsciiHistory& added, const Deck& deck, const World& world,
                         const Clock& clock) {
  AddedSample out;
  if (!(added.interval(deck) > 0)) return out;
  const bool binary_alone = added.numbers && added.binary && added.binary(deck) == 2;
  if (!binary_alone) out.text = added.text(world, clock);
  if (added.numbers) added.numbers(world, clock, out.numbers);
  return out;
}

}  // namespace

void Simulation::show_wall_forces() {
  for (const auto& contact : contacts()) contact->show_forces(world_);
  for (auto* walls : world_.passes.all<WallForceReporter>()) walls->show_forces(world_);
  for (auto* filler : world_.passes.all<FieldFiller>()) filler->fill_fields(world_);
}

Sample Simulation::sample(const std::string& dt_controlled_by, bool whole,
                          const std::vector<std::size_t>& gauges) {
  Sample s;
  s.t = clock_.t, s.dt = clock_.dt, s.cycle = clock_.cycle;
  if (whole) sample_all(dt_controlled_by, s);
  if (gauges.empty()) return s;
  const auto motions = bodies() ? bodies()->motions(clock_) : std::vector<RigidBodyMotion>();
  for (const auto* all : world_.passes.all<const Gauges>())
    s.gauges = all->measure(world_, clock_, motions, gauges);
  return s;
}

void Simulation::sample_all(const std::string& dt_controlled_by, Sample& s) {
  sample_energy(world_, clock_);
  s.dt_set_by = dt_controlled_by, s.energy = world_.energy;
  if (bodies()) s.bodies = bodies()->reports(), s.body_motions = bodies()->motions(clock_);
  sample_parts(world_, model_, s);
  for (auto* watch : world_.passes.all<MomentumWatch>()) watch->look(s, world_);
  for (auto* watch : world_.passes.all<ShapeWatch>()) watch->look(world_, clock_.cycle);
  s.interfaces = interface_forces(world_, contacts());
  for (const auto* impulses : world_.passes.all<InterfaceImpulses>())
    if (impulses->summed) s.impulses = impulses->so_far(s.interfaces.size());
  sample_boundary_forces(world_, clock_, s.boundary_forces);
  for (const auto* wall : world_.passes.all<const RigidWallReporter>())
    s.rigid_walls.push_back(wall->report_wall());
  for (const AsciiHistory& added : ascii_histories())
    s.added.push_back(added_sample(added, deck_, world_, clock_));
  const std::vector<Id>& wanted = model_.output.history_sph;
  const Particles& p = world_.particles;
  const auto index = places_of(wanted, p.id, p.size());
  for (const Id id : wanted)
    if (const Index i = index.at(id); i >= 0)
      s.particles.push_back(particle_sample(world_, neighbours(), clock_, i));
  sample_nodes(model_.output.history_node, world_, bodies(), clock_, s);
}

}  // namespace courant
