// DOF 9 to 11 of *BOUNDARY_PRESCRIBED_MOTION: nodes that go round an axis.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <string>

#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

/// A block whose nodes, or those at its end x = 0 alone, go round an axis along `axis` through (0.3, -0.2,
/// 0.5).
std::string going_round(int axis, int vad, bool all, const std::string& curve) {
  const Vec c(0.3, -0.2, 0.5);
  SolidDeck deck;
  deck.block(Vec(1, 0.2, 0.2), 5, 1, 1, 1);
  deck.cards =
      "*SECTION_SOLID\n1,2\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n*CONTROL_ACCURACY\n1\n";
  deck.node_set(1, [all](const Vec& x) { return all || x[0] < 1e-9; });
  deck.cards += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n1,{},{},1,-2.0\n{},{}\n*DEFINE_CURVE\n1\n{}",
                            9 + axis, vad, c[(axis + 1) % 3], c[(axis + 2) % 3], curve);
  return deck.text(10);
}

}  // namespace

// All nodes: places are those of a rotation by the angle, to round-off, whatever the steps are.
TEST(PrescribedRound, NodesAreWhereTheAngleTakesThem) {
  for (const int axis : {0, 1, 2})
    for (const int vad : {0, 2}) {
      auto s = simulation_of(
          going_round(axis, vad, true, vad == 0 ? "0.0,0.0\n0.1,10.0\n10.0,10.0\n" : "0.0,0.0\n10.0,50.0\n"));
      const Nodes& nodes = s->world().nodes;
      std::vector<Vec> X;
      for (Index n = 0; n < nodes.size(); ++n) X.push_back(nodes.x.vec(n));
      while (s->clock().t < 0.25) s->step(do_nothing);
      const Real t = s->clock().t, angle = -2 * (vad == 0 ? 10 * (t - 0.05) : 5 * t);
      Vec c(0.3, -0.2, 0.5);
      c[axis] = 0;
      const Matrix turn = Eigen::AngleAxisd(angle, Vec::Unit(axis)).toRotationMatrix();
      for (Index n = 0; n < nodes.size(); ++n)
        EXPECT_NEAR((nodes.x.vec(n) - c - turn * (X[static_cast<std::size_t>(n)] - c)).norm(), 0, 1e-11)
            << axis << " " << vad;
    }
}

// One end: the work of the drive is what the block gets.
TEST(PrescribedRound, TheWorkOfTheDriveIsCounted) {
  const std::string text = going_round(2, 2, false, "0.0,0.0\n0.1,0.02\n10.0,2.0\n");
  auto s = simulation_of(text);
  test::start_ledger(*s);
  while (s->clock().t < 0.5) s->step(do_nothing);
  EXPECT_GT(s->world().energy.external_work, 0.1);
  EXPECT_LT(test::energy_error_of_a_step(*s), 5e-3);
  test::expect_same_bits(text, 40, 20);
}
