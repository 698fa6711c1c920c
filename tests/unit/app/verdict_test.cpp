// Whether a run can be trusted: limits, the scale of energies, and scenes that were judged wrongly.
#include "app/report/verdict.hpp"

#include <gmock/gmock.h>

#include "small_scene.hpp"
#include "time/guard.hpp"

namespace courant {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> texts(const std::vector<Finding>& found) {
  std::vector<std::string> out;
  for (const Finding& f : found) out.push_back(f.text);
  return out;
}
std::string verdict(const Summary& s) {
  return verdict_of(findings(s));
}

/// Energies of which `error` of 1 came from nowhere.
Summary with_error(Real error) {
  Summary s;
  s.particles = 10000;
  s.energy = {.kinetic = 0.5 + error, .external_work = 0.5, .throughput = 0.5, .peak = 0.5};
  return s;
}

TEST(Verdict, EnergyErrorIsSoundBelowOnePerCentAndBrokenAboveTen) {
  EXPECT_EQ(verdict(Summary()), "sound");
  for (const Real sign : {-1, 1}) {
    EXPECT_EQ(verdict(with_error(sign * 0.0099)), "sound");
    EXPECT_EQ(verdict(with_error(sign * 0.0101)), "doubtful");
    EXPECT_EQ(verdict(with_error(sign * 0.0999)), "doubtful");
    EXPECT_EQ(verdict(with_error(sign * 0.1001)), "broken");
  }
  EXPECT_THAT(texts(findings(with_error(0.02))),
              ElementsAre(HasSubstr("0.02 [ML2/T2] came from nowhere, 2 % of the 1 ")));
  EXPECT_THAT(texts(findings(with_error(-0.02))),
              ElementsAre(HasSubstr("0.02 [ML2/T2] were lost, 2 % of the 1 ")));
  EXPECT_EQ(verdict(with_error(std::nan(""))), "broken");
}

TEST(Verdict, RelaxationsOfYieldingAndOfFacets) {
  Summary s = with_error(0);
  s.maxima = {{"relaxation_plastic_strain", 0.0057}};
  EXPECT_THAT(texts(findings(s)),
              ElementsAre(HasSubstr("yielded, to a plastic strain of 0.0057, in a dynamic "
                                    "relaxation whose load acts at once")));
  s.maxima = {{"angle_between_facets", 2.5}, {"unresisted_curvature", 0.0299}};
  EXPECT_EQ(verdict(s), "sound");
  s.maxima["unresisted_curvature"] = 0.0301;
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("3.01 % of their energy: without a stiffness")));
  s.maxima["unresisted_curvature"] = 0;
  s.energy.internal = 1, s.energy.hourglass = 0.2;
  EXPECT_THAT(texts(findings(s)), Contains(HasSubstr("meet at angles, give BWC 1 of *CONTROL_SHELL")));
  s.energy.internal = s.energy.hourglass = 0;
  s.maxima = {{"relaxation_ratio", 0.1}, {"relaxation_factor", 0.998}};
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("a DRFCTR of 0.998, by its lowest frequency")));
}

TEST(Verdict, SolidsThatBendInModesThatNothingHolds) {
  Summary s = with_error(0);
  s.maxima = {{"unresisted_modes", 0.099}, {"unresisted_modes_part", 7}};
  EXPECT_EQ(verdict(s), "sound");
  s.maxima["unresisted_modes"] = 0.333;
  EXPECT_EQ(verdict(s), "doubtful");
  EXPECT_THAT(texts(findings(s)), ElementsAre(AllOf(HasSubstr("solids of part 7 bend in hourglass modes"),
                                                    HasSubstr("displacements are too large by up to 33.3 %"),
                                                    HasSubstr("take IHQ 6 with QM 1"))));
  s.limits.hourglass_doubtful = 0.5;
  EXPECT_EQ(verdict(s), "sound");
}

TEST(Verdict, SolidsThatNothingHolds) {
  Summary s = with_error(0);
  s.maxima = {{"unresisted_modes", 88}, {"unresisted_modes_part", 7}};
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("almost nothing resists bending")));
}

TEST(Verdict, JointsThatAreSprings) {
  Summary s = with_error(0);
  s.maxima = {{"joint_gap_share", 1e-4}, {"joint_spring_gap_share", 0.9e-2}};
  EXPECT_EQ(verdict(s), "sound");
  s.maxima["joint_spring_gap_share"] = 1.1e-2;
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("a penalty spring, opened by 0.011 of the size")));
}

// Mass that moving nodes get has momentum that came from nowhere.
TEST(Verdict, MomentumOfMassAddedOnTheWay) {
  Summary s = with_error(0);
  s.maxima = {{"momentum_of_added_mass", 0.0099}, {"momentum_of_nodes", 1}};
  EXPECT_EQ(verdict(s), "sound");
  s.maxima["momentum_of_added_mass"] = 0.0101;
  EXPECT_THAT(texts(findings(s)),
              ElementsAre(HasSubstr("mass that DT2MS added during the run brought momentum "
                                    "with it, 1.01 % of that of all nodes")));
}

// A limit of its own may be the stricter one.
TEST(Verdict, BrokenLimitsBelowTheDoubtfulOnesCount) {
  Summary s = with_error(0.03);
  s.limits.residual_doubtful = 0.5, s.limits.residual_broken = 0.02;
  EXPECT_EQ(verdict(s), "broken");
  s = with_error(0);
  s.leaked_particles = 100, s.limits.leaks_doubtful = 0.5;
  EXPECT_EQ(verdict(s), "broken");
}

// What the forces do within half a step is no error: kinetic energy is of half a step before.
TEST(Verdict, HalfAStepIsNoError) {
  Summary s = with_error(-0.2);
  s.energy.half_step = 0.25;
  EXPECT_EQ(s.energy.error(), 0);
  s.energy.half_step = 0.15;
  EXPECT_NEAR(s.energy.error(), -0.05, 1e-12);
  s.energy.half_step = -0.1;  // away from it
  EXPECT_NEAR(s.energy.error(), -0.2, 1e-12);
}

// Leapfrog keeps less than the energy at a time, by what the forces of a step and of the first one tell.
TEST(Verdict, WhatLeapfrogKeepsIsNoError) {
  Summary s = with_error(0.2);
  s.energy.half_step = 0.1;
  s.energy.below = 0.3;
  EXPECT_NEAR(s.energy.error(), 0, 1e-12);
  s.energy.below = 0.25;
  EXPECT_NEAR(s.energy.error(), 0.05, 1e-12);
  s.energy.below_at_start = 0.2;  // the ledger starts as far below
  EXPECT_NEAR(s.energy.error(), 0.2, 1e-12);
  s = with_error(-0.2);
  s.energy.below_at_start = 0.15;
  EXPECT_NEAR(s.energy.error(), -0.05, 1e-12);
}

// Differences of large numbers, wherever heights count from.
TEST(Verdict, RoundOffIsNoError) {
  Summary s;
  s.energy = {.potential = 1e9 + 1e-3, .initial = 1e9, .peak = 1e-3};
  EXPECT_EQ(s.energy.error(), 0);
  s.energy.potential = 1e9 + 10;
  EXPECT_GT(s.energy.error(), 1);
}

TEST(Verdict, LeaksAreDoubtfulAndManyOfThemBroken) {
  Summary s = with_error(0);
  s.leaked_particles = 1;
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("1 particle leaked through a wall, 0.01 % of all")));
  EXPECT_EQ(verdict(s), "doubtful");
  s.leaked_particles = 10;
  EXPECT_EQ(verdict(s), "doubtful");
  s.leaked_particles = 11;
  EXPECT_EQ(verdict(s), "broken");
}

TEST(Verdict, SoAreNodesThatWentThroughAFace) {
  Summary s = with_error(0);
  s.counters["contact_nodes"] = 10000, s.counters["leaked_nodes"] = 0;
  EXPECT_EQ(verdict(s), "sound");
  s.counters["leaked_nodes"] = 10;
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("10 nodes went through a face, 0.1 % of those")));
  EXPECT_EQ(verdict(s), "doubtful");
  s.counters["leaked_nodes"] = 11;
  EXPECT_EQ(verdict(s), "broken");
}

TEST(Verdict, AJointThatOpensIsDoubtful) {
  Summary s = with_error(0);
  s.maxima["joint_gap_share"] = 0.9e-5;
  EXPECT_EQ(verdict(s), "sound");
  s.maxima["joint_gap_share"] = 1.1e-5;
  EXPECT_EQ(verdict(s), "doubtful");
  EXPECT_THAT(texts(findings(s)), ElementsAre(HasSubstr("a joint of rigid bodies opened by 1.1e-05 of")));
}

TEST(Verdict, MomentumThatChangesWhereNothingActsIsDoubtful) {
  Summary s = with_error(0);
  s.maxima["momentum_change_share"] = 0.9e-3;
  EXPECT_EQ(verdict(s), "sound");
  s.maxima["momentum_change_share"] = 1.1e-3;
  EXPECT_EQ(verdict(s), "doubtful");
  EXPECT_THAT(texts(findings(s)),
              ElementsAre(HasSubstr("total momentum changed by 0.11 % of that of the parts")));
}

TEST(Verdict, HourglassEnergyAboveATenthOfTheInternalIsDoubtful) {
  Summary s = with_error(0);
  s.energy = {.kinetic = 0.5, .internal = 0.4, .hourglass = 0.039, .initial = 0.939, .peak = 1};
  EXPECT_EQ(verdict(s), "sound");
  s.energy.hourglass = 0.041;
  EXPECT_THAT(texts(findings(s)),
              ElementsAre(HasSubstr("hourglass energy is 10.2 % of the largest internal energy")));
  EXPECT_EQ(verdict(s), "doubtful");
  s.energy = {
      .kinetic = 1, .internal = 1e-6, .hourglass = 1e-5, .initial = 1, .peak = 1};  // a block that flies
  EXPECT_EQ(verdict(s), "sound");
  s.energy = {
      .kinetic = 0.98, .internal = 1e-6, .hourglass = 0.02, .initial = 1, .most_internal = 0.21, .peak = 1};
  EXPECT_EQ(verdict(s), "sound") << "thrown back";
  s.energy.most_internal = 0.19;
  EXPECT_EQ(verdict(s), "doubtful");
  s.energy = {
      .kinetic = 1, .internal = 1e-5, .hourglass = 0.009, .initial = 1, .peak = 1};  // a block that slides
  EXPECT_EQ(verdict(s), "sound");
  s.energy.hourglass = 0.011, s.energy.kinetic = 0.998;
  EXPECT_THAT(texts(findings(s)),
              ElementsAre(HasSubstr("hourglass energy is 11 % of a tenth of the scene's energy")));
  s.energy = {.internal = 0.1, .hourglass = 0.4, .assumed_bending = 0.39, .external_work = 0.5, .peak = 0.5};
  EXPECT_EQ(verdict(s), "sound") << "beams that bend by assumed strains";
  s.energy.assumed_bending = 0.3;
  EXPECT_EQ(verdict(s), "doubtful");
}

TEST(Verdict, ClampsErrorsAndRangesSpeakAgainstARun) {
  Summary s = with_error(0);
  s.counters = {
      {"deactivated_by_maxv", 2}, {"speed_clipped", 3}, {"sound_speed_clamped", 4}, {"mirror_crossings", 5}};
  EXPECT_THAT(findings(s), SizeIs(3));
  EXPECT_EQ(verdict(s), "doubtful");
  s = with_error(0);
  s.ranges = {{.part = 1,
               .c0 = 10,
               .stiffness_field = "C1",
               .seen = true,
               .speed = {2.1, 7, 0.5},
               .density_low = {1, 0, 0},
               .density_high = {1, 0, 0}}};
  EXPECT_THAT(texts(findings(s)),
              ElementsAre(HasSubstr("part 1: the largest speed 2.1 (particle 7 at 0.5) is above 0.2")));
  s.limits.mach_doubtful = 0.3;
  EXPECT_THAT(findings(s), IsEmpty());
  s.termination = "error", s.reason = "it fell over";
  EXPECT_THAT(texts(findings(s)), ElementsAre("it fell over"));
  EXPECT_EQ(verdict(s), "broken");
}

TEST(Verdict, TheDeckSetsLimits) {
  const auto limits = [](const std::string& cards) {
    test::SmallScene scene;
    scene.extra = cards;
    return verdict_limits(test::build(scene)->deck());
  };
  EXPECT_FALSE(limits("").given);
  const VerdictLimits some = limits("*COURANT_VERDICT\n0.02,,0.001,0.01\n");
  EXPECT_TRUE(some.given);
  EXPECT_EQ(some.residual_doubtful, 0.02);
  EXPECT_EQ(some.residual_broken, 0.1);
  EXPECT_EQ(some.leaks_doubtful, 0.001);
  EXPECT_EQ(some.leaks_broken, 0.01);
  EXPECT_EQ(some.mach_doubtful, 0.2);
  const VerdictLimits others = limits("*COURANT_VERDICT\n,0.3,,,0.2,0.5,0.4,0.15\n");
  EXPECT_EQ(others.residual_doubtful, 0.01);
  EXPECT_EQ(others.residual_broken, 0.3);
  EXPECT_EQ(others.hourglass_doubtful, 0.2);
  EXPECT_EQ(others.hourglass_broken, 0.5);
  EXPECT_EQ(others.mach_doubtful, 0.4);
  EXPECT_EQ(others.density_doubtful, 0.15);
}

/// The error that the balance shows after n steps, with the forces there.
Real error_after(const test::SmallScene& scene, int n) {
  auto s = test::build(scene);
  test::steps(*s, n);
  std::string who;
  s->evaluate(who);
  s->guard().look(s->world(), s->clock());
  return s->world().energy.error();
}

// At rest with a load that does not act yet, round-off of the forces is all the energy that there is.
TEST(Verdict, RestIsSound) {
  test::SmallScene scene;
  scene.extra = "*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,0.\n5.,0.\n5.1,1.\n";
  EXPECT_LT(std::abs(error_after(scene, 3 * Guard::interval)), 1e-12);
}

// A fall loses nothing, after however few steps, and wherever heights count from.
TEST(Verdict, FreeFallIsSound) {
  for (const int n : {1, 2, 5, 20, 3 * Guard::interval}) {
    test::SmallScene scene;
    scene.extra = test::gravity_cards;
    EXPECT_LT(std::abs(error_after(scene, n)), 1e-3) << n;
  }
}

// Up again where it began, a particle has no energy but that of its height: what fell is remembered.
TEST(Verdict, ABounceIsJudgedByTheHeightItFell) {
  test::SmallScene scene;
  scene.n = 1, scene.section = "1,1.2,1.,1.,0.12";
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,1.E8\n", scene.timestep = "0.,0.1";
  scene.extra = std::string(test::gravity_cards) + test::floor_cards(-0.225, 1);
  auto s = test::build(scene);
  Real lowest = 1, back = -1;
  while (s->clock().t < 0.5) {  // up again at 0.45
    test::steps(*s, 1);
    const Real y = s->world().particles.x.vec(0)[1];
    if (y < lowest) lowest = back = y;
    back = std::max(back, y);
  }
  s->guard().look(s->world(), s->clock());
  EXPECT_LT(std::abs(s->world().energy.error()), 1e-3);
  EXPECT_NEAR(lowest, -0.2, 0.02);
  EXPECT_NEAR(back, 0.05, 1e-3);
}

}  // namespace
}  // namespace courant
