// Solids of foam and rubber by curves over rates of strain, *MAT_083 and *MAT_181: they give their curves
// back.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::driven_cube;
using test::pull_of_cube;
using test::simulation_of;
using test::SolidDeck;

namespace {

/// A smooth start, then a speed; from the time `back` on the same backwards.
std::string driven_at(Real speed, Real back = 1e8) {
  return fmt::format("0.0,0.0\n5.0,{0}\n{1},{0}\n{2},{3}\n1e9,{3}\n", speed, back, back + 4, -speed);
}
Real moved_by(Real speed, Real t) {
  return speed * (t - 2.5);
}
/// When the length is l, on the path out.
Real time_of(Real speed, Real l) {
  return (l - 1) / speed + 2.5;
}

/// Nominal stress of Treloar's rubber by Ogden's three terms, moduli five times as large.
Real rubber_curve(Real e) {
  const Real l = 1 + e;
  Real out = 0;
  for (const auto& [mu, alpha] : {std::pair(3.15, 1.3), {0.006, 5.0}, {-0.05, -2.0}})
    out += mu * (std::pow(l, alpha) - std::pow(l, -alpha / 2)) / l;
  return out;
}
std::string rubber_points(int id, Real factor) {
  std::string out = fmt::format("*DEFINE_CURVE\n{}\n", id);
  for (int k = -30; k <= 75; ++k) out += fmt::format("{},{}\n", 0.02 * k, factor * rubber_curve(0.02 * k));
  return out;
}
const std::string rubber_curves =
    rubber_points(11, 1) + rubber_points(12, 2) + "*DEFINE_TABLE_2D\n13\n0.0,11\n0.04,12\n";
std::string tabulated_rubber(int curve, const std::string& rest = "-1.0,1.0", Real unit = 1) {
  return fmt::format("*MAT_SIMPLIFIED_RUBBER/FOAM\n1,1.0,500.0\n{0},{0},{1},{2},{3}\n", 1.0, unit, curve,
                     rest) +
         rubber_curves;
}

const std::string foam_curves =
    "*DEFINE_CURVE\n11\n-0.5,-4.0\n0.0,0.0\n0.1,1.0\n0.6,1.5\n0.8,8.0\n"
    "*DEFINE_CURVE\n12\n-0.5,-8.0\n0.0,0.0\n0.1,2.0\n0.6,3.0\n0.8,16.0\n*DEFINE_TABLE_2D\n13\n0.0,11\n0.04,"
    "12\n";
std::string tabulated_foam(int curve, int sflag, int rflag, int tflag = 0) {
  return fmt::format("*MAT_FU_CHANG_FOAM\n1,1.0,20.0,,,,,{}\n0.0,{},{},{}\n\n\n", curve, sflag, rflag,
                     tflag) +
         foam_curves;
}

}  // namespace

// Pulled to 1.9 and pressed to 0.5 with free sides: the curve over the area at the start.
TEST(TabulatedSolids, RubberGivesItsCurveBack) {
  constexpr Real speed = 0.02;
  for (const auto& [n, elform] : {std::pair(1, 1), {2, 1}, {1, 2}}) {
    auto pulled =
        simulation_of(driven_cube(n, tabulated_rubber(11), driven_at(speed), false, elform).text(1e9));
    test::start_ledger(*pulled);
    for (const Real l : {1.1, 1.5, 1.9}) {
      test::run_until(*pulled, time_of(speed, l));
      EXPECT_NEAR(pull_of_cube(*pulled, n), rubber_curve(l - 1), 0.01 * rubber_curve(l - 1)) << n << " " << l;
    }
    EXPECT_LT(test::energy_error(*pulled), 0.01);
    auto pressed =
        simulation_of(driven_cube(n, tabulated_rubber(11), driven_at(-speed), false, elform).text(1e9));
    for (const Real l : {0.8, 0.5}) {
      test::run_until(*pressed, time_of(-speed, l));
      EXPECT_NEAR(pull_of_cube(*pressed, n), -rubber_curve(l - 1), -0.01 * rubber_curve(l - 1))
          << n << " " << l;
    }
  }
}

// A table: 1 + rate/0.04 times the curve, by rates of l or ln l; on the path back the curve at rest, or not.
TEST(TabulatedSolids, RubberIsStiffenedByItsRate) {
  constexpr Real speed = 0.02;
  struct Case {
    std::string rest;
    bool true_rate, back_too;
  };
  for (const Case& c :
       {Case{"-1.0,1.0", false, false}, {"-1.0,0.0", true, false}, {"1.0,1.0", false, true}}) {
    auto s =
        simulation_of(driven_cube(1, tabulated_rubber(13, c.rest), driven_at(speed, 35), false).text(1e9));
    for (const Real l : {1.15, 1.5}) {
      test::run_until(*s, time_of(speed, l));
      const Real rate = speed / (c.true_rate ? l : 1), stress = rubber_curve(l - 1) * (1 + rate / 0.04);
      EXPECT_NEAR(pull_of_cube(*s, 1), stress, 0.02 * stress) << c.rest << " " << l;
    }
    test::run_until(*s, 50);
    const Real l = 1 + moved_by(speed, 37) - speed * (50 - 37), stress = rubber_curve(l - 1);
    EXPECT_NEAR(pull_of_cube(*s, 1), (c.back_too ? 1.5 : 1) * stress, 0.03 * stress) << c.rest;
  }
  // in compression alone
  auto s = simulation_of(driven_cube(1, tabulated_rubber(13, "0.0,1.0"), driven_at(speed), false).text(1e9));
  test::run_until(*s, time_of(speed, 1.5));
  EXPECT_NEAR(pull_of_cube(*s, 1), rubber_curve(0.5), 0.02 * rubber_curve(0.5));
}

// A specimen of 1 by 1 by 4: forces are over 4 of its area.
TEST(TabulatedSolids, RubberTakesForcesOfASpecimen) {
  auto s =
      simulation_of(driven_cube(1, tabulated_rubber(11, "-1.0,1.0", 4), driven_at(0.02), false).text(1e9));
  test::run_until(*s, time_of(0.02, 1.5));
  EXPECT_NEAR(pull_of_cube(*s, 1), rubber_curve(0.5) / 4, 0.01 * rubber_curve(0.5) / 4);
}

// Foam pressed to 0.5 at two speeds: 1 + rate/0.04 times the lowest curve, which it goes back by.
TEST(TabulatedSolids, FoamFollowsTheCurveOfItsRate) {
  const auto at_rest = [](Real e) { return e < 0.1 ? 10 * e : 1 + (e - 0.1); };
  for (const int rflag : {0, 1, 2})
    for (const auto& [n, sflag] : {std::pair(1, 0), {1, 1}, {2, 1}})
      for (const Real speed : {0.005, 0.02}) {
        if (n == 2 && speed > 0.01) continue;
        auto s = simulation_of(
            driven_cube(n, tabulated_foam(13, sflag, rflag), driven_at(-speed, 0.5 / speed + 2.5), false)
                .text(1e9));
        for (const Real l : {0.7, 0.55}) {
          test::run_until(*s, (1 - l) / speed + 2.5);
          const Real rate = speed / (sflag == 1 ? 1 : l), stress = at_rest(1 - l) * (1 + rate / 0.04);
          EXPECT_NEAR(pull_of_cube(*s, n), stress, 0.015 * stress) << rflag << sflag << " " << l;
        }
        const Real turned = 0.5 / speed + 2.5 + 2, later = turned + 0.2 / speed;
        test::run_until(*s, later);
        const Real l = 1 - speed * (turned - 2.5) + speed * (later - turned);
        EXPECT_NEAR(pull_of_cube(*s, n), at_rest(1 - l), 0.03 * at_rest(1 - l)) << rflag << sflag;
      }
}

// E in tension, or the curve below 0.
TEST(TabulatedSolids, FoamIsPulledByItsModulusOrItsCurve) {
  for (const int tflag : {0, 1}) {
    auto s =
        simulation_of(driven_cube(1, tabulated_foam(11, 0, 0, tflag), driven_at(0.005), false).text(1e9));
    test::run_until(*s, time_of(0.005, 1.3));
    const Real stress = tflag == 1 ? 8 * 0.3 : 20 * 0.3;
    EXPECT_NEAR(pull_of_cube(*s, 1), stress, 0.01 * stress) << tflag;
  }
}

TEST(TabulatedSolids, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const std::string& material : {tabulated_rubber(13), tabulated_foam(13, 0, 1)}) {
    SolidDeck deck;
    deck.block(Vec(4, 3, 2), 8, 6, 4, 1);
    deck.cards = "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n" + material;
    deck.cards += "*INITIAL_VELOCITY\n0\n-1.0,0.5,-0.5\n*RIGIDWALL_PLANAR\n0\n-0.01,0.0,0.0,1.0,0.0,0.0\n";
    test::expect_same_bits(deck.text(100), 60, 25);
  }
}
