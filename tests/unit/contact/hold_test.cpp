// Particles that the penalty cannot hold: nothing goes through a wall at up to three times the speed of
// sound, whatever its thickness, how it lies or moves; and what is not so fast does not know of it.
#include "../app/small_scene.hpp"
#include "time/guard.hpp"

namespace courant {
namespace {

using test::SmallScene;

/// A plate of four corners that contact with particles uses, and what holds or drives it.
std::string plate(const std::array<Vec, 4>& corners, Real thickness, const std::string& rigid,
                  const std::string& more = "") {
  std::string text = "*NODE\n", rest = "*INITIAL_VELOCITY_NODE\n";  // that of the particles is of all nodes
  for (int k = 0; k < 4; ++k)
    rest += fmt::format("{},0.,0.,0.\n", 9001 + k),
        text += fmt::format("{},{},{},{}\n", 9001 + k, corners[k][0], corners[k][1], corners[k][2]);
  return text +
         fmt::format(
             "*ELEMENT_SHELL\n1,2,9001,9002,9003,9004\n*PART\nfloor\n2,2,2\n*SECTION_SHELL\n2,2\n{}\n"
             "*MAT_RIGID\n2,7850.,2.1E11,0.3\n{}\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n\n",
             thickness, rigid) +
         rest + more;
}
std::string level_plate(Real y, Real thickness, const std::string& rigid, const std::string& more = "") {
  return plate({Vec(-2, y, -2), Vec(3, y, -2), Vec(3, y, 3), Vec(-2, y, 3)}, thickness, rigid, more);
}

constexpr Real sound = 30;  // of SmallScene
const char* const is_held = "1,7,7";

/// The number of particles that leaked, and the share of energy from nowhere, after `times` passages of the
/// block through its own width.
struct Outcome {
  std::int64_t leaked = 0, held = 0;
  Real error = 0;
};
Outcome shot(SmallScene scene, Real speed, Real passages = 2) {
  auto s = test::build_deck(scene.text(), false);
  if (!s) return {-1, 0, 0};
  const Real end = passages * 0.6 / speed;
  while (s->clock().t < end) test::steps(*s, 1);
  std::string who;
  s->evaluate(who);
  s->guard().look(s->world(), s->clock());
  const World& w = s->world();
  const auto held = w.counters.find("contact_held");
  return {w.counters.at("leaked_particles"), held == w.counters.end() ? 0 : held->second, w.energy.error()};
}

TEST(Hold, NothingGoesThroughAWallAtUpToThreeTimesTheSpeedOfSound) {
  for (const int dim : {2, 3})
    for (const Real mach : {0.1, 0.5, 1.0, 2.0, 3.0})
      for (const Real thickness : {0.05, 0.002}) {
        SmallScene scene;
        scene.dim = dim, scene.n = dim == 3 ? 4 : 6;
        scene.start = fmt::format("0.,{},0.", -mach * sound);
        scene.extra = level_plate(-0.2, thickness, is_held);
        const Outcome out = shot(scene, mach * sound);
        EXPECT_EQ(out.leaked, 0) << dim << "D, Mach " << mach << ", thickness " << thickness;
        EXPECT_LT(std::abs(out.error), 0.1) << dim << "D, Mach " << mach << ", thickness " << thickness;
      }
}

TEST(Hold, NorThroughOneThatIsAskewOrACorner) {
  for (const Real mach : {0.5, 1.0, 3.0}) {
    SmallScene scene;
    scene.start = fmt::format("{},{},0.", -mach * sound / std::sqrt(2), -mach * sound / std::sqrt(2));
    scene.extra =
        plate({Vec(3, -3.4, -2), Vec(-3.4, 3, -2), Vec(-3.4, 3, 3), Vec(3, -3.4, 3)}, 0.01, is_held);
    EXPECT_EQ(shot(scene, mach * sound).leaked, 0) << "askew, Mach " << mach;
    scene.extra = level_plate(-0.05, 0.02, is_held) +
                  "*NODE\n9011,-0.05,-2.,-2.\n9012,-0.05,3.,-2.\n9013,-0.05,3.,3.\n9014,-0.05,-2.,3.\n"
                  "*ELEMENT_SHELL\n2,2,9011,9012,9013,9014\n";
    const Outcome corner = shot(scene, mach * sound);
    EXPECT_EQ(corner.leaked, 0) << "corner, Mach " << mach;
    EXPECT_LT(std::abs(corner.error), 0.1) << "corner, Mach " << mach;
  }
}

// The wall comes to the particles: driven, or a free body as heavy as they are.
TEST(Hold, NorThroughOneThatMoves) {
  for (const Real mach : {0.1, 1.0, 3.0}) {
    SmallScene scene;
    scene.dim = 3, scene.n = 4;
    scene.extra = level_plate(-0.2, 0.01, "1,6,7",
                              fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,2,0,1,1.\n*DEFINE_CURVE\n1\n"
                                          "0.,{0}\n100.,{0}\n",
                                          mach * sound));
    const Outcome driven = shot(scene, mach * sound);
    EXPECT_EQ(driven.leaked, 0) << "driven, Mach " << mach;
    EXPECT_LT(std::abs(driven.error), 0.1) << "driven, Mach " << mach;
    scene.start = fmt::format("0.,{},0.", -mach * sound);
    scene.extra = level_plate(-0.2, 0.01, "1,6,7");
    const Outcome free = shot(scene, mach * sound);
    EXPECT_EQ(free.leaked, 0) << "free, Mach " << mach;
    EXPECT_LT(std::abs(free.error), 0.03) << "free, Mach " << mach;
  }
}

// Held across the blow, free along the wall: as good as fixed.
TEST(Hold, NorThroughOneThatIsFreeAlongItself) {
  for (const Real mach : {0.5, 3.0}) {
    SmallScene scene;
    scene.dim = 3, scene.n = 4;
    scene.start = fmt::format("0.,{},0.", -mach * sound);
    scene.extra = level_plate(-0.2, 0.01, "1,5,7");
    const Outcome out = shot(scene, mach * sound);
    EXPECT_EQ(out.leaked, 0) << "Mach " << mach;
    EXPECT_LT(std::abs(out.error), 0.03) << "Mach " << mach;
  }
}

// m at v meets a free plate of mass M at its centre: both go on with m v/(m + M), as far as the penalty plays
// no part (soft, as SFSA is small); m M v^2/(2 (m + M)) is dissipated. Off the centre, at distance a, M is
// 1/(1/M + a^2/J).
TEST(Hold, APlasticImpactTakesWhatTheClosedFormSays) {
  for (const Real a : {0.0, 1.0}) {
    SmallScene scene;
    scene.dim = 3, scene.n = 1;
    scene.section = "1,1.2,1.,1.,0.12", scene.start = "0.,-60.,0.", scene.hourglass = "1,0,0,0,1.E-20,1.E-20";
    scene.extra = plate({Vec(-2 + a + 0.05, -0.2, -2 + 0.05), Vec(2 + a + 0.05, -0.2, -2 + 0.05),
                         Vec(2 + a + 0.05, -0.2, 2 + 0.05), Vec(-2 + a + 0.05, -0.2, 2 + 0.05)},
                        0.05, "1,0,0");
    const std::string scales = "1,2,3,3\n0.\n\n";
    scene.extra.replace(scene.extra.find(scales), scales.size(), "1,2,3,3\n0.\n1.E-9\n");
    const std::string steel = "2,7850.,";
    scene.extra.replace(scene.extra.find(steel), steel.size(), "2,5.,");  // M = 5 * 16 * 0.05 = 4
    auto s = test::build_deck(scene.text(), false);
    ASSERT_TRUE(s);
    while (s->clock().t < 0.2 / 60 + 0.002) test::steps(*s, 1);
    std::string who;
    s->evaluate(who);
    s->guard().look(s->world(), s->clock());
    const Real M = 4, J = M * (16 + 0.0025) / 12, m = 1, wall = 1 / (1 / M + a * a / J);
    const EnergyLedger& e = s->world().energy;
    EXPECT_NEAR(e.dissipated, 0.5 * m * wall / (m + wall) * 3600, 0.01 * 1800) << a;
    EXPECT_LT(std::abs(e.error()), 0.002) << a;
    EXPECT_EQ(s->world().counters.at("leaked_particles"), 0) << a;
  }
}

// A free plate that the blow sets spinning turns by a tenth of a radian in a step: particles that slide along
// it, and those that it turns towards, stay in front of it.
TEST(Hold, NorThroughOneThatSpins) {
  struct Case {
    Real mach, off_centre, density, half;
  };
  for (const Case& c : {Case{2, -0.219, 1298, 0.5}, Case{1, 0.438, 7592, 0.3}, Case{1, 0.354, 84.71, 1},
                        Case{2, 0.306, 1442, 1}, Case{0.5, 0.3, 20, 0.3}}) {
    SmallScene scene;
    scene.dim = 3, scene.n = 4;
    scene.timestep = "0.,0.9";
    scene.start = fmt::format("0.,{},0.", -c.mach * sound);
    const Real left = 0.2 + c.off_centre - c.half, right = left + 2 * c.half, back = 0.2 - c.half;
    scene.extra = plate({Vec(left, -0.2, back), Vec(right, -0.2, back), Vec(right, -0.2, 0.2 + c.half),
                         Vec(left, -0.2, 0.2 + c.half)},
                        0.02, "1,0,0");
    const std::string steel = "2,7850.,";
    scene.extra.replace(scene.extra.find(steel), steel.size(), fmt::format("2,{},", c.density));
    const Outcome out = shot(scene, c.mach * sound);
    EXPECT_EQ(out.leaked, 0) << "Mach " << c.mach << ", density " << c.density;
    EXPECT_GT(out.held, 0) << "Mach " << c.mach << ", density " << c.density;
    EXPECT_LT(std::abs(out.error), 0.03) << "Mach " << c.mach << ", density " << c.density;
  }
}

// What is slow is held by the penalty alone, with the same bits as where the penalty is all there is.
TEST(Hold, SlowScenesDoNotKnowOfIt) {
  SmallScene scene;
  scene.extra = std::string(test::gravity_cards) + test::floor_cards(-0.025, 10);
  auto one = test::build(scene);
  scene.extra += "*COURANT_LITERAL_PENALTY\n0\n";
  auto other = test::build(scene);
  test::steps(*one, 300), test::steps(*other, 300);
  EXPECT_FALSE(one->world().counters.contains("contact_held"));
  for (Index i = 0; i < one->world().particles.active; ++i)
    EXPECT_EQ(one->world().particles.x.vec(i), other->world().particles.x.vec(i));
}

// The card has the penalty alone: particles that are too fast for it leak, and are counted.
TEST(Hold, TheLiteralPenaltyLeaks) {
  SmallScene scene;
  scene.start = fmt::format("0.,{},0.", -sound);
  scene.extra = level_plate(-0.2, 0.05, is_held, "*COURANT_LITERAL_PENALTY\n1\n");
  EXPECT_EQ(shot(scene, sound).leaked, 36);
  scene.extra = level_plate(-0.2, 0.05, is_held);
  EXPECT_GT(shot(scene, sound).held, 0);
}

}  // namespace
}  // namespace courant
