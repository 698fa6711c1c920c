#pragma once
#include <array>
#include <string>

#include "keyword/deck.hpp"
#include "rigid/bodies/rigid_cards.hpp"
#include "rigid/joints/joint_rows.hpp"

namespace courant {

/// *CONSTRAINED_JOINT_SPHERICAL and those of other kinds
struct JointCard : JointCardFields {
  JointKind kind() const { return static_cast<JointKind>(name); }  ///< names are in the order of kinds
  std::array<Id, 6> nodes() const { return {n1, n2, n3, n4, n5, n6}; }
  Real sense = 1;  ///< -1: the file was mirrored, and a turn about its axes is the other way
};

}  // namespace courant
