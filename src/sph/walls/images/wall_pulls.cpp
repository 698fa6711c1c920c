// What the ways beside walls that move do to these walls.
#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel/parallel.hpp"
#include "sph/walls/images/wall_paths.hpp"

namespace courant {

void WallPaths::take_along(const World& world, Real back) {
  if (!any_moves_) return;
  if (moved_.empty()) {
    for (Index f = 0; f < surface_.faces(); ++f) moved_.push_back(surface_.face(f));
    motions_.resize(moved_.size());
    if (!moved_.empty()) faces_ = moved_.data();
  }
  surface_.take_along(moved_, motions_, world, back);
  boxes_.resize(moved_.size());
  for_each(surface_.faces(), [&](Index f) {
    Vec low = surface_.in_plane(moved_[f].x[0]), high = low;
    for (int e = 1; e < moved_[f].corners; ++e) {
      const Vec x = surface_.in_plane(moved_[f].x[e]);
      low = low.cwiseMin(x), high = high.cwiseMax(x);
    }
    boxes_[f] = {low, high};
    for (int e = 0; e < moved_[f].corners; ++e) {
      Edge& edge = edges_[f][e];
      if (!edge.ends) continue;
      for (Corner& corner : edge.corners)
        if (moved_[f].body >= 0 || moved_[corner.other].body >= 0) find_corner(f, e, corner);
      const Vec &a = moved_[f].x[e], &b = moved_[f].x[(e + 1) % moved_[f].corners];
      if (moved_[f].body >= 0) edge.middle = 0.5 * (a + b);
    }
  });
}

void WallPaths::find_corner(Index face, int edge, Corner& corner) const {
  const auto &f = this->face(face), &g = this->face(corner.other);
  const Vec across = g.n.cross(f.x[(edge + 1) % f.corners] - f.x[edge]).normalized();
  corner.n = g.n, corner.here = g.n.dot(f.inward[edge]), corner.there = corner.way * f.n.dot(across);
}

void WallPaths::place(Sheets& sheets) const {
  for (Sheet& sheet : sheets) {
    if (sheet.body < 0) continue;
    sheet.n = face(sheet.face).n, sheet.offset = face(sheet.face).offset;
    for (Brink& edge : sheet.edges) edge = now(edge);
    if (sheet.faces.empty()) continue;
    sheet.low = Vec::Constant(std::numeric_limits<Real>::infinity()), sheet.high = -sheet.low;
    for (const Index f : sheet.faces)
      sheet.low = sheet.low.cwiseMin(boxes_[f].first), sheet.high = sheet.high.cwiseMax(boxes_[f].second);
  }
}

/// Where a wall throws back what is at x and moves with `velocity`, which goes over to that of the image.
Vec WallPaths::image(const Sheet& sheet, const Vec& x, Vec& velocity) const {
  const Vec out = sheet.image(x);
  velocity = velocity_of(sheet, out) + sheet.turn() * (velocity - velocity_of(sheet, x));
  return out;
}

void WallPaths::bring(const Sheets& sheets, const Vec& at_i, const Vec& at_j, WallPath& path) const {
  Vec at = put_aside(at_j);
  path.turn = Matrix::Identity();
  for (std::size_t k = path.by.size(); k-- > 0;) {
    if (path.by[k] < 0) continue;
    const Sheet& sheet = sheets[static_cast<std::size_t>(path.by[k])];
    at = sheet.image(at), path.turn = sheet.turn() * path.turn;
  }
  path.d = put_aside(at_i) - at;
}

Index WallPaths::face_at(const Sheet& sheet, const Vec& q) const {
  Index best = sheet.face;
  Real most = -std::numeric_limits<Real>::infinity();
  for (const Index k : sheet.faces) {
    const auto& f = face(k);
    Real inside = std::numeric_limits<Real>::infinity();
    for (int e = 0; e < f.corners; ++e) inside = std::min(inside, f.inward[e].dot(q - f.x[e]));
    if (inside > most) most = inside, best = k;
    if (most >= 0) break;
  }
  return best;
}

/// What changes by `by_image` times the path of the image of `at` changes with the wall by that, and by what
/// is thrown back of it at `at` itself. Both together are a force along the normal, where the way goes
/// through the wall.
void WallPaths::pull(const Sheet& sheet, const Vec& at, const Vec& by_image,
                     std::vector<WallPull>& to) const {
  if (sheet.body < 0) return;
  const Vec& n = sheet.n;
  const Real along = by_image.dot(n), height = sheet.height(at), force = 2 * along;
  Vec q = at - height * n, lever = 2 * height * (by_image - along * n);
  if (lever.norm() < surface_.reach() * std::abs(force)) q += lever / force, lever.setZero();
  WallPull out{.face = face_at(sheet, q), .at = q, .force = force * n, .lever = lever};
  if (face(out.face).n.dot(n) < 0) out.lever = -lever;
  to.push_back(out);
}

void WallPaths::pull_edge(const Meeting& m, Real times, std::vector<WallPull>& to) const {
  if (!m.edge_of || m.edge_of->body < 0) return;
  to.push_back(
      {.face = face_at(*m.edge_of, m.on_edge), .at = m.on_edge, .force = times * (m.by_start + m.by_end)});
}

/// `by` belongs to where the way starts before wall k, behind the ones before it.
void WallPaths::pull_start(const Way& way, int k, Vec by, std::vector<WallPull>& to) const {
  while (k-- > 0) {
    pull(*way.by[k], way.start[k], by, to);
    by = way.by[k]->turn() * by;
  }
}

/// `by` belongs to the image that the way aims at before wall k, behind that one and those to come.
void WallPaths::pull_target(const Way& way, int k, Vec by, std::vector<WallPull>& to) const {
  for (; k < way.steps; ++k) {
    pull(*way.by[k], k + 1 < way.steps ? way.target[k + 1] : way.end, by, to);
    by = way.by[k]->turn() * by;
  }
}

/// `by` belongs to where wall k is hit; -1 and the number of walls are the ends of the path.
void WallPaths::pull_hit(const Way& way, int k, const Vec& by, std::vector<WallPull>& to) const {
  if (k < 0 || k == way.steps || by.isZero()) return;
  const Sheet& s = *way.by[k];
  const Meeting& m = way.met[k];
  if (!m.crosses) {
    if (m.edge_of && m.edge_of->body >= 0)
      to.push_back({.face = face_at(*m.edge_of, m.on_edge), .at = m.on_edge, .force = by});
    return;
  }
  const Vec along = way.target[k] - way.start[k], with_wall = along.dot(by) / s.n.dot(along) * s.n;
  if (s.body >= 0) to.push_back({.face = face_at(s, m.at), .at = m.at, .force = with_wall});
  const Real part = s.height(way.start[k]) / (s.height(way.start[k]) - s.height(way.target[k]));
  pull_start(way, k, (1 - part) * (by - with_wall), to);
  pull_target(way, k, part * (by - with_wall), to);
}

/// The share is a product of what walls take and of what none of the others hides.
void WallPaths::pull_all(const Way& way, Real share, std::vector<WallPull>& to) const {
  for (int k = 0; k <= way.steps; ++k) {
    if (const Meeting& h = way.hidden[k]; h.edge_of && h.share > 0) {
      const Real others = share / (1 - h.share);
      pull_hit(way, k - 1, -others * h.by_start, to);
      pull_hit(way, k, -others * h.by_end, to);
      pull_edge(h, others, to);
    }
    if (k == way.steps) break;
    if (const Meeting& m = way.met[k]; m.edge_of) {
      const Real others = share / m.share;
      pull_start(way, k, others * m.by_start, to);
      pull_target(way, k, others * m.by_end, to);
      pull_edge(m, -others, to);
    }
  }
}

void WallPaths::pull_images(const Sheets& sheets, const WallPath& path, const Vec& y, const Vec& by_d,
                            std::vector<WallPull>& to) const {
  Way way;
  way.end = put_aside(y);
  while (way.steps < 4 && path.by[static_cast<std::size_t>(way.steps)] >= 0) {
    way.by[way.steps] = &sheets[static_cast<std::size_t>(path.by[way.steps])];
    ++way.steps;
  }
  Vec at = way.end;
  for (int k = way.steps; k-- > 0;) way.target[k] = at = way.by[k]->image(at);
  pull_target(way, 0, -by_d, to);
}

}  // namespace courant
