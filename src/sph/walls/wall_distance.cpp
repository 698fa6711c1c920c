#include "sph/walls/wall_distance.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

namespace {

constexpr Real pieces_per_reach = 4;  ///< how finely faces are in the cells in which they are looked for

/// The point of a face next to x.
Vec next_on(const WallSurface::Face& face, const Vec& x) {
  const Vec foot = x - (face.n.dot(x) - face.offset) * face.n;
  bool inside = true;
  for (int e = 0; e < face.corners; ++e) inside &= (foot - face.x[e]).dot(face.inward[e]) >= 0;
  Vec nearest = foot;
  if (!inside) {
    Real least = std::numeric_limits<Real>::infinity();
    for (int e = 0; e < face.corners; ++e) {
      const Vec a = face.x[e], along = face.x[(e + 1) % face.corners] - a;
      const Real s = std::clamp((x - a).dot(along) / along.squaredNorm(), Real(0), Real(1));
      const Vec on_edge = a + s * along;
      if ((x - on_edge).norm() < least) least = (x - on_edge).norm(), nearest = on_edge;
    }
  }
  return nearest;
}

/// Velocity of a face at a point of it, linear over its triangles: exact where the wall turns as a whole.
Vec velocity_at(const WallSurface::Face& face, const Vec& x) {
  const auto weight = [&](int a, int b, const Vec& area) {  // of the corner across from edge a b
    return (face.x[b] - face.x[a]).cross(x - face.x[a]).dot(area) / area.squaredNorm();
  };
  for (int second = 1; second + 1 < face.corners; ++second) {
    const Vec area = (face.x[second] - face.x[0]).cross(face.x[second + 1] - face.x[0]);
    const Real last = weight(0, second, area), middle = weight(second + 1, 0, area);
    const bool is_last = second + 2 == face.corners;
    if (middle < 0 && !is_last) continue;  // beyond the diagonal
    return (1 - last - middle) * face.v[0] + middle * face.v[second] + last * face.v[second + 1];
  }
  return face.v[0];
}

}  // namespace

WallDistance::WallDistance(std::vector<Index> segments, Real reach, Real cell, std::vector<GhostPlane> planes,
                           const World& world)
    : segments_(std::move(segments)), reach_(reach), cells_(cell), planes_(std::move(planes)) {
  for (const Index s : segments_) any_moves_ |= segment_moves(world, s);
  // from the middle of a cell what is within the reach of any position in it must be seen
  surface_.emplace(world, segments_, reach_ / pieces_per_reach,
                   (1 + 1 / pieces_per_reach) * reach_ + (any_moves_ ? 0 : cell), planes_);
}

void WallDistance::follow(const World& world, std::int64_t rebuilds) {
  const Particles& p = world.particles;
  if (any_moves_) {
    const Real reach = (1 + 1 / pieces_per_reach) * reach_;
    const OccupiedCells from(p, reach, planes_);
    surface_.emplace(world, segments_, reach_ / pieces_per_reach, reach, planes_, &from);
    return;
  }
  if (rebuilds == rebuilds_) return;
  rebuilds_ = rebuilds;
  for (Index i = 0; i < p.active; ++i) {
    const Vec x = p.x.vec(i);
    const auto [place, is_new] = next_to_.try_emplace(cells_.of(x));
    if (is_new) place->second = next_to_cell(cells_.middle(x));
  }
}

/// No position of the cell is farther from its middle than half of its diagonal, r; so the face next to a
/// position is at most 2 r farther from the middle than the face next to that.
std::vector<Index> WallDistance::next_to_cell(const Vec& middle) const {
  const Vec from = surface_->in_plane(middle);
  const std::vector<Index> around = surface_->faces_around(middle);
  std::vector<Real> distance;
  for (const Index f : around) distance.push_back((from - next_on(surface_->face(f), from)).norm());
  if (around.empty()) return {};
  const Real most = *std::min_element(distance.begin(), distance.end()) + std::sqrt(Real(3)) * cells_.size();
  std::vector<Index> out;
  for (std::size_t k = 0; k < around.size(); ++k)
    if (distance[k] <= most) out.push_back(around[k]);
  return out;
}

NearestWall WallDistance::nearest(const Vec& x) const {
  const auto known = any_moves_ ? next_to_.end() : next_to_.find(cells_.of(x));
  return known != next_to_.end() ? nearest_of(known->second, x) : nearest_of(surface_->faces_next_to(x), x);
}

template <class Faces>
NearestWall WallDistance::nearest_of(const Faces& faces, const Vec& x) const {
  NearestWall out;
  const Vec from = surface_->in_plane(x);
  for (const Index f : faces) {
    const Vec on_face = next_on(surface_->face(f), from);
    const Real distance = (from - on_face).norm();
    if (!(distance < std::min(out.distance, reach_))) continue;
    out.distance = distance;
    out.normal = distance > 0 ? Vec((from - on_face) / distance) : surface_->face(f).n;
    out.segment = surface_->segment_of(f);
    out.velocity =
        any_moves_ ? surface_->from_image(f, velocity_at(surface_->face(f), on_face)) : Vec::Zero();
  }
  return out;
}

}  // namespace courant
