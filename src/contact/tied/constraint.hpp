#pragma once
// Nodes that go with faces exactly.
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contact/tied/ties.hpp"
#include "state/reports.hpp"
#include "state/world.hpp"

namespace courant {

/// All tied contacts of the constraint kind. The node goes where its face goes, and force and inertia of it
/// go to the corners: m_i a_i = f_i + sum_s B_si^T (f_s - m_s a_s), B the change of the node's place with
/// that of the corners, a_s what the node really does (CarriedMass). World::nodes has shares N_si m_s of its
/// mass at the corners. Where all corners belong to one rigid body, this gets the mass at the node's place
/// instead; where only some do, the shares are all the inertia that counts. The forces do no work, so nothing
/// is lost or won.
struct TiedConstraint {
  struct Contact {
    Id id = 0;
    std::string title{};
    std::size_t first = 0, last = 0;                     ///< its ties
    Real death = std::numeric_limits<Real>::infinity();  ///< from then on none holds [T]
  };
  std::vector<Tie> ties{};
  std::vector<char> turns{};    ///< of each tie: rotations are those of the face, too
  std::vector<char> on_body{};  ///< of each tie: all corners belong to one rigid body
  std::vector<Contact> contacts{};
};

/// Whether a face still takes the node with it.
inline bool is_tied(const Tie& tie, const World& world) {
  return world.nodes.follow[tie.node] == 2;
}
/// Whether the node can be freed in the run: no corner has given its share of the mass to a rigid body.
bool can_be_released(const Tie& tie, const World& world);

/// Whether the inertia of a node counts where it is.
bool weighs_where_it_is(const Tie& tie, const World& world);

struct TiedStart {
  Real before = 0, after = 0;  ///< kinetic energy of the nodes and corners that can move [ML2/T2]
};

/// Axes along which, or about which where it turns, a support holds a node (index into World::nodes).
using HeldAxes = std::function<std::array<bool, 3>(Index node, bool turns)>;

/// By how much at most a frequency of elements is larger once nodes are tied: not at all where their inertia
/// counts, as a constraint makes nothing faster. Beside a face of which rigid bodies have some corners a node
/// moves more than the shares of its mass do; no more follows from sum_s m_s |B_s v|^2 <= (g^2 - 1) sum_i m_i
/// v_i^2 + g^2 sum_is N_si m_s v_i^2. Call it before start_constraint. [-]
Real growth_of_frequencies(const TiedConstraint& tied, const HeldAxes& held, const World& world);

/// Gives masses to corners, lets tied nodes follow, and makes their velocities those of the faces, with the
/// momentum of all that no support takes kept.
TiedStart start_constraint(const TiedConstraint& tied, const HeldAxes& held, World& world);
/// Adds the passes. Call start_constraint first.
void add_constraint(std::shared_ptr<const TiedConstraint> tied, World& world);
/// Adds the pass that frees nodes whose face is deleted or whose contact is dead, where that can happen.
void add_release(std::shared_ptr<const TiedConstraint> tied, World& world);

}  // namespace courant
