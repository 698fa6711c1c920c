#include "rigid/bodies/body_mass.hpp"

#include <cmath>
#include <Eigen/Eigenvalues>

namespace courant {

namespace {

/// Area or volume of a part, integrated.
void add_elements(const Member& member, const World& world, MassIntegrals& out) {
  const Nodes& nodes = world.nodes;
  const Segments& g = world.segments;
  for (Index s = 0; s < g.size(); ++s) {
    if (g.part[s] != member.part) continue;
    const std::array<Index, 4> a = g.nodes(s);
    Quadrilateral x, v;
    for (std::size_t e = 0; e < 4; ++e) x[e] = nodes.x.vec(a[e]), v[e] = nodes.v.vec(a[e]);
    if (!(g.volume[s] > 0)) add_shell(x, v, g.thickness[s], out);
  }
  for (const SkinCell& cell : member.cells) {
    for (const std::array<Index, 8>& piece : cell.pieces()) {
      Hexahedron x, v;
      for (std::size_t c = 0; c < x.size(); ++c) x[c] = nodes.x.vec(piece[c]), v[c] = nodes.v.vec(piece[c]);
      add_solid(x, v, out);
    }
  }
}

/// Mass per volume of what add_elements sums up for a part: per area of shells.
Real weight_of(const Member& member, const World& world) {
  for (Index s = 0; s < world.segments.size() && member.cells.empty(); ++s)
    if (world.segments.part[s] == member.part) return member.ro * world.segments.thickness[s];
  return member.ro;
}

}  // namespace

MassIntegrals lumped(const std::vector<Index>& of_body, const World& world) {
  const Nodes& nodes = world.nodes;
  MassIntegrals out{.origin = of_body.empty() ? Vec(Vec::Zero()) : nodes.x.vec(of_body.front())};
  for (const Index n : of_body) out.add_point(nodes.m[n], nodes.x.vec(n), nodes.v.vec(n));
  return out;
}

MassIntegrals integrated(const std::vector<const Member*>& members, const std::set<Index>& nodes, Real total,
                         const World& world) {
  const Vec origin = world.nodes.x.vec(*nodes.begin());
  MassIntegrals others{.origin = origin}, out{.origin = origin};
  for (const auto& group : world.groups)
    for (int c = 0; c < group->corners(); ++c)
      for (Index e = 0; e < group->size(); ++e)
        if (const Index n = group->node.data(c)[e]; nodes.contains(n))
          others.add_point(group->mass[e] * group->share(e, c), world.nodes.x.vec(n), world.nodes.v.vec(n));
  for (const Member* member : members) {
    MassIntegrals one{.origin = origin};
    add_elements(*member, world, one);
    if (members.size() > 1) one *= weight_of(*member, world);
    out += one;
  }
  out *= (total - others.m) / out.m;  // so far it was the area, or the volume
  out += others;
  return out;
}

MassIntegrals shape_of(const std::vector<const Member*>& members, const std::set<Index>& nodes, Real weight,
                       const World& world) {
  MassIntegrals out{.origin = world.nodes.x.vec(*nodes.begin())};
  for (const Member* member : members) {
    MassIntegrals one{.origin = out.origin};
    add_elements(*member, world, one);
    one *= weight * member->ro;
    out += one;
  }
  return out;
}

void take_mass(RigidBody& b, const MassIntegrals& sums) {
  b.m = sums.m, b.x = sums.centre();
  b.v = sums.momentum / b.m, b.L = sums.angular_momentum();
  b.J0 = sums.inertia();
}

void join_mass(RigidBody& b, const RigidBody& other) {
  const Real m = b.m + other.m;
  const Vec x = (b.m * b.x + other.m * other.x) / m, v = (b.m * b.v + other.m * other.v) / m;
  const auto about = [&](const RigidBody& one) {
    const Vec r = one.x - x;
    return Matrix(one.J0 + one.m * (r.squaredNorm() * Matrix::Identity() - r * r.transpose()));
  };
  b.J0 = about(b) + Matrix(about(other));
  b.L += other.L + b.m * (b.x - x).cross(b.v - v) + other.m * (other.x - x).cross(other.v - v);
  b.m = m, b.x = x, b.v = v;
}

void complete_inertia(RigidBody& b, Real size) {
  constexpr Real round_off = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix> own(b.J0);
  const Vec J = own.eigenvalues();
  if (!(J[2] > round_off * b.m * size * size)) {
    b.no_turn = {true, true, true};
    return;
  }
  if (J[0] > round_off * J[2]) return;
  const Vec axis = own.eigenvectors().col(0);
  b.J0 += J[2] * axis * axis.transpose();
}

bool can_turn(const RigidBody& b) {
  Matrix J = b.J0;
  for (int k = 0; k < 3; ++k)
    if (b.no_turn[k]) {
      J.row(k).setZero();
      J.col(k).setZero();
      J(k, k) = b.J0.trace();
    }
  return std::abs(J.determinant()) > 1e-12 * std::pow(b.J0.trace(), 3) ||
         (b.no_turn[0] && b.no_turn[1] && b.no_turn[2]);
}

void start_velocities(RigidBody& b, World& world) {
  for (int k = 0; k < 3; ++k) {
    if (b.held[k]) b.v[k] = 0;
    if (b.no_turn[k]) b.L[k] = 0;
  }
  b.omega = b.fixed() ? Vec(Vec::Zero()) : b.omega_of(b.q);
  for (std::size_t k = 0; k < b.nodes.size(); ++k) world.nodes.v.set(b.nodes[k], b.v + b.omega.cross(b.X[k]));
}

}  // namespace courant
