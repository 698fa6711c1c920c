// Joints of a file that *INCLUDE_TRANSFORM moves.
#include <gtest/gtest.h>

#include <string>

#include "../keyword/decks_in_memory.hpp"
#include "model/transforms/included_entries.hpp"
#include "rigid/joints/joint_cards.hpp"

namespace courant {
namespace {

/// What is said, and the pitch of the screw, or the sense of the motor, of a file that is moved.
struct Moved {
  std::string messages;
  Real pitch = 0, sense = 1;
};
Moved moved(const std::string& transformation, const std::string& cards) {
  DecksInMemory decks{{{"main.k", "*KEYWORD\n*DEFINE_TRANSFORMATION\n1\n" + transformation +
                                      "\n*INCLUDE_TRANSFORM\njoint.k\n\n\n\n1\n*END\n"},
                       {"joint.k", "*KEYWORD\n" + cards + "*END\n"}}};
  Diagnostics diagnostics;
  Deck deck = read_deck("main.k", decks.options(), diagnostics);
  move_included_entries(deck, diagnostics);
  Moved out{.messages = diagnostics.text()};
  for (const JointCard& joint : deck.all<JointCard>()) out.pitch = joint.parm, out.sense = joint.sense;
  return out;
}

const std::string screw = "*CONSTRAINED_JOINT_SCREW\n1,2,3,4,5,6\n0.05\n";
std::string stiffness(const std::string& system) {
  return "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n3,1,2," + system + "\n\n\n,,,,,\n";
}

TEST(MovedJoints, APitchIsALengthWithASign) {
  EXPECT_NEAR(moved("SCALE,2.,2.,2.", screw).pitch, 0.1, 1e-15);
  EXPECT_NEAR(moved("ROTATE,0.,0.,1.,0.,0.,0.,90.", screw).pitch, 0.05, 1e-15);
  EXPECT_NEAR(moved("MIRROR,1.5,0.,0.,4.,0.,0.", screw).pitch, -0.05, 1e-15);
  EXPECT_NE(moved("SCALE,2.,1.,1.", screw).messages.find("the pitch of a screw"), std::string::npos);
}

TEST(MovedJoints, AMotorTurnsTheOtherWayInAMirror) {
  const std::string motor = "*CONSTRAINED_JOINT_ROTATIONAL_MOTOR\n1,2,3,4\n,7\n",
                    piston = "*CONSTRAINED_JOINT_TRANSLATIONAL_MOTOR\n1,2,3,4\n,7\n",
                    rack = "*CONSTRAINED_JOINT_RACK_AND_PINION\n1,2,3,4\n0.05\n";
  EXPECT_EQ(moved("MIRROR,1.5,0.,0.,4.,0.,0.", motor).sense, -1);
  EXPECT_EQ(moved("ROTATE,0.,0.,1.,0.,0.,0.,90.", motor).sense, 1);
  EXPECT_EQ(moved("SCALE,2.,2.,2.", motor).messages.find("motor"), std::string::npos);
  EXPECT_NE(moved("SCALE,2.,2.,2.", piston).messages.find("whether motors are, too"), std::string::npos);
  EXPECT_NEAR(moved("MIRROR,1.5,0.,0.,4.,0.,0.", rack).pitch, -0.05, 1e-15);
}

TEST(MovedJoints, StiffnessKnowsWhatItCannotFollow) {
  const auto says = [](const Moved& m, const char* what) {
    return m.messages.find(what) != std::string::npos;
  };
  EXPECT_TRUE(says(moved("MIRROR,1.5,0.,0.,4.,0.,0.", stiffness("5")),
                   "its angles would change their sign in a mirror"));
  EXPECT_TRUE(says(moved("ROTATE,0.,0.,1.,0.,0.,0.,90.", stiffness("0")), "do not turn with the file"));
  EXPECT_FALSE(says(moved("ROTATE,0.,0.,1.,0.,0.,0.,90.", stiffness("5")), "angles"));
  EXPECT_FALSE(says(moved("TRANSL,1.,2.,3.", stiffness("0")), "angles"));
}

}  // namespace
}  // namespace courant
