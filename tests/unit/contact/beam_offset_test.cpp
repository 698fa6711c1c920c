// *CONTACT_TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET: moments go through ties at a distance.
#include <gtest/gtest.h>

#include <cmath>

#include "../app/same_after_restart.hpp"
#include "../app/small_scene.hpp"

namespace courant {
namespace {

/// A cantilever of shells, 0.1 wide and 0.01 thick, in two pieces: part 1 from x = 0 to 0.4 at z = 0, held at
/// x = 0; part 2 from 0.35 to 0.75 at z = `gap`, whose first row is over the middle of the last shell of
/// part 1. A force at the free end, put on slowly.
std::string cantilever(const std::string& contact, Real gap = 0.01, const std::string& second = "1",
                       const std::string& more = "", const std::string& death = "") {
  std::string nodes, shells;
  const auto strip = [&](int first, int part, Real x0, Real z) {
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j < 3; ++j)
        nodes += fmt::format("{},{},{},{},{},{}\n", first + 3 * i + j, x0 + 0.05 * i, 0.05 * j, z,
                             part == 1 && i == 0 ? 7 : 0, part == 1 && i == 0 ? 7 : 0);
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 2; ++j) {
        const int n = first + 3 * i + j;
        shells += fmt::format("{},{},{},{},{},{}\n", first + 2 * i + j, part, n, n + 3, n + 4, n + 1);
      }
  };
  strip(100, 1, 0, 0), strip(200, 2, 0.375, gap);
  return "*KEYWORD\n*NODE\n" + nodes + "*ELEMENT_SHELL\n" + shells +
         "*PART\nfirst\n1,1,1\n*PART\nsecond\n2,1," + second +
         "\n*SECTION_SHELL\n1,2,0.833333,3\n0.01\n*MAT_ELASTIC\n1,1000.,1.E9,0.\n"
         "*MAT_RIGID\n2,1000.,1.E9,0.\n"
         "*SET_NODE\n1\n200,201,202\n*SET_NODE\n2\n224,225,226\n*CONTROL_TERMINATION\n9.\n"
         "*DEFINE_CURVE\n1\n0.,0.\n0.15,1.\n9.,1.\n*LOAD_NODE_SET\n2,3,1,0.02\n*DAMPING_GLOBAL\n0,25.\n" +
         contact + "\n1,1,4,3\n0." + (death.empty() ? "" : ",0.,0.,0.,0.,0,0.," + death) +
         "\n1.,1.,-0.05,-0.05\n" + more + "*END\n";
}

Real deflection(const std::string& deck, Real& dt) {
  Diagnostics diagnostics;
  const auto s = Simulation::build("deck.k", in_memory(deck), diagnostics);
  EXPECT_TRUE(s) << diagnostics.text();
  if (!s) return 0;
  test::run(*s, 0.6);
  dt = s->clock().dt_old;
  for (Index k = 0; k < s->world().nodes.size(); ++k)
    if (s->world().nodes.id[k] == 225) return s->world().nodes.x.vec(k)[2] - 0.01;
  return 0;
}

const char* const exact = "*CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET";
const char* const beam = "*CONTACT_TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET";

TEST(BeamOffset, IsExactWhereThatCanBe) {
  Real dt = 0;
  EXPECT_EQ(deflection(cantilever(beam), dt), deflection(cantilever(exact), dt));
}

TEST(BeamOffset, SpringsHoldRotationsWhereItCannot) {
  // a death beyond the run and before ENDTIM asks for springs
  Real dt = 0, dt_springs = 0;
  const Real of_exact = deflection(cantilever(exact), dt);
  EXPECT_NEAR(of_exact, 0.06 * 0.465484 / (3 * 1e9 * 0.1 * 1e-6 / 12), 0.1 * of_exact);
  const Real of_springs = deflection(cantilever(beam, 0.01, "1", "", "5."), dt_springs);
  EXPECT_NEAR(of_springs, of_exact, 0.05 * of_exact);
  // what ties displacements alone is a hinge
  const Real of_hinge = deflection(cantilever("*CONTACT_TIED_NODES_TO_SURFACE_OFFSET"), dt);
  EXPECT_GT(std::abs(of_hinge), 2 * of_exact);
}

TEST(BeamOffset, SameBitsAfterARestart) {
  test::expect_same_after_restart(cantilever(beam, 0.01, "1", "", "5."), 300, 300);
}

TEST(BeamOffset, PartsOfBeamsAreTiedByTheirNodes) {
  for (const char* const contact : {beam, exact, "*CONTACT_SPOTWELD"}) {
    const std::string deck =
        "*KEYWORD\n*CONTROL_TERMINATION\n1.\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n"
        "11,.4,.4,0\n12,.4,.4,.5\n13,1.,0,.5\n*ELEMENT_SHELL\n1,1,1,2,3,4\n*ELEMENT_BEAM\n2,2,11,12,13\n"
        "*PART\nsheet\n1,1,1\n*PART\npost\n2,2,1\n*SECTION_SHELL\n1,2,0.833333,3\n0.01\n"
        "*SECTION_BEAM\n2,1,0.833333,2\n0.05,0.05,0.05,0.05\n*MAT_ELASTIC\n1,1000.,1.E9,0.3\n" +
        std::string(contact) + "\n2,1,3,3\n0.\n1.,1.\n*INITIAL_VELOCITY_NODE\n12,0.,0.,1.\n*END\n";
    Diagnostics diagnostics;
    const auto s = Simulation::build("deck.k", in_memory(deck), diagnostics);
    ASSERT_TRUE(s) << contact << diagnostics.text();
    EXPECT_EQ(diagnostics.text().find("nothing is tied"), std::string::npos) << contact << diagnostics.text();
    test::run(*s, 0.01);
    Real fastest = 0;  // of the sheet, which the post takes with it
    for (Index k = 0; k < s->world().nodes.size(); ++k)
      if (s->world().nodes.id[k] <= 4) fastest = std::max(fastest, s->world().nodes.v.vec(k).norm());
    EXPECT_GT(fastest, 1e-3) << contact;
  }
}

}  // namespace
}  // namespace courant
