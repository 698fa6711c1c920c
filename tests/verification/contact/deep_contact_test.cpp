// How deep nodes may be pressed into bodies before they have gone through.
#include <gtest/gtest.h>

#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;

namespace deep_contact_test {
namespace {

/// A brick is driven 4 mm deep into a held slab of `layers` flat solids, each 1 mm thick and 50 mm wide.
std::string pressed_slab(int layers) {
  test::SolidDeck deck;
  deck.block(Vec(0.1, 0.1, 0.001 * layers), 2, 2, layers, 1);
  deck.block(Vec(0.02, 0.02, 0.02), 1, 1, 1, 2,
             [=](const Vec& x) { return Vec(x + Vec(0.01, 0.02, 0.001 * layers + 5e-5)); });
  deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
  deck.node_set(2, [=](const Vec& x) { return x[2] > 0.001 * layers + 1e-6; });
  deck.node_set(3, [=](const Vec& x) { return x[2] < 0.001 * layers + 1e-6; });
  deck.cards +=
      "*PART\nslab\n1,1,1\n*PART\nbrick\n2,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1e7,0.3\n"
      "*BOUNDARY_SPC_SET\n3,0,1,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,0,1\n*DEFINE_CURVE\n1\n0,-1\n1,-1\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n2,1,3,3\n0\n\n";
  return deck.text(0.00405);
}

/// Nodes that went through, and the force at the end over that of a spring over the whole depth.
struct Pressed {
  std::int64_t leaked = 0;
  Real force = 0;
};
Pressed press(int layers) {
  const auto s = test::simulation_of(pressed_slab(layers));
  Real early = 0, force = 0;
  while (s->clock().t < 0.00405) {
    s->step(test::do_nothing);
    force = s->world().passes.all<const InterfaceReporter>().at(0)->report().on_surfa[2];
    if (s->clock().t < 0.00055) early = force;
  }
  return {s->world().counters.at("leaked_nodes"), force / (8 * early)};
}

}  // namespace

TEST(DeepContact, ANodeGoesThroughABodyNotThroughItsFirstSolid) {
  EXPECT_EQ(press(1).leaked, 4);
  EXPECT_EQ(press(3).leaked, 4);
  const Pressed thick = press(6);
  EXPECT_EQ(thick.leaked, 0);
  EXPECT_NEAR(thick.force, 1, 0.05);
}

}  // namespace deep_contact_test
