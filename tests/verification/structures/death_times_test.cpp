// *DEFINE_DEATH_TIMES against a closed form: nodes driven with v = t are free once they have come to x = d,
// with v = sqrt(2 d).
#include <gtest/gtest.h>

#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;

namespace death_times_test {

using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

/// A cube whose eight nodes are driven along x.
std::string with(const std::string& cards) {
  SolidDeck deck;
  deck.cards =
      "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0E2,0.3\n*DEFINE_CURVE\n1\n0,0\n10,"
      "10\n"
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,1\n";
  deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
  deck.node_set(1, [](const Vec&) { return true; });
  deck.node_set(2, [](const Vec& x) { return x[0] < 0.5; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 0.5; });
  deck.cards += cards;
  return deck.text(2);
}

Real last_speed(const std::string& cards) {
  auto s = simulation_of(with(cards));
  if (!s) return -1;
  while (s->clock().t < 1.5) s->step(do_nothing);
  Real least = 1e9, most = 0;
  for (Index n = 0; n < 8; ++n)
    least = std::min(least, s->world().nodes.v.data(0)[n]),
    most = std::max(most, s->world().nodes.v.data(0)[n]);
  EXPECT_LT(most - least, 0.05 * most);
  return 0.5 * (least + most);
}

}  // namespace

TEST(DeathTimes, EndMotionsBeyondAPlaneACylinderAndASphere) {
  EXPECT_NEAR(last_speed(""), 1.5, 0.02);
  const Real d = 0.5, expected = std::sqrt(2 * d);
  // the nodes behind at x = d, those in front at x = 1 + d
  const auto planes = [](const char* flag, int ahead) {
    return fmt::format(
        "*DEFINE_DEATH_TIMES_SET\n1\n0.5,0,0,{0},0,0,0,{1}\n2\n*DEFINE_DEATH_TIMES_SET\n1\n1.5,0,0,{2},0,0,0,"
        "{1}\n3\n",
        0.5 + ahead, flag, 1.5 + ahead);
  };
  EXPECT_NEAR(last_speed(planes("", 1)), expected, 0.03);
  EXPECT_NEAR(last_speed(planes("-1", -1)), expected, 0.03);
  // out of spheres and cylinders of radius r about the nodes' own y and z
  std::string spheres, cylinders, inside;
  for (int n = 1; n <= 8; ++n) {
    const int x = (n - 1) % 2, y = (n - 1) / 2 % 2, z = (n - 1) / 4;
    spheres += fmt::format("*DEFINE_DEATH_TIMES_NODES\n3\n{},{},{},0,0,0,0.5,1\n{}\n", x, y, z, n);
    cylinders +=
        fmt::format("*DEFINE_DEATH_TIMES_NODES\n2\n{},{},{},{},{},{},0.5,1\n{}\n", x, y, z, x, y, z + 1, n);
    inside += fmt::format("*DEFINE_DEATH_TIMES_NODES\n3\n{},{},{},0,0,0,0.2,-1\n{}\n", x + 0.7, y, z, n);
  }
  EXPECT_NEAR(last_speed(spheres), expected, 0.03);
  EXPECT_NEAR(last_speed(cylinders), expected, 0.03);
  EXPECT_NEAR(last_speed(inside), expected, 0.03);
}

// A plane through a node that moves along is never passed by those behind; with its own normal of two nodes.
TEST(DeathTimes, GoByNodesThatMove) {
  EXPECT_NEAR(last_speed("*DEFINE_DEATH_TIMES_SET\n1,2,1,2\n0,0,0,0,0,0,0,1\n2\n"), 1.5, 0.02);
  auto s = simulation_of(with("*DEFINE_DEATH_TIMES_SET\n1,2,1,2\n0,0,0,0,0,0,0,-1\n1\n"));
  ASSERT_TRUE(s);
  s->step(do_nothing);
  EXPECT_EQ(s->world().counters["motions_ended_by_position"], 4) << "those behind it, at once";
}

TEST(DeathTimes, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  test::expect_same_bits(with("*DEFINE_DEATH_TIMES_SET\n1\n0.1,0,0,1.1,0,0,0,1\n2\n"), 60, 20);
}

}  // namespace death_times_test
