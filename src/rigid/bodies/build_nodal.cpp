#include "rigid/bodies/build_nodal.hpp"

#include <fmt/format.h>

#include <set>

#include "rigid/bodies/body_mass.hpp"
#include "rigid/bodies/given_inertia.hpp"
#include "rigid/bodies/held_nodes.hpp"
#include "rigid/bodies/node_inertias.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Rotary inertia of the nodes of shells and beams, which start as *INITIAL_VELOCITY turns them.
void add_rotary(const Model& model, const NodalBody& nodal, const std::map<Id, Index>& world_node,
                const World& world, RigidBody& b) {
  const Field<Real>* inertia = shared_fields::rotary_inertia.find(world.nodes.fields);
  if (!inertia) return;
  for (const Index n : nodal.nodes) {
    const Real J = (*inertia)[world_node.at(model.nodes[static_cast<std::size_t>(n)].id)];
    b.J0 += J * Matrix::Identity();
    if (const auto omega = model.angular_velocity.find(n); omega != model.angular_velocity.end())
      b.L += J * omega->second;
  }
}

void add_node(const Model& model, Index node, const std::map<Id, Index>& world_node, RigidBody& b,
              std::vector<const ModelNode*>& constrained) {
  const ModelNode& of_model = model.nodes[static_cast<std::size_t>(node)];
  b.nodes.push_back(world_node.at(of_model.id));
  if (is_constrained(model, of_model)) constrained.push_back(&of_model);
}

/// PNODE. `size`: of the body [L]. False where elements have it.
bool add_output_node(const NodalBody& nodal, const Deck& deck, const Model& model,
                     const std::map<Id, Index>& world_node, const World& world, Real size, RigidBody& b,
                     std::vector<const ModelNode*>& constrained, Diagnostics& diagnostics) {
  if (nodal.output_node < 0 ||
      std::find(nodal.nodes.begin(), nodal.nodes.end(), nodal.output_node) != nodal.nodes.end())
    return true;
  add_node(model, nodal.output_node, world_node, b, constrained);
  const Index n = b.nodes.back();
  if (world.nodes.m[n] > 0) {
    deck.error(diagnostics, nodal.card, "PNODE",
               fmt::format("node {} is a node of elements", world.nodes.id[n]),
               "add it to the node set, or leave PNODE blank");
    return false;
  }
  constexpr Real near = 1e-3;
  if ((world.nodes.x.vec(n) - b.x).norm() > near * size)
    deck.warning(
        diagnostics, nodal.card, "PNODE",
        fmt::format("node {} is not at the centre of mass ({:.6g}, {:.6g}, {:.6g}) and stays beside it",
                    world.nodes.id[n], b.x[0], b.x[1], b.x[2]),
        "put it there");
  return true;
}

/// The part of all nodes; -1 where they have several.
Index common_part(const std::set<Index>& parts) {
  return parts.size() == 1 ? *parts.begin() : -1;
}

}  // namespace

bool build_nodal_body(const NodalBody& nodal, const Deck& deck, const Model& model,
                      const std::map<Id, Index>& world_node, World& world, RigidBody& b,
                      Diagnostics& diagnostics) {
  const auto error = [&](std::string message, std::string hint) {
    deck.error(diagnostics, nodal.card, "", std::move(message), std::move(hint));
    return false;
  };
  if (world.dim == 2)
    return error("rigid bodies of nodes are not supported in plane scenes", "make them a part of *MAT_RIGID");
  b.part = nodal.id, b.name = nodal.name, b.held = nodal.held, b.no_turn = nodal.no_turn;
  std::set<Index> parts;
  std::vector<const ModelNode*> constrained;
  for (const Index n : nodal.nodes) {
    add_node(model, n, world_node, b, constrained);
    parts.insert(world.nodes.part[b.nodes.back()]);
  }
  b.part_index = common_part(parts);
  const MassIntegrals at_nodes = lumped(b.nodes, world);
  if (!nodal.given && !(at_nodes.m > 0))
    return error(fmt::format("the nodes of {} have no mass", nodal.name),
                 "name nodes of elements, add *ELEMENT_MASS, or give the mass by _INERTIA");
  if (at_nodes.m > 0) b.J_lumped = at_nodes.inertia();
  if (nodal.given) {
    if (!take_given_inertia(deck, model, world, *nodal.given, {-1, b.nodes}, b, diagnostics)) return false;
    b.unweighed = b.nodes;
  } else {
    take_mass(b, at_nodes);
    add_rotary(model, nodal, world_node, world, b);
  }
  if (!add_node_inertias(deck, model, world_node, world, b, diagnostics)) return false;
  Real size = 0;
  for (const Index n : b.nodes) size = std::max(size, (world.nodes.x.vec(n) - b.x).norm());
  complete_inertia(b, size);
  if (!add_output_node(nodal, deck, model, world_node, world, size, b, constrained, diagnostics))
    return false;
  const std::vector<Index> of_parts(parts.begin(), parts.end());
  const BodyAcceleration loads(model.body_loads);
  if (loads.by_parts() && (parts.contains(-1) || loads.on(of_parts).by_parts()))
    return error(fmt::format("body loads act on some of the nodes of {} only", nodal.name),
                 "let *LOAD_BODY_PARTS or *LOAD_GRAVITY_PART name all parts of its nodes, or none");
  for (const Index n : b.nodes) b.X.push_back(world.nodes.x.vec(n) - b.x);
  hold_by_nodes(model, constrained, world,
                {deck.where(nodal.card), nodal.name,
                 "hold the body with CMO = 1, CON1 and CON2 of *CONSTRAINED_NODAL_RIGID_BODY_SPC"},
                b, diagnostics);
  if (!can_turn(b))
    return error(fmt::format("{} has no inertia about an axis about which it may turn", nodal.name),
                 "hold its rotations");
  start_velocities(b, world);
  return true;
}

}  // namespace courant
