// What is beside a body does not touch it: where faces end, and nodes that only graze a face.
#include <algorithm>
#include <cmath>

#include "contact/nodes/node_contact.hpp"

namespace courant {

namespace {

/// Faces that turn by less at their edge are one smooth surface (cosine of 60 degrees).
constexpr Real smooth_edge = 0.5;
/// A node lies within a smooth surface if no normal around it is further off their mean (cosine).
constexpr Real smooth_node = 0.8;
/// Normals that differ from a right angle by less stand upright on each other (cosine of 80 degrees).
constexpr Real upright = 0.17;

/// From the middle of an edge to the centre of a face, at right angles to the edge.
Vec inward(const FaceCorners& x, const ContactFace& f, const Vec& a, const Vec& along) {
  const Vec w = centre_of(x, f.corners) - a;
  return w - w.dot(along) * along;
}

/// Whether a face of a node looks at one with this normal.
bool looks(const OwnFace& own, const Vec& n, const Vec& normal) {
  const Real towards = -n.dot(normal);
  return (own.two_sided ? std::abs(towards) : towards) > upright;
}

}  // namespace

Vec NodeContact::normal_of(const World& world, const OwnFace& own) const {
  return plane_normal(corners_of(own, world.nodes.x));
}

// Whether the faces at an edge of a face that are there go on smoothly in it.
bool NodeContact::is_smooth_at(const World& world, Index f, unsigned e) const {
  const ContactFace& one = face(f);
  const FaceCorners x = corners_of(one, world.nodes.x);
  const auto ends = ends_of_edge(one, e);
  const Vec along = (x[ends[1]] - x[ends[0]]).normalized(), in = inward(x, one, x[ends[0]], along);
  return edges_.any_at(f, e, [&](Index g) {
    const ContactFace& other = face(g);
    if (!(other.passes & one.passes) || !is_there(other)) return false;
    const Vec on = inward(corners_of(other, world.nodes.x), other, x[ends[0]], along);
    return -on.dot(in) > smooth_edge * on.norm() * in.norm();
  });
}

// Whether a face around the node that looks at face f lies over a part of it: by the corners of both.
bool NodeContact::overlaps(const World& world, Index i, Index f) const {
  const ContactFace& on = face(f);
  const FaceCorners x = corners_of(on, world.nodes.x);
  const Vec n = plane_normal(x);
  const ContactNode& who = node(i);
  const auto any_over = [](const FaceCorners& of, int corners, const FaceCorners& face, int its_corners) {
    return std::any_of(of.begin(), of.begin() + corners,
                       [&](const Vec& corner) { return project_over(face, its_corners, corner).within; });
  };
  for (Index o = who.first; o < who.last; ++o) {
    const OwnFace& own = own_[static_cast<std::size_t>(o)];
    if (!is_there(own) || !looks(own, normal_of(world, own), n)) continue;
    const FaceCorners y = corners_of(own, world.nodes.x);
    if (any_over(y, own.corners(), x, on.corners) || any_over(x, on.corners, y, own.corners())) return true;
  }
  return false;
}

// A face reaches a little beyond its edges where the surface goes on, and where bodies stand edge on edge, as
// far as they deform: not to what passes beside it.
bool NodeContact::is_over(const World& world, Index i, Index f, const Projection& p) const {
  for (unsigned e = 0; e < 4; ++e)
    if (p.beyond & (1U << e) && !is_smooth_at(world, f, e)) return overlaps(world, i, f);
  return p.over;
}

// Mean normal of the faces around a node within a smooth surface; 0 at rims, edges and corners of a body.
// Faces of a fan are taken round the node, as shells may be numbered both ways round.
Vec NodeContact::smooth_normal(const World& world, const ContactNode& n) const {
  const auto count = static_cast<std::size_t>(n.last - n.first);
  struct Part {
    Index next = -1, last = -1;  // corners beside the node
    Vec n = Vec::Zero();
    bool used = false;
  };
  std::vector<Part> fan;
  for (std::size_t k = 0; k < count; ++k) {
    const OwnFace& own = own_[static_cast<std::size_t>(n.first) + k];
    if (!is_there(own)) continue;
    const auto corners = static_cast<std::size_t>(own.corners());
    const auto at =
        static_cast<std::size_t>(std::find(own.node.begin(), own.node.end(), n.node) - own.node.begin());
    fan.push_back(
        {own.node[(at + 1) % corners], own.node[(at + corners - 1) % corners], normal_of(world, own)});
  }
  if (fan.size() < 3) return Vec::Zero();
  fan[0].used = true;
  Vec sum = fan[0].n;
  Index edge = fan[0].next;
  for (std::size_t step = 1; step < fan.size(); ++step) {
    const auto on = std::find_if(fan.begin(), fan.end(), [&](const Part& part) {
      return !part.used && (part.next == edge || part.last == edge);
    });
    if (on == fan.end()) return Vec::Zero();
    on->used = true;
    if (on->next == edge) std::swap(on->next, on->last), on->n = -on->n;
    edge = on->next, sum += on->n;
  }
  if (edge != fan[0].last) return Vec::Zero();
  sum.normalize();
  const bool smooth =
      std::all_of(fan.begin(), fan.end(), [&](const Part& part) { return part.n.dot(sum) > smooth_node; });
  return smooth ? sum : Vec::Zero();
}

// Whether some face around the node looks at what has this normal.
bool NodeContact::looks_at(const World& world, const ContactNode& n, const Vec& normal) const {
  if (n.first == n.last) return true;
  for (Index o = n.first; o < n.last; ++o) {
    const OwnFace& own = own_[static_cast<std::size_t>(o)];
    if (is_there(own) && looks(own, normal_of(world, own), normal)) return true;
  }
  return false;
}

bool NodeContact::is_of_solids(const ContactNode& n) const {
  return n.first != n.last && std::none_of(own_.begin() + n.first, own_.begin() + n.last,
                                           [](const OwnFace& own) { return own.two_sided; });
}

// A node that comes through a face only because its own surface is level with the one behind an edge of that
// face: a floor under a block that slides on it. A node within a smooth surface never touches what stands
// upright on that surface. Another, at the edge of a floor, is level with the surface behind the edge as far
// as the nodes around both are deep; of a solid none of whose faces is turned towards the touched one, as
// deep as contact is at most: it has nothing to meet that face with, and where its nodes lie over edges it
// comes through both faces in one step. The rim of shells has no faces of its own and may meet the face edge
// on. `q`, `normal`: of the face where the node meets it.
bool NodeContact::grazes(const World& world, Index i, Index touched, const Vec& q, const Vec& normal) const {
  const ContactNode& n = node(i);
  if (const Vec own = smooth_normal(world, n); !own.isZero()) return std::abs(own.dot(normal)) < upright;
  const ContactFace& f = face(touched);
  const Real width = std::sqrt(f.area);
  Real deepest = 0;  // of the nodes around this one
  for (Index o = n.first; o < n.last; ++o)
    for (const Index corner : own_[static_cast<std::size_t>(o)].node)
      deepest = std::max(deepest, depth_at(corner));
  const FaceCorners x = corners_of(f, world.nodes.x);
  if (is_of_solids(n) && !looks_at(world, n, normal)) deepest = width;
  for (unsigned e = 0; e < static_cast<unsigned>(f.corners); ++e) {
    const auto ends = ends_of_edge(f, e);
    const Vec along = (x[ends[1]] - x[ends[0]]).normalized(), w = q - x[ends[0]];
    const Real depth = std::max({deepest, depth_at(f.node[ends[0]]), depth_at(f.node[ends[1]])});
    if (!((w - w.dot(along) * along).norm() < level_at(depth, width)) || is_smooth_at(world, touched, e))
      continue;
    const bool level_with = edges_.any_at(touched, e, [&](Index g) {
      const ContactFace& other = face(g);
      const FaceCorners y = corners_of(other, world.nodes.x);
      const bool falls_away =
          inward(y, other, x[ends[0]], along).dot(normal) < 0;  // else the edge is an inner one
      return (other.passes & f.passes) && is_there(other) && falls_away &&
             looks_at(world, n, plane_normal(y));
    });
    if (level_with) return true;
  }
  return false;
}

}  // namespace courant
