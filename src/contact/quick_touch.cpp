// Shortcuts for particles whose candidates all lie in one to three fixed planes, the same side of each plane
// facing the particle. If the particle is surely over a facet of every plane that it is deep in, no other
// facet has a say: later ones of the plane are not deeper, earlier ones are further away, and all are at the
// contact distance once the particle is pushed out. So three plane distances at most decide. Where that is
// not sure, the full search of touch.cpp does, with the same bits.
#include <cmath>

#include "contact/near.hpp"

namespace courant {
namespace {

/// Plane distances of the facets of a plane differ by less (see Contact::choose_shortcuts).
constexpr Real surely_out = 0.5 * depth_tolerance, surely_in = 2 * depth_tolerance;

/// 1 - cos of a push that goes less than half a margin sideways (apart_of_contact_distance).
constexpr Real straight = 1e-8;

constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// Pair loops push walls out of the cache in every step, and a slot takes less time than it takes to fetch
/// its wall.
constexpr std::ptrdiff_t slots_ahead = 8;
void fetch(const Wall& wall) {
  constexpr std::size_t line = 64;
  for (std::size_t k = 0; k < sizeof(Wall); k += line)
    __builtin_prefetch(reinterpret_cast<const char*>(&wall) + k);
}

}  // namespace

void Contact::block(World& world, const Clock& clock, Index begin, Index) {
  if (asleep_) return;
  Block& b = blocks_[begin / block_size];
  b.clear_touches();
  const Real dt = soft_dt_ > 0 ? soft_dt_ : limit_;
  const Real calm =
      0.5 * r_least_ / dt - wall_speed_;  // slower particles do not come that far; all may where it is < 0
  const Real calm2 = !hold_ ? infinite : calm > 0 ? calm * calm : -1;
  const auto& x = world.particles.x;
  const Real* const at[3] = {x.data(0), x.data(1), x.data(2)};
  const auto& v = world.particles.v;
  Real* const f[3] = {world.particles.f.data(0), world.particles.f.data(1), world.particles.f.data(2)};
  Pushes pushes;
  const Slot* const end_of_slots = b.slots.data() + b.slots.size();
  for (Slot& slot : b.slots) {
    const Index i = slot.particle;
    if (end_of_slots - &slot > slots_ahead) fetch(walls_[(&slot + slots_ahead)->facet[0]]);
    if (v.vec(i).squaredNorm() > calm2) note_approach(world, b, slot, dt);
    if (slot.walls == 1 && !drag_on_ && !slot.behind &&
        touch_one_wall(world, b, slot, Vec(at[0][i], at[1][i], at[2][i]), f))
      continue;
    touch(world, clock, b, slot, pushes);
  }
}

// By far the most frequent case, so without the detour over pushes. Returns false where that is not sure.
bool Contact::touch_one_wall(const World& world, Block& b, Slot& slot, const Vec& x, Real* const f[]) const {
  const Wall* w = &walls_[slot.facet[0]];
  const Index i = slot.particle;
  const Real r = contact_distance(i, *w);
  Real d = plane_distance(*w, x), a = slot.side[0] * d;
  if (r - a <= surely_out * r) return true;
  if (slot.joints > 0 && is_at_joint(slot, x)) return false;
  if (!is_surely_over(*w, x)) {
    if (!find_facet(b, slot, 0, x)) return false;
    w = &walls_[slot.facet[0]];
    d = plane_distance(*w, x), a = slot.side[0] * d;
  }
  const Real depth = r - a;
  if (!(depth > surely_in * r) || !(a > clear_margin * r)) return false;
  const Vec n = slot.side[0] * w->n;
  const Real k = stiffness(i, slot.k, w->k, facets_[slot.facet[0]], world);
  slot.room = 0;
  b.touches.push_back({.particle = i,
                       .facet = slot.facet[0],
                       .share = depth,
                       .depth = depth,
                       .k = k,
                       .n = n,
                       .q = x - d * w->n});
  b.deepest = std::max(b.deepest, depth);
  const Vec force = k * depth * n;
  for (int c = 0; c < dim_; ++c) f[c][i] += 0.0 + force[c];  // never -0, as in forces_of
  return true;
}

// Returns false where the full search must decide.
bool Contact::quick_touch(const Block& b, Slot& slot, const Vec& x, Pushes& pushes) const {
  const bool at_joint = is_at_joint(slot, x);
  if (at_joint && joint_pushes(slot, x, pushes)) return true;
  if (quick_pushes(b, slot, x, pushes)) return true;
  return !at_joint && slot.walls == 1 && note_joint(b, slot, x) && joint_pushes(slot, x, pushes);
}

// As push_off does, but looks at one facet of each plane only.
bool Contact::quick_pushes(const Block& b, Slot& slot, const Vec& x, Pushes& pushes) const {
  pushes.count = 0;
  Vec u = Vec::Zero();
  while (pushes.count < Pushes::capacity) {
    const Vec y = x + u;
    int worst = -1;
    if (!worst_wall(b, slot, y, pushes, worst)) return false;
    if (worst < 0) return true;
    const Wall& w = walls_[slot.facet[worst]];
    const Real d = plane_distance(w, x);
    pushes.at[pushes.count++] = {.facet = slot.facet[worst],
                                 .n = slot.side[worst] * w.n,
                                 .depth = contact_distance(slot.particle, w) - slot.side[worst] * d,
                                 .share = 0,
                                 .q = x - d * w.n,
                                 .face = true};
    u = share_pushes(pushes);
  }
  return false;
}

// Particles at rest often sit where facets of a plane meet. Then only these few can be the deepest, in the
// order of the full search; the others come to the contact distance with them, if the push is so straight
// off the plane that it ends within their margin.
bool Contact::joint_pushes(const Slot& slot, const Vec& x, Pushes& pushes) const {
  std::array<std::int8_t, 4> side;
  const Wall& first = walls_[slot.facet[0]];
  if (!(slot.side[0] * plane_distance(first, x) > clear_margin * r_most_)) return false;
  bool over = false;
  for (int j = 0; j < slot.joints; ++j) {
    const Wall& w = walls_[slot.joint[j]];
    side[j] = std::int8_t(first.n.dot(w.n) > 0 ? slot.side[0] : -slot.side[0]);
    over = over || beyond_edges(w, x) <= 0;
  }
  if (!over) return false;
  Near near;
  near.particle = slot.particle;
  near.candidate = {slot.joint.data(), std::size_t(slot.joints)};
  near.side = {side.data(), std::size_t(slot.joints)};
  near.x = near.origin = x;
  pushes.count = 0;
  Vec u = Vec::Zero();
  push_off(near, pushes, u);
  for (int j = 0; j < pushes.count; ++j)
    if (!(std::abs(pushes.at[j].n.dot(first.n)) > 1 - straight)) return false;
  return true;
}

// Valid as long as the particle stays within the margin: so those within two margins are noted.
bool Contact::note_joint(const Block& b, Slot& slot, const Vec& x) const {
  slot.joints = 0;
  std::size_t count = 0;
  for (Index c = slot.first; c < slot.last; ++c) {
    const Wall& w = walls_[b.candidate[c]];
    if (beyond_edges(w, x) > 2 * w.margin) continue;
    if (count == slot.joint.size()) return false;
    slot.joint[count++] = b.candidate[c];
  }
  slot.joints = std::int8_t(count);
  slot.seen = x;
  slot.room = 0;
  return count > 0;
}

bool Contact::is_at_joint(const Slot& slot, const Vec& x) const {
  if (slot.joints == 0) return false;
  const Real margin = walls_[slot.joint[0]].margin;
  return (x - slot.seen).squaredNorm() < margin * margin;
}

// The wall that y is deepest in, -1 if it is in none. Returns false where that is not sure.
bool Contact::worst_wall(const Block& b, Slot& slot, const Vec& y, const Pushes& pushes, int& worst) const {
  std::array<Real, 3> depth{};
  for (int j = 0; j < slot.walls; ++j) {
    const Wall& w = walls_[slot.facet[j]];
    const Real r = contact_distance(slot.particle, w), a = slot.side[j] * plane_distance(w, y);
    depth[j] = r - a;
    if (depth[j] <= surely_out * r) continue;
    if (!(depth[j] > surely_in * r) || !(a > clear_margin * r) || pushes.has(slot.facet[j])) return false;
    if (is_surely_over(w, y)) continue;
    if (!find_facet(b, slot, j, y)) return false;
    return worst_wall(b, slot, y, pushes, worst);
  }
  worst = -1;
  Real violation = 0;
  for (int j = 0; j < slot.walls; ++j) {
    const Real r = contact_distance(slot.particle, walls_[slot.facet[j]]);
    if (depth[j] <= violation + depth_tolerance * r) continue;  // the rule of Contact::consider
    violation = depth[j];
    worst = j;
  }
  return true;
}

/// Takes for a plane the facet that y is surely over, if there is one.
bool Contact::find_facet(const Block& b, Slot& slot, int wall, const Vec& y) const {
  const Index plane = walls_[slot.facet[wall]].plane;
  for (Index c = slot.first; c < slot.last; ++c) {
    const Wall& w = walls_[b.candidate[c]];
    if (w.plane != plane || !is_surely_over(w, y)) continue;
    take_facet(slot, wall, b.candidate[c]);
    return true;
  }
  return false;
}

/// Keeps facets in ascending order, in which the full search looks at them.
void Contact::take_facet(Slot& slot, int wall, Index facet) const {
  if (walls_[facet].n.dot(walls_[slot.facet[wall]].n) < 0) slot.side[wall] = std::int8_t(-slot.side[wall]);
  slot.facet[wall] = facet;
  for (int j = 1; j < slot.walls; ++j)
    for (int k = j; k > 0 && slot.facet[k] < slot.facet[k - 1]; --k) {
      std::swap(slot.facet[k], slot.facet[k - 1]);
      std::swap(slot.side[k], slot.side[k - 1]);
    }
}

// It was `room` away from touching; since then neither it nor the walls have come that far.
bool Contact::is_far(const Slot& slot, const Vec& x) const {
  const Real room = slot.room - (travel_ - slot.travel);
  return room > 0 && (x - slot.seen).squaredNorm() < room * room;
}

}  // namespace courant
