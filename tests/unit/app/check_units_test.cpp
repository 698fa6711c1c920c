// Which system of units the numbers of a deck look like.
#include <gtest/gtest.h>

#include "app/check/check.hpp"

namespace courant {

namespace {

DeckFacts facts(const std::vector<Real>& densities, Real gravity, Real size, Real end, Real E = 0) {
  DeckFacts f;
  for (const Real ro : densities) f.materials.push_back({.keyword = "*MAT_NULL", .id = 1, .ro = ro, .E = E});
  f.nodes = 2;
  f.high = Vec(size, size / 2, 0);
  f.gravity = gravity;
  f.endtim = end;
  return f;
}

/// System and reasons, on one line.
std::string verdict(const DeckFacts& f, const std::vector<Real>& sound = {}) {
  const std::string text = units_text(f, sound);
  const std::size_t end = text.find('\n'), next = text.find('\n', end + 1);
  const std::string reasons = text.substr(end + 1, next - end - 1);
  return text.substr(0, end) + (reasons.rfind("  read as", 0) == 0 ? "" : reasons);
}

TEST(Units, WaterUnderGravityInManySystems) {
  EXPECT_EQ(verdict(facts({1000}, 9.81, 2, 5), {30}),
            "Units: kg-m-s (N, Pa)  the acceleration 9.81 is gravity, RO = 1000 is water");
  EXPECT_EQ(verdict(facts({1e-9}, 9810, 2000, 5), {3e4}),
            "Units: tonne-mm-s (N, MPa)  the acceleration 9810 is gravity, RO = 1e-09 is water");
  EXPECT_EQ(verdict(facts({1e-6}, 9.81e-3, 2000, 5000)),
            "Units: kg-mm-ms (kN, GPa)  the acceleration 0.00981 is gravity, RO = 1e-06 is water");
  EXPECT_EQ(verdict(facts({1}, 981, 200, 5)),
            "Units: g-cm-s (dyn, dyn/cm2)  the acceleration 981 is gravity, RO = 1 is water");
  EXPECT_EQ(verdict(facts({1}, 9.81e-10, 200, 5e6)),
            "Units: g-cm-us (1e7 N, Mbar)  the acceleration 9.81e-10 is gravity, RO = 1 is water");
  EXPECT_EQ(verdict(facts({1.94}, 32.2, 6, 5)),
            "Units: slug-ft-s (lbf, lbf/ft2)  the acceleration 32.2 is gravity, RO = 1.94 is water");
}

TEST(Units, SteelAndItsModulus) {
  EXPECT_EQ(verdict(facts({7.85e-9}, 0, 100, 1e-3, 2.1e5)),
            "Units: tonne-mm-s (N, MPa)  RO = 7.85e-09 is steel, E = 210000 is steel");
}

TEST(Units, SoundSpeedDecidesWhereGravityIsMissing) {
  EXPECT_EQ(verdict(facts({1}, 0, 10, 100), {0.148}),
            "Units: g-cm-us (1e7 N, Mbar)  RO = 1 is water, the sound speed 0.148 is that of water");
}

TEST(Units, GravityThatIsNotTheEarthsIsTold) {
  EXPECT_EQ(verdict(facts({1000}, 981, 2, 5), {30}),
            "Units: kg-m-s (N, Pa)  RO = 1000 is water; but the acceleration 981 is not the earth's");
}

TEST(Units, StrangeNumbersAreToldAsSuch) {
  EXPECT_EQ(verdict(facts({12345678}, 3, 1, 1)), "Units: no common system fits; are they consistent?");
  EXPECT_EQ(verdict(DeckFacts{}), "Units: the deck has neither densities nor gravity to derive them from");
}

TEST(Units, NoLineIsWiderThanThePage) {
  const std::string text = units_text(facts({1000, 7850, 2700, 1.2}, 9.81, 123456, 1e-5, 2.1e11), {1480});
  for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1)
    EXPECT_LE(text.find('\n', at) - at, 100u) << text;
}

TEST(Units, AModulusAloneTells) {
  // 5000 kg/m3 is no material that is known; 210 GPa is steel's modulus, in both systems whose stress is in
  // MPa
  EXPECT_EQ(verdict(facts({5e-9}, 0, 100, 1e-3, 2.1e5)),
            "Units: tonne-mm-s (N, MPa) or g-mm-ms (N, MPa)  E = 210000 is steel");
}

TEST(Units, AnEndTimeDecidesBetweenSecondsAndMicroseconds) {
  // a density of 1 is water in both; a run of 1e-3 microseconds, a nanosecond, is none
  const std::string found = verdict(facts({1}, 0, 10, 1e-3));
  EXPECT_EQ(found.rfind("Units: g-cm-s (", 0), 0u) << found;
  EXPECT_EQ(found.find("g-cm-us"), std::string::npos) << found;
}

}  // namespace

}  // namespace courant
