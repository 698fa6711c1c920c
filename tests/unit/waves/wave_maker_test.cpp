// *COURANT_WAVE_MAKER: how paddles move, what absorption does, and what is refused.
#include "waves/wave_maker.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "../app/small_scene.hpp"
#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {
namespace {

using test::build_deck;
using test::SmallScene;

/// A paddle of shells at x = 0, from y = 0 to 0.8, beside the block of water from 0 to 0.6.
std::string paddle_cards(const std::string& maker, const std::string& free = "1,3,4") {
  return "*NODE\n9001,0.,0.,-0.5\n9002,0.,0.8,-0.5\n9003,0.,0.8,0.5\n9004,0.,0.,0.5\n"
         "*ELEMENT_SHELL\n1,2,9001,9002,9003,9004\n*PART\npaddle\n2,2,2\n*SECTION_SHELL\n2,2\n0.05\n"
         "*MAT_RIGID\n2,7850.,2.1E11,0.3\n" +
         free + "\n" + test::gravity_cards +
         "*DEFINE_CURVE\n11\n0.,0.\n0.1,0.02\n0.2,0.01\n*DEFINE_CURVE\n12\n0.,0.\n1.,0.\n*COURANT_WAVE_"
         "MAKER\n" +
         maker + "\n";
}
std::unique_ptr<Simulation> scene_with(const std::string& maker) {
  SmallScene scene;
  scene.extra = paddle_cards(maker);
  return build_deck(scene.text(), false);
}
const RigidBody& paddle_of(const Simulation& s) {
  return s.get<std::shared_ptr<RigidBodies>>()->bodies().at(0);
}
Real curve_at(Real t) {
  return t < 0.1 ? 0.2 * t : 0.02 - 0.1 * (t - 0.1);
}

TEST(Paddle, MovesAsMuchWaterAsALongWaveNeeds) {
  Paddle p{.depth = 0.5};
  EXPECT_NEAR(p.long_wave_gain(9.81), std::sqrt(9.81 / 0.5), 1e-12);
  p.kind = Paddle::Kind::flap;  // from the bed: half the volume at the same velocity of the surface
  EXPECT_NEAR(p.long_wave_gain(9.81), 2 * std::sqrt(9.81 / 0.5), 1e-12);
  p.hinge = 0.25;
  EXPECT_NEAR(p.moved_depth(), 0.125, 1e-12);
  p.hinge = -0.5;  // from half to all of the velocity over the depth
  EXPECT_NEAR(p.moved_depth(), 0.375, 1e-12);
  p.hinge = -1e6;
  EXPECT_NEAR(p.moved_depth(), 0.5, 1e-6);
}

TEST(WaveMaker, PistonIsWhereItsCurveIs) {
  auto s = scene_with("2,0,11,1.,0,0.6\n0.,0.,0.,1.,0.,0.");
  ASSERT_TRUE(s);
  for (const Real until : {0.05, 0.15}) {
    test::run(*s, until);
    const RigidBody& b = paddle_of(*s);
    EXPECT_NEAR(b.x.x() - b.x0.x(), curve_at(s->clock().t), 1e-9);
    EXPECT_NEAR(b.x.y(), b.x0.y(), 1e-12);
    EXPECT_NEAR(b.q.w(), 1, 1e-12);
  }
}

TEST(WaveMaker, PistonMovesTowardsTheWater) {
  auto s = scene_with("2,0,11,2.,0,0.6\n0.,0.,0.,-3.,0.,0.");
  ASSERT_TRUE(s);
  test::run(*s, 0.05);
  EXPECT_NEAR(paddle_of(*s).x.x(), -2 * curve_at(s->clock().t), 1e-9);
}

// The hinge stays, and the curve is the displacement at the still level.
TEST(WaveMaker, FlapTurnsAboutItsHinge) {
  for (const Real hinge : {0.0, -0.1, -0.3}) {
    auto s = scene_with(fmt::format("2,1,11,1.,0,0.6,,{}\n0.,0.,0.,1.,0.,0.", hinge));
    ASSERT_TRUE(s);
    for (const Real until : {0.05, 0.15}) {
      test::run(*s, until);
      const RigidBody& b = paddle_of(*s);
      const auto now = [&](const Vec& start) { return Vec(b.x + b.q * (start - b.x0)); };
      EXPECT_NEAR((now(Vec(0, hinge, 0)) - Vec(0, hinge, 0)).norm(), 0, 1e-9);
      const Vec up = b.q * Vec::UnitY();
      EXPECT_NEAR((0.6 - hinge) * up.x() / up.y(), curve_at(s->clock().t), 1e-9);
    }
  }
}

// The line of the level leans with the flap: its height counts, not its length. The paddle touches nothing,
// so that the surface stays as it is.
TEST(WaveMaker, ALeaningFlapMeasuresTheLevelOfTheWater) {
  for (const Real far : {0.15, -0.15}) {
    SmallScene scene{.n = 8};
    scene.extra = paddle_cards("2,1,21,1.,12,0.8\n0.,0.,0.,1.,0.,0.\n1.,0.45,0.0001,0.,0.5");
    scene.extra += fmt::format("*DEFINE_CURVE\n21\n0.,0.\n0.002,{0}\n1.,{0}\n", far);
    auto s = build_deck(scene.text(), false);
    ASSERT_TRUE(s);
    test::run(*s, 0.004);
    const RigidBody& b = paddle_of(*s);
    const auto displacement = [&] {
      const Vec up = b.q * Vec::UnitY();
      return 0.8 * up.x() / up.y();
    };
    const Real before = displacement(), start = s->clock().t;
    test::run(*s, 0.014);
    const Real missing = (displacement() - before) / (2 * std::sqrt(9.81 / 0.8) * (s->clock().t - start));
    EXPECT_NEAR(missing, 0, 0.005) << far;
  }
}

// A level that is too low calls the paddle towards the water, one that is too high moves it back.
TEST(WaveMaker, AbsorbsTowardsTheLevelThatItShouldHave) {
  for (const Real depth : {0.7, 0.5}) {
    auto s = scene_with(fmt::format("2,0,0,1.,12,{}\n0.,0.,0.,1.,0.,0.\n1.,0.2,0.001,0.,0.5", depth));
    ASSERT_TRUE(s);
    const Real gain = std::sqrt(9.81 / depth);
    test::run(*s, 0.02);
    const RigidBody& b = paddle_of(*s);
    // the block has hardly begun to fall apart: its level is 0.6
    EXPECT_NEAR(b.x.x() - b.x0.x(), gain * (depth - 0.6) * (s->clock().t - 0.001), 0.15 * gain * 0.1 * 0.02);
  }
}

TEST(WaveMaker, DriftGoesBack) {
  Real moved[2];
  for (int k = 0; k < 2; ++k) {
    auto s = scene_with(fmt::format("2,0,0,1.,12,0.7\n0.,0.,0.,1.,0.,0.\n1.,0.2,0.001,{},0.5", k * 0.02));
    ASSERT_TRUE(s);
    test::run(*s, 0.1);
    moved[k] = paddle_of(*s).x.x();
  }
  EXPECT_GT(moved[0], 2 * moved[1]);
  EXPECT_GT(moved[1], 0);
}

TEST(WaveMaker, StopsBeyondItsLimit) {
  auto far = scene_with("2,0,0,1.,12,0.9\n0.,0.,0.,1.,0.,0.\n1.,0.2,0.001,0.,0.002");
  ASSERT_TRUE(far);
  EXPECT_THROW(test::run(*far, 0.1), RunError);
}

// The curve draws the paddle out of the water.
TEST(WaveMaker, StopsWithoutWater) {
  auto s = scene_with("2,0,11,-100.,12,0.6\n0.,0.,0.,1.,0.,0.\n1.,0.,0.,0.,9.");
  ASSERT_TRUE(s);
  EXPECT_THROW(test::run(*s, 0.1), RunError);
}

TEST(WaveMaker, HasTheSameBitsOnAnyNumberOfThreads) {
  Vec at[2];
  for (const int k : {0, 1}) {
    set_threads(k == 0 ? 1 : 3);
    auto s = scene_with("2,1,11,1.,12,0.65\n0.,0.,0.,1.,0.,0.\n1.,0.2,0.001,0.,0.5");
    ASSERT_TRUE(s);
    test::steps(*s, 60);
    at[k] = paddle_of(*s).x;
  }
  set_threads(1);
  EXPECT_EQ(at[0], at[1]);
  EXPECT_NE(at[0], Vec(0, 0.4, 0));
}

// Nothing else acts along x on a paddle that touches nothing: its work is its kinetic energy, and from
// outside.
/// Warnings of a deck that is accepted.
std::string warned(const std::string& maker) {
  SmallScene scene;
  scene.extra = paddle_cards(maker);
  Diagnostics diagnostics;
  EXPECT_NE(Simulation::build("deck.k", in_memory(scene.text()), diagnostics), nullptr);
  return diagnostics.text();
}

TEST(WaveMaker, WarnsOfALevelThatIsNotThatOfTheWater) {
  using testing::HasSubstr, testing::Not;
  const std::string at = "\n0.,0.,0.,1.,0.,0.\n1.,0.2,0.001,0.,0.5";
  for (const std::string depth : {"0.9", "0.3"})
    EXPECT_THAT(warned("2,0,0,1.,12," + depth + at),
                HasSubstr("the water at the paddle is 0.6 deep at the start"));
  EXPECT_THAT(warned("2,0,0,1.,12,0.65" + at), Not(HasSubstr("at the paddle is")));
  // within the support of the kernel an inclined flap changes the level
  EXPECT_THAT(warned("2,1,0,1.,12,0.6" + at), HasSubstr("an inclined flap changes it"));
  EXPECT_THAT(warned("2,1,0,1.,12,0.6\n0.,0.,0.,1.,0.,0.\n1."), Not(HasSubstr("an inclined flap")));
  // a column of a deck has fewer digits than h
  EXPECT_THAT(warned("2,1,0,1.,12,0.6\n0.,0.,0.,1.,0.,0.\n1.,0.2399999"), Not(HasSubstr("an inclined flap")));
}

// Constant levels move it away, and it comes back: the mean displacement ends at that of the curve.
TEST(WaveMaker, AMeanDifferenceOfLevelsDoesNotKeepItAway) {
  auto s = scene_with("2,0,0,1.,12,0.65\n0.,0.,0.,1.,0.,0.\n1.,0.2,0.0001,0.004,5.");
  ASSERT_TRUE(s);
  Real farthest = 0;
  for (const Real until : {0.004, 0.008, 0.012, 0.016, 0.02, 0.024, 0.028, 0.032}) {
    test::run(*s, until);
    farthest = std::max(farthest, paddle_of(*s).x.x());
  }
  EXPECT_GT(farthest, 1e-5);
  EXPECT_LT(std::abs(paddle_of(*s).x.x()), 0.1 * farthest);
}

TEST(WaveMaker, BooksItsWork) {
  auto s = scene_with("2,0,11,1.,0,0.6\n0.,0.,0.,1.,0.,0.");
  ASSERT_TRUE(s);
  for (const Real until : {0.05, 0.15}) {
    test::run(*s, until);
    const RigidBody& b = paddle_of(*s);
    EXPECT_GT(b.kinetic_energy(), 0);
    EXPECT_NEAR(b.drive_work, b.kinetic_energy(), 1e-9 * b.kinetic_energy());
    EXPECT_NEAR(s->world().energy.external_work, b.drive_work, 1e-9 * b.kinetic_energy());
  }
}

std::string refused(const std::string& maker, const std::string& free = "1,3,4") {
  SmallScene scene;
  scene.extra = paddle_cards(maker, free);
  Diagnostics diagnostics;
  EXPECT_EQ(Simulation::build("deck.k", in_memory(scene.text()), diagnostics), nullptr);
  return diagnostics.text();
}

TEST(WaveMaker, RefusesWhatItCannotDo) {
  using testing::HasSubstr;
  const std::string at = "\n0.,0.,0.,1.,0.,0.";
  EXPECT_THAT(refused("2,0,0,1.,0,0.6" + at), HasSubstr("neither follows a curve nor absorbs"));
  EXPECT_THAT(refused("2,0,11,1.,12,0.6" + at), HasSubstr("no effect without ABSORB"));
  EXPECT_THAT(refused("2,0,11,1.,0,0.6" + at + "\n1."), HasSubstr("takes the waves of the paddle itself"));
  EXPECT_THAT(refused("2,0,0,1.,12,0.6" + at + "\n1.,3."), HasSubstr("there is no water 3 in front of"));
  EXPECT_THAT(refused("2,0,0,1.,12,0.6\n0.,0.,0.,-1.,0.,0.\n1.,0.2"),
              HasSubstr("check X, Y, Z, the direction"));
  EXPECT_THAT(refused("2,0,11,1.,0,0.6,,0.1" + at), HasSubstr("a piston has no hinge"));
  EXPECT_THAT(refused("2,1,11,1.,0,0.6,,0.2" + at), HasSubstr("would turn the other direction"));
  EXPECT_THAT(refused("2,1,11,1.,0,0.6,,0.7" + at), HasSubstr("not below the still level"));
  EXPECT_THAT(refused("2,0,11,1.,0,0.6\n0.,0.,0.,0.,1.,0."), HasSubstr("a part along y"));
  EXPECT_THAT(refused("2,0,11,1.,0,0.6\n"), HasSubstr("the direction towards the water is 0"));
  EXPECT_THAT(refused("2,0,11,1.,0,0.6" + at, "1,7,7"), HasSubstr("cannot move along x"));
  EXPECT_THAT(refused("2,1,11,1.,0,0.6" + at, "1,3,7"), HasSubstr("cannot turn about z"));
  EXPECT_THAT(refused("1,0,11,1.,0,0.6" + at), HasSubstr("part 1 is no rigid body"));
  EXPECT_THAT(refused("2,0,11,1.,0,0.6" + at + "\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,1,2,11"),
              HasSubstr("is prescribed already"));
}

}  // namespace
}  // namespace courant
