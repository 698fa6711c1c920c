// Which faces a node touches, from step to step.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "contact/nodes/node_contact.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

/// A touch that goes on to another face may be deeper there by this, of a usual face.
constexpr Real step_in_depth = 1e-3;
/// What is less deep at the start is rounding, of a usual face.
constexpr Real start_rounding = 1e-6;
/// Nodes that start behind the face of a solid by less than this, of that depth, are taken for touching it.
constexpr Real start_depth = 0.4;
/// Lengths that are rounding, of a usual face.
constexpr Real rounding = 1e-9;
/// A neighbour of a touching face is another wall where it rises this steeply in front of it (sine).
constexpr Real rise = 0.25;
/// Along faces that meet at less than this angle (cosine) a node goes on with the nearest.
constexpr Real bent = 0.5;
/// Bounds are found again when so many more faces may be met than were left then; of a node that meets
/// faces, but touches none, after so many steps.
constexpr std::size_t few_faces = 1;
constexpr Real idle_steps = 3;
/// Neighbours whose normals differ by less go on in one another (cosine).
constexpr Real smooth = 0.866;

/// Whether a node touches the face, or one that shares a corner with it.
template <class Slots>
bool goes_on_at(const FaceEdges& edges, const Slots& slots, Index face) {
  return std::any_of(slots.begin(), slots.end(), [&](const auto& slot) {
    if (slot.face < 0) return false;
    const auto around = edges.around(slot.face);
    return face >= around.front() && std::binary_search(around.begin(), around.end(), face);
  });
}

}  // namespace

// Whether the face goes on smoothly from one that the node touches.
bool NodeContact::goes_on(const Slots& slots, const Seen& seen) const {
  for (const Slot& slot : slots)
    if (slot.face >= 0 && std::abs(slot.n.dot(seen.at.n)) > smooth &&
        face(slot.face).shared(face(seen.face)) > 0)
      return true;
  return false;
}

// How far from a face a node that touches nothing may meet it within a step; also from behind, where it may
// arrive late.
Real NodeContact::idle_reach(const ContactFace& f) const {
  return closing_ + late_reach * f.depth;
}

// Candidates within reach, at the positions of now: lists may hold more, or not, with the same result. Mostly
// only faces that the node is over matter. A node beside the face that it touches needs the nearest points of
// that and its neighbours, too, as far behind as touches may be, so that it finds where they go on; not of
// others, which in a heap of bodies are many.
void NodeContact::look(const World& world, Block& b, Index i, const Vec& x, const Slots& slots) const {
  const auto k = static_cast<std::size_t>(i % block_size);
  const bool idle =
      !fresh_ && std::none_of(slots.begin(), slots.end(), [](const Slot& slot) { return slot.face >= 0; });
  choose(b, i, slots, idle, fresh_);
  const std::size_t least = b.left[k] + (idle ? 0 : few_faces);
  if (b.chosen.size() > least || (idle && travelled_ > b.bounded[k] + idle_steps * closing_)) {
    bound(world, b, i, x);
    choose(b, i, slots, idle, fresh_);
    b.left[k] = static_cast<unsigned char>(std::min<std::size_t>(b.chosen.size(), 255));
    b.bounded[k] = travelled_;
    if (idle) b.wake[k] = next_wake(b, k);
  }
  b.seen.clear();
  see(world, b, i, x, slots, fresh_);
  const auto settled = [&](const Slot& slot) {
    return slot.face < 0 || std::any_of(b.seen.begin(), b.seen.end(), [&](const Seen& seen) {
             return seen.face == slot.face && seen.at.inside;
           });
  };
  if (fresh_ || std::all_of(slots.begin(), slots.end(), settled)) return;
  choose(b, i, slots, false, true);
  see(world, b, i, x, slots, true);
}

// Candidates that may matter. `around`: those that share corners with touched faces also where the node is
// not over them.
void NodeContact::choose(Block& b, Index i, const Slots& slots, bool idle, bool around) const {
  const auto k = static_cast<std::size_t>(i % block_size);
  const Real near = travelled_ + (idle ? closing_ : reach_),
             far = idle ? near : std::max(near, travelled_ + most_depth_);
  b.chosen.clear();
  for (Index c = b.first[k]; c < b.first[k + 1]; ++c) {
    const auto at = static_cast<std::size_t>(c);
    const bool over = b.beside[at] <= travelled_;
    if (!(over || around) || b.clear[at] > far) continue;
    if ((over && b.clear[at] <= near) || fresh_ || goes_on_at(edges_, slots, b.candidate[at]))
      b.chosen.push_back(c);
  }
}

// Of the faces around those that the node touches, those that were too far away for its list.
void NodeContact::add_missing(const World& world, Block& b, Index i, const Slots& slots) const {
  if (fresh_ || !may_touch_[static_cast<std::size_t>(i)]) return;
  const auto k = static_cast<std::size_t>(i % block_size);
  const auto first = b.candidate.begin() + b.first[k], last = b.candidate.begin() + b.first[k + 1];
  const std::size_t listed = b.faces.size();
  for (std::size_t j = 0; j < slots.size(); ++j) {
    const Index touched = slots[j].face;
    if (touched < 0 || touched == b.known[k][j]) continue;
    const std::size_t before = b.faces.size();
    for (const Index g : edges_.around(touched))
      if (!std::binary_search(first, last, g) && may_touch(world, node(i), face(g))) b.faces.push_back(g);
    if (b.faces.size() == before) b.known[k][j] = touched;
  }
  if (b.faces.size() == listed) return;
  std::sort(b.faces.begin(), b.faces.end());
  b.faces.erase(std::unique(b.faces.begin(), b.faces.end()), b.faces.end());
}

void NodeContact::see(const World& world, Block& b, Index i, const Vec& x, const Slots& slots,
                      bool around) const {
  const bool idle =
      !fresh_ && std::none_of(slots.begin(), slots.end(), [](const Slot& slot) { return slot.face >= 0; });
  const auto before = static_cast<std::ptrdiff_t>(b.seen.size());
  b.faces.clear();
  for (const Index c : b.chosen) b.faces.push_back(b.candidate[static_cast<std::size_t>(c)]);
  if (!idle) add_missing(world, b, i, slots);
  const bool all_chosen = b.faces.size() == b.chosen.size();
  for (std::size_t j = 0; j < b.faces.size(); ++j) {
    const Index s = b.faces[j];
    const ContactFace& f = face(s);
    const FaceCorners corners = corners_of(f, world.nodes.x);
    const auto is_deep = [&] { return fresh_ || goes_on_at(edges_, slots, s); };
    const bool whole = around && is_deep();
    Seen seen;
    seen.face = s;
    const auto last = std::find_if(b.seen.begin(), b.seen.begin() + before,
                                   [&](const Seen& other) { return other.face == s; });
    if (last != b.seen.begin() + before)
      seen.at = last->at;
    else if (whole && all_chosen && b.beside[static_cast<std::size_t>(b.chosen[j])] > travelled_)
      seen.at = project_on_rim(corners, f.corners, x);
    else
      seen.at = (whole ? project : project_over)(corners, f.corners, x);
    seen.sure = around || seen.at.beyond == 0;
    if (around && seen.at.over && !is_over(world, i, s, seen.at))
      seen.at = whole ? project_on_rim(corners, f.corners, x) : Projection();
    if (!whole && !seen.at.over) continue;
    const Real reach = most_distance(i, f) + (idle                 ? idle_reach(f)
                                              : whole || is_deep() ? std::max(reach_, f.depth)
                                                                   : reach_);
    if ((x - seen.at.q).squaredNorm() > reach * reach) continue;
    seen.d = seen.at.n.dot(x - seen.at.q);
    b.seen.push_back(seen);
  }
  b.seen.erase(b.seen.begin(), b.seen.begin() + before);
}

void NodeContact::touch(World& world, const Clock& clock, Block& b, Index i) {
  const auto c = static_cast<std::size_t>(i % block_size);
  const Vec x = world.nodes.x.vec(node(i).node);
  Slots slots;
  for (int k = 0; k < most_touches; ++k)
    if (in_touch_->data(k)[i] != 0) slots[static_cast<std::size_t>(k)] = load(i, k);
  look(world, b, i, x, slots);
  if (eroded_) let_go(world, b, i, x, slots);
  for (Slot& slot : slots)
    if (slot.face >= 0 && !hold(world, b, i, x, slots, slot)) slot = Slot();
  for (int k = 0; k < most_touches; ++k) {
    Slot& slot = slots[static_cast<std::size_t>(k)];
    if (slot.face < 0 || !jumps(world, clock, i, slot, in_touch_->data(k)[i] - 1)) continue;
    slot.slack = -slot.gap - std::max((*depth_)[i], Real(0));
    ++b.jumped;
  }
  find_touches(world, clock, b, i, slots);
  for (Slot& slot : slots)
    if (slot.face >= 0) push(world, clock, b, i, slot);
  if (std::any_of(slots.begin(), slots.end(), [](const Slot& slot) { return slot.face < 0; }))
    expect(world, clock, b, i, slots);
  Real depth = 0;
  bool touches = false;
  for (int k = 0; k < most_touches; ++k) {
    const Slot& slot = slots[static_cast<std::size_t>(k)];
    if (in_touch_->data(k)[i] != 0 || slot.face >= 0) store(i, k, slot);
    if (slot.face < 0) continue;
    depth = std::max(depth, -slot.gap - slot.slack), touches = true;
  }
  if (touches)
    b.touching.push_back(i), b.wake[c] = -std::numeric_limits<Real>::infinity();
  else if (b.wake[c] < 0)
    b.wake[c] = next_wake(b, c);
  (*depth_)[i] = depth;
}

// Whether a touch that went on to another face, or round an edge, is much deeper there than node and face
// have moved, as where surfaces fold. What is beyond that gives no force, as of nodes that start behind
// faces.
bool NodeContact::jumps(const World& world, const Clock& clock, Index i, const Slot& slot,
                        Index face_before) const {
  const Real tolerated =
      slot.face == face_before ? arrival_tolerance * face(slot.face).depth : step_in_depth * size_;
  if (!(-slot.gap - slot.slack > std::max((*depth_)[i], Real(0)) + tolerated)) return false;
  const Vec moved =
      (world.nodes.v.vec(node(i).node) - velocity_of_face(world, face(slot.face), slot.at.N)) * clock.dt_old;
  return -slot.gap - slot.slack > std::max((*depth_)[i], Real(0)) + 2 * moved.norm() + tolerated;
}

// Of what is deleted: its springs lose what they hold.
void NodeContact::let_go(const World& world, Block& b, Index i, const Vec& x, Slots& slots) const {
  for (Slot& slot : slots) {
    if (slot.face < 0 || (is_there(face(slot.face)) && may_touch_[static_cast<std::size_t>(i)])) continue;
    const ContactFace& f = face(slot.face);
    const Projection at = project(corners_of(f, world.nodes.x), f.corners, x);
    const Real r = distance(world, i, f, slot.side, slot.side * at.n);
    const Real depth = r - slot.side * at.n.dot(x - at.q) - slot.slack;
    if (depth > 0 && depth < f.through + r) b.let_go += 0.5 * slot.k * depth * depth;
    slot = Slot();
  }
}

// By which thickness counts from planes over the nodes, of the face and of those that the node belongs to; n
// is the normal towards the node.
Real NodeContact::lift(const World& world, Index i, const ContactFace& f, Real side, const Vec& n) const {
  const ContactNode& point = node(i);
  Real out = side * f.lift;
  if (!(point.most_lift > 0)) return out;
  for (Index o = point.first; o < point.last; ++o) {
    const OwnFace& own = own_[static_cast<std::size_t>(o)];
    if (own.lift != 0)
      out -= own.lift * normal_of(world, own).dot(n) / static_cast<Real>(point.last - point.first);
  }
  return out;
}

// Whether the touch lasts.
bool NodeContact::hold(const World& world, Block& b, Index i, const Vec& x, const Slots& slots,
                       Slot& slot) const {
  const Index touched = slot.face;
  const ContactFace& f = face(touched);
  const FaceCorners corners = corners_of(f, world.nodes.x);
  const auto seen =
      std::find_if(b.seen.begin(), b.seen.end(), [&](const Seen& one) { return one.face == slot.face; });
  slot.at = seen != b.seen.end() ? seen->at : project(corners, f.corners, x);
  const bool inside = slot.at.inside;
  if (!inside && slot.at.over) slot.at = project_on_rim(corners, f.corners, x);
  slot.n = slot.side * slot.at.n;
  if (first_step_) give_stiffness(world, i, slot);
  slot.beyond = 0;
  slot.gap = gap_at(world, i, f, slot.side, slot.n, slot.n.dot(x - slot.at.q));
  if (!move_on(world, b, i, x, slots, slot, inside) || slot.gap >= 0) return false;
  const ContactFace& now = face(slot.face);
  if (slot.beyond > 0 || slot.gap + distance(world, i, now, slot.side, slot.n) >= -now.through) return true;
  b.leaked.push_back(i);
  Real depth = std::max(-slot.gap - slot.slack, Real(0));
  if (slot.face != touched) depth = std::min(depth, (*depth_)[i]);  // it was never deeper on the face before
  b.let_go += 0.5 * slot.k * depth * depth;
  return false;
}

// Where the face goes on smoothly, the node is with the nearest of the faces, so that depth is continuous:
// behind the faces of a solid the least deep one, within the thickness of a dented shell the deepest. Beyond
// an edge of its face it goes on to a neighbour, too. Where it is in front of the one across the edge, it has
// left the body round an outer edge.
bool NodeContact::move_on(const World& world, const Block& b, Index i, const Vec& x, const Slots& slots,
                          Slot& slot, bool inside) const {
  const ContactFace& f = face(slot.face);
  const auto at_rim = [&](const ContactFace& g) {
    for (std::size_t e = 0; e < 4; ++e)
      if (std::abs(slot.at.N[e]) > rounding && !g.has(f.node[e])) return false;
    return true;
  };
  const Seen* best = nullptr;
  const Real slot_d = slot.gap + distance(world, i, f, slot.side, slot.n);
  Real best_d = 0, best_gap = 0, best_side = 1;
  const auto nearer = [&](Real d, Real gap, Real than, Real its_gap) {
    if (d > 0 && than > 0) return gap < its_gap - rounding * size_;
    if (d <= 0 && than <= 0) return gap > its_gap + rounding * size_;
    return std::abs(d) < std::abs(than) - rounding * size_;
  };
  bool best_is_smooth = false, outside = false, wedge = false;
  for (const Seen& seen : b.seen) {
    const ContactFace& g = face(seen.face);
    if (seen.face == slot.face || f.shared(g) == 0) continue;
    const Real along = slot.n.dot(seen.at.n), side = g.two_sided && along < 0 ? -1 : 1;
    const Real gap = gap_at(world, i, g, side, side * seen.at.n, side * seen.at.n.dot(x - seen.at.q));
    const bool goes_on = side * along > bent, across = !inside && at_rim(g);
    const bool rises = slot.n.dot(centre_of(corners_of(g, world.nodes.x), g.corners) - slot.at.q) > 0;
    if (seen.at.inside && (goes_on || (across && rises && gap < 0))) {
      const Real d = side * seen.d;
      if (inside && !nearer(d, gap, slot_d, slot.gap)) continue;
      if (best &&
          (best_is_smooth > goes_on || (best_is_smooth == goes_on && !nearer(d, gap, best_d, best_gap))))
        continue;
      best = &seen, best_d = d, best_gap = gap, best_side = side, best_is_smooth = goes_on;
    } else if (across && (!goes_on || rim_of(world, g, x).meets(slot.at, rounding * size_))) {
      (gap >= 0 || !(goes_on || rises) ? outside : wedge) = true;
    }
  }
  if (!best || is_taken(slots, best->face) || (outside && !best_is_smooth)) {
    if (inside) return true;
    if (!best) wedge = !go_along_edge(world, b, x, slots, slot) && wedge;
    return past_edge(world, x, wedge && !outside, distance(world, i, face(slot.face), slot.side, slot.n),
                     slot);
  }
  slot.face = best->face, slot.at = best->at, slot.gap = best_gap, slot.side = best_side;
  slot.n = slot.side * slot.at.n;
  return true;
}

// Beyond an outer edge, if by rounding alone, a node is within none of the faces along it: there it goes on
// to the one that it is less far beside, so that it fades off the outer edge alone, not off the edges that
// faces share.
bool NodeContact::go_along_edge(const World& world, const Block& b, const Vec& x, const Slots& slots,
                                Slot& slot) const {
  const ContactFace& f = face(slot.face);
  const auto beside = [&](const Projection& rim) {
    const Vec w = x - rim.q;
    return Vec(w - w.dot(rim.n) * rim.n).norm();
  };
  Real least = beside(slot.at) - rounding * size_;
  bool found = false;
  for (const Seen& seen : b.seen) {
    const ContactFace& g = face(seen.face);
    if (is_taken(slots, seen.face) || f.shared(g) == 0) continue;
    const Projection rim = rim_of(world, g, x);
    const Real along = slot.n.dot(rim.n), side = g.two_sided && along < 0 ? -1 : 1;
    if (!(side * along > smooth && beside(rim) < least)) continue;
    least = beside(rim), found = true;
    slot.face = seen.face, slot.side = side, slot.at = rim;
  }
  if (found) slot.n = slot.side * slot.at.n;
  return found;
}

Projection NodeContact::rim_of(const World& world, const ContactFace& f, const Vec& x) const {
  return project_on_rim(corners_of(f, world.nodes.x), f.corners, x);
}

// In the wedge between two faces that meet at an inner edge (or of two thick ones at an outer one) the edge
// is nearest. Round an outer edge the push fades while the node goes off it, beyond a margin in which two
// edges may stand on each other, as far as it was deep.
bool NodeContact::past_edge(const World& world, const Vec& x, bool wedge, Real r, Slot& slot) const {
  if (wedge) {
    const Vec w = x - slot.at.q;
    const Real length = w.norm(), side = slot.n.dot(w) < 0 ? -1 : 1;
    if (length > rounding * size_) slot.n = side / length * w;
    slot.gap = side * length - r;
    return true;
  }
  const ContactFace& f = face(slot.face);
  const FaceCorners corners = corners_of(f, world.nodes.x);
  const Vec aside = project_beyond(corners, f.corners, x, slot.at);
  slot.n = slot.side * slot.at.n;
  slot.gap = slot.n.dot(x - slot.at.q) - r;
  slot.beyond = aside.norm();
  if (!(slot.beyond - edge_of(f) < fading_length(f, -slot.gap))) return false;
  slot.aside = slot.beyond > 0 ? Vec(aside / slot.beyond) : Vec(Vec::Zero());
  return true;
}

// Whether the node came from in front of the face to behind it in this step, over the face: else it went
// round an edge.
bool NodeContact::arrives(const World& world, const Clock& clock, Index i, const Seen& seen,
                          Slot& slot) const {
  const ContactFace& f = face(seen.face);
  const Nodes& nodes = world.nodes;
  const Vec moved = (nodes.v.vec(node(i).node) - velocity_of_face(world, f, seen.at.N)) * clock.dt_old;
  const Real before = seen.d - seen.at.n.dot(moved);
  slot = Slot();
  slot.face = seen.face, slot.at = seen.at;
  slot.side = f.two_sided && before < lift(world, i, f, 1, seen.at.n) ? -1 : 1;
  // What leaves a shell without thickness was behind it a step ago, and stays on its side.
  for (int k = 0; f.two_sided && !(f.r + node(i).r > 0) && k < most_touches; ++k) {
    const Slot last = load(i, k);
    if (last.face < 0 || (last.face != seen.face && face(last.face).shared(f) == 0)) continue;
    const Vec normal = plane_normal(corners_of(face(last.face), world.nodes.x));
    slot.side = seen.at.n.dot(normal) < 0 ? -last.side : last.side;
  }
  slot.n = slot.side * slot.at.n;
  const Real r = distance(world, i, f, slot.side, slot.n);
  slot.gap = slot.side * seen.d - r;
  if (slot.gap >= 0) return false;
  if (fresh_) {
    slot.slack = -slot.gap;
    return -slot.gap > start_rounding * size_ && -slot.gap <= (f.two_sided ? r : start_depth * f.depth);
  }
  const Real gap_before = slot.side * before - r;
  if (gap_before < -arrival_tolerance * f.depth) return false;
  slot.late = gap_before < -rounding * size_;
  if (slot.late) slot.slack = -gap_before;  // it comes with no energy
  const Real way = gap_before - slot.gap, left = way > 0 ? std::min(-slot.gap / way, Real(1)) : Real(0);
  if (!slot.late && moved.squaredNorm() * left * left < 1e-12 * f.area) return true;
  const Projection there =
      project(corners_of(f, nodes.x), f.corners, nodes.x.vec(node(i).node) - left * moved);
  return slot.late ? there.inside : is_over(world, i, seen.face, there);
}

// Whether a node starts so deep inside another part that no face takes it.
bool NodeContact::is_lost(const World& world, const Block& b, Index i) const {
  return std::any_of(b.seen.begin(), b.seen.end(), [&](const Seen& seen) {
    const ContactFace& f = face(seen.face);
    const bool other = world.segments.part[f.segment] != world.nodes.part[node(i).node];
    const Real gap = gap_at(world, i, f, 1, seen.at.n, seen.d);
    return other && !f.two_sided && seen.at.over && gap < -start_depth * f.depth && gap > -f.depth &&
           !grazes(world, i, seen.face, seen.at.q, seen.at.n);
  });
}

// Whether a node starts on a shell, neither with a thickness, so that nothing says which side is its own.
bool NodeContact::is_undecided(const Block& b, Index i) const {
  return std::any_of(b.seen.begin(), b.seen.end(), [&](const Seen& seen) {
    const ContactFace& f = face(seen.face);
    return f.two_sided && !(f.r + node(i).r > 0) && seen.at.over &&
           std::abs(seen.d) <= start_rounding * size_;
  });
}

// Puts a new touch beside those there are. A neighbour of a touching face is another wall only where it rises
// in front of it. Round an outer edge the node is behind both faces: the deeper one holds it, or the first;
// at the start the least deep one.
bool NodeContact::take(const World& world, Index i, const Slot& slot, Slots& slots) const {
  const ContactFace& f = face(slot.face);
  Slot* to = nullptr;
  for (Slot& other : slots) {
    if (other.face < 0) {
      if (!to) to = &other;
      continue;
    }
    const ContactFace& g = face(other.face);
    if (f.shared(g) == 0) continue;
    if (slot.late) return false;
    const Vec apart = centre_of(corners_of(f, world.nodes.x), f.corners) -
                      centre_of(corners_of(g, world.nodes.x), g.corners);
    if (other.n.dot(apart) > rise * apart.norm()) continue;
    if (fresh_ || other.n.dot(slot.n) > smooth || slot.gap >= other.gap) return false;
    to = &other;
    break;
  }
  if (!to) return false;
  *to = slot;
  give_stiffness(world, i, *to);
  return true;
}

void NodeContact::find_touches(const World& world, const Clock& clock, const Block& b, Index i,
                               Slots& slots) const {
  const auto is_new = [&](const Seen& seen) {
    return seen.at.over && !is_taken(slots, seen.face) && !goes_on(slots, seen);
  };
  if (std::none_of(b.seen.begin(), b.seen.end(), is_new)) return;
  std::array<Slot, most_touches> found;
  int count = 0;
  for (const Seen& seen : b.seen) {
    if (!is_new(seen)) continue;
    Slot slot;
    if (!arrives(world, clock, i, seen, slot)) continue;
    if (!seen.sure && !is_over(world, i, seen.face, seen.at)) continue;
    if (grazes(world, i, slot.face, slot.at.q, slot.n)) continue;
    // the deepest first, of nodes that start there the least deep one, late ones last; of equals the first
    // face
    int at = count;
    const auto before = [&](const Slot& other) {
      if (slot.late != other.late) return other.late;
      return fresh_ ? slot.gap > other.gap : slot.gap < other.gap;
    };
    while (at > 0 && before(found[static_cast<std::size_t>(at) - 1])) --at;
    if (at == most_touches) continue;
    count = std::min(count + 1, most_touches);
    for (int k = count - 1; k > at; --k)
      found[static_cast<std::size_t>(k)] = found[static_cast<std::size_t>(k) - 1];
    found[static_cast<std::size_t>(at)] = slot;
  }
  for (int k = 0; k < count; ++k) take(world, i, found[static_cast<std::size_t>(k)], slots);
}

}  // namespace courant
