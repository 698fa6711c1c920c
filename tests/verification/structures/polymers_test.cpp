// Polymers and rubber of *MAT_SAMP-1 and *MAT_FRAZER_NASH_RUBBER_MODEL: decks of one element as users write
// them.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "same_bits_of_material.hpp"

using namespace courant;
using test::do_nothing;
using test::driven_cube;
using test::simulation_of;

namespace polymers_test {

namespace {

/// Yield stresses 1 + e in tension, 1.3 + e in compression, 0.7 + 0.6 e in shear; from EPFAIL 0.3 on fading
/// over 0.1.
const std::string samp_card =
    "*MAT_SAMP-1\n1,1.0,0,0,100.0,0.38\n7,8,9,0,0.4\n0,0.3,0.1\n*DEFINE_CURVE\n7\n0.0,1.0\n1.0,2.0\n*DEFINE_"
    "CURVE\n8\n0.0,1.3\n1.0,2.3\n*DEFINE_CURVE\n9\n0.0,0.7\n1.0,1.3\n";
const std::string rubber_card =
    "*MAT_FRAZER_NASH_RUBBER_MODEL\n1,1.0,0.49,1.0,0.1,0.02\n0.05,0.0,0.3,0.02\n\n";

Real force_of(Simulation& s) {
  const ElementGroup& group = *s.world().groups[0];
  Real sum = 0;
  for (const int corner : {1, 2, 5, 6}) sum += group.corner_force->data(3 * corner)[0];
  return std::abs(sum);
}

}  // namespace

// A cube of 1 between plates that move at 0.002: the force is the yield stress of the plastic strain times
// the area, until it fades; the energies agree.
TEST(Polymers, BarsFollowTheirCurves) {
  for (const Real sign : {1.0, -1.0}) {
    auto s = simulation_of(
        driven_cube(1, samp_card, fmt::format("0.0,{0}\n1e9,{0}\n", sign * 0.002), false).text(1e9));
    test::start_ledger(*s);
    int compared = 0;
    while (s->clock().t < 300 && s->world().counters["deleted_elements"] == 0) {
      s->step(do_nothing);
      const Real total = std::abs(std::log(1 + sign * 0.002 * s->clock().t)), first = sign > 0 ? 1 : 1.3;
      // total = e + (first + e)/E
      const Real e = (total - first / 100) / (1 + 1 / 100.0), stress = first + e;
      if (!(e > 0.03) || !(e < 0.29)) continue;
      const Real across = std::exp(-2 * (0.4 * e + 0.38 * stress / 100) * sign);
      EXPECT_NEAR(force_of(*s) / (stress * across), 1, 0.01) << e;
      ++compared;
    }
    EXPECT_GT(compared, 100);
    EXPECT_LT(test::energy_error(*s), 0.01);
    EXPECT_EQ(s->world().counters["deleted_elements"], 1);
    // with the elastic strain of the stress without fading
    const Real gone = 0.4 + ((sign > 0 ? 1 : 1.3) + 0.4) / 100;
    EXPECT_NEAR(std::abs(std::log(1 + sign * 0.002 * s->clock().t)), gone, 0.004);
  }
}

TEST(Polymers, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const std::string& material : {samp_card, rubber_card}) test::expect_same_bits_of_block(material);
  test::expect_same_bits_of_sheet(samp_card);
}

}  // namespace polymers_test
