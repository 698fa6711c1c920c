#include "app/check/advice.hpp"

#include <gtest/gtest.h>

#include "app/report/range_warnings.hpp"

namespace courant {
namespace {

/// A sound scene; each test changes what its cause changes.
StopFacts sound() {
  StopFacts f;
  f.cause = StopCause::energy;
  f.cycle = 5000;
  f.dt_set_by = "sph 17 of part 1";
  f.has_contact = true;
  f.contact_share = 0.5;
  f.start_speed = 1;
  f.fall_speed = 3;
  f.sound_speed = 30;
  f.spacing = 0.01;
  return f;
}

void expect_hint(const StopFacts& f, const std::string& part) {
  const std::string hint = advice(f);
  EXPECT_NE(hint.find(part), std::string::npos) << "'" << part << "' is not in: " << hint;
  EXPECT_EQ(hint.find('\n'), std::string::npos) << "one line";
}

TEST(Advice, WithoutACauseTheStepSize) {
  expect_hint(sound(), "lower TSSFAC of *CONTROL_TIMESTEP (now 0.9)");
}

TEST(Advice, AnErrorThatSaysItAllHasItsOwnHint) {
  StopFacts f = sound();
  f.cause = StopCause::other, f.tssfac = 1.3, f.start_speed = 1000;
  EXPECT_EQ(advice(f), "");
  f.hint = "take a shorter curve";
  EXPECT_EQ(advice(f), f.hint);
}

TEST(Advice, HintsOfErrorsComeBehindFaultsOfTheDeck) {
  StopFacts f = sound();
  f.cause = StopCause::element, f.hint = "take more elements", f.leaked = 12;
  EXPECT_EQ(advice(f), f.hint);
  f.start_speed = 1000;
  expect_hint(f, "check the units");
}

TEST(Advice, WithoutParticlesNoViscosityOfTheirs) {
  StopFacts f = sound();
  f.particles = false;
  expect_hint(f, "make contact softer");
  EXPECT_EQ(advice(f).find("*HOURGLASS"), std::string::npos);
}

TEST(Advice, StepsLongerThanStable) {
  StopFacts f = sound();
  f.tssfac = 1.3;
  f.initial_penetrations = 3;  // also: what the deck asked for first
  expect_hint(f, "TSSFAC = 1.3 of *CONTROL_TIMESTEP makes steps longer");
  f.tssfac = 1;
  EXPECT_EQ(advice(f).find("makes steps longer"), std::string::npos);
}

TEST(Advice, PenetrationAtTheStart) {
  StopFacts f = sound();
  f.initial_penetrations = 3, f.initial_depth = 0.004, f.cycle = 100;
  expect_hint(
      f,
      "3 particles started within the contact distance of a wall, up to 0.004 [L] deep at a spacing of 0.01");
  f.cycle = 100000;  // long ago
  expect_hint(f, "lower TSSFAC");
}

TEST(Advice, SpeedsAndUnits) {
  StopFacts f = sound();
  f.start_speed = 1000;
  expect_hint(f, "speeds of 1000 [L/T] at the start are above the sound speed of 30: check the units");
  f = sound();
  f.fall_speed = 100;
  expect_hint(f, "gravity gives speeds of 100 [L/T] over the height of the scene");
}

TEST(Advice, StiffContact) {
  StopFacts f = sound();
  f.dt_set_by = "contact 1 (particle stiffness)";
  expect_hint(f, "contact 1 (particle stiffness) set the step");
  expect_hint(f, "lower SLSFAC");
  f.dt_set_by = "sph 17 of part 1", f.contact_share = 0.97;
  expect_hint(f, "sph 17 of part 1 set the step, and contact allows hardly more: its penalty is stiff");
  f.has_contact = false;
  f.cause = StopCause::step_size;
  expect_hint(f, "look at its speed");
}

TEST(Advice, Leaks) {
  StopFacts f = sound();
  f.leaked = 12;
  expect_hint(f, "12 particles went through a wall: make the contact stiffer");
}

TEST(Advice, DensityTooHighOrTorn) {
  StopFacts f = sound();
  f.density_high = 2.4;
  expect_hint(f, "the density reached 2.4 RO: an impact too fast");
  f = sound();
  f.cause = StopCause::density, f.density_low = 0.3, f.tension = true;
  expect_hint(f, "set PC = 0");
  f.tension = false;  // no tension to speak of
  expect_hint(f, "lower TSSFAC");
  f.strength = true;
  expect_hint(f, "the density fell to 0.3 RO: pieces of a solid fly apart");
}

PartRange calm() {
  return {.part = 3,
          .rho0 = 1000,
          .c0 = 30,
          .stiffness_field = "C1",
          .seen = true,
          .speed = {5.9, 17, 0.1},
          .density_low = {0.91, 18, 0.2},
          .density_high = {1.09, 19, 0.3}};
}

TEST(RangeWarnings, NothingOfWhatIsCalmAGasOrNotThere) {
  EXPECT_TRUE(range_warnings({calm()}, 0.2, 0.1).empty());
  PartRange gas = calm();
  gas.speed.value = 100, gas.density_low.value = 0.1, gas.stiffness_field.clear();
  PartRange absent = gas;
  absent.stiffness_field = "C1", absent.seen = false;
  EXPECT_TRUE(range_warnings({gas, absent}, 0.2, 0.1).empty());
  EXPECT_EQ(range_lines({gas, absent}).size(), 1u);
}

TEST(RangeWarnings, SpeedAndDensityEachHaveALine) {
  PartRange r = calm();
  r.speed.value = 6.1;
  ASSERT_EQ(range_warnings({r}, 0.2, 0.1).size(), 1u);
  EXPECT_NE(range_warnings({r}, 0.2, 0.1)[0].find("part 3: the largest speed 6.1 (particle 17 at 0.1)"),
            std::string::npos);
  EXPECT_NE(range_warnings({r}, 0.2, 0.1)[0].find("where it should be, raise C1"), std::string::npos);
  r.density_low.value = 0.89;
  ASSERT_EQ(range_warnings({r}, 0.2, 0.1).size(), 2u);
  EXPECT_NE(range_warnings({r}, 0.2, 0.1)[1].find("density over RO went to 0.89 (particle 18 at 0.2)"),
            std::string::npos);
  r = calm();
  r.density_high.value = 1.11;
  ASSERT_EQ(range_warnings({r}, 0.2, 0.1).size(), 1u);
  EXPECT_NE(range_warnings({r}, 0.2, 0.1)[0].find("1.11 (particle 19 at 0.3)"), std::string::npos);
}

}  // namespace
}  // namespace courant
