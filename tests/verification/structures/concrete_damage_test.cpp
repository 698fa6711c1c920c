// *MAT_CONCRETE_DAMAGE_REL3: one-element decks as users write them, with generated and given compaction.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits_of_material.hpp"

using namespace courant;
using test::do_nothing;
using test::driven_cube;
using test::simulation_of;

namespace concrete_damage_test {

namespace {

constexpr Real fc = 30, ft = 2.9038, K = 11884.4;
/// 30 MPa; an inch is the unit of length, and the size of cubes. G = 0.75 K.
std::string concrete(const std::string& omega = "", const std::string& rates = "") {
  return fmt::format(
      "*MAT_CONCRETE_DAMAGE_REL3\n1,1.0,0.2\n0.0,-30.0,,,,{}\n0,0,0,1.0,145.0377377{}\n\n\n\n\n", omega,
      rates);
}
const std::string rate_curve = "*DEFINE_CURVE\n7\n-1.0,3.0\n0.0,1.0\n1.0,2.0\n";
const std::string eos =
    "*EOS_TABULATED_COMPACTION\n5\n0.0,-0.002,-0.2\n\n0.0,24.0,420.0\n\n0.0\n\n12e3,12e3,20e3\n\n";
std::string with_eos(std::string deck) {
  const auto at = deck.find("1,1,1\n");
  return deck.replace(at, 6, "1,1,1,5\n");
}
/// What the element exerts along x at its end.
Real force_of(Simulation& s) {
  Real sum = 0;
  for (const int corner : {1, 2, 5, 6}) sum += s.world().groups[0]->corner_force->data(3 * corner)[0];
  return std::abs(sum);
}
/// Work of a bar over the area of its crack: stress over the plastic strain along it, by lambda.
Real work_of_tension() {
  const Real x[] = {0, 8e-6, 2.4e-5, 4e-5, 5.6e-5, 7.2e-5, 8.8e-5, 3.2e-4, 5.2e-4, 5.7e-4};
  const Real y[] = {0, 0.85, 0.97, 0.99, 1, 0.99, 0.97, 0.5, 0.1, 0};
  Real area = 0;
  for (int k = 1; k < 10; ++k)
    for (int n = 0; n < 1000; ++n) {
      const Real share = (n + 0.5) / 1000, eta = y[k - 1] + share * (y[k] - y[k - 1]);
      const Real m = k <= 4 ? 0.5 * (1.35 + 1.65 * eta) : 1.5 * eta, stress = m * ft / (1 + m / 3);
      const Real dilates = 0.5 * (k <= 4 ? 1 : eta) * m;
      area += stress * (1 + dilates / 3) * (x[k] - x[k - 1]) / 1000 * std::pow(1 - stress / (3 * ft), 1.35) /
              std::sqrt(1 + 2.0 / 9 * dilates * dilates);
    }
  return area;
}

}  // namespace

// A cube torn slowly: its strength, and the energy that it has taken when no stress is left.
TEST(ConcreteDamage, TornCubeTakesItsEnergy) {
  auto s = simulation_of(driven_cube(1, concrete(), "0.0,2e-5\n1e9,2e-5\n", false).text(1e9));
  test::start_ledger(*s);
  Real top = 0;
  while (s->clock().t < 40) s->step(do_nothing), top = std::max(top, force_of(*s));
  EXPECT_NEAR(top, ft, 0.01 * ft);
  EXPECT_LT(force_of(*s), 0.05 * ft);
  sample_energy(s->world(), s->clock());
  EXPECT_NEAR(s->world().energy.internal, work_of_tension(), 0.04 * work_of_tension());
  EXPECT_LT(test::energy_error(*s), 0.01);
}

TEST(ConcreteDamage, CrushedCubeBearsItsStrength) {
  auto s = simulation_of(driven_cube(1, concrete(), "0.0,-1e-4\n1e9,-1e-4\n", false).text(1e9));
  test::start_ledger(*s);
  Real top = 0;
  while (s->clock().t < 80) s->step(do_nothing), top = std::max(top, force_of(*s));
  EXPECT_NEAR(top, fc, 0.01 * fc);
  EXPECT_LT(force_of(*s), 0.6 * fc);
  EXPECT_LT(test::energy_error(*s), 0.01);
}

// Pressed between walls the mean stress is the curve of compaction, generated or that of the part's equation
// of state; OMEGA is next to nothing.
TEST(ConcreteDamage, CompactionIsThatOfTheTable) {
  for (const bool given : {false, true}) {
    const std::string text =
        driven_cube(1, concrete("1e-9") + (given ? eos : ""), "0.0,-1e-2\n1e9,-1e-2\n", true).text(1e9);
    auto s = simulation_of(given ? with_eos(text) : text);
    test::run_until(*s, 6);
    const auto& stress = *dynamic_cast<const Field<Real>*>(s->world().groups.at(0)->fields.find("stress"));
    const Real p = -(stress.data(0)[0] + stress.data(1)[0] + stress.data(2)[0]) / 3;
    const Real e = -std::log(1 - 1e-2 * s->clock().t), P = 0.0015 * K;
    const Real made = P * (10.03 + (14.23 - 10.03) * (e - 0.0513) / (0.0726 - 0.0513));
    EXPECT_NEAR(p, given ? 24 + 2000 * (e - 0.002) : made, 0.005 * made) << given;
  }
}

TEST(ConcreteDamage, ErodesByMatAddErosion) {
  auto s = simulation_of(
      driven_cube(1, concrete() + "*MAT_ADD_EROSION\n1\n,,,0.05\n", "0.0,1e-2\n1e9,1e-2\n", false).text(1e9));
  while (s->world().counters["deleted_elements"] == 0 && s->clock().t < 20) s->step(do_nothing);
  EXPECT_NEAR(std::log(1 + 1e-2 * s->clock().t), 0.05, 0.002);
}

TEST(ConcreteDamage, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  test::expect_same_bits_of_block(concrete());
  test::expect_same_bits_of_block(concrete("0.9", ",7") + rate_curve);
}

}  // namespace concrete_damage_test
