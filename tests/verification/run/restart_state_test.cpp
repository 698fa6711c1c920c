// Every number that a restart keeps matters: changed, it changes what comes after.
#include <gtest/gtest.h>

#include <set>

#include "beam_decks.hpp"
#include "joint_decks.hpp"
#include "restart_walk.hpp"

using namespace courant;
using test::SolidDeck;

namespace restart_state_test {
namespace {

/// A block that slides and rubs on a rigid plate, which is driven, and meets a moving rigid wall with
/// friction.
std::string rubbing_block() {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1);
  deck.block(Vec(0.6, 0.6, 0.1), 2, 2, 1, 2, [](const Vec& x) { return Vec(x - Vec(0.2, 0.2, 0.1005)); });
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1e7,0.3\n*PART\nplate\n2,1,2\n"
      "*MAT_RIGID\n2,1000.0,1e7,0.3\n1,5,7\n*CONTROL_HOURGLASS\n4,0.05\n"
      "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n7,rubs\n1,2,3,3\n0.3,0.2,5.0,,20.0\n\n1\n"
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,1,0,3\n*DEFINE_CURVE\n3\n0,0.5\n9,5.0\n"
      "*LOAD_BODY_Z\n4,10.0\n*DEFINE_CURVE\n4\n0,1\n9,1\n"
      "*RIGIDWALL_PLANAR_MOVING\n0\n0.21,0.0,0.0,-0.79,0.0,0.0,0.3\n20.0,0.5\n"
      "*INITIAL_VELOCITY\n1\n1.0,0.2,-1.0\n*DAMPING_PART_STIFFNESS\n1,0.1\n";
  deck.node_set(1, [](const Vec& x) { return x[2] > -1e-9; });
  return deck.text(1);
}

}  // namespace

TEST(RestartState, EveryNumberOfARubbingBlockMatters) {
  // Made again in each step, kept for what reads the state between steps; or of no effect in this scene: the
  // driven plate does not yield to springs, lives on from the start, and no node comes to an edge. When
  // hourglass modes are looked at next changes no bits of the state.
  const std::set<std::string> made_anew{"clock/dt",
                                        "energy/below",
                                        "energy/bulk_viscosity",
                                        "energy/contact",
                                        "energy/half_step",
                                        "energy/hourglass",
                                        "energy/internal",
                                        "energy/kinetic",
                                        "energy/potential",
                                        "passes/contact 7 of nodes/asleep",
                                        "passes/contact 7 of nodes/body_push",
                                        "passes/contact 7 of nodes/body_springs",
                                        "passes/contact 7 of nodes/body_turn",
                                        "passes/contact 7 of nodes/deepest",
                                        "passes/contact 7 of nodes/fresh",
                                        "passes/hourglass modes of solids/next",
                                        "passes/rigid bodies/part 2/force",
                                        "passes/rigid bodies/part 2/moment",
                                        "passes/rigid bodies/part 2/omega",
                                        "passes/rigid wall 1/force",
                                        "solids of part 1/damped_stress"};
  for (const std::string& name : test::walk(rubbing_block(), {10, 60, 110}, 130).unnoticed)
    EXPECT_TRUE(made_anew.contains(name)) << name;
  test::expect_same_bits(rubbing_block(), 130, 60);
}

}  // namespace restart_state_test
