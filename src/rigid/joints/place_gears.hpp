#pragma once
#include <array>
#include <optional>
#include <string>

#include "rigid/joints/joint_cards.hpp"

namespace courant {

/// Where the nodes of a joint are at t = 0, those that are needed and N6 of a rack.
struct JointPlaces {
  std::array<Vec, 6> x;  ///< of N1 to N6 [L]
  bool sixth = false;    ///< N6 is given
  Real size = 0;         ///< of the joint, against which distances count as 0 [L]
};

/// What is wrong with a node, N1 for 0.
struct JointFault {
  std::size_t node = 0;
  std::string message, hint;
};

/// Gears, racks and pulleys: axes and how one turns the other. Places of the joint are those of N1 and N2.
std::optional<JointFault> place_gears(const JointCard& card, const JointPlaces& places, Joint& joint);
/// Motors: the axis N1 to N3 and, of translational ones, how far apart N1 and N2 are along it.
std::optional<JointFault> place_motor(const JointCard& card, const JointPlaces& places, Joint& joint);

}  // namespace courant
