// Which edges touch, from step to step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/edges/edge_contact.hpp"

namespace courant {

namespace {

/// Edges that are beside each other and turned by less than this (sine) begin to touch along each other, if
/// over the length that they share they part by less than the sum of their radii.
constexpr Real side_by_side = 0.3;
/// Edges that meet at a node and turn by less than 60 degrees there go on in one another (cosine).
constexpr Real straight_on = 0.5;
/// Lengths that are rounding, of a usual edge.
constexpr Real edge_rounding = 1e-9;
/// What is less deep at the start is rounding, of a usual edge.
constexpr Real edge_start_rounding = 1e-6;
/// Gauss points of [0, 1].
const std::array<Real, 2> gauss_points{0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};

/// Nearest distance of a straight path from the origin. [L]
Real nearest_on_way(const Vec& from, const Vec& to) {
  const Vec way = to - from;
  const Real way2 = way.squaredNorm();
  return way2 > 0 ? (from + std::clamp(-from.dot(way) / way2, Real(0), Real(1)) * way).norm() : from.norm();
}

/// The unit vector from b to a on the side of `old`, and how far a is on that side. Where lines meet it is
/// their common normal.
Vec normal_of(const NearestPoints& at, const Vec& old, Real rounding, Real& distance) {
  Vec n = at.w;
  if (at.distance > rounding)
    n /= at.distance;
  else if (at.cross.norm() > side_by_side)
    n = at.cross.normalized();
  else
    n = old;
  if (n.dot(old) < 0) n = -n;
  distance = n.dot(at.w);
  return n;
}

}  // namespace

EdgeEnds EdgeContact::ends_before(const World& world, const Clock& clock, Index e) const {
  EdgeEnds out = ends(world, e);
  for (std::size_t c = 0; c < 2; ++c) out[c] -= clock.dt_old * world.nodes.v.vec(edge(e).node[c]);
  return out;
}

// Of the pair and those of the edges that go on from both, the nearest, if it is another one. Edges go on
// where they are smooth, and round a corner where the nearest point is that. `ties`: of equal ones that of
// the least edges.
bool EdgeContact::find_nearer(const World& world, const Pair& pair, bool ties, Pair& best) const {
  best = pair;
  const Real tolerance = edge_rounding * size_;
  std::array<std::vector<Index>, 2> around;
  for (const int side : {0, 1}) {
    const Index e = side == 0 ? pair.a : pair.b;
    const Real at = side == 0 ? pair.at.s : pair.at.t;
    const EdgeEnds x = ends(world, e);
    auto& out = around[static_cast<std::size_t>(side)];
    out.push_back(e);
    for (const std::size_t end : {0U, 1U}) {
      const Vec away = (x[1 - end] - x[end]).normalized();
      for (const Index other : next_[static_cast<std::size_t>(e)][end]) {
        const Index n = edge(e).node[end];
        const Vec on = (world.nodes.x.vec(edge(other).other_end(n)) - x[end]).normalized();
        if (away.dot(on) < -straight_on || at == static_cast<Real>(end)) out.push_back(other);
      }
    }
  }
  bool found = false;
  for (const Index i : around[0])
    for (const Index j : around[1]) {
      const Pair other{std::min(i, j), std::max(i, j), {}, i > j};
      if (i == j || (i == pair.a && j == pair.b) || !may_touch(world, other.a, other.b)) continue;
      const NearestPoints at = nearest_points(ends(world, other.a), ends(world, other.b));
      const bool first = std::pair(other.a, other.b) < std::pair(best.a, best.b);
      if (!(at.distance < best.at.distance - tolerance) &&
          !(ties && first && at.distance <= best.at.distance + tolerance))
        continue;
      best = other, best.at = at, found = true;
    }
  return found;
}

Real EdgeContact::gap_of(Touch& touch) const {
  Real distance = 0;
  touch.n = normal_of(touch.at, touch.n, edge_rounding * size_, distance);
  return touch.gap = distance - reach_of(touch.a, touch.b);
}

// Half of the step is the old pair's, half the nearer one's, as are the impulses: the depth is what that
// makes of it, so that no energy comes or goes however often a touch changes back and forth.
void EdgeContact::hand_on(const World& world, const Clock& clock, Touch& touch) const {
  const Pair now{touch.a, touch.b, touch.at, false};
  Pair nearer;
  if (!find_nearer(world, now, false, nearer)) return;
  const auto change = [&] {
    return clock.dt_old * touch.n.dot(velocity([&](Index n) { return Vec(world.nodes.v.vec(n)); }, touch));
  };
  const Real gap = gap_of(touch), change_of_gap = change();
  touch.a = nearer.a, touch.b = nearer.b, touch.at = nearer.at;
  if (nearer.turned) touch.n = -touch.n, touch.friction = -touch.friction;
  const Real new_gap = gap_of(touch);
  touch.slack += gap - 0.5 * change_of_gap - (new_gap - 0.5 * change());
}

// Touches go on to neighbours; those that part end, and lose nothing.
void EdgeContact::go_on(const World& world, const Clock& clock) {
  std::vector<Touch> kept;
  parted_.clear();
  for (Touch touch : touches_) {
    if (touch.due > 0) continue;
    if (first_step_) touch.k = stiffness_of(world, touch.a, touch.b);
    const Pair from{touch.a, touch.b, {}, false};
    const bool there = is_there(edge(touch.a)) && is_there(edge(touch.b));
    if (there && touch.place == crossing) {
      touch.at = nearest_points(ends(world, touch.a), ends(world, touch.b));
      hand_on(world, clock, touch);
    } else if (!there || !place_along(world, touch)) {
      let_go_ += touch.stored;
      continue;
    }
    if (gap_of(touch) + std::min(touch.slack, Real(0)) >= 0) {
      parted_.insert({{from.a, from.b}, {touch.a, touch.b}});
      continue;
    }
    if (is_too_deep(touch))
      let_go_ += touch.stored, ++leaked_;
    else
      kept.push_back(touch);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Touch& x, const Touch& y) { return x.before(y); });
  touches_.clear();
  for (const Touch& touch : kept) {
    if (touches_.empty() || touches_.back().before(touch)) {
      touches_.push_back(touch);
      continue;
    }
    Touch& other = touches_.back();  // two came to the same pair: the one that holds more stays
    let_go_ += std::min(other.stored, touch.stored);
    if (touch.stored > other.stored) other = touch;
  }
}

// Through each other by more than their radii, or half of the shorter one, or behind a free end.
bool EdgeContact::is_too_deep(const Touch& touch) const {
  const Real distance = touch.gap + reach_of(touch.a, touch.b);
  const auto length = [&](Index e) {
    const EdgeEnds& x = start_[static_cast<std::size_t>(e)];
    return (x[1] - x[0]).norm();
  };
  const Real most = std::max(reach_of(touch.a, touch.b), 0.5 * std::min(length(touch.a), length(touch.b)));
  if (distance < -most) return true;
  const auto off = [&](Index e, Real at) {
    return (at == 0 && next_[static_cast<std::size_t>(e)][0].empty()) ||
           (at == 1 && next_[static_cast<std::size_t>(e)][1].empty());
  };
  return distance < 0 && touch.place == crossing && (off(touch.a, touch.at.s) || off(touch.b, touch.at.t));
}

// Where the Gauss point of the length that both share is now; false: they share none.
bool EdgeContact::place_along(const World& world, Touch& touch) const {
  const EdgeEnds a = ends(world, touch.a), b = ends(world, touch.b);
  const auto [from, to] = beside(a, b);
  if (!(to > from)) return false;
  const Real s = from + (to - from) * gauss_points[touch.place == along_first ? 0 : 1];
  touch.at = nearest_to_point(a, b, s);
  touch.part = 0.5 * (to - from);
  return true;
}

void EdgeContact::begin_touches(const World& world, const Clock& clock, Block& b, Index i, Index j) const {
  const Pair pair{i, j, nearest_points(ends(world, i), ends(world, j)), false};
  if (pair.at.distance > reach_of(i, j) + reach_) return;
  const auto known = [&](Index place) {
    Touch key;
    key.a = i, key.b = j, key.place = place;
    return std::binary_search(touches_.begin(), touches_.end(), key,
                              [](const Touch& x, const Touch& y) { return x.before(y); });
  };
  if (known(crossing) || held_by_nodes(i, j)) return;
  const bool along = known(along_first) || known(along_last);
  const EdgeEnds x = ends(world, i);
  const auto [from, to] = beside(x, ends(world, j));
  const Real turned = pair.at.cross.norm(), apart = turned * (to - from) * (x[1] - x[0]).norm();
  if (along || (turned < side_by_side && to > from && apart < reach_of(i, j))) {
    for (const Place place : {along_first, along_last})
      if (!known(place)) begin_along(world, clock, pair, place, b);
  } else {
    begin_crossing(world, clock, pair, b);
  }
}

// Whether lines of edges went through each other near the pair: an odd number of times, but for those that
// were pushed apart from behind.
bool EdgeContact::crossed(const World& world, const Clock& clock, const Pair& pair) const {
  if (fresh_ || !(clock.dt_old > 0)) return false;
  Real v = 0;
  for (const Index e : {pair.a, pair.b}) {
    Real most = 0;
    for (const Index n : edge(e).node) most = std::max(most, world.nodes.v.vec(n).norm());
    v += most;
  }
  if (pair.at.distance > v * clock.dt_old) return false;
  const auto around = [&](Index e) {
    std::vector<Index> out{e};
    for (const auto& end : next_[static_cast<std::size_t>(e)]) out.insert(out.end(), end.begin(), end.end());
    return out;
  };
  int times = 0;
  for (const Index i : around(pair.a))
    for (const Index j : around(pair.b)) {
      if (parted_.contains({std::min(i, j), std::max(i, j)})) return false;
      if (i != j && !edge(i).has(edge(j).node[0]) && !edge(i).has(edge(j).node[1]))
        times += went_through(ends_before(world, clock, i), ends_before(world, clock, j), ends(world, i),
                              ends(world, j));
    }
  return times % 2 == 1;
}

// Whether edges went through each other so close to a corner of one that its surface there is level with that
// of the other, as far as nodes are deep: what slides on a floor that has an edge, and goes over it.
bool EdgeContact::grazes(const World& world, const Pair& pair) const {
  Real depth = 0;
  if (nodes_)
    for (const Index e : {pair.a, pair.b})
      for (const Index n : edge(e).node) depth = std::max(depth, nodes_->depth_at(n));
  const auto near_corner = [&](Index e, Real at) {
    const EdgeEnds x = ends(world, e);
    const std::size_t end = at > 0.5 ? 1 : 0;
    const Vec w = x[1 - end] - x[end];
    const Real length = w.norm();
    if (!(std::abs(at - static_cast<Real>(end)) * length < level_at(depth, length))) return false;
    const Index n = edge(e).node[end];
    const auto& on = next_[static_cast<std::size_t>(e)][end];
    return std::none_of(on.begin(), on.end(), [&](Index other) {
      const Vec further = world.nodes.x.vec(edge(other).other_end(n)) - x[end];
      return w.dot(further) < -straight_on * length * further.norm();
    });
  };
  return near_corner(pair.a, pair.at.s) || near_corner(pair.b, pair.at.t);
}

void EdgeContact::begin_crossing(const World& world, const Clock& clock, const Pair& pair, Block& b) const {
  const Real r = reach_of(pair.a, pair.b);
  const bool through = crossed(world, clock, pair);
  if (through && grazes(world, pair)) return;
  if (!through && !(pair.at.distance < r)) return expect(world, pair, b);
  Pair nearer;
  if (find_nearer(world, pair, true, nearer)) return;
  const NearestPoints old =
      nearest_points(ends_before(world, clock, pair.a), ends_before(world, clock, pair.b));
  Touch touch;
  touch.a = pair.a, touch.b = pair.b, touch.at = pair.at;
  begin(world, touch, through, old);
  if (touch.gap >= 0) return;
  if (!is_too_deep(touch))
    b.touches.push_back(touch);
  else if (through)
    ++b.leaked;
}

void EdgeContact::begin_along(const World& world, const Clock& clock, const Pair& pair, Place place,
                              Block& b) const {
  Touch touch;
  touch.a = pair.a, touch.b = pair.b, touch.place = place;
  if (!place_along(world, touch)) return;
  const Real r = reach_of(pair.a, pair.b);
  const NearestPoints old =
      nearest_to_point(ends_before(world, clock, pair.a), ends_before(world, clock, pair.b), touch.at.s);
  const bool through = !fresh_ && !parted_.contains({pair.a, pair.b}) && old.w.dot(touch.at.w) < 0 &&
                       nearest_on_way(old.w, touch.at.w) < r;
  if (!through && !(touch.at.distance < r)) {
    if (place == along_first) expect(world, pair, b);
    return;
  }
  begin(world, touch, through, old);
  if (touch.gap < 0) b.touches.push_back(touch);
}

// Who was nearer than the radii before, touched by nothing, comes with no energy: its depth gives no force.
// Nor does more of it than its speed can press in, where a step was too long for what nobody saw coming.
void EdgeContact::begin(const World& world, Touch& touch, bool through, const NearestPoints& old) const {
  const Vec now = touch.at.distance > 0 ? Vec(touch.at.w / touch.at.distance) : old.w.normalized();
  touch.n = through ? Vec(-now) : now;
  gap_of(touch);
  touch.k = stiffness_of(world, touch.a, touch.b);
  const Real before = old.distance - reach_of(touch.a, touch.b);
  if (fresh_) {
    touch.slack = -touch.gap > edge_start_rounding * size_ ? -touch.gap : 0;
    return;
  }
  const Vec v = velocity([&](Index n) { return Vec(world.nodes.v.vec(n)); }, touch);
  const Real omega2 = touch.stiffness() * (mobility(world, touch, 0) + mobility(world, touch, 1));
  const Real pressed = std::max(-touch.n.dot(v), Real(0)) / std::sqrt(omega2);
  touch.slack = std::max({Real(0), -touch.gap - pressed, before < -edge_rounding * size_ ? -before : 0});
}

// The spring that a pair will have which meets within a step, no force: so that steps are short enough for it
// by then.
void EdgeContact::expect(const World& world, const Pair& pair, Block& b) const {
  const Real gap = pair.at.distance - reach_of(pair.a, pair.b);
  const Real within = soft_dt_ > 0 ? soft_dt_ : std::numeric_limits<Real>::infinity();
  if (!(gap >= 0 && pair.at.distance > 0)) return;
  Touch touch;
  touch.a = pair.a, touch.b = pair.b, touch.at = pair.at, touch.n = pair.at.w / pair.at.distance;
  const Real closing = -touch.n.dot(velocity([&](Index n) { return Vec(world.nodes.v.vec(n)); }, touch));
  if (!(closing > 0 && gap < closing * within)) return;
  touch.due = std::max(gap / closing, std::numeric_limits<Real>::min());
  touch.gap = gap;
  touch.k = stiffness_of(world, pair.a, pair.b);
  b.touches.push_back(touch);
}

}  // namespace courant
