// What touches of edges do: penalty, damping, friction; on nodes, in a fixed order; step and energy.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/edges/edge_contact.hpp"
#include "contact/nodes/contact_forces.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/face_forces.hpp"

namespace courant {

Index EdgeContact::node_of(const Touch& touch, int corner) const {
  return edge(corner < 2 ? touch.a : touch.b).node[static_cast<std::size_t>(corner % 2)];
}

// In the position of a less that of b.
Real EdgeContact::share_of(const Touch& touch, int corner) {
  const Real at = corner < 2 ? touch.at.s : touch.at.t, share = corner % 2 == 0 ? 1 - at : at;
  return corner < 2 ? share : -share;
}

Vec EdgeContact::velocity(const std::function<Vec(Index)>& of_node, const Touch& touch) const {
  Vec v = Vec::Zero();
  for (int c = 0; c < 4; ++c) v += share_of(touch, c) * of_node(node_of(touch, c));
  return v;
}

// The smaller of both; SOFT 1: at least what the step and the masses allow.
Real EdgeContact::stiffness_of(const World& world, Index a, Index b) const {
  const Real k = law_.slsfac * std::min(edge(a).k, edge(b).k);
  const Real dt = law_.dtstif > 0 ? law_.dtstif : soft_dt_;
  if (law_.soft == 0 || !(dt > 0)) return k;
  Real m = std::numeric_limits<Real>::infinity();
  for (const Index e : {a, b})
    for (const Index n : edge(e).node)
      if (!world.nodes.held[n]) m = std::min(m, world.nodes.m[n]);
  return std::isfinite(m) ? std::max(k, law_.sofscl * 0.5 * m / (dt * dt)) : k;
}

// Of the point of a (side 0) or b. [1/M]
Real EdgeContact::mobility(const World& world, const Touch& touch, int side) const {
  Real sum = 0;
  for (int c = 2 * side; c < 2 * side + 2; ++c) {
    const Index n = node_of(touch, c);
    const Real share = share_of(touch, c);
    if (!world.nodes.held[n]) sum += share * share / world.nodes.m[n];
  }
  return sum;
}

// The same along the push where a or b belongs to a rigid body, which does not move by the masses of its
// nodes.
Real EdgeContact::mobility_of_body(const World& world, const Touch& touch, int side, Real of_nodes) const {
  const Index body = bodies_.body(node_of(touch, 2 * side));
  if (body < 0 || bodies_.body(node_of(touch, 2 * side + 1)) != body) return of_nodes;
  const EdgeEnds ends = ends_of(edge(side == 0 ? touch.a : touch.b), world.nodes.x);
  return bodies_.give_alone(body, ends[0] + (side == 0 ? touch.at.s : touch.at.t) * (ends[1] - ends[0]),
                            touch.n);
}

// What other touches of a step ago, as deep as this one, add to its rate of speed over its depth. [1/T2]
Real EdgeContact::pulled_by_others(const World& world, const Touch& touch) const {
  Real sum = 0;
  for (int c = 0; c < 4; ++c) {
    const Index n = node_of(touch, c);
    if (world.nodes.held[n]) continue;
    const Real share = std::abs(share_of(touch, c)),
               all = springs_[static_cast<std::size_t>(place_[static_cast<std::size_t>(n)])];
    sum += share * std::max(all - share * touch.stiffness(), Real(0)) / world.nodes.m[n];
  }
  return sum;
}

void EdgeContact::push(const World& world, const Clock& clock, Touch& touch) const {
  touch.spread = touch.depth = touch.stored = touch.damping = 0;
  touch.force = Vec::Zero();
  for (int c = 0; c < 4; ++c)
    if (!world.nodes.held[node_of(touch, c)]) touch.spread += std::abs(share_of(touch, c));
  if (touch.due > 0) return;
  touch.slack = std::min(touch.slack, -touch.gap);
  touch.depth = -touch.gap - touch.slack;
  if (!(touch.depth > 0)) {
    touch.friction = Vec::Zero();
    return;
  }
  const Real k = touch.stiffness(), of_a = mobility(world, touch, 0), of_b = mobility(world, touch, 1);
  touch.stored = 0.5 * k * touch.depth * touch.depth;
  const Vec v = velocity([&](Index n) { return Vec(world.nodes.v.vec(n)); }, touch);
  const Real speed = v.dot(touch.n), dt = clock.dt_old;
  const Real others = pulled_by_others(world, touch);
  Real part = part_of_step(touch.depth, speed, dt, k * (of_a + of_b) + others);
  if (part < 1) {
    const Real gives = mobility_of_body(world, touch, 0, of_a) + mobility_of_body(world, touch, 1, of_b);
    part = part_of_step(touch.depth, speed, dt, k * gives + others);
  }
  Real fn = part * k * touch.depth;
  if (law_.vdc > 0 && of_a + of_b > 0) {
    // of the critical damping of both edges: 2 m omega, m the smaller mass
    const Real omega = std::sqrt(k * (of_a + of_b)), lighter = 1 / std::max(of_a, of_b);
    touch.damping = std::max(-0.01 * law_.vdc * 2 * lighter * omega * speed, -fn);  // never pulls
    fn += touch.damping;
  }
  if (friction_on_)
    touch.friction =
        friction_of(law_.between(edge(touch.a).of_part, edge(touch.b).of_part), touch.friction, touch.n, v,
                    k * dt, fn, touch.part * std::min(edge(touch.a).area, edge(touch.b).area));
  touch.force = fn * touch.n + touch.friction;
}

// Each touch has shares in four nodes; those of a node stand together, in the order of touches.
void EdgeContact::gather(const World& world) {
  note_access(touches_resource_);
  key_.clear();
  stiffest_ = {};
  due_ = std::numeric_limits<Real>::infinity();
  springs_.assign(springs_.size(), 0);
  for (const Touch& touch : touches_) {
    if (touch.due > 0) due_ = std::min(due_, touch.due);
    for (int c = 0; c < 4; ++c) {
      const Index p = place_[static_cast<std::size_t>(node_of(touch, c))];
      key_.push_back(p);
      if (touch.depth > 0)
        springs_[static_cast<std::size_t>(p)] += touch.stiffness() * std::abs(share_of(touch, c));
    }
  }
  if (key_.empty()) return;
  counting_sort(key_, static_cast<Index>(involved_.size()), first_, order_);
  for (Index p = 0; p < static_cast<Index>(involved_.size()); ++p) stiffest_.take(pull_on(world, p));
}

StiffestContact EdgeContact::pull_on(const World& world, Index p) const {
  const Index n = involved_[static_cast<std::size_t>(p)];
  Real now = 0, soon = 0;
  for (Index s = first_[static_cast<std::size_t>(p)]; s < first_[static_cast<std::size_t>(p) + 1]; ++s) {
    const Index of = order_[static_cast<std::size_t>(s)];
    const Touch& touch = touches_[static_cast<std::size_t>(of / 4)];
    (touch.due > 0 ? soon : now) +=
        touch.stiffness() * std::abs(share_of(touch, static_cast<int>(of % 4))) * touch.spread;
  }
  if (world.nodes.held[n]) return {};
  const Real m = world.nodes.m[n];
  return {{now / m, n}, {(now + soon) / m, n}};
}

bool EdgeContact::add_force_on(Index node, Vec& force) const {
  note_access(touches_resource_);
  const Index p = place_[static_cast<std::size_t>(node)];
  if (key_.empty() || p < 0) return false;
  const Index begin = first_[static_cast<std::size_t>(p)], end = first_[static_cast<std::size_t>(p) + 1];
  for (Index s = begin; s < end; ++s) {
    const Index of = order_[static_cast<std::size_t>(s)];
    const Touch& touch = touches_[static_cast<std::size_t>(of / 4)];
    force += share_of(touch, static_cast<int>(of % 4)) * touch.force;
  }
  return begin < end;
}

TimeLimit::Limit EdgeContact::limit(const World& world, const Clock&) {
  return limit_of(law_, stiffest_, due_, nodes_ ? 0.5 : 1, name(), world);
}

void EdgeContact::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  ledger.dissipated += let_go_, ledger.throughput += let_go_;
  damping_work_ += let_go_, let_go_ = 0;
  if (!drag_on_) return;
  const DrivenPoints driven(world.nodes.fields);
  Real damping = 0, friction = 0;
  for (const Touch& touch : touches_) {
    if (!(touch.depth > 0)) continue;
    const Vec v = velocity([&](Index n) { return middle_velocity(world, bodies_, clock, driven, n); }, touch);
    damping -= touch.damping * touch.n.dot(v) * clock.dt_mean();
    friction -= touch.friction.dot(v) * clock.dt_mean();
  }
  damping_work_ += damping, friction_work_ += friction;
  ledger.dissipated += damping + friction;
  ledger.throughput += std::abs(damping + friction);
}

// As of nodes: friction springs hold part of the friction work, which is not dissipated yet.
void EdgeContact::sample(const World&, const Clock&, EnergyLedger& ledger) const {
  for (const Touch& touch : touches_) ledger.contact += touch.stored;
}

// On the first face of each edge that is there, as the field of contact forces has them.
void EdgeContact::report_point_forces(const World& world,
                                      const std::function<void(const PointForce&)>& take) {
  for (const Touch& touch : touches_)
    for (int c = 0; c < 4; ++c)
      for (const Index s : edge(c < 2 ? touch.a : touch.b).faces) {
        if (eroded_ && (*eroded_)[s] != 0) continue;
        take({.segment = s,
              .point = world.nodes.x.vec(node_of(touch, c)),
              .force = share_of(touch, c) * touch.force});
        break;
      }
}

InterfaceForce EdgeContact::report() const {
  InterfaceForce out;
  out.id = law_.id ? law_.id : Id(number_);
  out.title = law_.title;
  Real springs = 0;
  for (const Touch& touch : touches_) {
    if (!law_.single) out.on_surfa += (edge(touch.a).sides & 1U) != 0 ? touch.force : Vec(-touch.force);
    out.energy_stored += touch.stored;
    if (friction_on_ && touch.depth > 0 && touch.k > 0)
      springs += 0.5 * touch.friction.squaredNorm() / touch.stiffness();
  }
  out.energy_stored += springs;
  out.energy_damping = damping_work_;
  out.energy_friction = friction_work_ - springs;
  return out;
}

void add_edge_contact(World& world, const std::shared_ptr<EdgeContact>& contact) {
  add_clear_face_forces(world);
  world.passes.add(contact);
  world.passes.add(std::make_shared<ContactForces<EdgeContact>>(contact));
}

}  // namespace courant
