// *DEFORMABLE_TO_RIGID_AUTOMATIC: when a switch may act, by TIME1 to TIME3.
#include <gtest/gtest.h>

#include "../../verification/structures/solid_decks.hpp"

using namespace courant;

namespace switch_times_test {
namespace {

using test::do_nothing;
using test::simulation_of;

/// Times at which switches of a block act until 0.03. It flies with 2 towards a wall, 0.02 away.
std::vector<Real> times_of(const std::string& cards) {
  test::SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1, [](const Vec& x) { return Vec(x + Vec(0.02, 0, 0)); });
  deck.cards =
      "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n*CONTROL_TIMESTEP\n"
      "0.0,0.9,0,0.0,0.0,9\n*DEFINE_CURVE\n9\n0.0,1.0e-4\n9.0,1.0e-4\n*INITIAL_VELOCITY\n0\n-2.0,0.0,0.0\n"
      "*RIGIDWALL_PLANAR_ID\n5,wall\n0\n0.0,0.0,0.0,1.0,0.0,0.0\n" +
      cards;
  auto s = simulation_of(deck.text(1));
  std::vector<Real> out;
  std::int64_t acted = 0;
  while (s && s->clock().t < 0.03) {
    const Real t = s->clock().t;
    s->step(do_nothing);
    const auto now = s->world().counters["rigid_switches"];
    if (now != acted) out.push_back(t);
    acted = now;
  }
  return out;
}
std::string switch_of(int number, const std::string& first, bool to_rigid) {
  return fmt::format("*DEFORMABLE_TO_RIGID_AUTOMATIC\n{},{}\n0,0,0,0.0,{},{}\n{}\n", number, first,
                     int(to_rigid), int(!to_rigid), to_rigid ? "1,0,PART" : "1,PART");
}
void expect_times(const std::vector<Real>& found, const std::vector<Real>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1.5e-4);
}

}  // namespace

// The second switch is due at 0.002, but waits until TIME3 of the first one is over.
TEST(SwitchTimes, OthersWaitForTimeThree) {
  const std::string second = switch_of(8, "0,0.002", false);
  expect_times(times_of(switch_of(7, "0,0.001", true) + second), {0.001, 0.002});
  expect_times(times_of(switch_of(7, "0,0.001,0.0,0.004", true) + second), {0.001, 0.005});
}

// By the force of the wall, which the block meets at 0.01: from TIME1 to TIME2 alone. By no force from the
// start.
TEST(SwitchTimes, ForcesCountFromTimeOneToTimeTwo) {
  const std::string rigid = "*DEFORMABLE_TO_RIGID\n1\n";
  expect_times(times_of(rigid + switch_of(1, "3,0.0,9.0,0.0,5", false)), {0.01});
  expect_times(times_of(rigid + switch_of(1, "3,0.0,0.008,0.0,5", false)), {});
  expect_times(times_of(switch_of(1, "1,0.003,9.0,0.0,5", true)), {0.003});
}

}  // namespace switch_times_test
