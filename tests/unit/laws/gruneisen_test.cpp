// *EOS_GRUNEISEN and *EOS_IDEAL_GAS beyond the values that the registry's test compares.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "keyword/deck.hpp"
#include "laws/eos/eos.hpp"

using namespace courant;

namespace {

std::shared_ptr<EosLaw> law_of(const std::string& keyword, const std::string& cards, Real rho0) {
  const auto path =
      std::filesystem::temp_directory_path() / ("gruneisen_test_" + std::to_string(::getpid()) + ".k");
  std::ofstream(path) << "*KEYWORD\n*" << keyword << "\n" << cards << "\n*END\n";
  Diagnostics diagnostics;
  const Deck deck = read_deck(path.string(), {}, diagnostics);
  std::filesystem::remove(path);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  for (const EosEntry& kind : eos_registry())
    for (const auto& [id, law] : kind.all(deck, Model{})) return law->at_density(rho0);
  return nullptr;
}

}  // namespace

TEST(Gruneisen, PressureOnTheHugoniotIsThatOfTheShock) {
  // Behind a shock of velocity us = C + S1 up into material at rest without pressure: p = rho0 us up,
  // mu = up/(us - up), E = rho0 up^2/2. With GAMMA0 the law must give the same p there, to the order up^2
  // to which LS-DYNA's numerator is the Hugoniot's; with GAMMA0 = 0 exactly.
  const Real rho0 = 1000, C = 1484, S1 = 1.979;
  const auto cold = law_of("EOS_GRUNEISEN", "1,1484.0,1.979", rho0);
  const auto warm = law_of("EOS_GRUNEISEN", "1,1484.0,1.979,0.0,0.0,0.11,3.0", rho0);
  for (const Real up : {1.0, 100.0, 500.0}) {
    const Real us = C + S1 * up, mu = up / (us - up), p = rho0 * us * up;
    EXPECT_NEAR(cold->pressure(mu, 0), p, 1e-9 * p);
    EXPECT_NEAR(warm->pressure(mu, 0.5 * rho0 * up * up), p, 0.5 * std::pow(mu, 2) * p);
  }
}

TEST(Gruneisen, EndsAtThePoleOfItsHugoniot) {
  const auto end = [](const std::string& s) {
    return law_of("EOS_GRUNEISEN", "1,1484.0," + s, 1)->mu_limit();
  };
  EXPECT_NEAR(end("1.979"), 1 / 0.979, 1e-14);
  EXPECT_TRUE(std::isinf(end("1.0")));
  EXPECT_TRUE(std::isinf(end("0.5")));
  EXPECT_TRUE(std::isinf(end("2.56,-1.986,0.2268")));  // water of Steinberg 1996
  // all terms: where the denominator of the formula vanishes
  const auto D = [](Real mu) {
    const Real r = mu / (1 + mu);
    return 1 - 0.25 * mu - 0.25 * mu * r - 0.5 * mu * r * r;
  };
  const Real mu = end("1.25,0.25,0.5");
  ASSERT_LT(mu, 10);
  EXPECT_NEAR(D(mu), 0, 1e-14);
  for (int k = 0; k < 1000; ++k) EXPECT_GT(D(mu * k / 1000), 0);
}

TEST(IdealGas, TakesItsEnergyFromTheTemperature) {
  const auto air = law_of("EOS_IDEAL_GAS", "1,718.0,1005.0,,,300.0,0.5", 1.2);
  EXPECT_DOUBLE_EQ(air->E0, 718 * 1.2 * 300);
  EXPECT_DOUBLE_EQ(air->V0, 0.5);
  // rho = 2.4: p = rho R T, c^2 = gamma R T
  EXPECT_NEAR(air->pressure(1, air->E0), 2.4 * 287 * 300, 1e-9);
  EXPECT_NEAR(air->sound_speed2(1.2, 1, air->E0), 1005.0 / 718 * 287 * 300, 1e-8);
}
