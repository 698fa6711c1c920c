// Search for paths between particles beside walls.
#include <algorithm>
#include <cmath>

#include "sph/kernel/kernel.hpp"
#include "sph/walls/images/wall_paths.hpp"

namespace courant {

namespace {

constexpr Real most_passed = 2;  ///< widths by which a path may pass edges, with space to spare

/// Closest points of two segments, and the position of the first one along its segment, 0 to 1. For
/// parallel segments, the middle of their overlap, the same from both sides.
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

/// Whether sheets meet in a convex corner: no path connects them.
bool WallPaths::turn_away(const Sheet& sheet, const Sheet& other, const Vec& x, const Vec& y) const {
  return std::any_of(sheet.edges.begin(), sheet.edges.end(), [&](const auto& edge) {
    return lies_in(edge.from, edge.to, &other) && is_free(edge.face, edge.edge, x) &&
           is_free(edge.face, edge.edge, y);
  });
}

/// The share of a path from `a` to `b`, with the start `start`, that the sheet takes. Near a free edge,
/// one that no other face closes for particles at x and y, it changes from one to zero over the width. The
/// faces on both sides of a corner and the path past it thus share all paths.
WallPaths::Meeting WallPaths::meet(const Sheet& sheet, const Box& about, const Vec& a, const Vec& b,
                                   const Vec& start, const Vec& x, const Vec& y, const Sheet* but,
                                   const Sheet* and_but) const {
  const Real from = sheet.height(a), to = sheet.height(b);
  Meeting out = Meeting::nowhere();
  out.crosses = from * to < 0;
  // edges lie in the plane and are not nearer than the plane
  if (!out.crosses &&
      (sheet.edges.empty() || std::min(std::abs(sheet.height(start)), std::abs(to)) > 0.5 * width_))
    return out;
  if (out.crosses) {
    out.at = a + (b - a) * (from / (from - to));
    out.inside = is_inside(sheet, out.at);
  }
  Real near = 0.5 * width_;
  for (const Border& edge : sheet.edges) {
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
    // the overlap of faces does not count at their ends
    if (out.inside && nearest(out.at, out.at, c, d).distance() < 2 * overlap * surface_.reach())
      out.inside = f.inward[e].dot(out.at - c) > 1e-12 * surface_.reach();
    if (passed) continue;  // the path ends on the other side of that edge
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

/// The sheet that hides most of a path from `a` to `b`.
WallPaths::Meeting WallPaths::hidden(const Pair& pair, const Vec& a, const Vec& b, const Sheet* but,
                                     const Sheet* and_but) const {
  const Sheets& sheets = *pair.from.sheets_;
  const Box about = box_about(a, b);
  Meeting most = Meeting::nowhere();
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    const Sheet& s = sheets[k];
    if (&s == but || &s == and_but || !has(pair.candidates, k) || !s.is_within(about)) continue;
    const Real from = s.height(a), to = s.height(b);
    if (!(from * to < 0) && (s.edges.empty() || std::min(std::abs(from), std::abs(to)) > 0.5 * width_))
      continue;  // as `meet` would find
    const Meeting m = meet(s, about, a, b, a, pair.from.x_, pair.y, but, and_but);
    if (m.share > most.share) most = m;
  }
  return most;
}

/// A path by a wall is at least as long as the distances of its ends from the wall, less the widths of
/// edges.
void WallPaths::look_from(const Sheets& sheets, const Vec& at, Real reach, Viewpoint& to) const {
  to.sheets_ = &sheets, to.x_ = put_aside(at), to.reach_ = reach;
  to.candidates_ = sheets.size() > 63 ? SheetSet(1) << 63 : 0;
  to.height_.resize(sheets.size()), to.off_.resize(sheets.size());
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    to.height_[k] = sheets[k].height(to.x_), to.off_[k] = sheets[k].off(to.x_);
    if (to.off_[k] <= reach + most_passed * width_) to.candidates_ |= bit(k);
  }
  to.routes_.clear();
  Sequence by;
  find_routes(to, by, to.x_, 0, 0);
}

/// Searches routes by the walls `by`, with the image of x at `there`, and by further walls: up to the
/// number of directions, or two more in the plane, where corners may be acute. `until`: lower bound of the
/// length up to the last wall, less a width per wall, as paths may pass edges by half of it. `least`: the
/// greatest lower bound so far, without widths.
void WallPaths::find_routes(Viewpoint& from, Sequence& by, const Vec& there, Real until, Real least) const {
  const std::size_t most = dim_ == 2 ? 4 : 3;
  const Sheets& sheets = *from.sheets_;
  const Real reach = from.reach_;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    if (!has(from.candidates_, k)) continue;
    const Sheet& s = sheets[k];
    if (by.empty() ? std::abs(from.height_[k]) > reach : by.back() == &s) continue;
    if (by.size() == 1 && by.front()->turns_away(k, by.front()->height(from.x_))) continue;
    Route route;
    route.until = by.empty() ? from.off_[k] : until + by.back()->off(s);
    route.least = std::max(least, route.until - Real(by.size() + 1) * width_);
    if (route.least > reach) continue;
    route.there = s.image(there), route.last = k, route.side = by.empty() ? 0 : s.height(there);
    // the path must reach the last wall from the side of the other particle
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

/// Whether a path by several walls may end at y: y is on the right side of the last wall, and the length
/// bounds hold.
bool WallPaths::may_end(const Viewpoint& from, const Route& route, const Vec& y) const {
  constexpr Real rounded = 1 + 1e-9;
  const Real height = from.height_there_[route.last];
  return height * route.side > 0 && route.front + std::abs(height) <= from.reach_ * rounded &&
         route.until + route.by.back()->off(y) <= from.reach_ + Real(route.by.size()) * width_;
}

void WallPaths::add(Viewpoint& from, Index i, Index j, const Vec& at_j, std::vector<WallPath>& to,
                    std::vector<WallDerivative>* derivatives) const {
  Pair pair{.from = from,
            .i = i,
            .j = j,
            .y = put_aside(at_j, i == j),
            .candidates = from.candidates_,
            .to = to,
            .derivatives = derivatives};
  const Vec &x = from.x_, &y = pair.y;
  const Real reach = from.reach_;
  if ((y - x).squaredNorm() >= reach * reach) return;  // images are farther
  const Sheets& sheets = *from.sheets_;
  from.height_there_.resize(sheets.size());
  Real from_x = reach, from_y = reach;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    if (!has(pair.candidates, k)) continue;
    const Real height = from.height_there_[k] = sheets[k].height(y);
    if (k < 63 && from.off_[k] + std::abs(height) > reach + most_passed * width_) {
      pair.candidates &= ~bit(k);
      continue;
    }
    from_x = std::min(from_x, std::abs(from.height_[k])), from_y = std::min(from_y, std::abs(height));
  }
  if (pair.candidates == 0) return;
  if (i != j) add_straight(pair);
  if (from_x + from_y > reach + width_) return;
  for (const Route& route : from.routes_) {
    if ((route.there - y).squaredNorm() >= reach * reach || (route.walls & ~pair.candidates) != 0) continue;
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
    path.across |= has(pair.candidates, k) && sheets[k].height(x) * sheets[k].height(y) < 0;
  if (pair.derivatives) {
    path.derivatives = static_cast<Index>(pair.derivatives->size());
    add_edge_derivative(m, 1, *pair.derivatives);
    path.derivatives_end = static_cast<Index>(pair.derivatives->size());
  }
  pair.to.push_back(path);
}

void WallPaths::add_path(const Pair& pair, const Route& route) const {
  const Sequence& by = route.by;
  Vec image = pair.y;
  for (std::size_t k = by.size(); k-- > 0;) image = by[k]->image(image);
  WallPath path{.i = pair.i, .j = pair.j, .d = pair.from.x_ - image, .turn = route.turn};
  const Sheet& s = *by.back();
  Ray ray;
  if (s.endless && !pair.derivatives)
    path.weight = s.height(pair.from.x_) * s.height(image) < 0;  // nothing else is there
  else
    path.weight = follow(pair, by, image, ray);
  if (!(path.weight > 0)) return;
  if (ray.bends) find_slopes(ray, path, pair.derivatives);
  if (pair.i == pair.j) path.by_i = path.by_j = 0.5 * (path.by_i + path.by_j);  // equal but for rounding
  note_walls(*pair.from.sheets_, by, pair.y, path);
  pair.to.push_back(path);
}

/// Records the reflecting walls of a path and the velocity of its image.
void WallPaths::note_walls(const Sheets& sheets, const Sequence& by, Vec y, WallPath& path) const {
  for (std::size_t k = 0; k < by.size(); ++k) {
    path.by[k] = static_cast<signed char>(by[k] - sheets.data());
    path.moves |= by[k]->body >= 0;
  }
  if (!path.moves) return;
  for (std::size_t k = by.size(); k-- > 0;) y = image(*by[k], y, path.drift);
}

/// Traces the path from x to the image of y behind the walls `by`; returns its share: the product of
/// reflected shares and of visible shares between walls.
Real WallPaths::follow(const Pair& pair, const Sequence& by, Vec target, Ray& ray) const {
  const Vec &x = pair.from.x_, &y = pair.y;
  Vec start = x, at = x;
  Real share = 1;
  const auto times = [&](Real factor, const Meeting& m) {
    share *= factor, ray.bends |= m.edge_of != nullptr;
    return share > 0;
  };
  const Sheet* last = nullptr;
  ray.end = y;
  for (const Sheet* s : by) {
    const Box about = box_about(start, target);
    if (!s->is_within(about)) return 0;
    const Meeting m = meet(*s, about, at, target, start, x, y);
    ray.step(*s, start, target, m);
    if (!times(m.share, m)) return 0;
    if (by.size() > 1 &&
        (!m.crosses || (last && (turn_away(*s, *last, x, y) || (any_moves_ && turn_away(*last, *s, x, y))))))
      return 0;
    const Meeting& h = ray.hidden[ray.steps - 1] = hidden(pair, at, m.at, last, s);
    if (!times(1 - h.share, h)) return 0;
    start = s->image(start), target = s->image(target);
    at = m.at, last = s;
  }
  const Meeting& h = ray.hidden[ray.steps] = hidden(pair, at, y, last);
  return times(1 - h.share, h) ? share : 0;
}

/// Derivatives of the share of a path with respect to its ends and to walls.
void WallPaths::find_slopes(const Ray& ray, WallPath& path, std::vector<WallDerivative>* derivatives) const {
  // derivatives of start, target and hit points with respect to x and y
  Matrix start_by_x = Matrix::Identity(), target_by_y = path.turn, at_by_x = start_by_x,
         at_by_y = Matrix::Zero();
  Real share = 1;
  Vec by_x = Vec::Zero(), by_y = Vec::Zero();
  const auto times = [&](Real factor, const Vec& slope_x, const Vec& slope_y) {
    by_x = factor * by_x + share * slope_x, by_y = factor * by_y + share * slope_y;
    share *= factor;
  };
  for (int k = 0; k < ray.steps; ++k) {
    const Sheet& s = *ray.by[k];
    const Meeting &m = ray.met[k], &h = ray.hidden[k];
    times(m.share, start_by_x.transpose() * m.by_start, target_by_y.transpose() * m.by_end);
    Matrix m_by_x = Matrix::Zero(), m_by_y = Matrix::Zero();
    if (m.crosses) {
      const Vec along = ray.target[k] - ray.start[k];
      const Matrix in_wall = Matrix::Identity() - along * s.n.transpose() / s.n.dot(along);
      const Real part = s.height(ray.start[k]) / (s.height(ray.start[k]) - s.height(ray.target[k]));
      m_by_x = (1 - part) * in_wall * start_by_x, m_by_y = part * in_wall * target_by_y;
    }
    times(1 - h.share, -(at_by_x.transpose() * h.by_start + m_by_x.transpose() * h.by_end),
          -(at_by_y.transpose() * h.by_start + m_by_y.transpose() * h.by_end));
    start_by_x = s.turn() * start_by_x, target_by_y = s.turn() * target_by_y;
    at_by_x = m_by_x, at_by_y = m_by_y;
  }
  const Meeting& h = ray.hidden[ray.steps];
  times(1 - h.share, -at_by_x.transpose() * h.by_start, -at_by_y.transpose() * h.by_start - h.by_end);
  path.by_i = by_x, path.by_j = by_y;
  if (!derivatives) return;
  path.derivatives = static_cast<Index>(derivatives->size());
  add_derivatives(ray, path.weight, *derivatives);
  path.derivatives_end = static_cast<Index>(derivatives->size());
}

}  // namespace courant
