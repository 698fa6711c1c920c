#pragma once
// The entities of a run: SPH particles, shell nodes, contact segments, and the bodies that own rigid nodes.
#include <array>

#include "state/block_sums.hpp"
#include "state/field.hpp"

namespace courant {

/// SPH particles, sorted as [active | halo | dormant]. Active particles are inside the computational box: the
/// equations are solved for them. Particles of the halo are outside but within reach of an active one:
/// they act as neighbours and move with constant velocity every step. Dormant particles are out of reach and
/// are touched only when neighbours are refreshed. Those made for an inlet are outside, too, until they have
/// crossed its plane.
struct Particles {
  FieldSet fields{"particles"};
  Field<Real>& x =
      fields.add<Real>({.name = "position", .dimension = "L", .components = 3, .exchange = true});
  Field<Real>& v = fields.add<Real>(
      {.name = "velocity", .dimension = "L/T", .components = 3, .output = true, .exchange = true});
  Field<Real>& f =
      fields.add<Real>({.name = "force", .dimension = "ML/T2", .components = 3, .restart = false});
  Field<Real>& m = fields.add<Real>({.name = "mass", .dimension = "M", .output = true, .exchange = true});
  Field<Real>& rho = fields.add<Real>({.name = "density", .dimension = "M/L3", .output = true});
  Field<Real>& drhodt = fields.add<Real>({.name = "density_rate", .dimension = "M/L3/T"});
  Field<Real>& p =
      fields.add<Real>({.name = "pressure", .dimension = "M/LT2", .output = true, .exchange = true});
  Field<Real>& c = fields.add<Real>({.name = "sound_speed", .dimension = "L/T"});
  Field<Real>& E = fields.add<Real>(
      {.name = "internal_energy", .dimension = "M/LT2", .output = true});  ///< per reference volume
  Field<Real>& h =
      fields.add<Real>({.name = "smoothing_length", .dimension = "L", .output = true, .exchange = true});
  Field<Id>& id = fields.add<Id>({.name = "id", .dimension = "-", .output = true});
  Field<Index>& part =
      fields.add<Index>({.name = "part", .dimension = "-"});  ///< index into the model's parts
  Field<Index>& state = fields.add<Index>({.name = "state", .dimension = "-"});  ///< see ParticleState

  Index active = 0;       ///< particles [0, active) are active
  Index moving = 0;       ///< particles [active, moving) are the halo
  Real dormant_time = 0;  ///< time at which dormant particles were at x; since then they move with v [T]
  /// Position of particle i at time t, the time of x of the moving ones. [L]
  Vec place(Index i, Real t) const {
    return i < moving ? x.vec(i) : Vec(x.vec(i) + v.vec(i) * (t - dormant_time));
  }
  Index size() const { return fields.size(); }
};

enum ParticleState : Index {
  particle_outside = 0,      ///< outside the box: keeps its state, moves with constant velocity
  particle_active = 1,       ///< inside the box
  particle_deactivated = 2,  ///< switched off permanently (MAXV)
  particle_waiting = 3,      ///< made for an inlet and not yet through its plane: like outside
};

/// Nodes of shells and solids. Contact and elements add forces to f. Nodes of rigid bodies follow these;
/// others move by their forces. Forces on fixed walls move nothing: they are computed on request
/// (Contact::show_forces).
struct Nodes {
  FieldSet fields{"nodes"};
  Field<Real>& x = fields.add<Real>({.name = "position", .dimension = "L", .components = 3});
  Field<Real>& v =
      fields.add<Real>({.name = "velocity", .dimension = "L/T", .components = 3, .output = true});
  Field<Real>& f = fields.add<Real>(
      {.name = "force", .dimension = "ML/T2", .components = 3, .output = true, .restart = false});
  Field<Real>& m = fields.add<Real>({.name = "mass", .dimension = "M"});
  Field<Id>& id = fields.add<Id>({.name = "id", .dimension = "-", .output = true});
  Field<Index>& held =
      fields.add<Index>({.name = "held", .dimension = "-"});  ///< 1: its body cannot move at all
  Field<Index>& follow =
      fields.add<Index>({.name = "follow", .dimension = "-"});  ///< 1: a rigid body moves it, 2: a face
  Field<Index>& part =
      fields.add<Index>({.name = "part", .dimension = "-"});  ///< of one of its elements, by index
  Index size() const { return fields.size(); }
};

/// Faces on which contact acts: shells, and exterior faces of solids. A triangle repeats its third node:
/// node[2] == node[3].
struct Segments {
  FieldSet fields{"segments"};
  Field<Index>& node0 = fields.add<Index>({.name = "node0", .dimension = "-"});
  Field<Index>& node1 = fields.add<Index>({.name = "node1", .dimension = "-"});
  Field<Index>& node2 = fields.add<Index>({.name = "node2", .dimension = "-"});
  Field<Index>& node3 = fields.add<Index>({.name = "node3", .dimension = "-"});
  Field<Real>& thickness = fields.add<Real>({.name = "thickness", .dimension = "L", .output = true});
  Field<Real>& K =
      fields.add<Real>({.name = "bulk_modulus",
                        .dimension = "M/LT2"});  ///< E/(3(1-2 nu)) of the material, times SSF of its part
  Field<Real>& volume = fields.add<Real>(
      {.name = "element_volume", .dimension = "L3"});  ///< of the solid behind the face; 0: a shell
  Field<Real>* contact_force = nullptr;                ///< null: nothing can touch them [ML/T2]
  Field<Real>& keep_contact_force() {
    return *(contact_force = &fields.add<Real>({.name = "contact_force",
                                                .dimension = "ML/T2",
                                                .components = 3,
                                                .output = true,
                                                .restart = false}));
  }
  Field<Index>& part = fields.add<Index>({.name = "part", .dimension = "-"});
  Field<Id>& id = fields.add<Id>({.name = "id", .dimension = "-", .output = true});
  Index size() const { return fields.size(); }
  std::array<Index, 4> nodes(Index s) const { return {node0[s], node1[s], node2[s], node3[s]}; }
};

/// Elements of one kind and one part, whose forces on their nodes are gathered by a pass over the nodes:
/// those on corners, or sums by block. Groups with mass only (`pushes` is false) have none.
struct ElementGroup {
  enum class Leaves { corners, sums, nothing };
  ElementGroup(FieldSet& set, Index part_index, int corners, Leaves leaves = Leaves::corners)
      : fields(set),
        node(set.add<Index>({.name = "node", .dimension = "-", .components = corners})),
        V0(set.add<Real>({.name = "reference_volume", .dimension = "L3"})),
        mass(set.add<Real>({.name = "mass", .dimension = "M"})),
        id(set.add<Id>({.name = "id", .dimension = "-", .output = true})),
        part(part_index),
        pushes(leaves != Leaves::nothing) {
    if (leaves == Leaves::corners) keep_corner_forces();
  }
  void keep_corner_forces() {
    corner_force = &fields.add<Real>(
        {.name = "corner_force", .dimension = "ML/T2", .components = 3 * corners(), .restart = false});
  }
  void keep_corner_moments() {
    corner_moment = &fields.add<Real>(
        {.name = "corner_moment", .dimension = "ML2/T2", .components = 3 * corners(), .restart = false});
  }
  FieldSet& fields;
  Field<Index>& node;  ///< component c: index of corner c into World::nodes
  Field<Real>& V0;     ///< volume at the start [L3]
  Field<Real>& mass;   ///< for the corners by `share` [M]
  Field<Id>& id;
  Index part;        ///< index into the model's parts
  bool pushes;       ///< false: its elements have mass and no forces
  Index layup = -1;  ///< shells with layers of their own: index into the model's layups
  /// Component 3 c + k: on corner c in direction k. Null: the forces are in `sums`, and no other pass reads
  /// them.
  Field<Real>* corner_force = nullptr;
  Field<Real>* corner_moment =
      nullptr;                      ///< on rotations of the corners, as corner_force; null: none, or sums
  std::unique_ptr<BlockSums> sums;  ///< null: the forces are corner_force and corner_moment
  bool repeats_nodes = false;       ///< some element has a node at several corners
  Field<Index>* segment = nullptr;  ///< shells: index into World::segments of each; null: solids
  int corners() const { return node.info().components; }
  Index size() const { return fields.size(); }
  /// Of solids: the corners of a hexahedron (8 or 20 corners), or of a shape reduced to one (pentahedra of 6
  /// corners, tetrahedra of 4 or 10), with the same ends of edges.
  std::array<int, 8> hexahedron() const {
    if (corners() == 8 || corners() == 20) return {0, 1, 2, 3, 4, 5, 6, 7};
    if (corners() == 6) return {0, 1, 2, 3, 4, 4, 5, 5};
    return {0, 1, 2, 2, 3, 3, 3, 3};
  }
  /// Whether the node of a corner is at no corner before it.
  bool is_first(Index e, int corner) const {
    for (int b = 0; b < corner; ++b)
      if (node.data(b)[e] == node.data(corner)[e]) return false;
    return true;
  }
  /// Fraction of the mass of an element at a corner: `shares`, or equal for all nodes, independent of their
  /// number of corners. [-]
  Real share(Index e, int corner) const {
    if (!shares.empty()) return shares[static_cast<std::size_t>(corner)];
    if (!repeats_nodes) return Real(1) / corners();
    int different = 0, same = 0;
    for (int c = 0; c < corners(); ++c)
      different += is_first(e, c), same += node.data(c)[e] == node.data(corner)[e];
    return Real(1) / (different * same);
  }

  /// Fractions of the mass of an element, by corner; empty: equal. [-]
  std::vector<Real> shares{};
};

}  // namespace courant
