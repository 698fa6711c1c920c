// *DEFINE_FRICTION: blocks that slide on a plate, each with a friction of its own.
#include <gtest/gtest.h>

#include <cmath>

#include "../app/same_after_restart.hpp"
#include "../app/small_scene.hpp"
#include "contact/friction.hpp"

namespace courant {
namespace {

/// Cubes of parts 11 to 13 that slide along x on a held plate of part 1, side by side, pressed on by gravity.
std::string scene(const std::string& table, const std::string& card,
                  const std::string& kind = "SURFACE_TO_SURFACE") {
  std::string nodes, solids, parts, velocities;
  for (int b = 0; b < 3; ++b) {
    for (int k = 0; k < 8; ++k) {
      const int x = (k % 4 == 1 || k % 4 == 2), y = k % 4 > 1, z = k > 3;
      nodes += fmt::format("{},{},{},{}\n", 100 * (b + 1) + k, 0.1 * x, 0.4 * b + 0.1 * y, 0.001 + 0.1 * z);
      velocities += fmt::format("{},1.,0.,0.\n", 100 * (b + 1) + k);
    }
    solids += fmt::format("{},{}", b + 1, 11 + b);
    for (int k = 0; k < 8; ++k) solids += fmt::format(",{}", 100 * (b + 1) + k);
    solids += "\n";
    parts += fmt::format("*PART\nblock\n{},2,2\n", 11 + b);
  }
  return "*KEYWORD\n*NODE\n1,-1.,-1.,0.\n2,3.,-1.,0.\n3,3.,2.,0.\n4,-1.,2.,0.\n" + nodes +
         "*ELEMENT_SHELL\n1,1,1,2,3,4\n*ELEMENT_SOLID\n" + solids + "*PART\nplate\n1,1,1\n" + parts +
         "*SECTION_SHELL\n1,2\n0.002\n*SECTION_SOLID\n2,1\n*MAT_RIGID\n1,7800.,2.E8,0.3\n1.,7,7\n"
         "*MAT_ELASTIC\n2,1000.,1.E8,0.3\n*SET_PART\n7\n12,13\n*SET_PART\n8\n1\n*CONTROL_TERMINATION\n1.\n"
         "*LOAD_BODY_Z\n1,9.81\n*DEFINE_CURVE\n1\n0.,1.\n9.,1.\n*DAMPING_GLOBAL\n2\n*DEFINE_CURVE\n2\n0.,0."
         "\n9.,0.\n"
         "*INITIAL_VELOCITY_NODE\n" +
         velocities + table + "*CONTACT_AUTOMATIC_" + kind + "_ID\n5,slide\n" +
         (kind == "SINGLE_SURFACE" ? "0,0,5\n" : "7,8,2,2\n") + card + "\n\n*END\n";
}

/// Mean speed along x of a block.
Real speed(const Simulation& s, int block) {
  Real sum = 0;
  for (Index k = 0; k < s.world().nodes.size(); ++k)
    if (s.world().nodes.id[k] / 100 == block) sum += s.world().nodes.v.vec(k)[0] / 8;
  return sum;
}

TEST(FrictionTable, EachPairHasItsOwn) {
  const std::string table = "*DEFINE_FRICTION_TITLE\nparts\n3,0.1,0.1\n12,1,0.2,0.2\n1,13,0.3,0.3\n";
  const auto s = test::build_deck(scene(table, "-2.,3.", "SINGLE_SURFACE"), false);
  ASSERT_TRUE(s);
  test::run(*s, 0.2);
  // v = v0 - mu g t; blocks land on the plate and bounce a little: 3 %
  for (const auto& [block, mu] : {std::pair(1, 0.1), std::pair(2, 0.2), std::pair(3, 0.3)})
    EXPECT_NEAR(1 - speed(*s, block), mu * 9.81 * 0.2, 0.03 * mu * 9.81 * 0.2) << block;
}

TEST(FrictionTable, SetsOfPartsAndScale) {
  // PSET 7 = parts 12 and 13; FSF 0.5 of the card
  const std::string table = "*DEFINE_FRICTION\n3,0.,0.\n7,8,0.4,0.4,0.,0.,PSET,PSET\n";
  std::string deck = scene(table, "-2.,0.");
  deck.replace(deck.find("-2.,0.\n\n"), 8, "-2.,0.\n1.,1.,,,1.,1.,0.5,1.\n");
  const auto s = test::build_deck(deck, false);
  ASSERT_TRUE(s);
  test::run(*s, 0.2);
  for (const int block : {2, 3})
    EXPECT_NEAR(1 - speed(*s, block), 0.2 * 9.81 * 0.2, 0.03 * 0.2 * 9.81 * 0.2) << block;
}

TEST(FrictionTable, RefusesByName) {
  const auto refusal = [](const std::string& table, const std::string& card) {
    Diagnostics diagnostics;
    EXPECT_FALSE(Simulation::build("deck.k", in_memory(scene(table, card)), diagnostics));
    return diagnostics.text();
  };
  const std::string table = "*DEFINE_FRICTION\n3,0.1,0.1\n12,1,0.2,0.2\n";
  EXPECT_NE(refusal("", "-2.").find("-2 asks for a *DEFINE_FRICTION, and there is none"), std::string::npos);
  EXPECT_NE(refusal(table, "-2.,4.").find("friction table 4 does not exist"), std::string::npos);
  EXPECT_NE(refusal(table, "-1.").find("'-1' is not supported"), std::string::npos);
  EXPECT_NE(refusal("*DEFINE_FRICTION\n3,0.1,0.1\n99,1,0.2,0.2\n", "-2.").find("99 does not exist"),
            std::string::npos);
  EXPECT_TRUE(test::build_deck(scene("*DEFINE_FRICTION\n3,0.1,0.1,0.,0.,1\n99,1,0.2,0.2\n", "-2."), false));
}

TEST(FrictionTable, SameBitsAfterARestart) {
  test::expect_same_after_restart(
      scene("*DEFINE_FRICTION\n3,0.1,0.1\n12,1,0.2,0.2\n1,13,0.3,0.3\n", "-2.,3.", "SINGLE_SURFACE"), 300,
      300);
}

}  // namespace
}  // namespace courant
