#include "sph/walls/wall_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "parallel/parallel.hpp"
#include "sph/kernel/kernel.hpp"

namespace courant {

namespace {

constexpr Real small = 1e-9;  ///< of the reach: lengths below are zero

}  // namespace

bool segment_moves(const World& world, Index segment) {
  const auto nodes = world.segments.nodes(segment);
  return std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return !world.nodes.held[n]; });
}

OccupiedCells::OccupiedCells(const Particles& p, Real reach, const std::vector<GhostPlane>& planes)
    : reach_(1.1 * reach) {  // particles may be slightly behind a mirror
  for (const GhostPlane& plane : planes) {
    // the image in a mirror is never nearer than the face itself
    if (plane.kind != GhostPlane::Kind::periodic) continue;
    const std::size_t known = shifts_.size();
    for (const Real shift : {-plane.period, plane.period})
      for (std::size_t k = 0; k < known; ++k) shifts_.push_back(shifts_[k] + shift * plane.normal);
  }
  Vec high;
  for (int k = 0; k < 3; ++k) {
    const Real* x = p.x.data(k);
    high[k] = maximum(p.active, [x](Index i) { return x[i]; });
    low_[k] = -maximum(p.active, [x](Index i) { return -x[i]; });
  }
  if (!(p.active > 0 && low_.allFinite() && high.allFinite())) return;
  const Real most = std::max<Real>(4096, p.active);
  cell_ = reach_;
  const auto count = [&] {
    Real all = 1;
    for (int k = 0; k < 3; ++k) all *= 1 + std::floor((high[k] - low_[k]) / cell_);
    return all;
  };
  while (count() > most) cell_ *= 1.25;
  for (int k = 0; k < 3; ++k) cells_[k] = 1 + static_cast<Index>((high[k] - low_[k]) / cell_);
  taken_.assign(std::size_t(cells_[0]) * cells_[1] * cells_[2], 0);
  for (Index i = 0; i < p.active; ++i) {
    std::size_t c = 0;
    for (int k = 0; k < 3; ++k)
      c = c * cells_[k] + static_cast<std::size_t>((p.x.data(k)[i] - low_[k]) / cell_);
    taken_[c] = 1;
  }
}

bool OccupiedCells::any_near(const Vec& low, const Vec& high) const {
  if (taken_.empty() || !low.allFinite() || !high.allFinite()) return true;
  for (const Vec& shift : shifts_)
    if (any_in(low + shift, high + shift)) return true;
  return false;
}

bool OccupiedCells::any_in(const Vec& low, const Vec& high) const {
  std::array<Index, 3> first{}, last{};
  for (int k = 0; k < 3; ++k) {
    const Real from = (low[k] - reach_ - low_[k]) / cell_, to = (high[k] + reach_ - low_[k]) / cell_;
    if (to < 0 || from >= Real(cells_[k])) return false;
    first[k] = static_cast<Index>(std::max(from, Real(0)));
    last[k] = static_cast<Index>(std::min(to, Real(cells_[k] - 1)));
  }
  for (Index i = first[0]; i <= last[0]; ++i)
    for (Index j = first[1]; j <= last[1]; ++j)
      for (Index k = first[2]; k <= last[2]; ++k)
        if (taken_[(std::size_t(i) * cells_[1] + j) * cells_[2] + k]) return true;
  return false;
}

WallSurface::WallSurface(const World& world, const std::vector<Index>& segments, Real spacing, Real reach,
                         std::vector<GhostPlane> planes, const OccupiedCells* from, const WallBelts* belts,
                         Real beyond)
    : dim_(world.dim),
      reach_(reach),
      farthest_(reach + beyond),
      spacing_(spacing),
      mirrors_and_periods_(std::move(planes)) {
  std::vector<char> seen(segments.size(), 1);
  if (from)
    for_each(static_cast<Index>(segments.size()), [&](Index k) {
      const auto nodes = world.segments.nodes(segments[k]);
      Vec low = world.nodes.x.vec(nodes[0]), high = low;
      for (const Index n : nodes)
        low = low.cwiseMin(world.nodes.x.vec(n)), high = high.cwiseMax(world.nodes.x.vec(n));
      if (dim_ == 2) low[2] = -std::numeric_limits<Real>::max(), high[2] = std::numeric_limits<Real>::max();
      seen[k] = from->any_near(low, high);
    });
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Index s = segments[k];
    if (!seen[k]) continue;
    const std::array<Index, 4> node = world.segments.nodes(s);
    Face face;
    face.segment = s;
    if (segment_moves(world, s)) face.body = world.segments.part[s];
    if (belts && (face.belt = belts->of(s)) >= 0)
      face.slide = belts->belts[static_cast<std::size_t>(face.belt)].motion;
    for (int e = 0; e < 4; ++e) face.v[e] = world.nodes.v.vec(node[e]);
    if (dim_ == 2) {
      add_line(world.nodes, node, face);
      continue;
    }
    face.corners = node[3] == node[2] ? 3 : 4;
    for (int e = 0; e < 4; ++e) face.x[e] = world.nodes.x.vec(node[e]);
    add_face(face);
  }
  for (Index f = 0; f < faces(); ++f) cut(f, spacing);
  for (int k = 0; k < static_cast<int>(mirrors_and_periods_.size()); ++k) add_images(k);
  sort_into_cells();
}

WallSurface::Key WallSurface::key(const Vec& a, const Vec& b) const {
  Key out{};  // shifted, since coordinates like round numbers
  for (int k = 0; k < 3; ++k) {
    out[k] = std::llround(1e6 * a[k] / reach_ + 0.318);
    out[k + 3] = std::llround(1e6 * b[k] / reach_ + 0.318);
  }
  return out;
}

/// The face of a shell that is extruded across the plane of flow: its trace, made one reach wide to each
/// side.
void WallSurface::add_line(const Nodes& nodes, const std::array<Index, 4>& node, Face face) {
  std::pair<Vec, Vec> ends;
  Real longest = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) {
      const Vec one = in_plane(nodes.x.vec(node[a])), other = in_plane(nodes.x.vec(node[b]));
      if ((other - one).norm() > longest * (1 + small)) longest = (other - one).norm(), ends = {one, other};
    }
  if (longest < small * reach_) return;
  const Key one = key(ends.first, ends.second), other = key(ends.second, ends.first);
  if (!lines_.insert(std::min(one, other)).second) return;  // another shell of the same wall, beside this one
  const Vec z(0, 0, reach_), direction = (ends.second - ends.first) / longest;
  for (int e = 0; e < 4; ++e)
    face.along[e] = (in_plane(nodes.x.vec(node[e])) - ends.first).dot(direction) > 0.5 * longest ? 1 : 0;
  face.x = {Vec(ends.first - z), Vec(ends.second - z), Vec(ends.second + z), Vec(ends.first + z)};
  add_face(face);
}

void WallSurface::Face::find_plane() {
  n = (x[2] - x[0]).cross(x[3] - x[1]).normalized();
  Vec middle = Vec::Zero();
  for (int e = 0; e < corners; ++e) middle += x[e] / corners;
  offset = n.dot(middle);
  for (int e = 0; e < corners; ++e) inward[e] = n.cross(x[(e + 1) % corners] - x[e]).normalized();
}

void WallSurface::add_face(Face face) {
  const Vec across = (face.x[2] - face.x[0]).cross(face.x[3] - face.x[1]);
  if (!(across.norm() > small * reach_ * reach_)) return;
  face.find_plane();
  const Key plane = key(face.n * reach_, face.n * face.offset);
  const Key turned = key(-face.n * reach_, face.n * face.offset);
  face.plane = planes_.emplace(std::min(plane, turned), faces()).first->second;
  faces_.push_back(face);
}

void WallSurface::cut(Index face, Real spacing) {
  const Face& f = faces_[face];
  const Vec a = f.x[0], b = f.x[1], c = f.x[2], d = f.x[3];
  const auto pieces = [&](Real length) { return std::max(1, static_cast<int>(std::ceil(length / spacing))); };
  const int n = pieces(std::max((b - a).norm(), (c - d).norm()));
  if (dim_ == 2) {
    const Vec one = in_plane(a), step = (in_plane(b) - one) / n;
    const Real at_end = f.along[0] + f.along[1] + f.along[2] + f.along[3];
    for (int i = 0; i < n; ++i) {
      const Real s = (i + 0.5) / n;
      const Vec x = one + n * s * step;
      std::array<Real, 4> weight{};
      for (int e = 0; e < 4; ++e) weight[e] = f.along[e] > 0 ? s / at_end : (1 - s) / (4 - at_end);
      if (const Real share = share_in_front(x, step, Vec::Zero()); share > 0)
        add_point(f, face, x, share * step.norm() * f.n, weight);
    }
    return;
  }
  const int m = pieces(std::max((d - a).norm(), (c - b).norm()));
  const auto at = [&](Real s, Real t) {
    return Vec((1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const Real s = Real(i) / n, t = Real(j) / m, s1 = Real(i + 1) / n, t1 = Real(j + 1) / m;
      const Vec p = at(s, t), q = at(s1, t), r = at(s1, t1), u = at(s, t1);
      const Vec x = 0.25 * (p + q + r + u);
      const Real sm = 0.5 * (s + s1), tm = 0.5 * (t + t1);
      if (const Real share = share_in_front(x, 0.5 * (q - p + r - u), 0.5 * (u - p + r - q)); share > 0)
        add_point(f, face, x, share * 0.5 * (r - p).cross(u - q),
                  {(1 - sm) * (1 - tm), sm * (1 - tm), sm * tm, (1 - sm) * tm});
    }
}

void WallSurface::add_point(const Face& face, Index index, const Vec& x, const Vec& area,
                            const std::array<Real, 4>& weight) {
  WallPoint point{.x = x, .area = area, .face = index, .weight = weight};
  for (int e = 0; e < 4; ++e) point.v += weight[e] * face.v[e];
  if (dim_ == 2) point.v[2] = 0;
  points_.push_back(point);
}

/// Fraction of a piece around x with these sides that is in front of all planes.
Real WallSurface::share_in_front(const Vec& x, const Vec& along, const Vec& across) const {
  Real share = 1;
  for (const GhostPlane& plane : mirrors_and_periods_) {
    const Real wide = std::abs(plane.normal.dot(along)) + std::abs(plane.normal.dot(across)),
               d = depth(plane, x);
    const auto part = [&](Real inside) {
      if (wide < small * reach_) return Real(inside > -small * reach_);
      return std::clamp(0.5 + inside / wide, Real(0), Real(1));
    };
    share *= part(d);
    if (plane.kind == GhostPlane::Kind::periodic) share *= part(plane.period - d);
  }
  return share;
}

Vec WallSurface::position_behind(int k, Side side, const Vec& x) const {
  const GhostPlane& plane = mirrors_and_periods_[k];
  if (plane.kind == GhostPlane::Kind::mirror) return x - 2 * depth(plane, x) * plane.normal;
  const Vec shift = plane.period * plane.normal;
  return side == 2 ? Vec(x + shift) : Vec(x - shift);
}

Vec WallSurface::direction_behind(int k, const Vec& v) const {
  const GhostPlane& plane = mirrors_and_periods_[k];
  if (plane.kind == GhostPlane::Kind::periodic) return v;
  return v - 2 * v.dot(plane.normal) * plane.normal;
}

WallMotion WallSurface::motion_behind(int k, Side side, const WallMotion& m) const {
  const bool turned = mirrors_and_periods_[k].kind == GhostPlane::Kind::mirror;
  const Vec omega = direction_behind(k, m.omega);
  return {position_behind(k, side, m.x0), direction_behind(k, m.v), turned ? Vec(-omega) : omega};
}

/// Images of the current faces, including those of earlier planes, as far as they are in sight.
void WallSurface::add_images(int k) {
  const GhostPlane plane = mirrors_and_periods_[k];
  const Index known_points = points(), known_faces = faces();
  const auto direction = [&](const Vec& v) { return direction_behind(k, v); };
  const auto add = [&](Side side, const auto& is_near) {
    std::vector<Index> image(known_faces, -1);
    for (Index q = 0; q < known_points; ++q) {
      const WallPoint point = points_[q];
      const Real d = depth(plane, point.x);
      // a face in the mirror is its own image
      const bool in_mirror = std::abs(d) < 1e-6 * reach_ &&
                             (direction(point.area) + point.area).norm() < 1e-6 * point.area.norm();
      if (!is_near(d) || in_mirror) continue;
      if (image[point.face] < 0) {
        Face face = faces_[point.face];
        for (Vec& x : face.x) x = position_behind(k, side, x);
        for (int c = 0; c < 3; ++c)
          face.from_image.col(c) = faces_[point.face].from_image * direction(Vec::Unit(c));
        face.side |= side << 2 * k;
        face.image_of = point.face, face.behind = k, face.image_side = side;
        face.slide = motion_behind(k, side, face.slide);
        image[point.face] = faces();
        add_face(face);
      }
      WallPoint at_image = point;
      at_image.x = position_behind(k, side, point.x), at_image.area = direction(point.area);
      at_image.v = direction(point.v), at_image.face = image[point.face];
      points_.push_back(at_image);
    }
  };
  if (plane.kind == GhostPlane::Kind::mirror) {
    add(1, [&](Real d) { return d < farthest_; });
  } else {
    add(2, [&](Real d) { return d < farthest_; });
    add(1, [&](Real d) { return plane.period - d < farthest_; });
  }
}

/// A point on a plane is on both of its sides.
bool WallSurface::is_at(Side side, const Vec& x) const {
  for (const GhostPlane& plane : mirrors_and_periods_) {
    const Real d = depth(plane, x), tolerance = small * reach_;
    const Side here = side & 3;
    side >>= 2;
    const bool periodic = plane.kind == GhostPlane::Kind::periodic;
    if (here == 1 ? d > tolerance : d < -tolerance) return false;
    if (periodic && (here == 2 ? d < plane.period - tolerance : d > plane.period + tolerance)) return false;
  }
  return true;
}

void WallSurface::sort_into_cells() {
  Vec low = Vec::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  for (const WallPoint& p : points_) low = low.cwiseMin(p.x), high = high.cwiseMax(p.x);
  if (points_.empty()) low = high = Vec::Zero();
  low_ = low;
  cell_ = farthest_;
  const Real most = std::max<Real>(1e6, 4.0 * points());  // cells of a large wall must not fill the memory
  const auto count = [&] {
    for (int k = 0; k < 3; ++k) cells_[k] = 1 + static_cast<Index>((high[k] - low[k]) / cell_);
    return Real(cells_[0]) * cells_[1] * cells_[2];
  };
  while (count() > most) cell_ *= 1.25;
  const auto cell_of = [&](const WallPoint& p) {
    Index c = 0;
    for (int k = 0; k < 3; ++k) c = c * cells_[k] + static_cast<Index>((p.x[k] - low_[k]) / cell_);
    return c;
  };
  std::vector<Index> cell(points_.size());
  for_each(points(), [&](Index q) { cell[q] = cell_of(points_[q]); });
  first_.assign(std::size_t(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
  for (const Index c : cell) ++first_[c + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<Index> place(first_.begin(), first_.end() - 1);
  for (Index& c : cell) c = place[c]++;
  std::vector<WallPoint> sorted(points_.size());
  for_each(points(), [&](Index q) { sorted[cell[q]] = points_[q]; });
  points_ = std::move(sorted);
  at_.resize(points_.size());
  for_each(points(), [&](Index q) { at_[q] = points_[q].x; });
}

int WallSurface::cells_around(const Vec& x, std::array<Index, 27>& cells) const {
  std::array<Index, 3> low{}, high{};
  for (int k = 0; k < 3; ++k) {
    const Real at = (x[k] - low_[k]) / cell_;
    if (!(at >= -1 && at <= Real(cells_[k]) + 1)) return 0;
    const auto middle = static_cast<Index>(std::floor(at));
    low[k] = std::max<Index>(0, middle - 1), high[k] = std::min<Index>(cells_[k] - 1, middle + 1);
  }
  int n = 0;
  for (Index i = low[0]; i <= high[0]; ++i)
    for (Index j = low[1]; j <= high[1]; ++j)
      for (Index k = low[2]; k <= high[2]; ++k) cells[n++] = (i * cells_[1] + j) * cells_[2] + k;
  return n;
}

WallSurface::View WallSurface::view_from(const Vec& x) const {
  View view;
  const Vec from = in_plane(x);
  std::array<Index, 27> cells;
  const int n = cells_around(from, cells);
  Real seen = 0;
  bool one_plane = true;
  for (int k = 0; k < n; ++k)
    for (Index q = first_[cells[k]]; q < first_[cells[k] + 1]; ++q) {
      if (!near(q, from)) continue;
      if (view.nothing) view = {false, points_[q].face};
      one_plane &= faces_[points_[q].face].plane == faces_[view.flat].plane;
      seen += points_[q].area.norm();
    }
  if (view.nothing) return view;
  const Real d = distance(view.flat, from), r2 = reach_ * reach_ - d * d;
  const Real whole = dim_ == 2 ? 2 * std::sqrt(std::max(r2, Real(0))) : pi * r2;
  if (!one_plane || seen < 0.93 * whole) view.flat = -1;
  return view;
}

std::vector<Index> WallSurface::faces_next_to(const Vec& x) const {
  const Vec from = in_plane(x);
  std::array<Index, 27> cells;
  const int n = cells_around(from, cells);
  // no point of a piece is farther from its middle than half of its diagonal
  const auto half = [&](const WallPoint& point) {
    return dim_ == 2 ? 0.5 * point.area.norm() : std::sqrt(Real(0.5)) * spacing_;
  };
  Real least = reach_;
  for (int k = 0; k < n; ++k)
    for (Index q = first_[cells[k]]; q < first_[cells[k] + 1]; ++q)
      least = std::min(least, (at_[q] - from).norm());
  std::vector<Index> found;
  for (int k = 0; k < n; ++k)
    for (Index q = first_[cells[k]]; q < first_[cells[k] + 1]; ++q)
      if ((at_[q] - from).norm() - half(points_[q]) <= least) found.push_back(points_[q].face);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool WallSurface::is_at_face(Index f, const Vec& q) const {
  return is_at(faces_[f].side, q);
}

std::vector<Index> WallSurface::faces_around(const Vec& x, Real within) const {
  const Vec from = in_plane(x);
  std::array<Index, 27> cells;
  const int n = cells_around(from, cells);
  std::vector<Index> found;
  for (int k = 0; k < n; ++k)
    for (Index q = first_[cells[k]]; q < first_[cells[k] + 1]; ++q)
      if ((at_[q] - from).squaredNorm() < within * within &&
          (found.empty() || found.back() != points_[q].face))
        found.push_back(points_[q].face);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<Index> WallSurface::points_around(const Vec& x, Real within) const {
  const Vec from = in_plane(x);
  std::array<Index, 27> cells;
  const int n = cells_around(from, cells);
  std::vector<Index> found;
  for (int k = 0; k < n; ++k)
    for (Index q = first_[cells[k]]; q < first_[cells[k] + 1]; ++q)
      if ((at_[q] - from).squaredNorm() < within * within) found.push_back(q);
  return found;
}

/// A face between is nearer, and one of its points is at most one size of a piece farther.
WallSurface::SightSearch::SightSearch(const WallSurface& surface, const Vec& from, Real within)
    : surface_(surface),
      from_(from),
      within2_(power<2>(std::min(within, surface.reach_))),
      around2_(power<2>(std::min(within + surface.spacing_, surface.reach_))) {}

void WallSurface::SightSearch::take(Index point, Real r2) {
  if (r2 < within2_) out_.points.push_back(point);
  const Index face = surface_.points_[point].face;
  if (!faces_.empty() && faces_.back() == face) return;
  corner_ |= plane_ >= 0 && surface_.faces_[face].plane != plane_;
  plane_ = surface_.faces_[face].plane;
  faces_.push_back(face);
}

WallSurface::Sight WallSurface::SightSearch::found() {
  if (!corner_ || out_.points.empty()) return std::move(out_);
  std::sort(faces_.begin(), faces_.end());
  faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
  for (const Index face : faces_) {
    const Face& f = surface_.faces_[face];
    auto known = std::find_if(out_.screens.begin(), out_.screens.end(),
                              [&](const Screen& s) { return s.plane == f.plane; });
    if (known == out_.screens.end())
      known = out_.screens.insert(known, {f.plane, f.n, f.offset, surface_.height(face, from_), {}});
    known->faces.push_back(face);
  }
  out_.doubt = 1e-4 * surface_.reach_ + 1e-5 * from_.norm();  // faces have one plane by a key that rounds
  return std::move(out_);
}

WallSurface::Sight WallSurface::sight_from(const Vec& from, Real within) const {
  SightSearch search(*this, from, within);
  std::array<Index, 27> cells;
  const int n = cells_around(from, cells);
  for (int k = 0; k < n; ++k)
    for (Index q = first_[cells[k]]; q < first_[cells[k] + 1]; ++q) search.look_at(q);
  return search.found();
}

bool WallSurface::hidden(const WallPoint& point, const Vec& from, const Sight& sight) const {
  const Real tolerance = small * reach_;
  const Index plane = sight.screens.empty() ? -1 : faces_[point.face].plane;
  for (const Screen& screen : sight.screens) {
    if (screen.plane == plane) continue;
    const Real there = screen.n.dot(point.x) - screen.offset;
    if (screen.height * there > 0 && std::min(std::abs(screen.height), std::abs(there)) > sight.doubt)
      continue;
    for (const Index face : screen.faces) {
      const Face& f = faces_[face];
      const Real a = f.n.dot(from) - f.offset, b = f.n.dot(point.x) - f.offset;
      if (!(a * b < 0) || std::abs(b) < tolerance) continue;
      const Vec q = from + (point.x - from) * (a / (a - b));
      bool inside = is_at(f.side, q);
      for (int e = 0; e < f.corners; ++e) inside &= f.inward[e].dot(q - f.x[e]) > -tolerance;
      if (inside) return true;
    }
  }
  return false;
}

}  // namespace courant
