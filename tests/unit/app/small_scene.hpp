#pragma once
// Decks of a few dozen particles, each card of which a test may change.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "../keyword/decks_in_memory.hpp"
#include "app/run/simulation.hpp"

namespace courant::test {

/// A block of water of n^dim particles, 0.1 apart, its lowest ones at y = 0.05; walls and more as cards.
struct SmallScene {
  int dim = 2, n = 6;
  std::string start = "0.,0.,0.";  ///< velocity
  std::string termination = "1.";  ///< ENDTIM, ENDCYC, DTMIN, ENDENG
  std::string timestep = "";       ///< cards of *CONTROL_TIMESTEP
  std::string control_sph = "";    ///< further fields behind IDIM: MEMORY.. up to MAXV, and card 2
  std::string section = "1,1.2,1.,1.";
  std::string material = "1,1000.,-1.E20";
  std::string eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5\n";
  std::string hourglass = "1,0,0,0,1.E-20,0.1";  ///< Q1 (the quadratic coefficient), Q2 (the linear one)
  std::string box = "";                          ///< number of a box in *CONTROL_SPH
  std::string extra = "";                        ///< keywords

  std::string text() const {
    std::string nodes, particles;
    const int depth = dim == 3 ? n : 1;
    Id id = 0;
    for (int k = 0; k < depth; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          nodes += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", ++id, 0.05 + 0.1 * i, 0.05 + 0.1 * j,
                               dim == 3 ? 0.05 + 0.1 * k : 0.0);
          particles += fmt::format("{},1,{}\n", id, dim == 3 ? 1.0 : 10.0);
        }
    return "*KEYWORD\n*NODE\n" + nodes + "*ELEMENT_SPH\n" + particles +
           "*PART\nwater\n1,1,1,1,1\n*SECTION_SPH\n" + section + "\n*MAT_NULL\n" + material + "\n" + eos +
           "*HOURGLASS\n" + hourglass + "\n*CONTROL_SPH\n1," + (box.empty() ? "0" : box) +
           fmt::format(",1.E20,{}", dim) + control_sph + "\n" +
           (timestep.empty() ? "" : "*CONTROL_TIMESTEP\n" + timestep + "\n") + "*CONTROL_TERMINATION\n" +
           termination + "\n*INITIAL_VELOCITY\n0\n" + start + "\n" + extra + "*END\n";
  }
};

/// For `control_sph`: ISHIFT 1.
inline const char* const shifting_cards = "\n0\n0,0,0,,0,1";

inline const char* const gravity_cards = "*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,9.81\n100.,9.81\n";

/// A floor whose contact surface is `y` with half the thickness 0.05 below the water. SFSA scales its
/// stiffness.
inline std::string floor_cards(Real y = -0.025, Real sfsa = 1, const std::string& rigid = "1,7,7") {
  return fmt::format(
      "*NODE\n9001,-2.,{0},-2.\n9002,3.,{0},-2.\n9003,3.,{0},3.\n9004,-2.,{0},3.\n"
      "*ELEMENT_SHELL\n1,2,9001,9002,9003,9004\n*PART\nfloor\n2,2,2\n*SECTION_SHELL\n2,2\n0.05\n"
      "*MAT_RIGID\n2,7850.,2.1E11,0.3\n{2}\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n{1}\n",
      y, sfsa, rigid);
}

/// Steps until `until` [T], without output.
inline void run(Simulation& s, Real until) {
  while (s.clock().t < until) s.step([](World&, const Clock&, const std::string&) {});
}
inline void steps(Simulation& s, int n) {
  for (int k = 0; k < n; ++k) s.step([](World&, const Clock&, const std::string&) {});
}

/// The deck `text` read, which must be without a word of warning unless `silent` is off. Null where it was
/// refused, which fails the test.
inline std::unique_ptr<Simulation> build_deck(const std::string& text, bool silent = true) {
  Diagnostics diagnostics;
  auto s = Simulation::build("deck.k", in_memory(text), diagnostics);
  EXPECT_TRUE(s != nullptr && (!silent || diagnostics.text().empty())) << diagnostics.text();
  return s;
}

inline std::unique_ptr<Simulation> build(const SmallScene& scene) {
  return build_deck(scene.text(), false);
}

}  // namespace courant::test
