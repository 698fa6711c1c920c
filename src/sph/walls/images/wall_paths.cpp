#include "sph/walls/images/wall_paths.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"
#include "sph/kernel/kernel.hpp"

namespace courant {

namespace {

constexpr Real level = 1 - 1e-6;  ///< cosine of the angle between normals of faces in one plane
constexpr Real bent = 0.87;       ///< cosine of the angle up to which one face continues in the next

/// Visibility tests use slightly offset positions, so that no path passes exactly through an edge or
/// between particles and faces of one lattice. A particle and its own images use a further offset at the
/// far end: in a corner that path always passes through the edge. [L]
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
      motions_(other.motions_),
      boxes_(other.boxes_) {
  if (!moved_.empty()) faces_ = moved_.data();
}

/// An edge is none if another face continues from its middle in the plane or slightly bent.
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
    // directions from the edge in which the other face extends
    Vec across = g.n.cross(b - a);
    if (!(across.norm() > 0)) continue;
    across.normalize();
    for (const Real sign : {-1.0, 1.0}) {
      const Vec t = sign * across, p = m + 10 * near * t;
      bool goes_on = true;
      for (int e = 0; e < g.corners; ++e) goes_on &= g.inward[e].dot(p - g.x[e]) > -near;
      if (!goes_on) continue;
      if (t.dot(outward) > bent) return {};
      if (std::abs(f.n.dot(t)) > touching)
        out.corners.push_back({g.n, -g.n.dot(outward), f.n.dot(t), other, sign});
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

/// Whether a face lies in the plane of a sheet, within the rounding of decks.
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
  // exact, so that both particles of a pair give the same result
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

/// Collinear edges with the same adjacent faces become one border.
void WallPaths::add_edge(Sheet& sheet, Index face, int edge) const {
  const auto& f = this->face(face);
  Border out{.face = face, .edge = edge, .last_face = face, .last_edge = edge};
  out.from = f.x[edge], out.to = f.x[(edge + 1) % f.corners];
  const Real near = 1e-6 * surface_.reach();
  const auto alike = [&](const Corner& a, const Corner& b) {
    return (a.n - b.n).norm() < 1e-9 && std::abs(a.here - b.here) < 1e-9 &&
           std::abs(a.there - b.there) < 1e-9;
  };
  const auto goes_on = [&](const Border& known) {
    const auto &these = edges_[known.face][known.edge].corners, &others = edges_[face][edge].corners;
    const Vec along = known.to - known.from;
    if (sheet.body >= 0 && this->face(known.face).side != f.side)
      return false;  // its image moves differently
    return (this->face(known.face).inward[known.edge] - f.inward[edge]).norm() < 1e-9 &&
           along.cross(out.to - known.from).norm() < near * along.norm() && these.size() == others.size() &&
           std::equal(these.begin(), these.end(), others.begin(), alike);
  };
  for (bool more = true; more;) {
    more = false;
    for (std::size_t k = 0; k < sheet.edges.size(); ++k) {
      const Border& known = sheet.edges[k];
      if (!goes_on(known)) continue;
      if ((known.to - out.from).norm() < near)
        out.from = known.from, out.face = known.face, out.edge = known.edge;
      else if ((known.from - out.to).norm() < near)
        out.to = known.to, out.last_face = known.last_face, out.last_edge = known.last_edge;
      else
        continue;
      sheet.edges.erase(sheet.edges.begin() + static_cast<std::ptrdiff_t>(k));
      more = true;
      break;
    }
  }
  sheet.edges.push_back(out);
}

/// Current position of a border of a moving wall.
WallPaths::Border WallPaths::now(const Border& edge) const {
  const auto &first = face(edge.face), &last = face(edge.last_face);
  Border out = edge;
  out.from = first.x[edge.edge], out.to = last.x[(edge.last_edge + 1) % last.corners];
  return out;
}

/// Finds successions of sheets that no path can have while they move as one body.
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
  const Vec past = Vec::Constant(overlap * surface_.reach());
  if (!sheet.is_within({q - past, q + past})) return false;
  return sheet.endless || std::any_of(sheet.faces.begin(), sheet.faces.end(), [&](Index face) {
           const auto& f = this->face(face);
           for (int e = 0; e < f.corners; ++e)
             if (!(f.inward[e].dot(q - f.x[e]) > -overlap * surface_.reach())) return false;
           return surface_.is_at_face(face, q);
         });
}

}  // namespace courant
