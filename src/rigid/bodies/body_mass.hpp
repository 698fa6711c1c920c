#pragma once
// Mass, centre and inertia of bodies from their parts and nodes, and how they start.
#include <set>
#include <vector>

#include "model/mesh/part_inertia.hpp"
#include "rigid/bodies/inertia.hpp"
#include "rigid/bodies/rigid.hpp"
#include "surfaces/skin.hpp"

namespace courant {

/// What a part gives its body.
struct Member {
  Index part = 0;
  Real ro = 0;                                  ///< [M/L3]
  std::vector<Index> nodes{};                   ///< of its elements, and extra ones
  std::vector<SkinCell> cells{};                ///< its solids
  std::vector<const ModelNode*> constrained{};  ///< by SPC, TC or RC
  const PartInertiaCard* given = nullptr;
};

/// Masses at nodes of a body, in equal shares of each element.
MassIntegrals lumped(const std::vector<Index>& nodes, const World& world);

/// Over the shells of each part, which have one thickness and density, or its solids, and the nodes' shares
/// of deformable elements that are fixed to them. `total`: the mass of all of that [M].
MassIntegrals integrated(const std::vector<const Member*>& members, const std::set<Index>& nodes, Real total,
                         const World& world);

/// The elements alone, as if shells had the thickness `weight` [L] and solids the share `weight` of RO.
MassIntegrals shape_of(const std::vector<const Member*>& members, const std::set<Index>& nodes, Real weight,
                       const World& world);

/// Mass, centre, inertia and momenta.
void take_mass(RigidBody& body, const MassIntegrals& sums);
/// Two bodies as one: their momenta, and inertia about the common centre.
void join_mass(RigidBody& body, const RigidBody& other);

/// Nodes on a line have no inertia about it, nor does a force on them turn them about it: with any inertia
/// there they move the same. Nodes at one position do not turn. `size`: of the body [L].
void complete_inertia(RigidBody& body, Real size);

/// Whether there is inertia about all axes that may turn: not where all nodes lie on a line.
bool can_turn(const RigidBody& body);

/// Gives a body, and its nodes, the velocities that its constraints leave of its momenta.
void start_velocities(RigidBody& body, World& world);

}  // namespace courant
