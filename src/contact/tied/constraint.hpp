#pragma once
// Nodes that go with faces exactly.
#include <memory>
#include <string>
#include <vector>

#include "contact/tied/ties.hpp"
#include "state/reports.hpp"
#include "state/world.hpp"

namespace courant {

/// All tied contacts of the constraint kind. Mass and force of a node go to the corners of its face: a_i =
/// (f_i
/// + sum_s B_si^T f_s) / (m_i + sum_s N_si m_s), B the change of the node's place with that of the corners;
/// the node goes where its face goes. The forces do no work, so nothing is lost or won.
struct TiedConstraint {
  struct Contact {
    Id id = 0;
    std::string title{};
    std::size_t first = 0, last = 0;  ///< its ties
  };
  std::vector<Tie> ties{};
  std::vector<char> turns{};  ///< of each tie: rotations are those of the face, too
  std::vector<Contact> contacts{};
};

struct TiedStart {
  Real before = 0, after = 0;  ///< kinetic energy of the nodes and corners that can move [ML2/T2]
};

/// Gives masses to corners, lets tied nodes follow, and makes their velocities those of the faces, with the
/// momentum of all kept.
TiedStart start_constraint(const TiedConstraint& tied, World& world);
/// Adds the passes. Call start_constraint first.
void add_constraint(std::shared_ptr<const TiedConstraint> tied, World& world);

}  // namespace courant
