// Regions whose walls are those of a box corner.
#include <algorithm>
#include <cmath>
#include <utility>

#include "parallel/parallel.hpp"
#include "sph/kernel/kernel.hpp"
#include "sph/walls/images/wall_visibility.hpp"

namespace courant {

namespace {

/// Adds an end of a wall, a line through `at`; false if there is no space for it.
bool add_end(WallSubDomain& domain, int wall, const Vec& out, const Vec& at) {
  const Real limit = out.dot(at);
  for (int e = 0; e < domain.ends; ++e) {
    const WallSubDomain::End& known = domain.end[e];
    if ((Vec(known.m[0], known.m[1], known.m[2]) - out).norm() < 1e-6 &&
        std::abs(known.limit - limit) < 1e-6 * (std::abs(limit) + at.norm()))
      return true;
  }
  if (domain.ends == WallSubDomain::most_ends) return false;
  WallSubDomain::End& end = domain.end[domain.ends++];
  for (int c = 0; c < 3; ++c) end.m[c] = out[c], end.n[c] = domain.n[wall][c];
  end.limit = limit, end.offset = domain.offset[wall];
  return true;
}

}  // namespace

Real WallPaths::distance_to(const Vec& x, const Vec& a, const Vec& b) {
  const Vec along = b - a;
  const Real s =
      std::clamp((x - a).dot(along) / std::max(along.squaredNorm(), Real(1e-300)), Real(0), Real(1));
  return (x - a - s * along).norm();
}

/// Walls of a sub-domain, each with the side that faces it.
struct WallPaths::Walls {
  std::vector<const Sheet*> walls;
  std::vector<Real> side;
  std::vector<const Sheet*> far;  ///< out of range, with ends in range
  Real height(std::size_t k, const Vec& x) const { return side[k] * walls[k]->height(x); }
  void leave_out(std::size_t k) {
    walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(k));
    side.erase(side.begin() + static_cast<std::ptrdiff_t>(k));
  }
};

/// Removes walls that are entirely behind another wall.
void WallPaths::leave_out_hidden(Walls& box) const {
  const Real most = 1e-3 * surface_.reach();
  const auto is_behind = [&](std::size_t t, std::size_t k) {
    return std::all_of(box.walls[t]->faces.begin(), box.walls[t]->faces.end(), [&](Index f) {
      const auto& x = face(f).x;
      return std::all_of(x.begin(), x.begin() + face(f).corners,
                         [&](const Vec& c) { return box.height(k, surface_.in_plane(c)) <= most; });
    });
  };
  for (std::size_t t = box.walls.size(); t-- > 0;)
    for (std::size_t k = 0; k < box.walls.size(); ++k)
      if (k != t && is_behind(t, k)) {
        box.leave_out(t);
        break;
      }
}

/// Whether the walls are orthogonal and cover the box near the centre.
bool WallPaths::is_orthogonal(const Walls& box, const Vec& centre, Real inside) const {
  const std::size_t n = box.walls.size();
  if (n == 0 || n > static_cast<std::size_t>(dim_)) return false;
  for (std::size_t k = 0; k < n; ++k) {
    Vec q = centre - box.walls[k]->height(centre) * box.walls[k]->n;
    for (std::size_t l = 0; l < n; ++l) {
      if (l == k) continue;
      if (std::abs(box.walls[k]->n.dot(box.walls[l]->n)) > orthogonal) return false;
      const Real deep = box.height(l, q);
      if (deep < inside) q += (inside - deep) * box.side[l] * box.walls[l]->n;
    }
    if (!is_inside(*box.walls[k], q)) return false;
  }
  return true;
}

/// Whether a part of the sheet is on the same side of another one as x.
bool WallPaths::rises_from(const Sheet& sheet, const Sheet& other, const Vec& x) const {
  const Real side = other.height(x) > 0 ? 1 : -1, most = 1e-3 * surface_.reach();
  return std::any_of(sheet.faces.begin(), sheet.faces.end(), [&](Index f) {
    return std::any_of(face(f).x.begin(), face(f).x.begin() + face(f).corners,
                       [&](const Vec& c) { return side * other.height(surface_.in_plane(c)) > most; });
  });
}

/// Finds edges within `around` of `centre`; up to them, each wall covers its side entirely.
void WallPaths::find_ends(const Walls& box, const Sheets& sheets, const Vec& centre, Real around,
                          OpenSubDomain& domain) const {
  const Real most = 1e-3 * surface_.reach();
  for (const Sheet& sheet : sheets)
    for (const Border& edge : sheet.edges) {
      const Vec a = surface_.in_plane(edge.from), b = surface_.in_plane(edge.to);
      if (distance_to(centre, a, b) > around) continue;
      bool hidden = false;
      for (std::size_t k = 0; k < box.walls.size(); ++k)
        hidden |= box.walls[k] != &sheet && std::max(box.height(k, a), box.height(k, b)) <= most;
      hidden |= std::any_of(box.far.begin(), box.far.end(), [&](const Sheet* far) {
        const Real side = far->height(centre) > 0 ? 1 : -1;
        return far != &sheet && std::max(side * far->height(a), side * far->height(b)) <= most &&
               rises_from(*far, sheet, centre);
      });
      if (hidden) continue;
      domain.ends.push_back({a, b});
      const auto wall = std::find(box.walls.begin(), box.walls.end(), &sheet);
      domain.known &=
          wall != box.walls.end() && add_end(domain.open, static_cast<int>(wall - box.walls.begin()),
                                             -face(edge.face).inward[edge.edge], a);
    }
}

std::vector<OpenSubDomain> WallPaths::sub_domains_about(const Sheets& sheets, const Vec& at, Real half,
                                                        Real reach) const {
  const Vec centre = surface_.in_plane(at);
  std::vector<OpenSubDomain> domains;
  Walls near;
  for (const Sheet& s : sheets) {
    if (s.body >= 0) return domains;
    if (s.off(centre) < reach + half)
      near.walls.push_back(&s);
    else if (std::abs(s.height(centre)) >= reach + half)
      near.far.push_back(&s);
  }
  std::vector<std::size_t> either;  // walls with positions around the centre on both sides
  for (std::size_t k = 0; k < near.walls.size(); ++k) {
    const Real height = near.walls[k]->height(centre);
    near.side.push_back(height > 0 ? 1 : -1);
    if (std::abs(height) <= half) either.push_back(k);
  }
  if (either.size() > 3) return domains;
  for (unsigned turned = 0; turned < 1U << either.size(); ++turned) {
    Walls box = near;
    for (std::size_t k = 0; k < either.size(); ++k)
      if (turned >> k & 1U) box.side[either[k]] *= -1;
    leave_out_hidden(box);
    if (!is_orthogonal(box, centre, 1e-3 * reach)) continue;
    OpenSubDomain domain;
    WallSubDomain& walls = domain.open;
    for (std::size_t k = 0; k < box.walls.size(); ++k) {
      const Vec n = box.side[k] * box.walls[k]->n;
      for (int c = 0; c < 3; ++c) walls.n[k][c] = n[c];
      walls.offset[k] = box.side[k] * box.walls[k]->offset, walls.face[k] = box.walls[k]->faces.front();
    }
    walls.walls = static_cast<int>(box.walls.size());
    domain.closed = walls;
    find_ends(box, sheets, centre, reach + half + 0.5 * width_, domain);
    domains.push_back(domain);
  }
  return domains;
}

std::unique_ptr<WallSubDomain> WallPaths::closed_sub_domain_about(const Sheets& sheets, const Vec& x,
                                                                  Real sight) const {
  std::unique_ptr<WallSubDomain> out;
  for (const OpenSubDomain& domain : sub_domains_about(sheets, x, 0, sight))
    if (domain.ends.empty()) out = std::make_unique<WallSubDomain>(domain.closed);
  return out;
}

std::unique_ptr<WallSubDomain> WallPaths::open_sub_domain_about(const Sheets& sheets, const Vec& x,
                                                                Real sight) const {
  std::unique_ptr<WallSubDomain> out;
  for (const OpenSubDomain& domain : sub_domains_about(sheets, x, 0, sight))
    if (domain.holds_open(x, 0.5 * width_)) out = std::make_unique<WallSubDomain>(domain.open);
  return out;
}

WallVisibility::WallVisibility(const WallSurface& surface, Real width, Real cell, Real reach, Alike alike)
    : surface_(surface),
      paths_(surface, surface.dim(), width),
      reach_(reach),
      width_(width),
      cells_(cell),
      alike_(std::move(alike)) {}

/// Greatest distance of a position in a cell from its middle. [L]
Real WallVisibility::half_of(Real cell, int dim) {
  return 0.5 * std::sqrt(Real(dim)) * cell;
}

void WallVisibility::look_from(const Particles& p) {
  seen_.resize(static_cast<std::size_t>(p.active));
  std::vector<std::pair<Vec, CellVisibility*>> unknown;
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Vec x = surface_.in_plane(p.x.vec(static_cast<Index>(i)));
    const std::uint64_t cell = cells_.of(x);
    if (i > 0 && cell == last) {
      seen_[i] = seen_[i - 1];
      continue;
    }
    last = cell;
    const auto [place, is_new] = visibility_.try_emplace(cell);
    if (is_new) {
      unknown.push_back({surface_.in_plane(cells_.middle(x)), &place->second});
    }
    seen_[i] = &place->second;
  }
  for_each(static_cast<Index>(unknown.size()), [&](Index k) {
    const auto& [middle, to] = unknown[static_cast<std::size_t>(k)];
    *to = visibility_from(middle);
  });
}

const WallSubDomain* WallVisibility::sub_domain(Index i, const Vec& at, Real sight,
                                                std::unique_ptr<WallSubDomain>& own) const {
  const Vec x = surface_.in_plane(at);
  own.reset();
  if (of(i).nothing) return nullptr;
  if (const WallSubDomain* domain = of(i).sub_domain_of(x, sight + 0.5 * width_)) return domain;
  if (!of(i).alike) return nullptr;
  own = paths_.closed_sub_domain_about(of(i).sheets, x, sight);
  return own.get();
}

const WallSubDomain* WallVisibility::open_sub_domain(Index i, const Vec& at, Real sight,
                                                     std::unique_ptr<WallSubDomain>& own) const {
  if (const WallSubDomain* closed = sub_domain(i, at, sight, own)) return closed;
  if (of(i).nothing || !of(i).alike) return nullptr;
  const Vec x = surface_.in_plane(at);
  for (const OpenSubDomain& domain : of(i).domains)
    if (domain.holds_open(x, 0.5 * width_)) return &domain.open;
  own = paths_.open_sub_domain_about(of(i).sheets, x, sight);
  return own.get();
}

CellVisibility WallVisibility::visibility_from(const Vec& middle) const {
  const Real half = half_of(cells_.size(), surface_.dim());
  CellVisibility out;
  out.sheets = paths_.sheets_around(middle, reach_ + half + 0.5 * width_);
  out.nothing = std::all_of(out.sheets.begin(), out.sheets.end(), [&](const WallPaths::Sheet& s) {
    return s.edges.empty() && std::abs(s.height(middle)) >= reach_ + half;
  });
  const auto alike = [&](const WallPaths::Sheet& s) {
    return std::all_of(s.faces.begin(), s.faces.end(), [&](Index f) { return alike_(s.faces[0], f); });
  };
  out.alike = std::all_of(out.sheets.begin(), out.sheets.end(), alike);
  if (!out.nothing && out.alike) out.domains = paths_.sub_domains_about(out.sheets, middle, half, reach_);
  const bool closed =
      !out.domains.empty() && std::all_of(out.domains.begin(), out.domains.end(),
                                          [](const OpenSubDomain& r) { return r.ends.empty(); });
  if (!out.nothing && !closed) out.points = surface_.points_around(middle, surface_.reach() + 2 * half);
  return out;
}

bool OpenSubDomain::holds(const Vec& x, Real sight) const {
  for (int k = 0; k < closed.walls; ++k)
    if (!(Vec(closed.n[k][0], closed.n[k][1], closed.n[k][2]).dot(x) > closed.offset[k])) return false;
  return std::none_of(ends.begin(), ends.end(), [&](const auto& edge) {
    return WallPaths::distance_to(x, edge.first, edge.second) <= sight;
  });
}

bool OpenSubDomain::holds_open(const Vec& x, Real within) const {
  const auto at = [&](const Real(&n)[3]) { return n[0] * x[0] + n[1] * x[1] + n[2] * x[2]; };
  for (int k = 0; k < open.walls; ++k)
    if (!(at(open.n[k]) > open.offset[k])) return false;
  for (int e = 0; e < open.ends; ++e)
    if (!(at(open.end[e].m) < open.end[e].limit - within)) return false;
  return known;
}

const WallSubDomain* CellVisibility::sub_domain_of(const Vec& x, Real sight) const {
  for (const OpenSubDomain& open : domains)
    if (open.holds(x, sight)) return &open.closed;
  return nullptr;
}

}  // namespace courant
