// Reactions of paths on moving walls.
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
  corner.n = g.n, corner.here = g.n.dot(f.inward[edge]), corner.there = corner.sign * f.n.dot(across);
}

void WallPaths::update(Sheets& sheets) const {
  for (Sheet& sheet : sheets) {
    if (sheet.body < 0) continue;
    sheet.n = face(sheet.face).n, sheet.offset = face(sheet.face).offset;
    for (Border& edge : sheet.edges) edge = now(edge);
    if (sheet.faces.empty()) continue;
    sheet.low = Vec::Constant(std::numeric_limits<Real>::infinity()), sheet.high = -sheet.low;
    for (const Index f : sheet.faces)
      sheet.low = sheet.low.cwiseMin(boxes_[f].first), sheet.high = sheet.high.cwiseMax(boxes_[f].second);
  }
}

/// Mirror image of a point at x with `velocity`; `velocity` becomes that of the image.
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

/// Derivative with respect to the wall of a quantity with the gradient `by_image` at the image of `at`:
/// the sum of the contributions at the image and at `at`, a normal force where the path meets the wall.
void WallPaths::add_derivative(const Sheet& sheet, const Vec& at, const Vec& by_image,
                               std::vector<WallDerivative>& to) const {
  if (sheet.body < 0) return;
  const Vec& n = sheet.n;
  const Real along = by_image.dot(n), height = sheet.height(at), force = 2 * along;
  Vec q = at - height * n, lever = 2 * height * (by_image - along * n);
  if (lever.norm() < surface_.reach() * std::abs(force)) q += lever / force, lever.setZero();
  WallDerivative out{.face = face_at(sheet, q), .at = q, .force = force * n, .lever = lever};
  if (face(out.face).n.dot(n) < 0) out.lever = -lever;
  to.push_back(out);
}

void WallPaths::add_edge_derivative(const Meeting& m, Real times, std::vector<WallDerivative>& to) const {
  if (!m.edge_of || m.edge_of->body < 0) return;
  to.push_back(
      {.face = face_at(*m.edge_of, m.on_edge), .at = m.on_edge, .force = times * (m.by_start + m.by_end)});
}

/// `by`: gradient at the start of the path before wall k, mirrored by the walls before it.
void WallPaths::add_start_derivative(const Ray& ray, int k, Vec by, std::vector<WallDerivative>& to) const {
  while (k-- > 0) {
    add_derivative(*ray.by[k], ray.start[k], by, to);
    by = ray.by[k]->turn() * by;
  }
}

/// `by`: gradient at the target image before wall k, mirrored by this wall and the following ones.
void WallPaths::add_target_derivative(const Ray& ray, int k, Vec by, std::vector<WallDerivative>& to) const {
  for (; k < ray.steps; ++k) {
    add_derivative(*ray.by[k], k + 1 < ray.steps ? ray.target[k + 1] : ray.end, by, to);
    by = ray.by[k]->turn() * by;
  }
}

/// `by`: gradient at the point where the path meets wall k; -1 and the number of walls are the ends of the
/// path.
void WallPaths::add_hit_derivative(const Ray& ray, int k, const Vec& by,
                                   std::vector<WallDerivative>& to) const {
  if (k < 0 || k == ray.steps || by.isZero()) return;
  const Sheet& s = *ray.by[k];
  const Meeting& m = ray.met[k];
  if (!m.crosses) {
    if (m.edge_of && m.edge_of->body >= 0)
      to.push_back({.face = face_at(*m.edge_of, m.on_edge), .at = m.on_edge, .force = by});
    return;
  }
  const Vec along = ray.target[k] - ray.start[k], with_wall = along.dot(by) / s.n.dot(along) * s.n;
  if (s.body >= 0) to.push_back({.face = face_at(s, m.at), .at = m.at, .force = with_wall});
  const Real part = s.height(ray.start[k]) / (s.height(ray.start[k]) - s.height(ray.target[k]));
  add_start_derivative(ray, k, (1 - part) * (by - with_wall), to);
  add_target_derivative(ray, k, part * (by - with_wall), to);
}

/// The share is the product of the reflected shares and of the visible shares between walls.
void WallPaths::add_derivatives(const Ray& ray, Real share, std::vector<WallDerivative>& to) const {
  for (int k = 0; k <= ray.steps; ++k) {
    if (const Meeting& h = ray.hidden[k]; h.edge_of && h.share > 0) {
      const Real others = share / (1 - h.share);
      add_hit_derivative(ray, k - 1, -others * h.by_start, to);
      add_hit_derivative(ray, k, -others * h.by_end, to);
      add_edge_derivative(h, others, to);
    }
    if (k == ray.steps) break;
    if (const Meeting& m = ray.met[k]; m.edge_of) {
      const Real others = share / m.share;
      add_start_derivative(ray, k, others * m.by_start, to);
      add_target_derivative(ray, k, others * m.by_end, to);
      add_edge_derivative(m, -others, to);
    }
  }
}

void WallPaths::add_image_derivatives(const Sheets& sheets, const WallPath& path, const Vec& y,
                                      const Vec& by_d, std::vector<WallDerivative>& to) const {
  Ray ray;
  ray.end = put_aside(y);
  while (ray.steps < 4 && path.by[static_cast<std::size_t>(ray.steps)] >= 0) {
    ray.by[ray.steps] = &sheets[static_cast<std::size_t>(path.by[ray.steps])];
    ++ray.steps;
  }
  Vec at = ray.end;
  for (int k = ray.steps; k-- > 0;) ray.target[k] = at = ray.by[k]->image(at);
  add_target_derivative(ray, 0, -by_d, to);
}

}  // namespace courant
