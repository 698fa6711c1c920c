// Nodes with a prescribed motion: all other loads act along the other directions, and in all directions while
// no motion acts.
#include <gtest/gtest.h>

#include <cmath>

#include "time/step.hpp"

#include "../../verification/bodies/joint_decks.hpp"
#include "../../verification/shells/shell_decks.hpp"

using namespace courant;

namespace driven_nodes_test {
namespace {

using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

/// A cube of side 0.2, its nodes driven along x with velocity 1 while BIRTH <= t < DEATH. Steps of 1e-4.
SolidDeck driven_cube(const std::string& vad, const std::string& life, const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1);
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n"
      "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,99\n*DEFINE_CURVE\n99\n0.0,1.0e-4\n9.0,1.0e-4\n"
      "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n*BOUNDARY_PRESCRIBED_MOTION_SET\n" +
      vad + life + "\n" + cards;
  deck.node_set(1, [](const Vec&) { return true; });
  return deck;
}
const std::string along_x = "1,1,0,1,1.0,,";

struct End {
  Vec v = Vec::Zero();
  Real t = 0, residual = 0;  ///< energy from nowhere over that gained and passed
};
End run(const SolidDeck& deck, int steps) {
  auto s = simulation_of(deck.text(1));
  EnergyLedger last;
  for (int k = 0; k < steps; ++k)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      last = world.energy;
    });
  const World& world = s->world();
  End out{.v = Vec::Zero(), .t = s->clock().t, .residual = last.unexplained() / last.throughput};
  for (Index n = 0; n < world.nodes.size(); ++n) out.v += world.nodes.v.vec(n) / world.nodes.size();
  return out;
}

}  // namespace

// v = exp(-D t) by the trapezoidal rule: within (D dt)^2 D t/12 of it.
TEST(DrivenNodes, AreDampedAlongOtherDirections) {
  for (const std::string damping : {"*DAMPING_GLOBAL\n0,50.0\n", "*DAMPING_PART_MASS\n1,1,50.0\n"}) {
    const End end = run(driven_cube(along_x, "", damping + "*INITIAL_VELOCITY\n1\n1.0,0.0,1.0\n"), 500);
    EXPECT_NEAR(end.v[2] / std::exp(-50 * 0.05), 1, 5e-3) << damping;
    EXPECT_NEAR(end.v[0], 1, 1e-12) << "the motion overcomes the damping";
    EXPECT_NEAR(end.residual, 0, 1e-10);
  }
}

TEST(DrivenNodes, AreDampedBeforeAndAfterTheirMotion) {
  const std::string cards = "*DAMPING_GLOBAL\n0,50.0\n*INITIAL_VELOCITY\n1\n1.0,0.0,0.0\n";
  const End after = run(driven_cube(along_x, "0.02,0.0", cards), 500);
  EXPECT_NEAR(after.v[0] / std::exp(-50 * 0.03), 1, 1e-2);
  const End before = run(driven_cube(along_x, "9.0,8.0", cards), 500);
  EXPECT_NEAR(before.v[0] / std::exp(-50 * 0.05), 1, 1e-2);
}

// The mean velocity of a step is that of the drive along it, and of the force across it.
TEST(DrivenNodes, LoadsDoTheWorkThatTheEnergyGains) {
  for (const std::string motion : {along_x, std::string("1,4,0,1,1.0,7,")})
    for (const std::string force : {"*LOAD_NODE_SET\n1,3,1,40.0\n", "*LOAD_NODE_SET\n1,1,1,40.0\n"}) {
      const End end =
          run(driven_cube(motion, "", "*DEFINE_VECTOR\n7,0.0,0.0,0.0,0.6,0.0,0.8\n" + force), 300);
      EXPECT_NEAR(end.residual, 0, 1e-10) << motion << force;
    }
}

TEST(DrivenNodes, MeetRigidWallsThatAreAlongTheirMotion) {
  const std::string floor =
      "*RIGIDWALL_PLANAR\n0\n0.0,0.0,-0.01,0.0,0.0,1.0,0.0\n*INITIAL_VELOCITY\n1\n1.0,0.0,-1.0\n";
  const End end = run(driven_cube(along_x, "", floor), 400);
  EXPECT_GT(end.v[2], -1e-2) << "held by the floor";
  EXPECT_NEAR(end.v[0], 1, 1e-12);
  const End through = run(driven_cube("1,3,0,1,-1.0,,", "", floor), 400);
  EXPECT_NEAR(through.v[2], -1, 1e-12) << "driven through it";
  const End released = run(driven_cube("1,3,0,1,-1.0,,", "0.005,0.0", floor), 400);
  EXPECT_GT(released.v[2], -1e-2) << "after DEATH";
}

}  // namespace driven_nodes_test
