// *SECTION_BEAM with SECTION_01 ...: the measures of the standard sections of *INTEGRATION_BEAM.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "elements/beam/standard_section.hpp"
#include "solid_decks.hpp"

using namespace courant;
using namespace courant::test::beams;
using test::simulation_of;

namespace {

/// End of a cantilever of length 1 under a load along y (N3, s) or z (t), in the middle of its vibration at
/// rest.
Vec tip_of(const std::string& section, const std::string& more = "") {
  constexpr int n = 8;
  BeamDeck deck;
  deck.part(1, section, "*MAT_ELASTIC\n         1    7850.0   2.1E+08       0.3\n");
  deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += more +
                "*LOAD_NODE_POINT\n9,2,1,1.0\n9,3,1,1.0\n*DEFINE_CURVE\n1\n0.0,0.0\n2.0,1.0\n90.0,1.0\n"
                "*DAMPING_GLOBAL\n0,8.0\n";
  auto s = simulation_of(deck.text(20));
  while (s->clock().t < 4) s->step(test::do_nothing);
  return s->world().nodes.x.vec(n);
}

}  // namespace

// A box tube of 40 x 60 mm, 2 and 3 mm thick: by hand, and with the same measures given.
TEST(StandardSections, ResultantsAreThoseOfTheProfile) {
  const Real A = 0.04 * 0.06 - 0.034 * 0.056,
             ss = (0.04 * std::pow(0.06, 3) - 0.034 * std::pow(0.056, 3)) / 12,
             tt = (0.06 * std::pow(0.04, 3) - 0.056 * std::pow(0.034, 3)) / 12;
  const Real w = 0.037, h = 0.058, J = 2 * w * w * h * h / (w / 0.002 + h / 0.003);
  const std::string given =
      fmt::format("         2\n{:10.4e}{:10.4e}{:10.4e}{:10.4e}{:10.4e}\n", A, ss, tt, J, 2 * 0.003 * 0.06);
  const std::string named = "         2\nSECTION_05      0.04     0.002      0.06     0.003\n";
  EXPECT_NEAR((tip_of(named) - tip_of(given)).norm() / tip_of(given).tail<2>().norm(), 0, 1e-3);
  EXPECT_NEAR(tip_of(named)[1] / (1 / (3 * 2.1e8 * tt)), 1, 0.02);
  EXPECT_NEAR(tip_of(named)[2] / (1 / (3 * 2.1e8 * ss)), 1, 0.03);
}

// The same points as by *INTEGRATION_BEAM with ICST, to the bit; lower case and parameters as in other
// fields.
TEST(StandardSections, PointsAreThoseOfIntegrationBeam) {
  const Vec by_rule =
      tip_of("         1       1.0        -3         2\n      0.04      0.04      0.06      0.06\n",
             "*INTEGRATION_BEAM\n         3         0       0.0         1\n      0.04     0.004      0.06    "
             " 0.003\n");
  EXPECT_EQ(
      tip_of(
          "         1       1.0         2         2\nSECTION_01      0.04     0.004      0.06     0.003\n"),
      by_rule);
  EXPECT_EQ(tip_of("         1       1.0         2         2\nsection_01,0.04,0.004,0.06,0.003\n"), by_rule);
}

TEST(StandardSections, TorsionAndMoments) {
  std::string why;
  EXPECT_NEAR(standard_section(11, {2, 2, 0, 0}, 1, why).torsion / (16 * 0.1406), 1, 5e-3);
  EXPECT_NEAR(standard_section(11, {6, 2, 0, 0}, 1, why).torsion / (48 * 0.2633), 1, 5e-3);
  EXPECT_NEAR(standard_section(8, {2, 0, 0, 0}, 1, why).torsion / (8 * pi), 1, 1e-12);
  EXPECT_NEAR(standard_section(9, {2, 1, 0, 0}, 1, why).torsion / (7.5 * pi), 1, 1e-12);
  EXPECT_NEAR(standard_section(1, {60, 3, 80, 2}, 1, why).torsion / ((120 * 27 + 74 * 8) / 3.0), 1, 1e-12);
  EXPECT_NEAR(standard_section(5, {60, 2, 80, 2}, 1, why).torsion / (2 * 58.0 * 58 * 78 * 78 / (29 + 39)), 1,
              1e-12);
  // an angle of equal legs: product moment, about its centroid
  const auto angle = standard_section(3, {10, 1, 10, 1}, 1, why).moments();
  const Real A1 = 10, A2 = 9, s = (A1 * 0 + A2 * -4.5) / 19, t = (A1 * -4.5 + A2 * 0.5) / 19;
  EXPECT_NEAR(angle.st, A1 * (0 - s) * (-4.5 - t) + A2 * (-4.5 - s) * (0.5 - t), 1e-9);
  EXPECT_NEAR(angle.area, 19, 1e-12);
}
