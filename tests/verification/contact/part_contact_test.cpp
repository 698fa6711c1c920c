// Thickness and stiffness of parts in contacts (*PART_CONTACT).
#include <gtest/gtest.h>

#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;

namespace part_contact_test {
namespace {

/// A plate that is driven down with 1 m/s from 20 mm above the middle of a held floor 4 mm thick.
struct Driven {
  Real thickness = 0.004;
  std::string of_part{};  ///< OPTT, SFT, SSF; empty: *PART
  std::string of_contact = "";
};

std::string driven_plate(const Driven& d) {
  test::ShellDeck deck;
  deck.plate(0.2, 0.2, 2, 2, 1, [](const Vec& x) { return Vec(x + Vec(0.1, 0.1, 0.02)); });
  deck.plate(0.4, 0.4, 1, 1, 2);
  deck.node_set(3, [](const Vec& x) { return x[2] > 0; });
  deck.cards += d.of_part.empty() ? "*PART\nplate\n1,1,1\n"
                                  : "*PART_CONTACT\nplate\n1,1,1\n0.0,0.0,0.0,0.0," + d.of_part + "\n";
  deck.cards += fmt::format(
      "*SECTION_SHELL\n1,2\n{},,,\n*MAT_ELASTIC\n1,2700.0,7e10,0.33\n*PART\nfloor\n2,2,2\n*SECTION_SHELL\n"
      "2,2\n0.004\n*MAT_RIGID\n2,7800.0,2e12,0.3\n1,7,7\n*BOUNDARY_PRESCRIBED_MOTION_SET\n3,3,0,1\n"
      "*DEFINE_CURVE\n1\n0,-1\n1,-1\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0\n{}\n",
      d.thickness, d.of_contact);
  return deck.text(1);
}

/// Height at which the first force comes, and the force over the depth from there on.
struct Touch {
  Real height = 0, stiffness = 0;
};
Touch touch_of(const Driven& d) {
  const auto s = test::simulation_of(driven_plate(d));
  const World& w = s->world();
  Touch out;
  while (w.nodes.x.data(2)[0] > 1e-3) {
    const Real z = w.nodes.x.data(2)[0];
    s->step(test::do_nothing);
    const Real force = w.passes.all<const InterfaceReporter>().at(0)->report().on_surfa[2];
    if (force > 0 && out.height == 0) out.height = z;
    if (out.height > 0 && z < out.height - 1e-3) {
      out.stiffness = force / (out.height - z);
      break;
    }
  }
  return out;
}

}  // namespace

// A step is 1e-5 s, in which the plate comes 1e-5 m nearer.
TEST(PartContact, CountsWithItsOwnThicknessAndStiffness) {
  const Real step = 2e-5;
  const Touch usual = touch_of({}), thick = touch_of({.thickness = 0.01});
  EXPECT_NEAR(usual.height, 0.004, step);
  EXPECT_NEAR(thick.height, 0.007, step);
  const struct {
    Driven deck;
    Real height, stiffness;
  } cases[] = {{{.of_part = "0.01,1.0,1.0"}, 0.007, 1},
               {{.of_part = "0.0,2.5,0.25"}, 0.007, 0.25},
               {{.of_part = "0.01,1.0,1.0", .of_contact = "0.0,0.0,0.0,0.0,2.0"}, 0.012, 1},
               {{.of_part = "0.01,1.0,0.5", .of_contact = "0.0,0.0,0.006"}, 0.005, 0.5}};
  for (const auto& one : cases) {
    const Touch now = touch_of(one.deck);
    EXPECT_NEAR(now.height, one.height, step) << one.deck.of_part;
    EXPECT_NEAR(now.stiffness / usual.stiffness, one.stiffness, 0.02 * one.stiffness) << one.deck.of_part;
  }
}

// A particle falls on a floor of 40 mm that counts as 60 and 20 mm; its penalty is that of the softer side.
TEST(PartContact, HoldsParticlesOffAtItsOwnThickness) {
  for (const auto& [of_part, height] : {std::pair("0.06", 0.03), {"0.0,0.5", 0.01}}) {
    const auto s = test::simulation_of(fmt::format(
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*CONTROL_SPH\n1,0,1e20,3\n*NODE\n1,0.5,0.5,0.1\n"
        "11,0.0,0.0,0.0\n12,1.0,0.0,0.0\n13,1.0,1.0,0.0\n14,0.0,1.0,0.0\n*ELEMENT_SPH\n1,1,0.001\n"
        "*ELEMENT_SHELL\n1,2,11,12,13,14\n*PART\nwater\n1,1,1,1\n*SECTION_SPH\n1,1.2,0.2,2.0,0.1\n*MAT_NULL\n"
        "1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0.0,9e5\n*PART_CONTACT\nfloor\n2,2,2\n"
        "0.0,0.0,0.0,0.0,{}\n*SECTION_SHELL\n2,2\n0.04\n*MAT_RIGID\n2,7850.0,2e11,0.3\n1,7,7\n"
        "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0\n\n*INITIAL_VELOCITY_NODE\n"
        "1,0.0,0.0,-1.0\n",
        of_part));
    Real z = 0.1;
    while (s->world().particles.v.data(2)[0] <= -1 + 1e-12 && z > 0) {
      s->step(test::do_nothing);
      z = s->world().particles.x.data(2)[0];
    }
    EXPECT_NEAR(z, height, 1.5e-3) << of_part;  // a step takes 0.6 mm
  }
}

}  // namespace part_contact_test
