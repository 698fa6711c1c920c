// `courant check`: choices that do not suit a scene, by hand: water 1 m high between its outer particles
// falls at sqrt(2 g h) = 4.429 m/s under 9.81 m/s2.
#include <gtest/gtest.h>

#include "../text.hpp"
#include "app/check/check.hpp"
#include "small_scene.hpp"

namespace courant {

namespace {

using test::holds;
using test::SmallScene;

constexpr const char* earth = "*LOAD_BODY_Y\n1,1.\n*DEFINE_CURVE\n1\n0.,9.81\n1000.,9.81\n";

/// 11 particles over the height.
SmallScene fine_scene() {
  SmallScene scene;
  scene.n = 11;
  scene.extra = earth;
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,4.E6\n";
  scene.hourglass = "1,0,0,0,1.E-20,1.E-20";
  return scene;
}

std::string advice_of(const SmallScene& scene) {
  const CheckResult result = check_deck("deck.k", in_memory(scene.text()), false);
  EXPECT_TRUE(result.sound) << result.messages;
  const std::size_t begin = result.model.find("Choices to look at\n"),
                    end = result.model.find("a step, by stages");
  if (begin == std::string::npos) return "";
  std::string text;  // without its line breaks
  for (const char c : result.model.substr(begin, end - begin))
    if (c != '\n' && (c != ' ' || text.empty() || text.back() != ' ')) text += c;
  return text;
}

TEST(CheckAdvice, GoodChoicesSayNothing) {
  EXPECT_EQ(advice_of(fine_scene()), "");
}

TEST(CheckAdvice, SoundSpeedAgainstTheFall) {
  SmallScene scene = fine_scene();
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,1.E5\n";
  std::string said = advice_of(scene);
  EXPECT_TRUE(holds(said, "sound speed 10 is 2.26 times the speed of 4.429")) << said;
  EXPECT_TRUE(holds(said, "type C1 = 1.962e+06 of *EOS_LINEAR_POLYNOMIAL")) << said;  // 1000 * 100 * 2 g
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,2.25E9\n";                                // real water
  said = advice_of(scene);
  EXPECT_TRUE(holds(said, "sound speed 1500 is 339 times")) << said;
  EXPECT_TRUE(holds(said, "type C1 = 1.962e+06")) << said;
  scene.extra = "",
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,1.E5\n";  // no gravity, at rest: nothing to compare with
  EXPECT_EQ(advice_of(scene), "");
  scene.start = "4.,0.,0.";
  EXPECT_TRUE(holds(advice_of(scene), "sound speed 10 is 2.5 times the speed of 4 "));
}

// nu = 0.01 0.12 63.25/8, k = 2 pi, T = 0.8003: exp(-2 nu k^2 T) = 0.549; of half the length 0.183.
TEST(CheckAdvice, ViscosityAgainstWaves) {
  SmallScene scene = fine_scene();
  scene.hourglass = "1,0,0,0,1.E-20,0.01";
  EXPECT_TRUE(holds(advice_of(scene),
                    "a wave as long as the water, 1, loses 45 % of its height in a period of 0.8, one of "
                    "half that length 82 %"))
      << advice_of(scene);
  scene.hourglass = "1,0,0,0,1.E-20,3.E-4";
  EXPECT_EQ(advice_of(scene), "");
  scene.hourglass = "1,0,0,0,1.E-20,0.01";
  scene.extra = "";
  EXPECT_FALSE(holds(advice_of(scene), "wave")) << "no gravity, no waves";
}

TEST(CheckAdvice, SpacingAndSmoothingLength) {
  SmallScene scene = fine_scene();
  scene.n = 6;
  EXPECT_TRUE(holds(advice_of(scene),
                    "5 spacings of 0.1 over the height of 0.5 are few; type particles 0.025 apart"));
  scene = fine_scene();
  scene.section = "1,1.05,1.,1.";
  EXPECT_TRUE(
      holds(advice_of(scene),
            "particles reach 2.1 spacings, 2.4 is usual: sums have too few neighbours; type CSLH = 1.2"));
  scene.section = "1,1.6,1.,1.";
  EXPECT_TRUE(holds(advice_of(scene), "details are smoothed away; type CSLH = 1.2"));
}

// Wider kernels of smaller support and reversed: what counts is their width.
TEST(CheckAdvice, SmoothingLengthOfOtherKernels) {
  SmallScene scene = fine_scene();
  for (const char* quintic : {"1,1.,1.,1.,0.,1e20,0.,1", "1,1.4,1.,1.,0.,1e20,0.,1"}) {
    scene.section = quintic;
    EXPECT_EQ(advice_of(scene), "");
  }
  scene.section = "1,0.8,1.,1.,0.,1e20,0.,1";
  EXPECT_TRUE(holds(advice_of(scene),
                    "reach 2.4 spacings, 2.9 is usual: sums have too few neighbours; type CSLH = 0.97"))
      << advice_of(scene);
  scene.section = "1,2.,1.,1.";
  scene.extra = std::string(earth) + "*COURANT_KERNEL\nwendland_c2\n";
  EXPECT_EQ(advice_of(scene), "");
}

TEST(CheckAdvice, BodiesThatMayFloat) {
  SmallScene scene = fine_scene();
  scene.extra = std::string(earth) + test::floor_cards(0);
  EXPECT_FALSE(holds(advice_of(scene), "floats"));   // held
  std::string loose = test::floor_cards(0, 1, "0");  // and one deep in z
  for (const auto& [wide, deep] : {std::pair{",0,-2.\n", ",0,0.\n"}, {",0,3.\n", ",0,1.\n"}})
    for (std::size_t at; (at = loose.find(wide)) != std::string::npos;)
      loose.replace(at, std::string(wide).size(), deep);
  scene.extra = earth + loose;
  EXPECT_TRUE(holds(advice_of(scene), "if it floats, it heaves a fifth and rolls a third too little"))
      << advice_of(scene);
  EXPECT_TRUE(holds(advice_of(scene), "type SPHKERN = 1 in *SECTION_SPH"));
  scene.section = "1,1.2,1.,1.,0.,1e20,0.,1";
  EXPECT_FALSE(holds(advice_of(scene), "floats"));
}

TEST(CheckAdvice, TensionMattersUnderGravityAlone) {
  SmallScene scene = fine_scene();
  scene.material = "1,1000.,0.";
  EXPECT_TRUE(holds(advice_of(scene), "type PC = -1.0E20 in *MAT_NULL"));
  scene.extra = "";
  EXPECT_EQ(advice_of(scene), "");
}

}  // namespace

}  // namespace courant
