#include "post/water_body.hpp"

#include <gtest/gtest.h>

#include "particle_sets.hpp"

namespace courant {
namespace {

using test::all_of;

constexpr Real spacing = 0.005;

TEST(WaterBody, PlateUnderADetachedDrop) {
  ParticleFrame frame = test::water({.x1 = 0.5, .y1 = 0.05});
  const std::size_t plate = frame.size();
  // 8 particles, 4 spacings above the plate
  test::fill(frame, {.x0 = 0.24, .x1 = 0.26, .y0 = 0.07, .y1 = 0.08});
  const ParticleGrid all = all_of(frame);
  const ParticleGrid water = water_body(all, {});
  EXPECT_EQ(water.particles().size(), plate);
  const auto on_line = [](const ParticleGrid& grid) { return water_on_line(grid, {0.25, 0, 0}, 1); };
  ASSERT_EQ(on_line(water).size(), 1u);
  EXPECT_NEAR(on_line(water)[0].low, 0, 0.1 * spacing);
  EXPECT_NEAR(on_line(water)[0].high, 0.05, 0.1 * spacing);

  ASSERT_EQ(on_line(all).size(), 2u);  // both surfaces of the drop are seen where it counts
  EXPECT_NEAR(on_line(all)[1].low, 0.07, 0.25 * spacing);
  EXPECT_NEAR(on_line(all)[1].high, 0.08, 0.25 * spacing);
  EXPECT_EQ(water_body(all, {.link = 1.5, .share = 0}).particles().size(), frame.size());
}

TEST(WaterBody, ADropThatTouchesBelongsToTheWater) {
  ParticleFrame frame = test::water({.x1 = 0.5, .y1 = 0.05});
  for (int k = 0; k < 4; ++k) test::add(frame, 0.2525, 0.05 + (k + 0.5) * spacing, spacing);
  EXPECT_EQ(water_body(all_of(frame), {}).particles().size(), frame.size());
}

TEST(WaterBody, TwoBasinsBothCount) {
  ParticleFrame frame = test::water({.x1 = 0.5, .y1 = 0.05});
  test::fill(frame, {.x0 = 0.6, .x1 = 0.7, .y0 = 0, .y1 = 0.05});  // a sixth of the water
  EXPECT_EQ(water_body(all_of(frame), {}).particles().size(), frame.size());
  EXPECT_LT(water_body(all_of(frame), {.link = 1.5, .share = 0.3}).particles().size(), frame.size());
}

TEST(WaterBody, NoParticles) {
  const ParticleFrame frame;
  const ParticleGrid water = water_body(all_of(frame), {});
  EXPECT_TRUE(water.particles().empty());
  EXPECT_TRUE(water_on_line(water, {0, 0, 0}, 1).empty());
}

TEST(WaterOnLine, AnOverhangHasSeveralPieces) {
  ParticleFrame frame = test::water({.x1 = 0.5, .y1 = 0.03});
  test::fill(frame, {.x0 = 0.1, .x1 = 0.3, .y0 = 0.06, .y1 = 0.09});   // a tongue
  test::fill(frame, {.x0 = 0.1, .x1 = 0.12, .y0 = 0.03, .y1 = 0.06});  // that hangs together with the water
  const ParticleGrid water = water_body(all_of(frame), {});
  EXPECT_EQ(water.particles().size(), frame.size());
  const auto pieces = water_on_line(water, {0.2, 0, 0}, 1);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(pieces[0].high, 0.03, 0.1 * spacing);
  EXPECT_NEAR(pieces[1].low, 0.06, 0.1 * spacing);
  EXPECT_NEAR(pieces[1].high, 0.09, 0.1 * spacing);
}

TEST(WaterOnLine, FilledIsTheVolumeOfTheParticles) {
  ParticleFrame frame = test::water({.x1 = 0.5, .y1 = 0.05});
  for (Real& volume : frame.V) volume *= 0.95;  // sparse particles: the surface stays, the volume shrinks
  Real filled = -1;
  const auto pieces = water_on_line(all_of(frame), {0.2512, 0, 0}, 1, &filled);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(pieces[0].high, 0.05, 0.1 * spacing);
  EXPECT_NEAR(filled, 0.95 * 0.05, 0.002 * 0.05);
  water_on_line(all_of(frame), {3, 0, 0}, 1, &filled);
  EXPECT_EQ(filled, 0);
}

TEST(WaterOnLine, AlongEachAxisInSpace) {
  ParticleFrame frame;
  frame.dim = 3;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < 14; ++k)
        test::add(frame, (i + 0.5) * spacing, (j + 0.5) * spacing, spacing, (k + 0.5) * spacing);
  const ParticleGrid water = water_body(all_of(frame), {});
  EXPECT_EQ(water.particles().size(), frame.size());
  const Point middle{5 * spacing, 6 * spacing, 7 * spacing};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto pieces = water_on_line(water, middle, axis);
    ASSERT_EQ(pieces.size(), 1u) << axis;
    EXPECT_NEAR(pieces[0].low, 0, 0.1 * spacing) << axis;
    EXPECT_NEAR(pieces[0].high, static_cast<Real>(10 + 2 * axis) * spacing, 0.1 * spacing) << axis;
  }
}

}  // namespace
}  // namespace courant
