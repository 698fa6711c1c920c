// Forces of touches on nodes, gathered in a fixed order; the step that they allow; their energy.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "contact/nodes/contact_forces.hpp"
#include "contact/nodes/node_contact.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/face_forces.hpp"

namespace courant {

Real NodeContact::share_of(const Share& share) const {
  return share.corner < 0
             ? Real(1)
             : -touches_[static_cast<std::size_t>(share.touch)].N[static_cast<std::size_t>(share.corner)];
}

Vec NodeContact::force_of(const Share& share) const {
  const Touch& touch = touches_[static_cast<std::size_t>(share.touch)];
  if (share.corner < 0) return touch.force;
  const auto e = static_cast<std::size_t>(share.corner);
  return -touch.N[e] * touch.force + touch.tilt[e] * touch.lever;
}

// Each touch has shares in its node and in the corners of its face; those of a node stand together, in the
// order of touches.
void NodeContact::gather(const World& world) {
  note_access(touches_resource_);
  key_.clear(), shares_.clear();
  for (std::size_t t = 0; t < touches_.size(); ++t) {
    const Touch& touch = touches_[t];
    const ContactFace& f = face(touch.face);
    key_.push_back(place_[static_cast<std::size_t>(touch.node)]);
    shares_.push_back({static_cast<Index>(t), -1});
    for (int e = 0; e < f.corners; ++e) {
      key_.push_back(place_[static_cast<std::size_t>(f.node[static_cast<std::size_t>(e)])]);
      shares_.push_back({static_cast<Index>(t), e});
    }
  }
  stiffest_ = {};
  due_ = std::numeric_limits<Real>::infinity();
  if (shares_.empty()) return;
  for (const Touch& touch : touches_) {
    if (touch.due > 0) due_ = std::min(due_, touch.due);
    // of one alone where bodies yield by more than the masses of their nodes tell
    const ContactFrequency own{touch.k * touch.spread * std::max(touch.gives[0], touch.gives[1]), touch.node};
    stiffest_.take({touch.due > 0 ? ContactFrequency() : own, own});
  }
  counting_sort(key_, static_cast<Index>(involved_.size()), first_, order_);
  const StiffestContact of_nodes = reduce(
      static_cast<Index>(involved_.size()), StiffestContact(),
      [&](Index begin, Index end) {
        StiffestContact out;
        for (Index p = begin; p < end; ++p) out.take(pull_on(world, p));
        return out;
      },
      [](StiffestContact a, const StiffestContact& b) {
        a.take(b);
        return a;
      });
  stiffest_.take(of_nodes);
}

void NodeContact::sum_springs_of_bodies(const World& world, const Clock& clock) {
  if (body_springs_.empty()) return;
  body_springs_.assign(body_springs_.size(), 0);
  body_push_.assign(body_springs_.size(), Vec::Zero()), body_turn_ = body_push_;
  constexpr Real soon = 2;  // steps
  for (const Touch& touch : touches_)
    for (std::size_t side = 0; side < 2; ++side) {
      if (touch.body[side] < 0 || (clock.dt_old > 0 && !(touch.due < soon * clock.dt_old))) continue;
      const auto b = static_cast<std::size_t>(touch.body[side]);
      const Vec push = (side == 0 ? touch.k : -touch.k) * touch.n;
      body_springs_[b] += touch.k, body_push_[b] += push;
      body_turn_[b] += world.nodes.x.vec(touch.node).cross(push);
    }
}

StiffestContact NodeContact::pull_on(const World& world, Index p) const {
  if (first_[static_cast<std::size_t>(p)] == first_[static_cast<std::size_t>(p) + 1]) return {};
  const Index n = involved_[static_cast<std::size_t>(p)];
  Real now = 0, soon = 0;
  for (Index s = first_[static_cast<std::size_t>(p)]; s < first_[static_cast<std::size_t>(p) + 1]; ++s) {
    const Share& share = shares_[static_cast<std::size_t>(order_[static_cast<std::size_t>(s)])];
    const Touch& touch = touches_[static_cast<std::size_t>(share.touch)];
    (touch.due > 0 ? soon : now) += touch.k * std::abs(share_of(share)) * touch.spread;
  }
  if (world.nodes.held[n]) return {};
  const Real m = world.nodes.m[n];
  return {{now / m, n}, {(now + soon) / m, n}};
}

bool NodeContact::add_force_on(Index node, Vec& force) const {
  note_access(touches_resource_);
  const Index p = place_[static_cast<std::size_t>(node)];
  if (shares_.empty() || p < 0) return false;
  const Index begin = first_[static_cast<std::size_t>(p)], end = first_[static_cast<std::size_t>(p) + 1];
  for (Index s = begin; s < end; ++s) {
    force += force_of(shares_[static_cast<std::size_t>(order_[static_cast<std::size_t>(s)])]);
  }
  return begin < end;
}

Vec NodeContact::force_between(const Surface& a, const Surface& b) const {
  note_access(touches_resource_);
  Vec sum = Vec::Zero();
  for (const Touch& touch : touches_) {
    const auto n = static_cast<std::size_t>(touch.node);
    const Index s = face(touch.face).segment;
    if (a.node[n] != 0 && b.has_segment(s))
      sum += touch.force;
    else if (b.node[n] != 0 && a.has_segment(s))
      sum -= touch.force;
  }
  return sum;
}

TimeLimit::Limit NodeContact::limit(const World& world, const Clock&) {
  // springs that hold the same nodes, and edges, ask for the other half
  const Real part = holder_ || law_.with_edges ? 0.5 : 1;
  return limit_of(law_, stiffest_, due_, part, name(), world);
}

bool NodeContact::holds(Index node, Index segment) const {
  note_access(touches_resource_);
  const Index p = place_[static_cast<std::size_t>(node)];
  if (shares_.empty() || p < 0) return false;
  for (Index s = first_[static_cast<std::size_t>(p)]; s < first_[static_cast<std::size_t>(p) + 1]; ++s) {
    const Share& share = shares_[static_cast<std::size_t>(order_[static_cast<std::size_t>(s)])];
    if (share.corner < 0 && face(touches_[static_cast<std::size_t>(share.touch)].face).segment == segment)
      return true;
  }
  return false;
}

void NodeContact::record(World& world, const Clock& clock, EnergyLedger& ledger) {
  ledger.dissipated += let_go_, ledger.throughput += let_go_;
  damping_work_ += let_go_, let_go_ = 0;
  if (!drag_on_ || touches_.empty()) return;
  const DrivenPoints driven(world.nodes.fields);
  struct Work {
    Real damping = 0, friction = 0;
  };
  const Work work = reduce(
      static_cast<Index>(touches_.size()), Work(),
      [&](Index begin, Index end) {
        Work out;
        for (Index t = begin; t < end; ++t) {
          const Touch& touch = touches_[static_cast<std::size_t>(t)];
          const ContactFace& f = face(touch.face);
          Vec v = middle_velocity(world, bodies_, clock, driven, touch.node);
          for (std::size_t e = 0; e < static_cast<std::size_t>(f.corners); ++e)
            v -= touch.N[e] * middle_velocity(world, bodies_, clock, driven, f.node[e]);
          out.damping -= touch.damping * touch.n.dot(v) * clock.dt_mean();
          out.friction -= touch.friction.dot(v) * clock.dt_mean();
        }
        return out;
      },
      [](const Work& a, const Work& b) {
        return Work{a.damping + b.damping, a.friction + b.friction};
      });
  damping_work_ += work.damping, friction_work_ += work.friction;
  ledger.dissipated += work.damping + work.friction;
  ledger.throughput += std::abs(work.damping + work.friction);
}

// Friction springs hold part of the friction work: what they store now is not dissipated yet.
void NodeContact::sample(const World&, const Clock&, EnergyLedger& ledger) const {
  for (const Touch& touch : touches_) ledger.contact += touch.stored;
}

InterfaceForce NodeContact::report() const {
  InterfaceForce out;
  out.id = law_.id ? law_.id : Id(number_);
  out.title = law_.title;
  Real springs = 0;
  for (const Touch& touch : touches_) {
    if (!law_.single) out.on_surfa += touch.pass == 0 ? touch.force : Vec(-touch.force);
    out.energy_stored += touch.stored;
    if (friction_on_ && touch.k > 0) springs += 0.5 * touch.friction.squaredNorm() / touch.k;
  }
  out.energy_stored += springs;
  out.energy_damping = damping_work_;
  out.energy_friction = friction_work_ - springs;
  return out;
}

void NodeContact::report_point_forces(const World& world,
                                      const std::function<void(const PointForce&)>& take) {
  for (const Touch& touch : touches_) {
    take({.node = touch.node, .point = world.nodes.x.vec(touch.node), .force = touch.force});
    const ContactFace& on = face(touch.face);
    for (std::size_t e = 0; e < touch.N.size(); ++e)
      take({.segment = on.segment,
            .point = world.nodes.x.vec(on.node[e]),
            .force = -touch.N[e] * touch.force + touch.lever * touch.tilt[e]});
  }
}

void add_node_contact(World& world, const std::shared_ptr<NodeContact>& contact) {
  add_clear_face_forces(world);
  world.passes.add(contact);
  world.passes.add(std::make_shared<ContactForces<NodeContact>>(contact));
}

}  // namespace courant
