// *MAT_BILKHU/DUBOIS_FOAM, *MAT_SOIL_AND_FOAM, *MAT_WINFRITH_CONCRETE, *MAT_GENERAL_VISCOELASTIC and
// *MAT_ORTHOTROPIC_ELASTIC in solids: one-element decks as users write them.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits_of_material.hpp"

using namespace courant;
using test::do_nothing;
using test::driven_cube;
using test::simulation_of;

namespace foam_soil_and_cracks_test {

namespace {

const std::string foam =
    "*MAT_BILKHU/DUBOIS_FOAM\n1,1.0,2000.0,5,6,0.0,5.0\n1.0,0.0,0,0.1\n*DEFINE_CURVE\n5\n0.0,30.0\n0.5,60.0\n"
    "*DEFINE_CURVE\n6\n0.0,20.0\n0.5,50.0\n";
/// p = 1000 e up to 0.02, then 500.
const std::string soil =
    "*MAT_SOIL_AND_FOAM\n1,1.0,300.0,1000.0,1.0,0.5,0.0,-5.0\n\n-0.02,-0.2\n\n20.0,110.0\n\n";
/// RATE 1; an opening of FE = 0.002 in elements of size 1.
const std::string concrete =
    "*MAT_WINFRITH_CONCRETE\n1,1.0,30000.0,0.2,30.0,3.0,0.002,0.01\n,,,,1.0,1.0,1.0,1.0\n\n\n";
/// RATE 0: an energy of 0.003; the unit of time is a year, so that nothing is fast.
const std::string by_energy =
    "*MAT_WINFRITH_CONCRETE\n1,1.0,30000.0,0.2,30.0,3.0,0.003,0.01\n,,,,0.0,1.0e21,1.0,3.15e7\n\n\n";

/// What the element exerts along x at its end.
Real force_of(Simulation& s) {
  Real sum = 0;
  for (const int corner : {1, 2, 5, 6}) sum += s.world().groups[0]->corner_force->data(3 * corner)[0];
  return std::abs(sum);
}

}  // namespace

// Crushed along x, the sides free: LCUYS over -ln V, of which PR leaves 0.8 of the strain.
TEST(FoamSoilAndCracks, FoamCubeBearsItsCurve) {
  auto s = simulation_of(driven_cube(1, foam, "0.0,-1e-2\n1e9,-1e-2\n", false).text(1e9));
  test::start_ledger(*s);
  test::run_until(*s, 30);
  const Real along = std::log(1 - 1e-2 * s->clock().t), e = -0.8 * along, area = std::exp(-0.2 * along);
  EXPECT_NEAR(force_of(*s), area * (20 + 60 * e), 0.02 * 35);
  EXPECT_LT(test::energy_error(*s), 0.01);
}

// Between walls the mean stress is the table, and q follows A0 + A1 p.
TEST(FoamSoilAndCracks, SoilIsCompacted) {
  auto s = simulation_of(driven_cube(1, soil, "0.0,-1e-2\n1e9,-1e-2\n", true).text(1e9));
  test::start_ledger(*s);
  test::run_until(*s, 10);
  const auto& stress = *dynamic_cast<const Field<Real>*>(s->world().groups.at(0)->fields.find("stress"));
  const Real x = stress.data(0)[0], y = stress.data(1)[0], p = -(x + y + stress.data(2)[0]) / 3;
  const Real e = -std::log(1 - 1e-2 * s->clock().t), table = 20 + 500 * (e - 0.02);
  EXPECT_NEAR(p, table, 0.01 * table);
  EXPECT_NEAR((y - x) * (y - x) / 3, 1 + 0.5 * p, 0.01 * table);
  EXPECT_LT(test::energy_error(*s), 0.01);
}

// A cube torn slowly: UTS, and the work of its crack: half of UTS FE, or FE.
TEST(FoamSoilAndCracks, TornConcreteTakesTheEnergyOfItsCrack) {
  for (const bool energy : {false, true}) {
    auto s =
        simulation_of(driven_cube(1, energy ? by_energy : concrete, "0.0,2e-5\n1e9,2e-5\n", false).text(1e9));
    test::start_ledger(*s);
    Real top = 0;
    while (s->clock().t < (energy ? 260 : 110)) s->step(do_nothing), top = std::max(top, force_of(*s));
    EXPECT_NEAR(top, 3, 0.03);
    EXPECT_LT(force_of(*s), 0.05);
    sample_energy(s->world(), s->clock());
    EXPECT_NEAR(s->world().energy.internal, 0.003, 0.03 * 0.003) << energy;
    EXPECT_LT(test::energy_error(*s), 0.01);
  }
}

TEST(FoamSoilAndCracks, CrushedConcreteBearsItsStrength) {
  auto s = simulation_of(driven_cube(1, concrete, "0.0,-1e-4\n1e9,-1e-4\n", false).text(1e9));
  test::start_ledger(*s);
  test::run_until(*s, 40);
  EXPECT_NEAR(force_of(*s), 30, 0.4);
  EXPECT_LT(test::energy_error(*s), 0.01);
}

// Wood: 1/E of each direction, a turned by A and D from x to y.
TEST(FoamSoilAndCracks, WoodHasTheStiffnessOfItsDirections) {
  for (const bool turned : {false, true}) {
    const std::string wood =
        std::string(
            "*MAT_ORTHOTROPIC_ELASTIC\n1,1.0,1000.0,80.0,50.0,0.03,0.02,0.3\n60.0,5.0,70."
            "0,2.0\n0,0,0,") +
        (turned ? "0,1,0\n0,0,0,-1,0,0\n" : "1,0,0\n0,0,0,0,1,0\n");
    auto s = simulation_of(driven_cube(1, wood, "0.0,1e-4\n1e9,1e-4\n", false).text(1e9));
    test::start_ledger(*s);
    test::run_until(*s, 30);
    const Real E = turned ? 80 : 1000;
    EXPECT_NEAR(force_of(*s), E * 1e-4 * s->clock().t, 0.03 * E * 3e-3) << turned;
    EXPECT_LT(test::energy_error(*s), 0.01);
  }
}

TEST(FoamSoilAndCracks, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  test::expect_same_bits_of_block(foam);
  test::expect_same_bits_of_block(soil);
  test::expect_same_bits_of_block(concrete);
  test::expect_same_bits_of_block(by_energy);
  const std::string three_terms =
      "*MAT_GENERAL_VISCOELASTIC\n1,1.0,50.0\n\n10.0\n20.0,0.1\n5.0,2.0,30.0,0.5\n";
  test::expect_same_bits_of_block(three_terms);
  test::expect_same_bits_of_sheet(three_terms);
}

}  // namespace foam_soil_and_cracks_test
