// Ways between particles beside walls: which there may be, and how they go.
#include <algorithm>
#include <cmath>

#include "sph/kernel/kernel.hpp"
#include "sph/walls/images/wall_paths.hpp"

namespace courant {

namespace {

constexpr Real most_passed = 2;  ///< widths by which a way may pass edges, with space to spare

/// The positions where two pieces of lines come nearest, and how far on the first one that is, from 0 to 1.
/// Of two that are level, the middle of where they are side by side, as seen from both ends alike.
struct Nearest {
  Vec here, there;
  Real part = 0;
  Real distance() const { return (here - there).norm(); }
};
Nearest nearest(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  const Vec u = b - a, v = d - c, w = a - c;
  const Real uu = u.squaredNorm(), uv = u.dot(v), vv = std::max(v.squaredNorm(), Real(1e-300)), uw = u.dot(w),
             vw = v.dot(w), det = uu * vv - uv * uv;
  Real s = 0;
  if (det > 1e-12 * uu * vv)
    s = std::clamp((uv * vw - vv * uw) / det, Real(0), Real(1));
  else if (uu > 0)
    s = 0.5 * (std::clamp(-uw / uu, Real(0), Real(1)) + std::clamp((uv - uw) / uu, Real(0), Real(1)));
  const Real t = std::clamp((uv * s + vw) / vv, Real(0), Real(1));
  if (uu > 0) s = std::clamp((uv * t - uw) / uu, Real(0), Real(1));
  return {a + s * u, c + t * v, s};
}

}  // namespace

/// Whether both ends of an edge lie in the plane of a sheet.
bool WallPaths::lies_in(const Vec& c, const Vec& d, const Sheet* sheet) const {
  const Real most = touching * surface_.reach();
  return sheet && std::abs(sheet->height(c)) < most && std::abs(sheet->height(d)) < most;
}

/// Whether sheets meet in a convex corner: no way goes from one to the other.
bool WallPaths::turn_away(const Sheet& sheet, const Sheet& other, const Vec& x, const Vec& y) const {
  return std::any_of(sheet.edges.begin(), sheet.edges.end(), [&](const auto& edge) {
    return lies_in(edge.from, edge.to, &other) && is_free(edge.face, edge.edge, x) &&
           is_free(edge.face, edge.edge, y);
  });
}

/// How much of a path from `a` to `b`, which began at `start`, the sheet takes: where it passes an edge that
/// nothing else closes for particles at x and y, it goes over from all to nothing within the width, as the
/// way passes before the edge or behind it. So the faces on both sides of a corner, and the way past it,
/// share all ways alike.
WallPaths::Meeting WallPaths::meet(const Sheet& sheet, const Box& about, const Vec& a, const Vec& b,
                                   const Vec& start, const Vec& x, const Vec& y, const Sheet* but,
                                   const Sheet* and_but) const {
  const Real from = sheet.height(a), to = sheet.height(b);
  Meeting out = Meeting::nowhere();
  out.crosses = from * to < 0;
  // edges lie in the plane, and are not nearer than it is
  if (!out.crosses &&
      (sheet.edges.empty() || std::min(std::abs(sheet.height(start)), std::abs(to)) > 0.5 * width_))
    return out;
  if (out.crosses) {
    out.at = a + (b - a) * (from / (from - to));
    out.inside = is_inside(sheet, out.at);
  }
  Real near = 0.5 * width_;
  for (const Brink& edge : sheet.edges) {
    if (!edge.is_within(about)) continue;
    const Vec &c = edge.from, &d = edge.to;
    const Nearest to_edge = nearest(start, b, c, d);
    const Real r = to_edge.distance();
    if (r >= std::max(near, 2 * overlap * surface_.reach())) continue;
    const Index face = edge.face;
    const int e = edge.edge;
    const auto& f = this->face(face);
    const bool passed = lies_in(c, d, but) || lies_in(c, d, and_but);
    if (!passed && (r >= near || !is_free(face, e, x) || !is_free(face, e, y))) continue;
    // what joins faces does not count where they end
    if (out.inside && nearest(out.at, out.at, c, d).distance() < 2 * overlap * surface_.reach())
      out.inside = f.inward[e].dot(out.at - c) > 1e-12 * surface_.reach();
    if (passed) continue;  // the way ends on the other side of that edge
    near = r;
    if (!out.crosses) out.at = to_edge.there;
    out.edge_of = &sheet, out.on_edge = to_edge.there;
    const Vec away = (to_edge.here - to_edge.there) / std::max(r, Real(1e-300));
    out.by_start = (1 - to_edge.part) * away, out.by_end = to_edge.part * away;
  }
  const Real side = out.inside ? 1 : -1, t = 0.5 + side * near / width_;
  out.share = t * t * (3 - 2 * t);
  out.by_start *= 6 * t * (1 - t) * side / width_, out.by_end *= 6 * t * (1 - t) * side / width_;
  return out;
}

/// What hides most of a path from `a` to `b`, of walls that may matter to it.
WallPaths::Meeting WallPaths::hidden(const Pair& pair, const Vec& a, const Vec& b, const Sheet* but,
                                     const Sheet* and_but) const {
  const Sheets& sheets = *pair.from.sheets_;
  const Box about = box_about(a, b);
  Meeting most = Meeting::nowhere();
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    const Sheet& s = sheets[k];
    if (&s == but || &s == and_but || !has(pair.some, k) || !s.is_within(about)) continue;
    const Real from = s.height(a), to = s.height(b);
    if (!(from * to < 0) && (s.edges.empty() || std::min(std::abs(from), std::abs(to)) > 0.5 * width_))
      continue;  // as `meet` would find
    const Meeting m = meet(s, about, a, b, a, pair.from.x_, pair.y, but, and_but);
    if (m.share > most.share) most = m;
  }
  return most;
}

/// A way that has to do with a wall is no shorter than what both ends are off it, but for widths of edges.
void WallPaths::stand(const Sheets& sheets, const Vec& at, Real reach, Standpoint& to) const {
  to.sheets_ = &sheets, to.x_ = put_aside(at), to.reach_ = reach;
  to.some_ = sheets.size() > 63 ? Some(1) << 63 : 0;
  to.height_.resize(sheets.size()), to.off_.resize(sheets.size());
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    to.height_[k] = sheets[k].height(to.x_), to.off_[k] = sheets[k].off(to.x_);
    if (to.off_[k] <= reach + most_passed * width_) to.some_ |= bit(k);
  }
  to.routes_.clear();
  Sequence by;
  find_routes(to, by, to.x_, 0, 0);
}

/// Ways by the walls `by`, behind all of which x is seen at `there`, and then one more, or several: as many
/// as there are directions, or two more in the plane, where corners may be sharp. `until`: they are no
/// shorter up to the last of these walls, but for a width for each of them: ways may pass edges by half of
/// that. `least`: the most that is known so of them and of what they are part of, without the widths.
void WallPaths::find_routes(Standpoint& from, Sequence& by, const Vec& there, Real until, Real least) const {
  const std::size_t most = dim_ == 2 ? 4 : 3;
  const Sheets& sheets = *from.sheets_;
  const Real reach = from.reach_;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    if (!has(from.some_, k)) continue;
    const Sheet& s = sheets[k];
    if (by.empty() ? std::abs(from.height_[k]) > reach : by.back() == &s) continue;
    if (by.size() == 1 && by.front()->turns_away(k, by.front()->height(from.x_))) continue;
    Route route;
    route.until = by.empty() ? from.off_[k] : until + by.back()->off(s);
    route.least = std::max(least, route.until - Real(by.size() + 1) * width_);
    if (route.least > reach) continue;
    route.there = s.image(there), route.last = k, route.side = by.empty() ? 0 : s.height(there);
    // it would come from where who is looked at is to the last one
    const bool ends = by.empty() || (route.side != 0 && !s.turns_away(by.back() - sheets.data(), route.side));
    by.push_back(&s);
    if (ends && (route.there - from.x_).squaredNorm() < power<2>(2 * reach)) {
      route.by = by, route.front = std::abs(by.front()->height(from.x_));
      for (const Sheet* sheet : by) {
        route.turn = route.turn * sheet->turn();
        route.walls |= bit(static_cast<std::size_t>(sheet - sheets.data()));
      }
      from.routes_.push_back(route);
    }
    if (by.size() < most && sheets.size() > 1) find_routes(from, by, route.there, route.until, route.least);
    by.pop_back();
  }
}

/// Whether a path by several walls may end at y: it meets them all, and is no shorter than what its ends are
/// off the first and the last one.
bool WallPaths::may_end(const Standpoint& from, const Route& route, const Vec& y) const {
  constexpr Real rounded = 1 + 1e-9;
  const Real height = from.height_there_[route.last];
  return height * route.side > 0 && route.front + std::abs(height) <= from.reach_ * rounded &&
         route.until + route.by.back()->off(y) <= from.reach_ + Real(route.by.size()) * width_;
}

void WallPaths::add(Standpoint& from, Index i, Index j, const Vec& at_j, std::vector<WallPath>& to,
                    std::vector<WallPull>* pulls) const {
  Pair pair{.from = from,
            .i = i,
            .j = j,
            .y = put_aside(at_j, i == j),
            .some = from.some_,
            .to = to,
            .pulls = pulls};
  const Vec &x = from.x_, &y = pair.y;
  const Real reach = from.reach_;
  if ((y - x).squaredNorm() >= reach * reach) return;  // images are farther
  const Sheets& sheets = *from.sheets_;
  from.height_there_.resize(sheets.size());
  Real from_x = reach, from_y = reach;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    if (!has(pair.some, k)) continue;
    const Real height = from.height_there_[k] = sheets[k].height(y);
    if (k < 63 && from.off_[k] + std::abs(height) > reach + most_passed * width_) {
      pair.some &= ~bit(k);
      continue;
    }
    from_x = std::min(from_x, std::abs(from.height_[k])), from_y = std::min(from_y, std::abs(height));
  }
  if (pair.some == 0) return;
  if (i != j) add_straight(pair);
  if (from_x + from_y > reach + width_) return;
  for (const Route& route : from.routes_) {
    if ((route.there - y).squaredNorm() >= reach * reach || (route.walls & ~pair.some) != 0) continue;
    if (route.least + from_y > reach) continue;
    if (route.by.size() == 1 || may_end(from, route, y)) add_path(pair, route);
  }
}

void WallPaths::add_straight(const Pair& pair) const {
  const Vec &x = pair.from.x_, &y = pair.y;
  const Meeting m = hidden(pair, x, y);
  if (!(m.share > 0)) return;
  WallPath path{.i = pair.i, .j = pair.j, .weight = -m.share, .d = x - y};
  path.by_i = -m.by_start, path.by_j = -m.by_end;
  const Sheets& sheets = *pair.from.sheets_;
  for (std::size_t k = 0; m.edge_of && k < sheets.size(); ++k)
    path.across |= has(pair.some, k) && sheets[k].height(x) * sheets[k].height(y) < 0;
  if (pair.pulls) {
    path.pulls = static_cast<Index>(pair.pulls->size());
    pull_edge(m, 1, *pair.pulls);
    path.pulls_end = static_cast<Index>(pair.pulls->size());
  }
  pair.to.push_back(path);
}

void WallPaths::add_path(const Pair& pair, const Route& route) const {
  const Sequence& by = route.by;
  Vec image = pair.y;
  for (std::size_t k = by.size(); k-- > 0;) image = by[k]->image(image);
  WallPath path{.i = pair.i, .j = pair.j, .d = pair.from.x_ - image, .turn = route.turn};
  const Sheet& s = *by.back();
  Way way;
  if (s.endless && !pair.pulls)
    path.weight = s.height(pair.from.x_) * s.height(image) < 0;  // nothing else is there
  else
    path.weight = follow(pair, by, image, way);
  if (!(path.weight > 0)) return;
  if (way.bends) find_slopes(way, path, pair.pulls);
  if (pair.i == pair.j) path.by_i = path.by_j = 0.5 * (path.by_i + path.by_j);  // but for rounding they are
  note_walls(*pair.from.sheets_, by, pair.y, path);
  pair.to.push_back(path);
}

/// Which walls throw a path back, and how they take the image of y along.
void WallPaths::note_walls(const Sheets& sheets, const Sequence& by, Vec y, WallPath& path) const {
  for (std::size_t k = 0; k < by.size(); ++k) {
    path.by[k] = static_cast<signed char>(by[k] - sheets.data());
    path.moves |= by[k]->body >= 0;
  }
  if (!path.moves) return;
  for (std::size_t k = by.size(); k-- > 0;) y = image(*by[k], y, path.drift);
}

/// Follows the path from x towards the image of y behind the walls `by`, each of which turns it back; returns
/// its share: a product of what walls take and of what none of the others hides.
Real WallPaths::follow(const Pair& pair, const Sequence& by, Vec target, Way& way) const {
  const Vec &x = pair.from.x_, &y = pair.y;
  Vec start = x, at = x;
  Real share = 1;
  const auto times = [&](Real factor, const Meeting& m) {
    share *= factor, way.bends |= m.edge_of != nullptr;
    return share > 0;
  };
  const Sheet* last = nullptr;
  way.end = y;
  for (const Sheet* s : by) {
    const Box about = box_about(start, target);
    if (!s->is_within(about)) return 0;
    const Meeting m = meet(*s, about, at, target, start, x, y);
    way.step(*s, start, target, m);
    if (!times(m.share, m)) return 0;
    if (by.size() > 1 &&
        (!m.crosses || (last && (turn_away(*s, *last, x, y) || (any_moves_ && turn_away(*last, *s, x, y))))))
      return 0;
    const Meeting& h = way.hidden[way.steps - 1] = hidden(pair, at, m.at, last, s);
    if (!times(1 - h.share, h)) return 0;
    start = s->image(start), target = s->image(target);
    at = m.at, last = s;
  }
  const Meeting& h = way.hidden[way.steps] = hidden(pair, at, y, last);
  return times(1 - h.share, h) ? share : 0;
}

/// How the share of a way goes over with the positions of its ends and of walls.
void WallPaths::find_slopes(const Way& way, WallPath& path, std::vector<WallPull>* pulls) const {
  // what start, target and hits change by when x and y do
  Matrix start_by_x = Matrix::Identity(), target_by_y = path.turn, at_by_x = start_by_x,
         at_by_y = Matrix::Zero();
  Real share = 1;
  Vec by_x = Vec::Zero(), by_y = Vec::Zero();
  const auto times = [&](Real factor, const Vec& slope_x, const Vec& slope_y) {
    by_x = factor * by_x + share * slope_x, by_y = factor * by_y + share * slope_y;
    share *= factor;
  };
  for (int k = 0; k < way.steps; ++k) {
    const Sheet& s = *way.by[k];
    const Meeting &m = way.met[k], &h = way.hidden[k];
    times(m.share, start_by_x.transpose() * m.by_start, target_by_y.transpose() * m.by_end);
    Matrix m_by_x = Matrix::Zero(), m_by_y = Matrix::Zero();
    if (m.crosses) {
      const Vec along = way.target[k] - way.start[k];
      const Matrix in_wall = Matrix::Identity() - along * s.n.transpose() / s.n.dot(along);
      const Real part = s.height(way.start[k]) / (s.height(way.start[k]) - s.height(way.target[k]));
      m_by_x = (1 - part) * in_wall * start_by_x, m_by_y = part * in_wall * target_by_y;
    }
    times(1 - h.share, -(at_by_x.transpose() * h.by_start + m_by_x.transpose() * h.by_end),
          -(at_by_y.transpose() * h.by_start + m_by_y.transpose() * h.by_end));
    start_by_x = s.turn() * start_by_x, target_by_y = s.turn() * target_by_y;
    at_by_x = m_by_x, at_by_y = m_by_y;
  }
  const Meeting& h = way.hidden[way.steps];
  times(1 - h.share, -at_by_x.transpose() * h.by_start, -at_by_y.transpose() * h.by_start - h.by_end);
  path.by_i = by_x, path.by_j = by_y;
  if (!pulls) return;
  path.pulls = static_cast<Index>(pulls->size());
  pull_all(way, path.weight, *pulls);
  path.pulls_end = static_cast<Index>(pulls->size());
}

}  // namespace courant
