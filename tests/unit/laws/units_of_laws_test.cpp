// Numbers whose meaning hangs on their size, in files that *INCLUDE_TRANSFORM converts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "laws/strength/strength.hpp"

using namespace courant;

namespace {

/// The law of cards in a file whose times are multiplied by 1000, and so its stresses by 1e-6.
std::shared_ptr<StrengthLaw> converted(const std::string& keyword, const std::string& cards) {
  ReadOptions options;
  options.open = [&](const std::string& name) {
    return std::optional<std::string>(
        name.find("sub.k") != std::string::npos
            ? "*KEYWORD\n*" + keyword + "\n" + cards + "*END\n"
            : "*KEYWORD\n*INCLUDE_TRANSFORM\nsub.k\n0,0,0,0,0,0,0\n0\n1.0,1000.0,1.0\n0\n*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("m.k", options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  for (const StrengthEntry& kind : strength_registry())
    if (kind.keyword == keyword) return kind.all(deck, Model()).at(0).second;
  return nullptr;
}

/// Shear stress after a large step.
Real yield_in_shear(const StrengthLaw& law) {
  Real rate[6] = {0, 0, 0, 1e-2, 0, 0}, stress[6] = {}, kept = 0, c = 0;
  Real* const history[] = {&kept};
  PointBlock block;
  block.count = 1, block.dt = 1, block.sound_speed = &c, block.history = history;
  for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
  law.update(block);
  EXPECT_GT(kept, 0);
  return stress[3];
}

}  // namespace

// SIGY = 250 is 2.5e-4 there, and still a stress; 0.01 is a strain, and stays.
TEST(UnitsOfLaws, SigyOfThePowerLawKeepsItsMeaning) {
  const auto first = [](const char* sigy) {
    return yield_in_shear(
        *converted("MAT_POWER_LAW_PLASTICITY", fmt::format("1,7.8e-9,2e8,0.3,600.0,0.5\n{}\n", sigy)));
  };
  // a step of 0.02/sqrt(3) of plastic strain, far above the elastic one: K sqrt(e0 + e)
  const Real e = 0.02 / std::sqrt(3.0);
  EXPECT_NEAR(first("250.0"), 6e-4 * std::sqrt(std::pow(250.0 / 600, 2) + e) / std::sqrt(3.0), 1e-7);
  EXPECT_NEAR(first("0.01"), 6e-4 * std::sqrt(0.01 + e) / std::sqrt(3.0), 1e-7);
}

// TFAIL = 0.05 is a time, 50 of the other unit; 0.5 is a share of the first step.
TEST(UnitsOfLaws, TfailOfPliesKeepsItsMeaning) {
  const auto least = [](const char* tfail) {
    return converted(
               "MAT_ENHANCED_COMPOSITE_DAMAGE",
               fmt::format("1,1.0,100.0,10.0,0.0,0.02\n5.0,2.0,3.0\n\n\n{}\n0.8,1.5,0.3,0.1,0.2\n", tfail))
        ->least_step();
  };
  const StrengthLaw::LeastStep time = least("0.05"), share = least("0.5");
  EXPECT_NEAR(time.step, 50, 1e-12);
  EXPECT_EQ(time.ratio, 0);
  EXPECT_NEAR(share.ratio, 0.5, 1e-12);
  EXPECT_EQ(share.step, 0);
}

namespace {

/// Shear stresses along a path of shear and tension, in steps of `dt` in an element of size 25.
std::vector<Real> path_of(const StrengthLaw& law, Real dt) {
  std::vector<Real> kept, out;
  for (const HistoryVariable& h : law.history())
    for (int k = 0; k < h.components; ++k) kept.push_back(h.name == element_size ? 25 : 0);
  std::vector<Real*> history;
  for (Real& number : kept) history.push_back(&number);
  Real stress[6] = {}, c = 0;
  for (int n = 0; n < 300; ++n) {
    Real rate[6] = {2e-6 / dt, 0, 0, 2e-6 / dt, 0, 0};
    PointBlock block;
    block.count = 1, block.dt = dt, block.sound_speed = &c, block.history = history;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    law.update(block);
    out.push_back(stress[0]), out.push_back(stress[3]);
  }
  return out;
}
void expect_same_path(const std::shared_ptr<StrengthLaw>& law, const std::shared_ptr<StrengthLaw>& other,
                      Real scale) {
  const std::vector<Real> a = path_of(*law, 1e-2), b = path_of(*other, 1e-2);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-7 * scale) << k;
}
std::shared_ptr<StrengthLaw> as_it_is(const std::string& keyword, const std::string& cards) {
  ReadOptions options;
  options.open = [&](const std::string&) {
    return std::optional<std::string>("*KEYWORD\n*" + keyword + "\n" + cards + "*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("m.k", options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  for (const StrengthEntry& kind : strength_registry())
    if (kind.keyword == keyword) return kind.all(deck, Model()).at(0).second;
  return nullptr;
}

}  // namespace

// A flag of units no longer holds; FE is an energy or an opening.
TEST(UnitsOfLaws, ConcreteKeepsItsUnits) {
  const auto cards = [](int rate, Real stress, Real fe, const char* units) {
    return fmt::format("1,{:.16g},{:.16g},0.2,{:.16g},{:.16g},{:.16g},8.0\n,,,,{},{}\n\n\n",
                       2.4e-9 * stress * 1e6, 30e3 * stress, 30 * stress, 3 * stress, fe, rate, units);
  };
  for (const int rate : {0, 1}) {
    const Real fe = 0.05;
    expect_same_path(converted("MAT_WINFRITH_CONCRETE", cards(rate, 1, fe, "-4")),
                     as_it_is("MAT_WINFRITH_CONCRETE",
                              cards(rate, 1e-6, rate == 0 ? fe * 1e-6 : fe, "1000.0,0.001,0.001")),
                     3e-6);
    expect_same_path(converted("MAT_WINFRITH_CONCRETE", cards(rate, 1, fe, "1000.0,0.001,1.0")),
                     as_it_is("MAT_WINFRITH_CONCRETE",
                              cards(rate, 1e-6, rate == 0 ? fe * 1e-6 : fe, "1000.0,0.001,0.001")),
                     3e-6);
  }
}

// DC is a rate, or a time.
TEST(UnitsOfLaws, DecayOfKelvinAndMaxwellKeepsItsMeaning) {
  const auto cards = [](Real stress, Real dc, int fo) {
    return fmt::format("1,1e-9,{:.16g},{:.16g},{:.16g},{:.16g},{}\n", 50 * stress, 30 * stress, 10 * stress,
                       dc, fo);
  };
  const char* keyword = "MAT_KELVIN-MAXWELL_VISCOELASTIC";
  expect_same_path(converted(keyword, cards(1, 2e3, 0)), as_it_is(keyword, cards(1e-6, 2, 0)), 1e-8);
  expect_same_path(converted(keyword, cards(1, 5e-4, 1)), as_it_is(keyword, cards(1e-6, 0.5, 1)), 1e-8);
}
