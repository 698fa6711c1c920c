#include "contact/tied/on_bodies.hpp"

#include <set>

#include "state/shared_fields.hpp"

namespace courant {

namespace {

Real inertia_of(Index node, const World& world) {
  const Field<Real>* inertia = shared_fields::rotary_inertia.find(world.nodes.fields);
  return inertia ? (*inertia)[node] : 0;
}

}  // namespace

bool is_on_body(const Tie& tie, const WallBodies& bodies) {
  const Index body = bodies.body(tie.at.node[0]);
  for (int e = 1; e < tie.at.corners; ++e)
    if (bodies.body(tie.at.node[static_cast<std::size_t>(e)]) != body) return false;
  return body >= 0;
}

MassesOfBodies::MassesOfBodies(const TiedConstraint& tied, const TiedOptions& options, const World& world)
    : tied_(tied), options_(options) {
  std::set<Index> corners;
  for (const Tie& tie : tied.ties) corners.insert(tie.at.node.begin(), tie.at.node.end());
  for (const Index n : corners)
    if (options.bodies.take_mass && options.bodies.body(n) >= 0)
      corners_.push_back({n, world.nodes.m[n], inertia_of(n, world)});
}

Real MassesOfBodies::give(World& world) const {
  Real lost = 0;
  const auto give_one = [&](Index corner, const Vec& place, Real mass, Real inertia) {
    if (mass > 0 && !options_.bodies.take_mass(corner, place, mass, inertia)) lost += mass;
  };
  for (const Corner& one : corners_)
    give_one(one.node, world.nodes.x.vec(one.node), world.nodes.m[one.node] - one.mass,
             inertia_of(one.node, world) - one.inertia);
  for (std::size_t t = 0; t < tied_.ties.size(); ++t)
    if (const Tie& tie = tied_.ties[t]; tied_.on_body[t] && options_.bodies.take_mass)
      give_one(tie.at.node[0], world.nodes.x.vec(tie.node), world.nodes.m[tie.node],
               tied_.turns[t] ? inertia_of(tie.node, world) : 0);
  return lost;
}

}  // namespace courant
