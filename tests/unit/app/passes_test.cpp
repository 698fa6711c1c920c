// Only what a scene needs: the whole list of passes, active and left out with the reason, scene by scene.
#include <gmock/gmock.h>

#include <sstream>

#include "small_scene.hpp"

namespace courant {
namespace {

using test::build;
using test::SmallScene;

/// The list of the barest scene, line by line; a scene's list differs by what is taken away and what comes.
struct Lists {
  std::vector<std::string> active, left_out;
};

Lists lists_of(const SmallScene& scene) {
  Lists out;
  const auto s = build(scene);
  if (!s) return out;
  const std::string text = s->passes();
  std::vector<std::string>* to = &out.active;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = text.find('\n', at);
    std::string line = text.substr(at, end - at);
    at = end + 1;
    if (line.rfind("  ", 0) != 0) {
      if (line.rfind("not needed", 0) == 0) to = &out.left_out;
      continue;
    }
    std::string words;  // blanks in a row are columns
    if (line.rfind("  stage", 0) == 0 || line.rfind("    --", 0) == 0 || line.rfind("  time step,", 0) == 0)
      continue;
    for (const char c : line.substr(2))
      if (c != ' ' || (!words.empty() && words.back() != ' ')) words += c;
    if (line.rfind("    ", 0) == 0) words.erase(words.rfind(' '));  // the set that a pass runs over
    to->push_back(words);
  }
  return out;
}

const Lists bare{
    {"rates clear forces", "rates sph rates", "rates sph rates, reduction", "laws eos linear polynomial",
     "laws sph volumes", "reductions sph time step", "reductions sph energy", "forces sph forces",
     "forces sph forces, reduction", "motion motion of particles", "preparation sph viscous speed",
     "preparation neighbours", "time limit sph time step", "energy kinetic energy of particles",
     "energy sph energy", "guard every 64 steps"},
    {"inlets no *DEFINE_SPH_INJECTION",
     "ghost particles no *BOUNDARY_SPH_SYMMETRY_PLANE, no *BOUNDARY_SPH_PERIODIC",
     "prescribed motion no *BOUNDARY_PRESCRIBED_MOTION",
     "rigid walls no *RIGIDWALL",
     "wall support no *COURANT_WALL_SUPPORT",
     "renormalisation FORM of *CONTROL_SPH is a plain one",
     "Riemann flux no *COURANT_RIEMANN",
     "density diffusion no *COURANT_DENSITY_DIFFUSION",
     "volume control no *COURANT_VOLUME_CONTROL",
     "shifting ISHIFT 0",
     "XSPH no *COURANT_XSPH",
     "re-initialisation no *COURANT_DENSITY_REINITIALISATION",
     "frozen gradients no *COURANT_PAIR_GEOMETRY",
     "smoothing length HMIN = HMAX = 1: h is constant",
     "bulk viscosity IAVIS 0: Monaghan viscosity between pairs",
     "eddy viscosity no *COURANT_EDDY_VISCOSITY",
     "turbulence no *COURANT_TURBULENCE",
     "viscous stress MU is 0 in all SPH materials",
     "strength all SPH materials are fluids",
     "speed limit MAXV none given",
     "computational box no BOXID",
     "body loads on particles no *LOAD_BODY, *LOAD_GRAVITY_PART",
     "nodal forces on particles no *LOAD_NODE",
     "SPC on particles no *BOUNDARY_SPC",
     "damping on particles no *DAMPING",
     "level outlet no *COURANT_LEVEL_OUTLET",
     "frozen outlets no *COURANT_FROZEN_OUTLET",
     "contact no *CONTACT",
     "rigid bodies no *MAT_RIGID",
     "forces on nodes no node moves",
     "pressure on segments no *LOAD_SEGMENT, no *LOAD_SHELL, no *LOAD_BLAST",
     "joint stiffness no *CONSTRAINED_JOINT_STIFFNESS",
     "joints no *CONSTRAINED_JOINT",
     "node sets that move alike no *CONSTRAINED_NODE_SET",
     "solids no *ELEMENT_SOLID",
     "field states no *DATABASE_BINARY_D3PLOT",
     "glstat no *DATABASE_GLSTAT",
     "matsum no *DATABASE_MATSUM",
     "rcforc no *DATABASE_RCFORC",
     "sleout no *DATABASE_SLEOUT",
     "sphout no *DATABASE_SPHOUT",
     "nodout no *DATABASE_NODOUT",
     "rbdout no *DATABASE_RBDOUT",
     "bndout no *DATABASE_BNDOUT",
     "spcforc no *DATABASE_SPCFORC",
     "rwforc no *DATABASE_RWFORC"}};

/// Compares with the barest scene's lists: `gone` of left_out (by their first words) have become `come` among
/// the active; `other` left-out lines stand with another reason. Order within a list does not matter here:
/// the order of a step has tests of its own.
void expect_change(const SmallScene& scene, const std::vector<std::string>& gone,
                   const std::vector<std::string>& come, const std::vector<std::string>& other = {},
                   const std::vector<std::string>& replaced = {}) {
  Lists expected = bare, got = lists_of(scene);
  const auto starts = [](const std::string& line, const std::string& word) {
    return line.rfind(word, 0) == 0;
  };
  for (const std::string& word : gone)
    EXPECT_EQ(std::erase_if(expected.left_out, [&](const std::string& line) { return starts(line, word); }),
              1u)
        << word;
  for (const std::string& line : replaced) EXPECT_EQ(std::erase(expected.active, line), 1u) << line;
  expected.active.insert(expected.active.end(), come.begin(), come.end());
  expected.left_out.insert(expected.left_out.end(), other.begin(), other.end());
  for (auto* lines : {&expected.active, &expected.left_out, &got.active, &got.left_out})
    std::sort(lines->begin(), lines->end());
  EXPECT_EQ(got.active, expected.active);
  EXPECT_EQ(got.left_out, expected.left_out);
}

/// Beside the lists that others are counted from.
TEST(Passes, AreCountedInShort) {
  const SmallScene scene;
  const auto s = build(scene);
  ASSERT_TRUE(s);
  const std::string text = s->passes(), short_text = s->passes_in_short();
  // of each four blanks in front and the set it runs over behind
  int passes = 0, outputs = 0, left_out = 0;
  bool behind = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (behind) ++left_out;
    behind = behind || line == "not needed by this deck:";
    passes += line.rfind("    ", 0) == 0 && line.find(" particles", 30) != std::string::npos;
    outputs += line.rfind("  output  ", 0) == 0;
  }
  EXPECT_GT(passes, 8);
  EXPECT_EQ(short_text,
            fmt::format("{} passes make a step, {} outputs are asked for, {} of both are left out", passes,
                        outputs, left_out))
      << text;
}

TEST(Passes, BareSceneInTheOrderOfAStep) {
  const Lists got = lists_of({});
  EXPECT_EQ(got.active, bare.active);
  EXPECT_THAT(got.left_out, testing::UnorderedElementsAreArray(bare.left_out));
}

TEST(Passes, ThreeDimensionsNeedNoOtherPasses) {
  SmallScene scene;
  scene.dim = 3, scene.n = 3;
  expect_change(scene, {}, {});
}

TEST(Passes, AnotherKernelIsNamed) {
  SmallScene scene;
  scene.section = "1,1.2,1.,1.,0.,0.,0.,1";
  Lists got = lists_of(scene);
  EXPECT_EQ(got.active.at(1), "rates sph rates, quintic spline");
  got.active.at(1) = bare.active.at(1);
  EXPECT_EQ(got.active, bare.active);
  EXPECT_THAT(got.left_out, testing::UnorderedElementsAreArray(bare.left_out));
}

TEST(Passes, Gravity) {
  SmallScene scene;
  scene.extra = test::gravity_cards;
  expect_change(scene, {"body loads"}, {"forces body loads", "energy body loads"});
}

TEST(Passes, LevelOutlet) {
  SmallScene scene;
  scene.extra = std::string(test::gravity_cards) +
                "*DEFINE_BOX\n7,0.,0.6,0.,1.,-1.,1.\n*COURANT_LEVEL_OUTLET\n7,0.4,0.05\n";
  expect_change(scene, {"body loads", "level outlet"},
                {"forces body loads", "energy body loads", "forces level outlet 7",
                 "time limit level outlet 7", "energy level outlet 7"});
}

TEST(Passes, FrozenOutlet) {
  SmallScene scene;
  scene.box = "7";
  scene.extra = std::string(test::gravity_cards) + "*DEFINE_BOX\n7,-9.,9.,-9.,9.,-9.,9.\n";
  const Lists without = lists_of(scene);
  scene.extra += "*COURANT_FROZEN_OUTLET\n1,0.4\n";
  const Lists with = lists_of(scene);
  EXPECT_EQ(with.left_out.size() + 1, without.left_out.size());
  EXPECT_EQ(with.active, without.active) << "it only looks at what leaves";
}

TEST(Passes, ContactWithAFloorThatIsHeld) {
  SmallScene scene;
  scene.extra = test::floor_cards();
  expect_change(scene, {"contact", "rigid bodies"},
                {"forces contact 1", "time limit contact 1", "impact contact 1", "energy contact 1"},
                {"rigid bodies all are held in every direction"});
}

TEST(Passes, ABodyThatMoves) {
  SmallScene scene;
  scene.dim = 3, scene.n = 3;
  scene.extra = test::floor_cards(-0.025, 1, "1,5,7");
  expect_change(
      scene, {"contact", "rigid bodies", "forces on nodes"},
      {"rates clear forces", "rates clear contact forces", "forces contact 1", "forces contact 1 (nodes)",
       "forces contact 1 (faces)", "time limit contact 1", "impact contact 1", "energy contact 1",
       "constraints rigid bodies", "energy rigid bodies", "motion rigid bodies (motion)"});
}

TEST(Passes, Viscous) {
  SmallScene scene;
  scene.material = "1,1000.,-1.E20,0.001";
  expect_change(scene, {"viscous stress"}, {"laws viscous stress"});
}

TEST(Passes, EddyViscosity) {
  SmallScene scene;
  scene.extra = "*COURANT_EDDY_VISCOSITY\n0.1\n";
  expect_change(scene, {"eddy viscosity", "viscous stress"}, {"laws eddy viscosity", "laws viscous stress"});
}

TEST(Passes, Turbulence) {
  SmallScene scene;
  scene.extra = "*COURANT_TURBULENCE\n2\n";
  expect_change(scene, {"turbulence", "viscous stress"}, {"rates turbulence (sums)", "laws turbulence"});
}

TEST(Passes, BulkViscosity) {
  SmallScene scene;
  scene.dim = 3, scene.n = 3;
  scene.control_sph = "\n0,0,0,0,0,0,1";
  expect_change(scene, {"bulk viscosity"}, {"laws bulk viscosity"}, {}, {"preparation sph viscous speed"});
}

TEST(Passes, SmoothingLengthsThatChange) {
  SmallScene scene;
  scene.section = "1,1.2,0.2,2.";
  expect_change(scene, {"smoothing length"}, {"preparation smoothing length"}, {},
                {"rates sph rates, reduction", "forces sph forces, reduction"});
}

TEST(Passes, SpeedLimit) {
  SmallScene scene;
  scene.control_sph = ",150,0,0.,10.";
  expect_change(scene, {"speed limit MAXV"}, {"constraints speed limit MAXV"});
}

TEST(Passes, ComputationalBox) {
  SmallScene scene;
  scene.box = "1";
  scene.extra = "*DEFINE_BOX\n1,-1.,1.,-1.,1.,-1.,1.\n";
  expect_change(scene, {"computational box"}, {});
}

TEST(Passes, FixedParticles) {
  SmallScene scene;
  scene.extra = "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n";
  expect_change(scene, {"SPC"}, {"constraints fixed particles (SPC)"});
}

TEST(Passes, GhostsBehindAPlane) {
  SmallScene scene;
  scene.extra = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n";
  expect_change(
      scene, {"ghost particles"},
      {"exchange ghost particles", "rates mirror core (rates)", "forces mirror core", "relocation mirrors"});
}

TEST(Passes, DensityDiffusion) {
  SmallScene scene;
  scene.extra = "*COURANT_DENSITY_DIFFUSION\n0.1\n";
  expect_change(scene, {"density diffusion"},
                {"rates density diffusion", "preparation potential of body loads"});
  scene.extra = "*COURANT_VOLUME_CONTROL\n0.1\n";
  expect_change(scene, {"volume control"}, {"rates volume control", "time limit volume control"});
  scene.extra = "*COURANT_DENSITY_REINITIALISATION\n20\n";
  expect_change(scene, {"re-initialisation"}, {"rates density re-initialisation"});
}

TEST(Passes, Renormalisation) {
  SmallScene scene;
  scene.control_sph = ",0,1";
  expect_change(scene, {"renormalisation"},
                {"rates renormalisation (rates)", "forces renormalisation (forces)"});
}

TEST(Passes, RiemannFlux) {
  SmallScene scene;
  scene.extra = "*COURANT_RIEMANN\n3.\n";
  expect_change(
      scene, {"Riemann flux", "bulk viscosity"},
      {"rates Riemann flux (momentum)", "rates Riemann flux (density)", "forces Riemann flux (mass)",
       "time limit Riemann flux (mass)", "preparation potential of body loads"},
      {"bulk viscosity *COURANT_RIEMANN replaces viscosity"});
}

TEST(Passes, Drifts) {
  SmallScene scene;
  scene.control_sph = test::shifting_cards;
  expect_change(scene, {"shifting"},
                {"rates shifting (gradient)", "reductions drift work", "energy drift work",
                 "relocation shifting", "preparation surfaces"});
  scene.control_sph = "";
  scene.extra = "*COURANT_XSPH\n0.5\n";
  expect_change(scene, {"XSPH"},
                {"rates XSPH", "rates drift (density)", "reductions drift work", "energy drift work",
                 "relocation XSPH motion"});
  scene.extra = "*COURANT_XSPH\n0.01,1,1\n";
  expect_change(scene, {"XSPH"}, {"rates XSPH", "energy velocity smoothing", "impact velocity smoothing"});
}

TEST(Passes, PrescribedMotionOfParticles) {
  SmallScene scene;
  scene.extra = "*DEFINE_CURVE\n9\n0.,0.\n1.,1.\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n1,1,0,9\n";
  expect_change(scene, {"prescribed motion"},
                {"energy prescribed particles", "drive prescribed particles", "impact prescribed particles"});
}

TEST(Passes, FrozenGradients) {
  SmallScene scene;
  scene.extra = "*COURANT_PAIR_GEOMETRY\n0.005\n";
  expect_change(
      scene, {"frozen gradients"}, {"preparation frozen gradients"}, {},
      {"preparation sph viscous speed", "rates sph rates, reduction", "forces sph forces, reduction"});
}

TEST(Passes, AnotherEquationOfState) {
  SmallScene scene;
  scene.eos = "*EOS_MURNAGHAN\n1,7.,1.28E5\n";
  expect_change(scene, {}, {"laws eos murnaghan"}, {}, {"laws eos linear polynomial"});
}

TEST(Passes, AnEquationOfStateThatUsesEnergy) {
  SmallScene scene;
  scene.eos = "*EOS_GRUNEISEN\n1,30.,2.,,,0.3\n1.\n";
  expect_change(scene, {}, {"laws eos gruneisen", "rates viscous heat"}, {}, {"laws eos linear polynomial"});
}

TEST(Passes, TwoPartsWithOneLawShareAPass) {
  SmallScene scene;
  scene.extra =
      "*PART\nmore water\n3,1,1,1,1\n*NODE\n901,0.05,0.65,0.\n902,0.15,0.65,0.\n"
      "*ELEMENT_SPH\n901,3,10.\n902,3,10.\n";
  expect_change(scene, {}, {});
}

TEST(Passes, PairsAreWorkedOutTwiceWherePartsHaveDifferentSmoothingLengths) {
  const std::vector<std::string> reductions{"rates sph rates, reduction", "forces sph forces, reduction"};
  for (const auto& [cslh, gone] : {std::pair{"1.3", reductions},
                                   {"1.20001", reductions},
                                   {"1.2000001", {}}}) {  // as coordinates are rounded in decks
    SmallScene scene;
    scene.extra = fmt::format(
        "*SECTION_SPH\n2,{},1.,1.\n*PART\nmore water\n3,2,1,1,1\n*NODE\n901,0.05,0.65,0.\n902,0.15,0.65,0.\n"
        "*ELEMENT_SPH\n901,3,10.\n902,3,10.\n",
        cslh);
    expect_change(scene, {}, {}, {}, gone);
  }
}

TEST(Passes, OutputsThatAreAskedFor) {
  SmallScene scene;
  scene.extra =
      "*DATABASE_GLSTAT\n0.1\n*DATABASE_MATSUM\n0.1\n*DATABASE_BINARY_D3PLOT\n0.1\n"
      "*DATABASE_SPHOUT\n0.1\n*DATABASE_HISTORY_SPH\n1\n";
  expect_change(scene, {"glstat", "matsum", "sphout", "field states"},
                {"output field states", "output glstat", "output matsum", "output sphout"});
}

TEST(Passes, ThreadsWaitForAReasonOnly) {
  const auto s = test::build(SmallScene{});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->passes().find("threads wait: \n"), std::string::npos) << s->passes();
}

TEST(Passes, SampleHasTheEnergyOfABody) {
  SmallScene scene;
  scene.dim = 3, scene.n = 2;
  scene.extra = test::floor_cards(-5, 1, "1,5,7") + "*INITIAL_VELOCITY_GENERATION\n2,2,0.,3.,0.,0.\n\n";
  const auto s = test::build(scene);
  ASSERT_TRUE(s);
  test::steps(*s, 2);
  const Sample sample = s->sample("");
  ASSERT_EQ(sample.parts.size(), 2u);
  const Real m = 7850 * 5 * 5 * 0.05;  // the plate is 5 by 5, held but along x
  EXPECT_NEAR(sample.parts[1].mass, m, 1e-9 * m);
  EXPECT_NEAR(sample.parts[1].momentum[0], 3 * m, 1e-9 * m);
  EXPECT_NEAR(sample.parts[1].kinetic, 0.5 * m * 3 * 3, 1e-9 * m);
}

}  // namespace
}  // namespace courant
