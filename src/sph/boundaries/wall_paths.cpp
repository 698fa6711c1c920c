#include "sph/boundaries/wall_paths.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "parallel/parallel.hpp"
#include "sph/core/kernel.hpp"

namespace courant {

namespace {

constexpr Real touching = 1e-3;   ///< of the reach: what is nearer is joined, as decks round places
constexpr Real overlap = 1e-4;    ///< of the reach: so far faces go on past their edges
constexpr Real level = 1 - 1e-6;  ///< cosine of the angle between normals of faces in one plane
constexpr Real most_passed = 2;   ///< widths by which a way may pass edges, with room to spare
constexpr Real bent = 0.87;       ///< cosine of the turn up to which one face goes on in the next

/// The places where two pieces of lines come nearest, and how far on the first one that is, from 0 to 1.
struct Nearest {
  Vec here, there;
  Real part = 0;
  Real distance() const { return (here - there).norm(); }
};
Nearest nearest(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  const Vec u = b - a, v = d - c, w = a - c;
  const Real uu = u.squaredNorm(), uv = u.dot(v), vv = std::max(v.squaredNorm(), Real(1e-300)), uw = u.dot(w),
             vw = v.dot(w), det = uu * vv - uv * uv;
  Real s = det > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, Real(0), Real(1)) : Real(0);
  const Real t = std::clamp((uv * s + vw) / vv, Real(0), Real(1));
  if (uu > 0) s = std::clamp((uv * t - uw) / uu, Real(0), Real(1));
  return {a + s * u, c + t * v, s};
}

/// No way goes exactly through an edge, or between particles and faces that stand on one lattice, when all
/// particles are looked at a little aside of their places, which does not matter otherwise; at the other end
/// of its way, a particle that sees itself elsewhere again: in a corner that way always goes through the
/// edge. [L]
Vec aside(Real reach, int dim, bool again) {
  return 1e-5 * reach *
         (again ? Vec(-0.2, 0.5303, dim == 2 ? 0 : 0.7071) : Vec(0.6180, 0.4142, dim == 2 ? 0 : 0.2679));
}

}  // namespace

WallPaths::WallPaths(const WallSurface& surface, int dim, Real width)
    : surface_(surface),
      dim_(dim),
      width_(width),
      aside_(aside(surface.reach(), dim, false)),
      aside_again_(aside(surface.reach(), dim, true)),
      edges_(static_cast<std::size_t>(surface.faces())),
      faces_(surface.faces() > 0 ? &surface.face(0) : nullptr) {
  for_each(surface.faces(), [&](Index f) {
    for (int e = 0; e < surface_.face(f).corners; ++e)
      // in 2D, edges 0 and 2 are far to the sides of the plane of flow
      if (dim_ == 3 || e % 2 == 1) edges_[f][e] = edge_of(f, e);
  });
  for (Index f = 0; f < surface.faces(); ++f) any_moves_ |= surface.face(f).body >= 0;
}

WallPaths::WallPaths(const WallPaths& other)
    : surface_(other.surface_),
      dim_(other.dim_),
      width_(other.width_),
      aside_(other.aside_),
      aside_again_(other.aside_again_),
      edges_(other.edges_),
      any_moves_(other.any_moves_),
      faces_(other.faces_),
      moved_(other.moved_),
      motions_(other.motions_) {
  if (!moved_.empty()) faces_ = moved_.data();
}

/// Other faces that go on from the middle of an edge decide: in the plane or slightly bent, it is no edge.
WallPaths::Edge WallPaths::edge_of(Index face, int edge) const {
  const auto& f = surface_.face(face);
  const Real near = touching * surface_.reach();
  const Vec a = f.x[edge], b = f.x[(edge + 1) % f.corners], m = 0.5 * (a + b), outward = -f.inward[edge];
  Edge out{true, {}, m, 0.5 * (b - a).norm()};
  for (const Index other : surface_.faces_around(m)) {
    const auto& g = surface_.face(other);
    if (other == face || std::abs(g.n.dot(m) - g.offset) > near) continue;
    bool inside = true;
    for (int e = 0; e < g.corners; ++e) inside &= g.inward[e].dot(m - g.x[e]) > -near;
    if (!inside) continue;
    // where the other face lies, seen from the edge: both ways across it, as far as it goes
    Vec across = g.n.cross(b - a);
    if (!(across.norm() > 0)) continue;
    across.normalize();
    for (const Real way : {-1.0, 1.0}) {
      const Vec t = way * across, p = m + 10 * near * t;
      bool goes_on = true;
      for (int e = 0; e < g.corners; ++e) goes_on &= g.inward[e].dot(p - g.x[e]) > -near;
      if (!goes_on) continue;
      if (t.dot(outward) > bent) return {};
      if (std::abs(f.n.dot(t)) > touching)
        out.corners.push_back({g.n, -g.n.dot(outward), f.n.dot(t), other, way});
    }
  }
  return out;
}

bool WallPaths::is_free(Index face, int edge, const Vec& p) const {
  const auto& f = this->face(face);
  const Vec d = p - f.x[edge];
  const auto& corners = edges_[face][edge].corners;
  return std::none_of(corners.begin(), corners.end(),
                      [&](const Corner& c) { return f.n.dot(d) * c.there > 0 && c.n.dot(d) * c.here > 0; });
}

/// Whether a face lies in the plane of a sheet, but for how decks round places.
bool WallPaths::goes_on_in(const Sheet& sheet, Index face) const {
  const auto& f = this->face(face);
  if (f.body != sheet.body || std::abs(f.n.dot(sheet.n)) < level) return false;
  return std::all_of(f.x.begin(), f.x.begin() + f.corners,
                     [&](const Vec& x) { return std::abs(sheet.height(x)) < touching * surface_.reach(); });
}

WallPaths::Sheets WallPaths::seen_from(const Vec& x) const {
  Sheets out;
  const WallSurface::View view = surface_.view_from(x);
  if (view.nothing) return out;
  const std::vector<Index> around = surface_.faces_around(x);
  // exactly, or a pair of particles would not look alike from both
  const auto ends = [&](Index f) {
    return face(f).body >= 0 ||
           std::any_of(edges_[f].begin(), edges_[f].end(), [](const Edge& e) { return e.ends; });
  };
  const bool edges = std::any_of(around.begin(), around.end(), ends);
  if (view.flat >= 0 && !edges) {
    out.push_back(sheet_of(view.flat));
    out.back().endless = true;
    return out;
  }
  return sheets_of(around);
}

WallPaths::Sheets WallPaths::sheets_around(const Vec& x, Real within) const {
  return sheets_of(surface_.faces_around(x, within + surface_.spacing()));
}

WallPaths::Sheet WallPaths::sheet_of(Index face) const {
  const auto& f = this->face(face);
  Sheet sheet;
  sheet.n = f.n, sheet.offset = f.offset, sheet.plane = f.plane, sheet.face = face, sheet.body = f.body;
  return sheet;
}

WallPaths::Sheets WallPaths::sheets_of(const std::vector<Index>& faces) const {
  Sheets out;
  for (const Index f : faces) {
    auto known = std::find_if(out.begin(), out.end(), [&](const Sheet& s) { return goes_on_in(s, f); });
    if (known == out.end()) known = out.insert(out.end(), sheet_of(f));
    known->faces.push_back(f);
    for (int e = 0; e < 4; ++e)
      if (edges_[f][e].ends) add_edge(*known, f, e);
  }
  compare(out);
  return out;
}

/// Edges that go on straight beside the same other faces are one.
void WallPaths::add_edge(Sheet& sheet, Index face, int edge) const {
  const auto& f = this->face(face);
  Brink out{.face = face, .edge = edge, .from = f.x[edge], .to = f.x[(edge + 1) % f.corners]};
  const Real near = 1e-6 * surface_.reach();
  const auto alike = [&](const Corner& a, const Corner& b) {
    return (a.n - b.n).norm() < 1e-9 && std::abs(a.here - b.here) < 1e-9 &&
           std::abs(a.there - b.there) < 1e-9;
  };
  const auto goes_on = [&](const Brink& known) {
    const auto &these = edges_[known.face][known.edge].corners, &others = edges_[face][edge].corners;
    const Vec along = known.to - known.from;
    return (this->face(known.face).inward[known.edge] - f.inward[edge]).norm() < 1e-9 &&
           along.cross(out.to - known.from).norm() < near * along.norm() && these.size() == others.size() &&
           std::equal(these.begin(), these.end(), others.begin(), alike);
  };
  for (bool more = sheet.body < 0; more;) {
    more = false;
    for (std::size_t k = 0; k < sheet.edges.size(); ++k) {
      const Brink& known = sheet.edges[k];
      if (!goes_on(known)) continue;
      if ((known.to - out.from).norm() < near)
        out.from = known.from;
      else if ((known.from - out.to).norm() < near)
        out.to = known.to;
      else
        continue;
      sheet.edges.erase(sheet.edges.begin() + static_cast<std::ptrdiff_t>(k));
      more = true;
      break;
    }
  }
  out.find_middle();
  sheet.edges.push_back(out);
}

/// Where an edge of a wall that moves is now.
WallPaths::Brink WallPaths::now(const Brink& edge) const {
  const auto& f = face(edge.face);
  Brink out{
      .face = edge.face, .edge = edge.edge, .from = f.x[edge.edge], .to = f.x[(edge.edge + 1) % f.corners]};
  out.find_middle();
  return out;
}

/// What no way by several of the sheets can do, however they move as one.
void WallPaths::compare(Sheets& sheets) const {
  const auto for_each_corner = [&](const Sheet& s, const auto& f) {
    for (const Index face : s.faces)
      for (int e = 0; e < this->face(face).corners; ++e) f(surface_.in_plane(this->face(face).x[e]));
  };
  for (Sheet& s : sheets) {
    Index n = 0;
    for_each_corner(s, [&](const Vec& x) { s.middle += x, ++n; });
    s.middle /= n, s.half = 0;
    s.low = s.high = s.middle;
    for_each_corner(s, [&](const Vec& x) {
      s.half = std::max(s.half, (x - s.middle).norm());
      s.low = s.low.cwiseMin(x), s.high = s.high.cwiseMax(x);
    });
    for (std::size_t k = 0; k < std::min<std::size_t>(sheets.size(), 64); ++k) {
      const Sheet& other = sheets[k];
      if (&other == &s || other.body != s.body) continue;
      Real low = std::numeric_limits<Real>::infinity(), high = -low;
      for_each_corner(
          other, [&](const Vec& x) { low = std::min(low, s.height(x)), high = std::max(high, s.height(x)); });
      const Real nothing = 1e-6 * surface_.reach();
      if (high < nothing) s.under |= std::uint64_t(1) << k;
      if (low > -nothing) s.over |= std::uint64_t(1) << k;
    }
  }
}

bool WallPaths::is_inside(const Sheet& sheet, const Vec& q) const {
  return sheet.endless || std::any_of(sheet.faces.begin(), sheet.faces.end(), [&](Index face) {
           const auto& f = this->face(face);
           bool in = surface_.is_at_face(face, q);
           for (int e = 0; e < f.corners; ++e)
             in &= f.inward[e].dot(q - f.x[e]) > -overlap * surface_.reach();
           return in;
         });
}

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

/// How much of a way from `a` to `b`, which began at `start`, the sheet takes: where it passes an edge that
/// nothing else closes for particles at x and y, it goes over from all to nothing within the width, as the
/// way passes before the edge or behind it. So the faces on both sides of a corner, and the way past it,
/// share all ways alike.
WallPaths::Meeting WallPaths::meet(const Sheet& sheet, const Vec& a, const Vec& b, const Vec& start,
                                   const Vec& x, const Vec& y, const Sheet* but, const Sheet* and_but) const {
  const Real from = sheet.height(a), to = sheet.height(b);
  Meeting out;
  out.crosses = from * to < 0;
  // edges lie in the plane, and are not nearer than it is
  if (!out.crosses &&
      (sheet.edges.empty() || std::min(std::abs(sheet.height(start)), std::abs(to)) > 0.5 * width_))
    return {};
  if (out.crosses) {
    out.at = a + (b - a) * (from / (from - to));
    out.inside = is_inside(sheet, out.at);
  }
  Real near = 0.5 * width_;
  const Vec middle = 0.5 * (start + b);
  const Real around = 0.5 * (b - start).norm() + near;
  for (const Brink& edge : sheet.edges) {
    if ((edge.middle - middle).squaredNorm() > power<2>(around + edge.half)) continue;
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
    out.edge_of = face, out.on_edge = to_edge.there;
    const Vec away = (to_edge.here - to_edge.there) / std::max(r, Real(1e-300));
    out.by_start = (1 - to_edge.part) * away, out.by_end = to_edge.part * away;
  }
  const Real side = out.inside ? 1 : -1, t = 0.5 + side * near / width_;
  out.share = t * t * (3 - 2 * t);
  out.by_start *= 6 * t * (1 - t) * side / width_, out.by_end *= 6 * t * (1 - t) * side / width_;
  return out;
}

/// What hides most of a way from `a` to `b`.
WallPaths::Meeting WallPaths::hidden(const Sheets& sheets, Some some, const Vec& a, const Vec& b,
                                     const Vec& x, const Vec& y, const Sheet* but,
                                     const Sheet* and_but) const {
  Meeting most;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    const Sheet& s = sheets[k];
    if (&s == but || &s == and_but || !has(some, k)) continue;
    const Real from = s.height(a), to = s.height(b);
    if (!(from * to < 0) && (s.edges.empty() || std::min(std::abs(from), std::abs(to)) > 0.5 * width_))
      continue;  // as `meet` would find
    const Meeting m = meet(s, a, b, a, x, y, but, and_but);
    if (m.share > most.share) most = m;
  }
  return most;
}

WallPaths::Some WallPaths::within(const Sheets& sheets, const Vec& at, Real reach) const {
  const Vec x = put_aside(at);
  Some out = sheets.size() > 63 ? Some(1) << 63 : 0;
  for (std::size_t k = 0; k < std::min<std::size_t>(sheets.size(), 63); ++k)
    if (sheets[k].off(x) <= reach) out |= Some(1) << k;
  return out;
}

/// A way that has to do with a wall is no shorter than what both ends are off it, but for widths of edges.
void WallPaths::add(const Sheets& sheets, Some some, Index i, const Vec& at_i, Index j, const Vec& at_j,
                    Real reach, std::vector<WallPath>& to, std::vector<WallPull>* pulls) const {
  const Vec x = put_aside(at_i), y = put_aside(at_j, i == j);
  if ((y - x).squaredNorm() >= reach * reach) return;  // images are farther
  Real from_x = reach, from_y = reach;
  for (std::size_t k = 0; k < std::min<std::size_t>(sheets.size(), 63); ++k) {
    if (!has(some, k)) continue;
    const Sheet& s = sheets[k];
    if (s.off(x) + s.off(y) > reach + most_passed * width_) {
      some &= ~(Some(1) << k);
      continue;
    }
    from_x = std::min(from_x, std::abs(s.height(x)));
    from_y = std::min(from_y, std::abs(s.height(y)));
  }
  for (std::size_t k = 63; k < sheets.size(); ++k) {
    from_x = std::min(from_x, std::abs(sheets[k].height(x)));
    from_y = std::min(from_y, std::abs(sheets[k].height(y)));
  }
  if (some == 0) return;
  if (i != j) add_straight(sheets, some, i, x, j, y, to, pulls);
  if (from_x + from_y > reach + width_) return;
  Sequence by;
  add_thrown_back({sheets, some, i, j, x, y, reach, from_y, to, pulls}, by, x, 0);
}

void WallPaths::add_straight(const Sheets& sheets, Some some, Index i, const Vec& x, Index j, const Vec& y,
                             std::vector<WallPath>& to, std::vector<WallPull>* pulls) const {
  const Meeting m = hidden(sheets, some, x, y, x, y);
  if (!(m.share > 0)) return;
  WallPath path{.i = i, .j = j, .weight = -m.share, .d = x - y};
  path.by_i = -m.by_start, path.by_j = -m.by_end;
  if (pulls) {
    path.pulls = static_cast<Index>(pulls->size());
    pull_edge(m, 1, *pulls);
    path.pulls_end = static_cast<Index>(pulls->size());
  }
  to.push_back(path);
}

/// Ways by the walls `by`, behind all of which x is seen at `x_there`, and then one more, or several: as many
/// as there are directions, or two more in the plane, where corners may be sharp. `way`: they are no shorter
/// up to the last of these walls, but for a width for each of them: ways may pass edges by half of that.
void WallPaths::add_thrown_back(const Search& search, Sequence& by, const Vec& x_there, Real way) const {
  const std::size_t most = dim_ == 2 ? 4 : 3;
  const Sheets& sheets = search.sheets;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    if (!has(search.some, k)) continue;
    const Sheet& s = sheets[k];
    if (by.empty() ? std::abs(s.height(search.x)) > search.reach : by.back() == &s) continue;
    if (by.size() == 1 && by.front()->turns_away(k, search.x)) continue;
    const Real until = by.empty() ? s.off(search.x) : way + by.back()->off(s);
    if (until + search.least_y > search.reach + Real(by.size() + 1) * width_) continue;
    const bool ends = by.empty() || may_end(search, by, s, x_there, until);
    const Vec there = s.image(x_there);
    by.push_back(&s);
    if (ends && (there - search.y).squaredNorm() < search.reach * search.reach) add_path(search, by);
    if (by.size() < most && sheets.size() > 1) add_thrown_back(search, by, there, until);
    by.pop_back();
  }
}

/// Whether a way by the walls `by` may end with one more. It would meet them all, so that it comes from where
/// y is to the last one, and is no shorter than what x is off the first and y off the last.
bool WallPaths::may_end(const Search& search, const Sequence& by, const Sheet& last, const Vec& x_there,
                        Real way) const {
  constexpr Real rounded = 1 + 1e-9;
  const Real from_y = last.height(search.y);
  if (!(from_y * last.height(x_there) > 0)) return false;
  if (std::abs(by.front()->height(search.x)) + std::abs(from_y) > search.reach * rounded) return false;
  if (last.turns_away(static_cast<std::size_t>(by.back() - search.sheets.data()), search.y)) return false;
  return way + last.off(search.y) <= search.reach + Real(by.size() + 1) * width_;
}

void WallPaths::add_path(const Search& search, const Sequence& by) const {
  WallPath path{.i = search.i, .j = search.j};
  Vec image = search.y;
  for (std::size_t k = by.size(); k-- > 0;) image = by[k]->image(image);
  path.d = search.x - image;
  for (const Sheet* sheet : by) path.turn = path.turn * sheet->turn();
  const Sheet& s = *by.back();
  if (s.endless && !search.pulls)
    path.weight = s.height(search.x) * s.height(image) < 0;  // nothing else is there
  else if (search.pulls)
    follow<true>(search.sheets, search.some, by, search.x, search.y, image, path, search.pulls);
  else
    follow<false>(search.sheets, search.some, by, search.x, search.y, image, path, search.pulls);
  if (search.i == search.j)
    path.by_i = path.by_j = 0.5 * (path.by_i + path.by_j);  // but for rounding they are
  if (!(path.weight > 0)) return;
  note_walls(search.sheets, by, search.y, path);
  search.to.push_back(path);
}

/// Which walls throw a way back, and how they take the image of y along.
void WallPaths::note_walls(const Sheets& sheets, const Sequence& by, Vec y, WallPath& path) const {
  for (std::size_t k = 0; k < by.size(); ++k) {
    path.by[k] = static_cast<signed char>(by[k] - sheets.data());
    path.moves |= by[k]->body >= 0;
  }
  if (!path.moves) return;
  for (std::size_t k = by.size(); k-- > 0;) y = image(*by[k], y, path.drift);
}

/// Follows the way from x towards the image of y behind the walls `by`, each of which turns it back, and
/// gives the path its share and the slopes of that: a product of what walls take and of what none of the
/// others hides.
template <bool recorded>
void WallPaths::follow(const Sheets& sheets, Some some, const Sequence& by, const Vec& x, const Vec& y,
                       Vec target, WallPath& path, [[maybe_unused]] std::vector<WallPull>* pulls) const {
  [[maybe_unused]] std::conditional_t<recorded, Way, char> way;
  Vec start = x, at = x;
  // what these change by when x and y do
  Matrix start_by_x = Matrix::Identity(), target_by_y = path.turn, at_by_x = start_by_x,
         at_by_y = Matrix::Zero();
  Real share = 1;
  Vec by_x = Vec::Zero(), by_y = Vec::Zero();
  const auto times = [&](Real factor, const Vec& slope_x, const Vec& slope_y) {
    by_x = factor * by_x + share * slope_x, by_y = factor * by_y + share * slope_y;
    share *= factor;
    return share > 0;
  };
  const Sheet* last = nullptr;
  for (const Sheet* s : by) {
    const Meeting m = meet(*s, at, target, start, x, y);
    if constexpr (recorded) way.step(*s, start, target, m);
    if (by.size() > 1 &&
        (!m.crosses || (last && (turn_away(*s, *last, x, y) || (any_moves_ && turn_away(*last, *s, x, y))))))
      return;
    if (!times(m.share, start_by_x.transpose() * m.by_start, target_by_y.transpose() * m.by_end)) return;
    Matrix m_by_x = Matrix::Zero(), m_by_y = Matrix::Zero();
    if (m.crosses) {
      const Vec along = target - start;
      const Matrix in_wall = Matrix::Identity() - along * s->n.transpose() / s->n.dot(along);
      const Real part = s->height(start) / (s->height(start) - s->height(target));
      m_by_x = (1 - part) * in_wall * start_by_x, m_by_y = part * in_wall * target_by_y;
    }
    const Meeting h = hidden(sheets, some, at, m.at, x, y, last, s);
    if constexpr (recorded) way.hidden[way.steps - 1] = h;
    if (!times(1 - h.share, -(at_by_x.transpose() * h.by_start + m_by_x.transpose() * h.by_end),
               -(at_by_y.transpose() * h.by_start + m_by_y.transpose() * h.by_end)))
      return;
    start = s->image(start), target = s->image(target);
    start_by_x = s->turn() * start_by_x, target_by_y = s->turn() * target_by_y;
    at = m.at, at_by_x = m_by_x, at_by_y = m_by_y, last = s;
  }
  const Meeting h = hidden(sheets, some, at, y, x, y, last);
  if (!times(1 - h.share, -at_by_x.transpose() * h.by_start, -at_by_y.transpose() * h.by_start - h.by_end))
    return;
  path.weight = share, path.by_i = by_x, path.by_j = by_y;
  if constexpr (recorded) {
    way.hidden[way.steps] = h, way.end = y;
    path.pulls = static_cast<Index>(pulls->size());
    pull_all(way, share, *pulls);
    path.pulls_end = static_cast<Index>(pulls->size());
  }
}

}  // namespace courant
