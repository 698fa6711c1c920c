// Flow stress, damage and spall of *MAT_JOHNSON_COOK and its relatives.
#include <gtest/gtest.h>

#include <cmath>

#include "law_from_cards.hpp"

using namespace courant;
using test::law_from_cards;

namespace {

/// One point beside an equation of state.
struct HydroPoint {
  explicit HydroPoint(std::shared_ptr<StrengthLaw> of) : law(std::move(of)) {
    for (const HistoryVariable& h : law->history()) history.resize(history.size() + h.components, 0.0);
  }
  std::shared_ptr<StrengthLaw> law;
  std::array<Real, 6> stress{};
  std::vector<Real> history;
  Real p = 0, least = 0, c = 0;

  /// Shear by rate D_xy over dt.
  void shear(Real rate, Real dt) { strain({0, 0, 0, rate, 0, 0}, dt); }
  void strain(const std::array<Real, 6>& rate, Real dt) {
    PointBlock block;
    block.count = 1, block.dt = dt;
    std::vector<Real*> kept;
    for (Real& h : history) kept.push_back(&h);
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    least = law->pressure_cutoff();
    block.pressure = &p, block.least_pressure = &least, block.sound_speed = &c, block.history = kept;
    law->update(block);
  }
  Real q() const {
    Real s = 0;
    for (std::size_t k = 0; k < 6; ++k) s += (k < 3 ? 1 : 2) * stress[k] * stress[k];
    return std::sqrt(1.5 * s);
  }
};

/// Copper (OFHC) of Johnson and Cook 1983, MPa: A 90, B 292, N 0.31, C 0.025, M 1.09; melts 1000 above the
/// room, heat capacity such that nothing gets warm. `vp`, `rest`: as on the cards.
std::string copper(int vp = 0, const std::string& rest = "1e30\n") {
  return fmt::format("1,8.96e-9,46000.0,,,,{},0.0\n90.0,292.0,0.31,0.025,1.09,1300.0,300.0,1.0\n{}", vp,
                     rest);
}

}  // namespace

// Numbers of the formula, worked out apart from this program.
TEST(MatJohnsonCook, HasTheFlowStressOfCopper) {
  struct FlowRow {
    Real e, rate, cold, half_melted;
  };
  for (const FlowRow& row : {FlowRow{0.1, 1, 233.0154, 123.5538},
                             {0.1, 1e4, 286.6692, 152.0031},
                             {0.5, 1, 325.5394, 172.6136},
                             {0.5, 1e4, 400.4976, 212.3593},
                             {1, 1, 382, 202.5512},
                             {1, 1e4, 469.9588, 249.1903}})
    for (const int vp : {0, 1})
      for (const bool warm : {false, true}) {
        HydroPoint point(law_from_cards("MAT_JOHNSON_COOK", copper(vp)));
        const Real expected = warm ? row.half_melted : row.cold;
        point.history = {row.e, warm ? 500.0 : 0.0};
        point.stress[3] = expected / std::sqrt(3.0);
        // effective rate 2 D_xy/sqrt(3); a step that adds a millionth of strain
        point.shear(row.rate * std::sqrt(3.0) / 2, 1e-6 / row.rate);
        EXPECT_NEAR(point.q() / expected, 1, 1e-5) << row.e << " " << row.rate << " " << warm << " VP " << vp;
        EXPECT_NEAR(point.history[0] - row.e, 1e-6, 1e-8);
      }
}

TEST(MatJohnsonCook, FollowsTheOtherFormsOfTheRate) {
  const auto flow = [](const char* cards, Real rate) {
    HydroPoint point(law_from_cards("MAT_JOHNSON_COOK", cards));
    for (int k = 0; k < 1000; ++k) point.shear(rate * std::sqrt(3.0) / 2, 1e-5 / rate);  // until all is flow
    return point.q();
  };
  const Real x = std::log(50.0);
  EXPECT_NEAR(flow("1,1.0,1e6,,,,0,1\n100.0,,,0.02,,,,2.0\n\n,0.003\n", 100),
              100 * (1 + 0.02 * x + 0.003 * x * x), 1e-9);
  EXPECT_NEAR(flow("1,1.0,1e6,,,,0,2\n100.0,,,0.02,,,,2.0\n\n\n", 100), 100 * std::pow(50, 0.02), 1e-9);
  EXPECT_NEAR(flow("1,1.0,1e6,,,,0,3\n100.0,,,40.0,,,,2.0\n\n,5.0\n", 100), 100 * (1 + std::pow(2.5, 0.2)),
              1e-9);
  EXPECT_NEAR(flow("1,1.0,1e6,,,,0,0\n100.0,,,0.02,,,,2.0\n\n\n", 1), 100, 1e-9) << "below EPSO";
}

// All plastic work heats: RO CP dT = integral of q de, here of perfect plasticity.
TEST(MatJohnsonCook, IsHeatedByPlasticWork) {
  HydroPoint point(law_from_cards("MAT_JOHNSON_COOK", "1,2.0,1e6\n100.0,,,,1.0,1e15,0.0\n25.0\n\n"));
  for (int k = 0; k < 100; ++k) point.shear(1, 0.01);
  EXPECT_NEAR(point.history[1], 100 * point.history[0] / (2 * 25), 1e-9);
  EXPECT_GT(point.history[0], 1);
  // until it melts: TM - TR = 2 with a capacity of 1
  HydroPoint melts(law_from_cards("MAT_JOHNSON_COOK", "1,2.0,1e6\n100.0,,,,1.0,302.0,300.0\n1.0\n\n"));
  for (int k = 0; k < 3000; ++k) melts.shear(1, 0.01);
  EXPECT_LT(melts.q(), 1e-3 * 100);
}

// Strain at fracture (D1 + D2 exp(D3 sigma_m/q)) (1 + D4 ln rate) (1 + D5 T*): damage is what is spent of it.
TEST(MatJohnsonCook, IsDamaged) {
  const std::string cards = "1,1.0,1e6\n100.0,,,,1.0,1300.0,300.0,1.0\n1e30,,,,0.5,3.0,-2.0,0.1\n0.4\n";
  for (const Real p : {-50.0, 0.0, 100.0})
    for (const Real warm : {0.0, 500.0}) {
      HydroPoint point(law_from_cards("MAT_JOHNSON_COOK", cards));
      EXPECT_EQ(point.law->failure_variable(), "damage");
      EXPECT_EQ(point.law->failure_limit(), 1);
      point.p = p, point.history[1] = warm;
      point.shear(10 * std::sqrt(3.0) / 2, 1e-2);
      const Real flow = 100 * (1 - warm / 1000);
      const Real fracture =
          (0.5 + 3 * std::exp(-2 * -p / flow)) * (1 + 0.1 * std::log(10.0)) * (1 + 0.4 * warm / 1000);
      EXPECT_NEAR(point.history[2] * fracture / point.history[0], 1, 1e-9) << p << " " << warm;
    }
  // EROD: it stays, without a deviator; EFMIN is the least
  HydroPoint kept(law_from_cards("MAT_JOHNSON_COOK", "1,1.0,1e6\n100.0\n,,,,1e-9\n0.0,,1.0,0.05\n"));
  EXPECT_TRUE(std::isinf(kept.law->failure_limit()));
  kept.shear(1, 0.04);
  EXPECT_GT(kept.q(), 99);
  EXPECT_NEAR(kept.history[1], kept.history[0] / 0.05, 1e-12);
  kept.shear(1, 0.04);
  EXPECT_EQ(kept.q(), 0);
}

TEST(Spall, ComesByPressureOrPrincipalStress) {
  for (const int option : {1, 2, 3}) {
    HydroPoint point(
        law_from_cards("MAT_JOHNSON_COOK", fmt::format("1,1.0,1e6\n1e5\n,-50.0,{}\n\n", option)));
    EXPECT_EQ(point.law->pressure_cutoff(), option == 1 ? -50 : -std::numeric_limits<Real>::infinity());
    point.p = -40, point.shear(1, 4.5e-6);  // principal stress 40 + 9
    EXPECT_GT(point.q(), 0) << option;
    point.shear(1, 1e-6);  // 40 + 11
    EXPECT_EQ(point.q() == 0, option == 2);
    point.p = -51, point.shear(1, 1e-6);
    EXPECT_EQ(point.q() == 0, option != 1);
    EXPECT_EQ(point.least, option == 1 ? -50 : 0);
    point.p = 100, point.shear(1, 1e-6);
    EXPECT_EQ(point.q() == 0, option != 1) << "for good";
    EXPECT_EQ(point.c == 0, option != 1) << "no waves of shear";
  }
}

// Included with a unit of time a thousandth of the deck's: C of RATEOP 3 is a rate, a blank EPSO is 1 of the
// file's.
TEST(MatJohnsonCook, RatesGoWithTheUnitsOfIncludedFiles) {
  const std::string sub =
      "*KEYWORD\n*MAT_JOHNSON_COOK\n1,1.0,1e6,,,,0,3\n100.0,,,40.0,,,,2.0\n,\n,5.0\n"
      "*MAT_SIMPLIFIED_JOHNSON_COOK\n2,1.0,2e6,0.0\n100.0,,,0.5\n*END\n";
  ReadOptions options;
  options.open = [&](const std::string& name) {
    const bool is_sub = name.find("sub.k") != std::string::npos;
    return std::optional<std::string>(
        is_sub ? sub : "*KEYWORD\n*INCLUDE_TRANSFORM\nsub.k\n0,0,0,0,0,0,0\n0\n1.0,0.001,1.0\n0\n*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("m.k", options, diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.text();
  for (const StrengthEntry& kind : strength_registry()) {
    const bool full = kind.keyword == "MAT_JOHNSON_COOK";
    if (!full && kind.keyword != "MAT_SIMPLIFIED_JOHNSON_COOK") continue;
    // densities and stresses change, too: M/L3 by 1, M/LT2 by 1e6; G 1e12, A 1e8
    HydroPoint point(kind.all(deck, Model()).at(0).second);
    const Real rate = 1e5;
    for (int k = 0; k < 1000; ++k) point.shear(rate * std::sqrt(3.0) / 2, 1e-5 / rate);
    const Real factor = full ? 1 + std::pow(rate / 40e3, 0.2) : 1 + 0.5 * std::log(rate / 1e3);
    EXPECT_NEAR(point.q() / (1e8 * factor), 1, 1e-9) << kind.keyword;
  }
}

TEST(MatJohnsonCook, ChecksItsCards) {
  const auto faults = [](const std::string& cards) {
    ReadOptions options;
    options.open = [&](const std::string&) {
      return std::optional<std::string>("*KEYWORD\n*MAT_JOHNSON_COOK\n" + cards + "*END\n");
    };
    Diagnostics diagnostics;
    const Deck deck = read_deck("m.k", options, diagnostics);
    for (const StrengthEntry& kind : strength_registry())
      if (kind.keyword == "MAT_JOHNSON_COOK") kind.check(deck, Model(), diagnostics);
    return diagnostics.text();
  };
  EXPECT_EQ(faults(copper()), "");
  EXPECT_NE(faults("1,1.0,1.0,,,,2\n1.0\n\n").find("(VP"), std::string::npos);
  EXPECT_NE(faults("1,1.0,1.0,,,,0,5\n1.0\n\n").find("(RATEOP"), std::string::npos);
  EXPECT_NE(faults("1,1.0,1.0\n1.0\n,,4\n").find("(SPALL"), std::string::npos);
  EXPECT_NE(faults("1,1.0,1.0\n1.0,,,0.1\n\n").find("(EPSO"), std::string::npos);
  EXPECT_NE(faults("1,1.0,1.0\n1.0,,,,1.0,300.0,300.0\n1.0\n").find("(TM"), std::string::npos);
  EXPECT_NE(faults("1,1.0,1.0\n1.0,,,,0.0,900.0,300.0\n1.0\n").find("(M,"), std::string::npos);
  EXPECT_NE(faults("1,1.0,1.0\n1.0\n\n,,,,,,,1\n").find("DMODEL"), std::string::npos);
}
