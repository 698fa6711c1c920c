// Walls that move, between two searches for what is near them.
#include "parallel/parallel.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {

// omega = 1/2 sum g_k x (omega x e_k) over any basis e with its reciprocal g, the third of which is the
// normal
WallMotion rigid_motion(const std::array<Vec, 3>& x, const std::array<Vec, 3>& v, int dim) {
  WallMotion out{x[0], v[0], Vec::Zero()};
  const Vec e1 = x[1] - x[0], u1 = v[1] - v[0];
  if (dim == 2) {
    out.omega = e1.cross(u1) / e1.squaredNorm();
    return out;
  }
  const Vec e2 = x[2] - x[0], u2 = v[2] - v[0], across = e1.cross(e2);
  const Real area2 = across.squaredNorm();
  const Vec n = across / std::sqrt(area2), g1 = e2.cross(across) / area2, g2 = across.cross(e1) / area2;
  const Vec turn_of_n = -(u1.dot(n) * g1 + u2.dot(n) * g2);
  out.omega = 0.5 * (g1.cross(u1) + g2.cross(u2) + n.cross(turn_of_n));
  return out;
}

void WallSurface::take_along(std::vector<Face>& faces, std::vector<WallMotion>& motions, const World& world,
                             Real back) const {
  const auto x = [&](Index node) { return Vec(world.nodes.x.vec(node) - back * world.nodes.v.vec(node)); };
  const auto take = [&](Face& face, WallMotion& motion) {
    const auto node = world.segments.nodes(face.segment);
    std::array<Index, 3> at{node[0], node[1], node[2]};
    if (dim_ == 2) {
      std::size_t first = 0, last = 0;
      while (face.along[first] > 0) ++first;
      while (!(face.along[last] > 0)) ++last;
      at = {node[first], node[last], node[last]};
      const Vec z(0, 0, reach_), one = in_plane(x(at[0])), other = in_plane(x(at[1]));
      face.x = {Vec(one - z), Vec(other - z), Vec(other + z), Vec(one + z)};
      motion = rigid_motion(
          {one, other, other},
          {in_plane(world.nodes.v.vec(at[0])), in_plane(world.nodes.v.vec(at[1])), Vec::Zero()}, 2);
    } else {
      for (std::size_t e = 0; e < 4; ++e) face.x[e] = x(node[e]);
      std::array<Vec, 3> v;
      for (std::size_t e = 0; e < 3; ++e) v[e] = world.nodes.v.vec(at[e]);
      motion = rigid_motion({face.x[0], face.x[1], face.x[2]}, v, 3);
    }
    face.find_plane();
  };
  for_each(this->faces(), [&](Index f) {
    if (faces[f].body >= 0 && faces[f].image_of < 0) take(faces[f], motions[f]);
  });
  for (Index f = 0; f < this->faces(); ++f) {  // images are behind what they are images of
    Face& face = faces[f];
    if (face.body < 0 || face.image_of < 0) continue;
    const Face& seen = faces[face.image_of];
    const WallMotion& of = motions[face.image_of];
    for (std::size_t e = 0; e < 4; ++e) face.x[e] = position_behind(face.behind, face.image_side, seen.x[e]);
    face.find_plane();
    motions[f] = motion_behind(face.behind, face.image_side, of);
  }
}

std::array<Real, 4> WallSurface::weights_of_nodes(const Face& face, const Vec& x) const {
  std::array<Real, 4> out{};
  if (dim_ == 2) {
    const Vec along = face.x[1] - face.x[0];
    const Real s = in_plane(x - face.x[0]).dot(along) / along.squaredNorm();
    const Real at_end = face.along[0] + face.along[1] + face.along[2] + face.along[3];
    for (std::size_t e = 0; e < 4; ++e) out[e] = face.along[e] > 0 ? s / at_end : (1 - s) / (4 - at_end);
    return out;
  }
  const auto weight = [&](std::size_t a, std::size_t b, const Vec& area) {  // of the corner across from a b
    return (face.x[b] - face.x[a]).cross(x - face.x[a]).dot(area) / area.squaredNorm();
  };
  for (std::size_t second = 1; second < 3; ++second) {
    const std::size_t third = second + 1;
    const Vec area = (face.x[second] - face.x[0]).cross(face.x[third] - face.x[0]);
    const bool is_last = second == 2 || face.corners == 3;
    const Real last = weight(0, second, area), middle = weight(third, 0, area);
    if (middle < 0 && !is_last) continue;  // beyond the diagonal
    out[0] = 1 - last - middle, out[second] = middle, out[third] = last;
    break;
  }
  return out;
}

}  // namespace courant
