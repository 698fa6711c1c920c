#pragma once
#include <array>
#include <string>

#include "keyword/deck.hpp"
#include "rigid/joint_rows.hpp"

namespace courant {

/// *CONSTRAINED_JOINT_SPHERICAL and those of other kinds
struct JointCard : Entry {
  JointKind kind() const { return static_cast<JointKind>(name); }  ///< names stand in the order of kinds
  std::array<Id, 6> nodes() const { return {n1, n2, n3, n4, n5, n6}; }
  std::string title;
  Id id = 0, n1 = 0, n2 = 0, n3 = 0, n4 = 0, n5 = 0, n6 = 0, lcid = 0;
  Real rps = 1, damp = 1, parm = 0, r1 = 0, h_angle = 0;
  Real sense = 1;  ///< -1: the file was mirrored, and a turn about its axes is
                   ///< the other way
  int type = 0;
};

}  // namespace courant
