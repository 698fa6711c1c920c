// Beams and trusses of other materials than the elastic and the piecewise linear one.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "elements/element_report.hpp"
#include "solid_decks.hpp"

using namespace courant;
using namespace courant::test::beams;
using test::simulation_of;

namespace {

/// ELFORM 3 of area 1e-4, and ELFORM 1 of 10 mm x 10 mm, 3 x 3 points.
const std::string truss = "         3\n    1.0E-4\n", square = square_1;

struct Pulled {
  Real stress = 0, strain = 0;  ///< true ones [M/LT2], [-]
  std::int64_t deleted = 0;
};
/// A beam of length 1 that is drawn to 1 + `by` within 1 s: slow against its waves.
Pulled pulled(const std::string& section, const std::string& material, Real by) {
  BeamDeck deck;
  deck.part(1, section, material);
  deck.line(1, 1, [](int k) { return k == 0 ? ",7,7" : ",5,7"; });
  deck.cards += fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,2,1\n*DEFINE_CURVE\n1\n0.,0.\n1.,{0:.16g}\n2.,{1:.16g}\n", by,
      2 * by);
  auto s = simulation_of(deck.text(1));
  if (!s) return {};
  Pulled out;
  while (s->clock().t < 1) {  // stress is that of the positions from which a step begins
    out.strain = std::log(s->world().nodes.x.vec(1)[0] - s->world().nodes.x.vec(0)[0]);
    s->step(test::do_nothing);
  }
  const auto reporters = s->world().passes.all<ElementReporter>();
  const ElementReport report = reporters.front()->report_element(s->world(), 0, {});
  out.stress = report.resultants[0] / 1e-4;
  const auto found = s->world().counters.find("deleted_beams");
  out.deleted = found == s->world().counters.end() ? 0 : found->second;
  return out;
}

}  // namespace

// sigma_y = K (e_0 + e_p)^N with e_0 = (E/K)^(1/(N - 1)) where the curve meets Hooke's line; e_p = e -
// sigma/E. Rates follow the middle of each step: within 1e-4 after some thousand steps.
TEST(BeamMaterials, FollowAPowerLaw) {
  constexpr Real E = 7e9, K = 4e8, N = 0.2;
  for (const std::string& section : {truss, square}) {
    const Pulled p = pulled(section, "*MAT_POWER_LAW_PLASTICITY\n1,2700.,7.E9,0.33,4.E8,0.2\n\n", 0.1);
    const Real e0 = std::pow(E / K, 1 / (N - 1));
    Real stress = K * std::pow(p.strain, N);
    for (int k = 0; k < 50; ++k) stress = K * std::pow(e0 + p.strain - stress / E, N);
    EXPECT_NEAR(p.stress, stress, 1e-4 * stress) << section;
  }
}

// A + B e_p^N without rates; above PSFAIL the beam is deleted.
TEST(BeamMaterials, FollowSimplifiedJohnsonCookAndFail) {
  constexpr Real E = 7e9, A = 1e8, B = 2e8, N = 0.5;
  const auto material = [](const char* fails) {
    return fmt::format("*MAT_SIMPLIFIED_JOHNSON_COOK\n1,2700.,7.E9,0.33\n1.E8,2.E8,0.5,0.,{}\n", fails);
  };
  for (const std::string& section : {truss, square}) {
    const Pulled p = pulled(section, material("0.2"), 0.1);
    Real stress = A;
    for (int k = 0; k < 200; ++k) stress = 0.5 * (stress + A + B * std::pow(p.strain - stress / E, N));
    EXPECT_NEAR(p.stress, stress, 1e-4 * stress) << section;
    EXPECT_EQ(p.deleted, 0) << section;
    EXPECT_EQ(pulled(section, material("0.05"), 0.1).deleted, 1) << section;
  }
}
