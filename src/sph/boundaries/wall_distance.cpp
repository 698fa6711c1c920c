#include "sph/boundaries/wall_distance.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

namespace {

constexpr Real pieces_per_reach = 4;  ///< how finely faces stand in the cells in which they are looked for

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

WallDistance::WallDistance(std::vector<Index> segments, Real reach, std::vector<GhostPlane> planes,
                           const World& world)
    : segments_(std::move(segments)), reach_(reach), planes_(std::move(planes)) {
  for (const Index s : segments_) any_moves_ |= segment_moves(world, s);
  surface_.emplace(world, segments_, reach_ / pieces_per_reach, (1 + 1 / pieces_per_reach) * reach_, planes_);
}

void WallDistance::follow(const World& world) {
  if (!any_moves_) return;
  const Real reach = (1 + 1 / pieces_per_reach) * reach_;
  const Lookouts from(world.particles, reach, planes_);
  surface_.emplace(world, segments_, reach_ / pieces_per_reach, reach, planes_, &from);
}

NearestWall WallDistance::nearest(const Vec& x) const {
  NearestWall out;
  const Vec from = surface_->in_plane(x);
  for (const Index f : surface_->faces_next_to(x)) {
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
