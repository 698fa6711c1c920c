// *INITIAL_STRESS_SPH: particles that start under the pressure a deck asks for.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "../../generate_deck.hpp"
#include "app/run/simulation.hpp"
#include "sph/materials/initial_stress.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

class InitialStress : public ::testing::Test {
 protected:
  fs::path base_ = fs::temp_directory_path() / ("courant_stress_" + std::to_string(::getpid()));
  void TearDown() override {
    for (const char* end : {".k", ".yaml"}) fs::remove(base_.string() + end);
  }

  std::unique_ptr<Simulation> built(const std::string& deck) {
    std::ofstream(base_.string() + ".k") << deck;
    Diagnostics diagnostics;
    auto s = Simulation::build(base_.string() + ".k", {}, diagnostics);
    messages_ = diagnostics.text();
    return s;
  }

  /// keyword_decks/still_water with a line more for the water.
  std::unique_ptr<Simulation> still_water(const std::string& line) {
    std::stringstream text;
    text << std::ifstream(std::string(SOURCE_DIR) + "/keyword_decks/still_water/scene.yaml").rdbuf();
    std::string scene = text.str();
    const std::string mark = "    hourglass: 1\n";
    scene.insert(scene.find(mark) + mark.size(), line);
    std::ofstream(base_.string() + ".yaml") << scene;
    Diagnostics diagnostics;
    EXPECT_TRUE(test::generate_deck(base_.string() + ".yaml", base_.string() + ".k", {{"resolution", "16"}},
                                    diagnostics))
        << diagnostics.text();
    auto s = Simulation::build(base_.string() + ".k", {}, diagnostics);
    EXPECT_TRUE(s) << diagnostics.text();
    return s;
  }
  std::string messages_;
};

/// Two particles of a gas or liquid, and the stress of the first.
std::string pair_of(const std::string& eos, const std::string& stress, const std::string& pc = "-1.0E20") {
  return R"(*KEYWORD
*NODE
       1             0.1             0.0             0.0
       2             0.2             0.0             0.0
*ELEMENT_SPH
       1       1            10.0
       2       1            10.0
*PART
water
         1         1         1         1
*SECTION_SPH
         1       1.2       1.0       1.0
*MAT_NULL
1,1000.0,)" +
         pc + "\n*EOS_" + eos + R"(
*CONTROL_SPH
         1         0    1.0E20         2
*CONTROL_TERMINATION
       1.0
*INITIAL_STRESS_SPH +
)" + stress +
         "\n*END\n";
}

TEST_F(InitialStress, GivesEachLawTheDensityOfThePressure) {
  const std::string laws[] = {"LINEAR_POLYNOMIAL\n1,0.0,9.0E5,3.0E5,2.0E5",
                              "LINEAR_POLYNOMIAL\n1,1.0,9.0E5,3.0E5,2.0E5,0.3,0.2,0.1\n4.0E4,0.99",
                              "MURNAGHAN\n1,7.0,1.0E5", "GRUNEISEN\n1,30.0,1.979,0.0,0.0,0.11,3.0,1.0E4",
                              "IDEAL_GAS\n1,718.0,1005.0,,,0.5"};
  for (const std::string& law : laws)
    for (const Real p : {2e5, 1e3, -2e4}) {
      if (p < 0 && law[0] == 'I') continue;  // a gas has no tension
      const std::string sigma = std::to_string(-p);
      const auto s = built(pair_of(law, "1," + sigma + "," + sigma + "," + sigma));
      ASSERT_TRUE(s) << law << messages_;
      std::string who;
      s->evaluate(who);
      const Particles& q = s->world().particles;
      const Index i = q.id[0] == 1 ? 0 : 1;
      // rho carries 16 digits, so p is exact to 16 digits of the bulk modulus
      EXPECT_NEAR(q.p[i], p, 4e-16 * std::max(1000.0, q.rho[i]) * q.c[i] * q.c[i] + 1e-15 * std::abs(p))
          << law;
      EXPECT_EQ(q.m[i], 10);
      EXPECT_GT(std::abs(q.rho[i] - q.rho[1 - i]), 1e-4) << law;  // the other one is as it was
    }
}

TEST_F(InitialStress, RefusesByNameWhatNoDensityGives) {
  const std::string liquid = "LINEAR_POLYNOMIAL\n1,0.0,9.0E5";
  EXPECT_FALSE(built(pair_of(liquid, "1,1.0E6,1.0E6,1.0E6")));
  EXPECT_NE(
      messages_.find("*INITIAL_STRESS_SPH field 2 (SIGXX, stress component, -p [M/LT2]): the equation of "
                     "state of part 1 has no density with the pressure -1e+06 and the energy E0 = 0"),
      std::string::npos)
      << messages_;
  EXPECT_FALSE(built(pair_of(liquid, "1,100.0,100.0,100.0", "-50.0")));
  EXPECT_NE(messages_.find("the pressure -100 is below PC = -50"), std::string::npos) << messages_;
  EXPECT_TRUE(built(pair_of(liquid, "1,50.0,50.0,50.0", "-50.0"))) << messages_;
  EXPECT_FALSE(built(pair_of("IDEAL_GAS\n1,718.0,1005.0,,,0.5", "1,0.0,0.0,0.0")));
}

TEST_F(InitialStress, AHydrostaticColumnHardlyMovesAtTheStart) {
  Real kinetic[2];
  for (const bool pressed : {false, true}) {
    const auto s = still_water(pressed ? "    pressure: rho0 * g * (depth - y)\n" : "");
    std::string who;
    s->evaluate(who);
    const Particles& p = s->world().particles;
    for (Index i = 0; pressed && i < p.size(); ++i)
      EXPECT_NEAR(p.p[i], 9810 * (0.5 - p.x.vec(i)[1]), 1e-9 * 9810 * 0.5);
    kinetic[pressed] = 0;
    while (s->clock().t < 0.03) {
      s->step([&](World& world, const Clock& clock, const std::string&) {
        sample_energy(world, clock);
        kinetic[pressed] = std::max(kinetic[pressed], world.energy.kinetic);
      });
    }
  }
  // Not less than that: at the bed neighbours are missing on one side, and the wall carries nothing before
  // particles are in it.
  EXPECT_LT(kinetic[1], 0.2 * kinetic[0]);
}

}  // namespace
}  // namespace courant
