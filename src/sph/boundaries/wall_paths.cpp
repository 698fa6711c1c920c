#include "sph/boundaries/wall_paths.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"

namespace courant {

namespace {

constexpr Real touching = 1e-3;   ///< of the reach: what is nearer is joined, as decks round places
constexpr Real overlap = 1e-4;    ///< of the reach: so far faces go on past their edges
constexpr Real level = 1 - 1e-6;  ///< cosine of the angle between normals of faces in one plane
constexpr Real bent = 0.87;       ///< cosine of the turn up to which one face goes on in the next

/// How far a way in direction `way` (a unit vector, or 0) through q passes by an edge; `most` where q is
/// farther from it.
Real distance_to_edge(const Vec& q, const Vec& way, const Vec& a, const Vec& b, Real most) {
  const Vec along = b - a;
  const Real t =
      std::clamp((q - a).dot(along) / std::max(along.squaredNorm(), Real(1e-300)), Real(0), Real(1));
  const Vec to_edge = a + t * along - q;
  return to_edge.norm() > most ? most : (to_edge - to_edge.dot(way) * way).norm();
}

/// No way goes exactly through an edge, or between particles and faces that stand on one lattice, when all
/// particles are looked at a little aside of their places, which does not matter otherwise. [L]
Vec aside(Real reach, int dim) {
  return 1e-5 * reach * Vec(0.6180, 0.4142, dim == 2 ? 0 : 0.2679);
}

}  // namespace

WallPaths::WallPaths(const WallSurface& surface, int dim, Real width)
    : surface_(surface), dim_(dim), width_(width), open_(static_cast<std::size_t>(surface.faces())) {
  for_each(surface.faces(), [&](Index f) {
    for (int e = 0; e < surface_.face(f).corners; ++e)
      // in 2D, edges 0 and 2 are far to the sides of the plane of flow
      open_[f][e] = dim_ == 2 && e % 2 == 0 ? Sides(0) : open_sides(f, e);
  });
}

/// Where other faces go on from the middle of an edge decides: in the plane or slightly bent, it is no edge;
/// on one side, it ends no mirror there; behind, it does.
WallPaths::Sides WallPaths::open_sides(Index face, int edge) const {
  const auto& f = surface_.face(face);
  const Real near = touching * surface_.reach();
  const Vec a = f.x[edge], b = f.x[(edge + 1) % f.corners], m = 0.5 * (a + b), outward = -f.inward[edge];
  Sides open = 3;
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
      if (t.dot(outward) > bent) return 0;
      if (f.n.dot(t) > touching) open &= ~Sides(1);
      if (f.n.dot(t) < -touching) open &= ~Sides(2);
    }
  }
  return open;
}

/// Whether a face lies in the plane of a sheet, but for how decks round places.
bool WallPaths::goes_on_in(const Sheet& sheet, Index face) const {
  const auto& f = surface_.face(face);
  if (std::abs(f.n.dot(sheet.n)) < level) return false;
  return std::all_of(f.x.begin(), f.x.begin() + f.corners,
                     [&](const Vec& x) { return std::abs(sheet.height(x)) < touching * surface_.reach(); });
}

WallPaths::Sheets WallPaths::seen_from(const Vec& x) const {
  Sheets out;
  const WallSurface::View view = surface_.view_from(x);
  if (view.nothing) return out;
  const auto sheet_of = [&](Index face) {
    const auto& f = surface_.face(face);
    return Sheet{f.n, f.offset, f.plane, false, {}};
  };
  const std::vector<Index> around = surface_.faces_around(x);
  // exactly, or a pair of particles would not look alike from both
  const bool edges =
      std::any_of(around.begin(), around.end(), [&](Index f) { return open_[f] != std::array<Sides, 4>{}; });
  if (view.flat >= 0 && !edges) {
    out.push_back(sheet_of(view.flat));
    out.back().endless = true;
    return out;
  }
  for (const Index f : around) {
    auto known = std::find_if(out.begin(), out.end(), [&](const Sheet& s) { return goes_on_in(s, f); });
    if (known == out.end()) known = out.insert(out.end(), sheet_of(f));
    known->faces.push_back(f);
  }
  return out;
}

/// How much of a way in direction `way` through q the sheet takes: at an edge that is free on one of `sides`
/// it goes over from all to nothing within the width, as the way passes before the edge or behind it. So the
/// faces on both sides of a corner, and the way past it, share all ways alike.
Real WallPaths::cover(const Sheet& sheet, const Vec& q, const Vec& way, Sides sides) const {
  if (sheet.endless) return 1;
  bool inside = false;
  Real to_edge = 0.5 * width_;
  for (const Index face : sheet.faces) {
    const auto& f = surface_.face(face);
    if (!surface_.is_at_face(face, q)) continue;
    bool in = true;
    for (int e = 0; e < f.corners; ++e) {
      in &= f.inward[e].dot(q - f.x[e]) > -overlap * surface_.reach();
      if (open_[face][e] & sides)
        to_edge = std::min(to_edge, distance_to_edge(q, way, f.x[e], f.x[(e + 1) % f.corners], width_));
    }
    inside |= in;
  }
  return 0.5 + (inside ? to_edge : -to_edge) / width_;
}

bool WallPaths::is_clear(const Sheets& sheets, const Vec& a, const Vec& b, Index but_plane,
                         Index and_plane) const {
  for (const Sheet& s : sheets) {
    if (s.plane == but_plane || s.plane == and_plane || s.endless) continue;
    const Real from = s.height(a), to = s.height(b);
    if (from * to < 0 && cover(s, a + (b - a) * (from / (from - to)), Vec::Zero(), 0) > 0.5) return false;
  }
  return true;
}

void WallPaths::add(const Sheets& sheets, Index i, const Vec& at_i, Index j, const Vec& at_j, Real reach,
                    std::vector<WallPath>& to) const {
  const Vec x = surface_.in_plane(at_i) + aside(surface_.reach(), dim_),
            y = surface_.in_plane(at_j) + aside(surface_.reach(), dim_);
  if ((y - x).squaredNorm() >= reach * reach) return;  // images are farther
  if (i != j) add_straight(sheets, i, x, j, y, to);
  std::vector<const Sheet*> by;
  add_thrown_back(sheets, by, i, x, j, y, reach, to);
}

void WallPaths::add_straight(const Sheets& sheets, Index i, const Vec& x, Index j, const Vec& y,
                             std::vector<WallPath>& to) const {
  Real hidden = 0;
  for (const Sheet& s : sheets) {
    const Real from = s.height(x), behind = s.height(y);
    if (from * behind < 0)
      hidden = std::max(hidden, cover(s, x + (y - x) * (from / (from - behind)), (y - x).normalized(), 3));
  }
  if (hidden > 0) to.push_back({.i = i, .j = j, .weight = -hidden, .d = x - y});
}

/// Ways by the walls `by` and then one more, or several: as many as there are directions, or two more in the
/// plane, where corners may be sharp.
void WallPaths::add_thrown_back(const Sheets& sheets, std::vector<const Sheet*>& by, Index i, const Vec& x,
                                Index j, const Vec& y, Real reach, std::vector<WallPath>& to) const {
  const std::size_t most = dim_ == 2 ? 4 : 3;
  for (const Sheet& s : sheets) {
    if (!by.empty() && by.back() == &s) continue;
    by.push_back(&s);
    Vec image = y;
    for (auto sheet = by.rbegin(); sheet != by.rend(); ++sheet) image = (*sheet)->image(image);
    if ((image - x).squaredNorm() < reach * reach) {
      if (const Real share = share_of_way(sheets, by, x, y, image); share > 0) {
        WallPath path{.i = i, .j = j, .weight = share, .d = x - image, .shift = image - y};
        for (const Sheet* sheet : by)
          path.turn = path.turn * (Matrix::Identity() - 2 * sheet->n * sheet->n.transpose());
        to.push_back(path);
      }
    }
    if (by.size() < most && sheets.size() > 1 && std::abs(s.height(x)) < reach)
      add_thrown_back(sheets, by, i, x, j, y, reach, to);
    by.pop_back();
  }
}

/// Follows the way from x towards the image of y behind the walls `by`, each of which turns it back.
Real WallPaths::share_of_way(const Sheets& sheets, const std::vector<const Sheet*>& by, const Vec& x,
                             const Vec& y, Vec target) const {
  Vec at = x;
  Real share = 1;
  Index last = -1;
  for (const Sheet* s : by) {
    const Real from = s->height(at), behind = s->height(target);
    if (!(from * behind < 0)) return 0;
    const Vec q = at + (target - at) * (from / (from - behind));
    share *= cover(*s, q, (target - at).normalized(), from > 0 ? 1 : 2);
    if (!(share > 0) || !is_clear(sheets, at, q, last, s->plane)) return 0;
    target = s->image(target);
    at = q, last = s->plane;
  }
  return is_clear(sheets, at, y, last, -1) ? share : 0;
}

}  // namespace courant
