#pragma once
// A node and a face that it touches, for tests.
#include <functional>
#include <memory>

#include "contact/nodes/node_contact.hpp"

namespace courant {

/// A fixed square face in z = 0, side 2, its normal along z, of a solid as deep as it is wide; a free node
/// above it, whose own face looks down.
struct TouchScene {
  World world;
  Clock clock;
  NodeContactLaw law;
  std::shared_ptr<NodeContact> contact;
  Vec at{0.5, 0.2, 0.001}, v{0, 0, -1};
  bool held = true;
  Real depth = 2;     ///< of the solid
  unsigned pass = 0;  ///< 1: the node is of SURFB
  WallBodies bodies;
  std::function<void(ContactSides&)> change = [](ContactSides&) {};  ///< of the sides, before they touch

  void build() {
    Nodes& nodes = world.nodes;
    nodes.fields.resize(8);
    const FaceCorners x{Vec(-1, -1, 0), Vec(1, -1, 0), Vec(1, 1, 0), Vec(-1, 1, 0)};
    for (Index n = 0; n < 4; ++n) {
      nodes.x.set(n, x[static_cast<std::size_t>(n)]);
      nodes.m[n] = 2, nodes.held[n] = held, nodes.id[n] = n + 1;
      // the own face of node 4: (4, 5, 6, 7) clockwise seen from above
      nodes.x.set(4 + n, at + Vec(n == 1 || n == 2, n >= 2, 0));
      nodes.v.set(4 + n, v);
      nodes.m[4 + n] = 1, nodes.id[4 + n] = n + 5;
    }
    world.segments.fields.resize(1);
    ContactSides sides;
    sides.faces.push_back(
        {.node = {0, 1, 2, 3}, .k = 100, .area = 4, .depth = depth, .through = depth, .passes = 1U << pass});
    sides.own.push_back({.node = {4, 7, 6, 5}, .k = 25, .area = 0.25});
    ContactNode node;
    node.node = 4, node.last = 1, node.pass = pass;
    sides.nodes = {node};
    change(sides);
    contact = std::make_shared<NodeContact>(law, std::move(sides), bodies, 1, world);
  }
  /// Moves the free nodes on for dt and finds the forces.
  void step(Real dt) {
    clock.dt = clock.dt_old = dt;
    for (Index n = 4; n < 8; ++n) world.nodes.x.add(n, dt * world.nodes.v.vec(n));
    contact->start(world, clock);
    contact->block(world, clock, 0, contact->tracked());
    contact->finish(world, clock);
  }
  Vec force_on(Index n) const {
    Vec f = Vec::Zero();
    contact->add_force_on(n, f);
    return f;
  }
};

}  // namespace courant
