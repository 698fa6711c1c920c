// What a touch does: penalty, damping, friction.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/nodes/node_contact.hpp"

namespace courant {

namespace {

constexpr Real unbounded = std::numeric_limits<Real>::infinity();

}  // namespace

// The body that all corners of a face belong to; -1: none.
Index NodeContact::body_under(const ContactFace& f) const {
  const Index body = bodies_.body(f.node[0]);
  const auto last = f.node.begin() + f.corners;
  return body >= 0 && std::all_of(f.node.begin(), last, [&](Index n) { return bodies_.body(n) == body; })
             ? body
             : -1;
}

// Nodes of bodies move as these do, not by masses of their own.
void NodeContact::find_bodies(const World& world, Touch& touch) const {
  touch.body = {bodies_.body(touch.node), body_under(face(touch.face))};
  const Vec x = world.nodes.x.vec(touch.node);
  for (std::size_t side = 0; side < 2; ++side)
    if (touch.body[side] >= 0) touch.gives[side] = bodies_.give_alone(touch.body[side], x, touch.n);
}

// Of the force: see part_of_step. Beside the spring act those of the corners of the face as far as they
// touched something a step ago, and on a body all that touch it, as deep as this one.
Real NodeContact::part_of(const World& world, const Clock& clock, const Touch& touch, Real speed,
                          const std::array<Real, 2>& mobility) const {
  const ContactFace& f = face(touch.face);
  const Vec x = world.nodes.x.vec(touch.node);
  Real springs = 1, omega2 = 0;
  for (std::size_t e = 0; e < static_cast<std::size_t>(f.corners); ++e)
    springs += std::max(touch.N[e], Real(0)) *
               touched_[static_cast<std::size_t>(place_[static_cast<std::size_t>(f.node[e])])];
  for (std::size_t side = 0; side < 2; ++side) {
    const Index body = touch.body[side];
    if (body < 0) {
      omega2 += springs * touch.k * mobility[side];
      continue;
    }
    const auto b = static_cast<std::size_t>(body);
    constexpr Real alone = 1.5;  // times its own spring: no other touch, or this touch was not predicted
    if (body_springs_[b] < alone * touch.k) {
      omega2 += touch.k * touch.gives[side];
      continue;
    }
    const Vec answer = bodies_.answer_alone(body, x, body_push_[b], body_turn_[b] - x.cross(body_push_[b]));
    omega2 += std::max((side == 0 ? 1 : -1) * touch.n.dot(answer), Real(0));
  }
  return part_of_step(touch.depth, speed, clock.dt_old, omega2);
}

// The face's, and the share that the node has in the faces around it, as far as they look at the touched one:
// so that equal pressure makes equal depth up to the edges of a body. SOFT 1: at least what the step and the
// masses allow.
void NodeContact::give_stiffness(const World& world, Index i, Slot& slot) const {
  const ContactFace& f = face(slot.face);
  const ContactNode& who = node(i);
  const Vec& n = slot.n;
  Real k = 0, all = 0, area = 0;
  for (Index o = who.first; o < who.last; ++o) {
    const OwnFace& own = own_[static_cast<std::size_t>(o)];
    const Real looks = -normal_of(world, own).dot(n);
    const Real share = own.two_sided ? std::abs(looks) : std::max(looks, Real(0));
    k += share * own.k, area += share * own.area, all += own.k;
  }
  constexpr Real least = 0.1;  // of nodes whose faces all look elsewhere
  k = who.first == who.last ? f.k : std::max(k, least * all);
  slot.area = who.first == who.last || !(area > 0) ? f.area : area;
  slot.k = law_.penopt == 2 ? f.k : law_.penopt == 3 ? k : std::min(k, f.k);
  slot.k *= law_.slsfac * law_.sfs[who.pass];
  const Real dt = law_.dtstif > 0 ? law_.dtstif : soft_dt_;
  if (law_.soft == 0 || !(dt > 0)) return;
  Real m = mass_of(world, who.node);
  for (std::size_t e = 0; e < static_cast<std::size_t>(f.corners); ++e)
    m = std::min(m, mass_of(world, f.node[e]));
  if (std::isfinite(m)) slot.k = std::max(slot.k, law_.sofscl * 0.5 * m / (dt * dt));
}

// Beside an outer edge: the energy k depth^2/2 times w(u) = 1 - 3 u^2 + 2 u^3, u = (beyond - margin)/length,
// and the forces that follow from it: on the node, which is pushed off the edge, too, and on the corners, as
// the face may turn about the edge.
void NodeContact::fade(const World& world, const Slot& slot, Touch& touch) const {
  const ContactFace& f = face(slot.face);
  const Real depth = touch.depth, past = slot.beyond - edge_of(f);
  if (!(depth > 0 && past > 0)) return;
  const Real length = fading_length(f, depth), grows = length < depth ? 0 : 1;
  const Real u = std::min(past / length, Real(1)), w = 1 - u * u * (3 - 2 * u);
  const Real normal = w + grows * 3 * u * u * (1 - u), aside = 3 * u * (1 - u) * depth / length;
  const Vec push = normal * slot.n + aside * slot.aside;
  touch.tilt = plane_change(corners_of(f, world.nodes.x), f.corners, slot.aside);
  for (Real& t : touch.tilt) t *= -touch.k * depth * aside * depth;
  touch.lever = slot.n;
  touch.stored *= w;
  touch.faded = push.norm();
  if (touch.faded > 0) touch.n = push / touch.faded;
}

void NodeContact::push(const World& world, const Clock& clock, Block& b, Index i, Slot& slot) const {
  const ContactNode& who = node(i);
  slot.slack = std::min(slot.slack, -slot.gap);
  Touch touch;
  touch.node = who.node, touch.face = slot.face, touch.pass = who.pass;
  touch.k = slot.k, touch.depth = -slot.gap - slot.slack;
  touch.n = slot.n, touch.N = slot.at.N;
  touch.stored = 0.5 * touch.k * touch.depth * touch.depth;
  if (slot.beyond > 0) fade(world, slot, touch);
  fill(world, clock, slot, touch);
  b.touches.push_back(touch);
}

// Nodes count as parts of their own faces.
void NodeContact::find_parts(const World& world) {
  part_of_node_.assign(world.nodes.part.data(), world.nodes.part.data() + world.nodes.size());
  for (const ContactNode& n : nodes_)
    if (n.first < n.last)
      part_of_node_[static_cast<std::size_t>(n.node)] =
          world.segments.part[own_[static_cast<std::size_t>(n.first)].segment];
  for (const ContactFace& f : faces_) part_of_face_.push_back(world.segments.part[f.segment]);
}

const Friction& NodeContact::friction_at(const Touch& touch) const {
  if (part_of_face_.empty()) return law_;
  return law_.between(part_of_node_[static_cast<std::size_t>(touch.node)],
                      part_of_face_[static_cast<std::size_t>(touch.face)]);
}

// All but where the touch is and what it stores.
void NodeContact::fill(const World& world, const Clock& clock, Slot& slot, Touch& touch) const {
  const ContactFace& f = face(touch.face);
  const Real m = mass_of(world, touch.node);
  Real mobility = 0;  // of the face where it is touched [1/M]
  for (std::size_t e = 0; e < static_cast<std::size_t>(f.corners); ++e) {
    if (world.nodes.held[f.node[e]]) continue;
    mobility += touch.N[e] * touch.N[e] / world.nodes.m[f.node[e]];
    touch.spread += std::abs(touch.N[e]);
  }
  if (std::isfinite(m)) touch.spread += 1;
  if (!bodies_.of_node.empty()) find_bodies(world, touch);
  if (!(touch.depth > 0)) {
    slot.friction = Vec::Zero();
    return;
  }
  const Vec v = world.nodes.v.vec(touch.node) - velocity_of_face(world, f, touch.N);
  const Real part = part_of(world, clock, touch, v.dot(touch.n), {1 / m, mobility});
  Real fn = part * touch.k * touch.depth * touch.faded;
  for (Real& t : touch.tilt) t *= part;
  if (law_.vdc > 0) {
    // of the critical damping of node and face: 2 m omega, m the smaller mass
    const Real omega = std::sqrt(touch.k * (1 / m + mobility)), lighter = std::min(m, 1 / mobility);
    touch.damping = std::max(-0.01 * law_.vdc * 2 * lighter * omega * v.dot(touch.n), -fn);  // never pulls
    fn += touch.damping;
  }
  if (friction_on_)
    slot.friction = touch.friction =
        friction_of(friction_at(touch), slot.friction, touch.n, v, slot.k * clock.dt_old, fn, slot.area);
  touch.force = fn * touch.n + touch.friction;
}

namespace {
/// Of its diagonal. [L]
Real width_of(const World& world, const ContactFace& f) {
  return (world.nodes.x.vec(f.node[2]) - world.nodes.x.vec(f.node[0])).norm();
}
}  // namespace

// The spring that a node will have which comes through a face within a step, no force: so that steps are
// short enough for it by then. What is near at the start without a speed, or behind by rounding, is expected
// at once: nothing else may limit the first step of rigid bodies, in which weight moves them unseen. The
// force of the first sample behind the surface pushes through half of the step that led there, which would
// not be bounded else.
void NodeContact::expect(const World& world, const Clock& clock, Block& b, Index i,
                         const Slots& slots) const {
  constexpr Real touching = 1e-6, near = 1e-3;  // of the width of the face
  const Seen* first = nullptr;
  Real soonest = soft_dt_ > 0 ? soft_dt_ : unbounded, its_side = 1;
  for (const Seen& seen : b.seen) {
    if (!seen.at.over || is_taken(slots, seen.face) || goes_on(slots, seen)) continue;
    const ContactFace& f = face(seen.face);
    const Real side = f.two_sided && seen.d < lift(world, i, f, 1, seen.at.n) ? -1 : 1,
               gap = gap_at(world, i, f, side, side * seen.at.n, side * seen.d);
    const Real apart = clock.dt_old == 0 ? std::abs(gap) / width_of(world, f) : unbounded;
    if (gap < 0 && apart > touching) continue;
    const Vec v = world.nodes.v.vec(node(i).node) - velocity_of_face(world, f, seen.at.N);
    const Real closing = -side * seen.at.n.dot(v);
    const bool rests = closing >= 0 && apart <= (closing > 0 ? touching : near);
    if (!rests && !(closing > 0 && gap < closing * soonest)) continue;
    if (!seen.sure && !is_over(world, i, seen.face, seen.at)) continue;
    soonest = rests ? 0 : gap / closing, first = &seen, its_side = side;
  }
  if (!first) return;
  Slot next;
  next.face = first->face, next.at = first->at, next.side = its_side, next.n = its_side * first->at.n;
  give_stiffness(world, i, next);
  Touch touch;
  touch.node = node(i).node, touch.face = next.face, touch.pass = node(i).pass;
  touch.k = next.k, touch.n = next.n, touch.N = next.at.N;
  touch.due = std::max(soonest, std::numeric_limits<Real>::min());
  fill(world, clock, next, touch);
  b.touches.push_back(touch);
}

}  // namespace courant
