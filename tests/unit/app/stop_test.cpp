// Runs that must not go on: each stops with a message that names its cause, in time.
#include "app/check/advice.hpp"
#include "small_scene.hpp"
#include "time/guard.hpp"

namespace courant {
namespace {

using test::build;
using test::SmallScene;

struct Stopped {
  std::string text;  ///< empty: it ran on
  StopCause cause = StopCause::other;
  std::string hint;
};

/// Takes at most `steps`; `meddle` may spoil the state before step `at`.
Stopped run_on(Simulation& s, int steps, int at = -1, const std::function<void(World&)>& meddle = {}) {
  StopFacts facts = facts_at_start(s);
  std::string dt_set_by;
  try {
    for (int k = 0; k < steps; ++k) {
      if (k == at) meddle(s.world());
      s.step([&](World&, const Clock&, const std::string& who) { dt_set_by = who; });
    }
  } catch (const RunError& error) {
    add_facts_at_stop(facts, s, error, dt_set_by);
    return {error.what(), error.cause, advice(facts)};
  }
  return {};
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

Index index_of(const World& world, Id id) {
  Index i = 0;
  while (world.particles.id[i] != id) ++i;
  return i;
}

// Every real field of a particle, spoilt in turn: found and named within 100 steps.
TEST(Stop, NumbersThatAreNoneAreFoundAndNamed) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  for (const Real bad : {std::nan(""), infinity, -infinity})
    for (const char* name : {"position", "velocity", "density", "internal_energy", "pressure", "mass"}) {
      auto s = build({});
      const Stopped stopped = run_on(*s, 110, 10, [&](World& w) {
        dynamic_cast<Field<Real>&>(*w.particles.fields.find(name))[index_of(w, 17)] = bad;
      });
      EXPECT_FALSE(stopped.text.empty()) << name << " " << bad;
      EXPECT_LE(s->clock().cycle, 10 + Guard::interval) << name;
      expect_part(stopped.text, " of part 1");
      expect_part(stopped.text, ", cycle ");
    }
}

// The energy of an equation of state that does not use it drives nothing: only the guard sees it.
TEST(Stop, TheGuardNamesQuantityParticleAndPart) {
  auto s = build({});
  const Stopped stopped =
      run_on(*s, 110, 10, [&](World& w) { w.particles.E[index_of(w, 17)] = std::nan(""); });
  expect_part(stopped.text,
              "particle 17 of part 1 has values that are no finite numbers: internal_energy (nan)");
  EXPECT_EQ(s->clock().cycle, Guard::interval);
  EXPECT_EQ(stopped.cause, StopCause::not_finite);
}

TEST(Stop, ABrokenWallIsNamed) {
  SmallScene scene;
  scene.extra = test::floor_cards();
  auto s = build(scene);
  const Stopped stopped = run_on(*s, 110, 10, [&](World& w) { w.nodes.v.set(2, Vec(0, std::nan(""), 0)); });
  expect_part(stopped.text, "node 9003 has values that are no finite numbers: velocity (nan)");
}

TEST(Stop, EnergyFromNowhere) {
  SmallScene scene;
  scene.start = "0.1,0.,0.";
  auto s = build(scene);
  const Stopped stopped = run_on(*s, 110, 10, [&](World& w) {
    for (Index i = 0; i < w.particles.active; ++i) w.particles.v.set(i, Vec(0.4, 0, 0));
  });
  expect_part(stopped.text, "the energy ran away: ");
  EXPECT_EQ(stopped.cause, StopCause::energy);
  EXPECT_EQ(s->clock().cycle, Guard::interval);
}

TEST(Stop, TheEnergyRatioLeavesEndeng) {
  const auto with_endeng = [](const char* endeng) {
    SmallScene scene;
    scene.start = "0.1,0.,0.";
    scene.termination = std::string("1.,0,0.,") + endeng;
    auto s = build(scene);
    return run_on(*s, 110, 10, [&](World& w) {  // 4 % more speed: 8.16 % more energy
      for (Index i = 0; i < w.particles.active; ++i) w.particles.v.set(i, Vec(0.104, 0, 0));
    });
  };
  EXPECT_EQ(with_endeng("8.2").text, "");
  EXPECT_EQ(with_endeng("0.").text, "");
  const Stopped stopped = with_endeng("8.1");
  expect_part(stopped.text, "the energy ratio changed by 8.16 %, more than ENDENG = 8.1 %");
  EXPECT_EQ(stopped.cause, StopCause::energy);
}

// Energy that falls, expands or comes from a load is no energy from nowhere, however little there was at the
// start; nor does the half step of kinetic energy make the ratio of a fall leave ENDENG.
TEST(Stop, SoundRunsGoOn) {
  SmallScene falls;
  falls.extra = test::gravity_cards;
  falls.termination = "9.,0,0.,5.";
  SmallScene expands;
  expands.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5\n0.,0.97\n";
  SmallScene rests;
  rests.extra = std::string(test::gravity_cards) + test::floor_cards();
  SmallScene pushed;
  pushed.extra = "*LOAD_BODY_X\n1\n*DEFINE_CURVE\n1\n0.,0.\n0.05,5.\n100.,0.\n";
  for (const SmallScene& scene : {falls, expands, rests, pushed}) {
    auto s = build(scene);
    EXPECT_EQ(run_on(*s, 4 * Guard::interval + 1).text, "");
  }
}

/// Particle 7 is flung away in cycle 10, where DTMIN is half the first step.
Stopped stopped_by_a_fast_particle(SmallScene scene) {
  scene.termination = "1.,0,0.5";
  auto s = build(scene);
  return run_on(*s, 50, 10, [&](World& w) { w.particles.v.set(index_of(w, 7), Vec(0, 40, 0)); });
}

TEST(Stop, TheStepFallsBelowDtmin) {
  const Stopped stopped = stopped_by_a_fast_particle({});
  expect_part(stopped.text, "fell below DTMIN x first step = ");
  expect_part(stopped.text, "cycle 10, set by sph 7 of part 1");
  EXPECT_EQ(stopped.cause, StopCause::step_size);
}

// DTMIN scales the step that was computed, not the first one that DTINIT chose.
TEST(Stop, DtinitDoesNotCountForDtmin) {
  SmallScene scene;
  scene.timestep = "1.E-6";
  const Stopped stopped = stopped_by_a_fast_particle(scene);
  expect_part(stopped.text, "fell below DTMIN x first step = ");
}

TEST(Stop, LctmDoesNotCountForDtmin) {
  SmallScene scene;
  scene.timestep = "0.,0.9,0,0.,0.,2";
  scene.extra = "*DEFINE_CURVE\n2\n0.,1.E-6\n0.001,1.E-6\n0.0011,1.\n9.,1.\n";
  const Stopped stopped = stopped_by_a_fast_particle(scene);
  expect_part(stopped.text, "fell below DTMIN x first step = ");
  expect_part(stopped.text, "set by sph 7 of part 1");
}

TEST(Stop, StepsBeyondTheStableOne) {
  SmallScene scene;
  scene.timestep = "0.,3.";
  scene.extra = std::string(test::gravity_cards) + test::floor_cards();
  auto s = build(scene);
  const Stopped stopped = run_on(*s, 5000);
  EXPECT_NE(stopped.text, "");
  expect_part(stopped.hint, "TSSFAC = 3 of *CONTROL_TIMESTEP");
}

TEST(Stop, EverybodyLeaves) {
  SmallScene scene;
  scene.start = "0.,-2.,0.";
  scene.control_sph = ",150,0,0.,1.";
  auto s = build(scene);
  const Stopped stopped = run_on(*s, 50);
  expect_part(stopped.text, "nothing limits the step size at time ");
  EXPECT_EQ(s->world().counters.at("deactivated_by_maxv"), 36);
}

// What comes towards an empty box gets there; what goes away does not.
TEST(Stop, NobodyIsInTheBoxYet) {
  SmallScene scene;
  scene.n = 1, scene.box = "1", scene.start = "2.,0.,0.";
  scene.section = "1,1.2,1.,1.,0.12";
  scene.extra = "*DEFINE_BOX\n1,0.5,1.5,-9.,9.,-9.,9.\n";
  auto coming = build(scene);
  EXPECT_EQ(run_on(*coming, 110).text, "");
  EXPECT_EQ(coming->world().particles.active, 1);
  scene.start = "-2.,0.,0.";
  auto going = build(scene);
  expect_part(run_on(*going, 110).text, "nothing limits the step size at time 0");
}

// A liquid so soft that the step lets it fall through the floor at once.
TEST(Stop, LeapsThatPassWallsUnseen) {
  SmallScene scene;
  scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,10.\n";  // c0 = 0.1
  scene.extra = std::string(test::gravity_cards) + test::floor_cards();
  auto s = build(scene);
  const Stopped stopped = run_on(*s, 50);
  expect_part(stopped.text, "smoothing lengths in the step to time 1.08, cycle 1: no pair and no wall");
  EXPECT_EQ(stopped.cause, StopCause::leap);
  expect_part(stopped.hint, "gravity gives speeds of ");
}

// At v >> c a step is nearly h long. Who lands out of a thin wall's reach has leaked all the same.
TEST(Stop, LeaksThroughThinWallsAreCounted) {
  SmallScene scene;
  scene.start = "0.,-3000.,0.";
  scene.extra = test::floor_cards(-0.4);
  const std::string thick = "2,2\n0.05\n";
  scene.extra.replace(scene.extra.find(thick), thick.size(), "2,2\n0.001\n");
  scene.extra += "*COURANT_LITERAL_PENALTY\n0\n";
  auto s = build(scene);
  EXPECT_EQ(run_on(*s, 40).text, "");
  EXPECT_LT(s->world().particles.x.vec(0)[1], -1);
  EXPECT_EQ(s->world().counters.at("leaked_particles"), 36);
}

// LS-DYNA: MAXV > 0 switches faster particles off, MAXV < 0 slows them, 0 does nothing.
TEST(Stop, MaxvSwitchesOffSlowsOrDoesNothing) {
  const auto fast = [](const char* maxv) {
    SmallScene scene;
    scene.start = "0.,-0.1,0.";
    scene.control_sph = std::string(",150,0,0.,") + maxv;
    auto s = build(scene);
    EXPECT_EQ(run_on(*s, 20, 10, [](World& w) { w.particles.v.set(index_of(w, 7), Vec(0, 4, 0)); }).text, "");
    return s;
  };
  const auto off = fast("2.");
  EXPECT_EQ(off->world().particles.active, 35);
  EXPECT_EQ(off->world().counters.at("deactivated_by_maxv"), 1);
  const auto slowed = fast("-2.");
  EXPECT_EQ(slowed->world().particles.active, 36);
  EXPECT_EQ(slowed->world().counters.at("speed_clipped"), 1);
  const auto free = fast("0.");
  EXPECT_EQ(free->world().particles.active, 36);
  EXPECT_FALSE(free->world().counters.contains("speed_clipped"));
}

// A sound run keeps its bits whoever looks, and its ranges are what the state shows.
TEST(Stop, RangesAreThoseOfTheState) {
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    SmallScene scene;
    scene.n = 12;
    scene.start = "0.,-0.5,0.";
    scene.extra = std::string(test::gravity_cards) + test::floor_cards();
    auto s = build(scene);
    ASSERT_EQ(run_on(*s, 64).text, "");
    PartRange expected = s->guard().ranges()[0];
    EXPECT_EQ(expected.part, 1);
    EXPECT_EQ(expected.c0, 30);
    EXPECT_EQ(expected.stiffness_field, "C1");
    EXPECT_EQ(expected.speed.value, 0.5);  // seen at cycle 0 only
    ASSERT_EQ(run_on(*s, 1).text, "");     // the look at cycle 64
    const PartRange& r = s->guard().ranges()[0];
    EXPECT_GT(r.speed.value, 0.5);
    EXPECT_GT(r.density_high.value, 1.0);
    EXPECT_LE(r.density_low.value, 1.0);
    EXPECT_GT(r.speed.t, 0.0);
    static Extreme first = r.speed;
    EXPECT_EQ(r.speed.value, first.value) << n << " threads";
    EXPECT_EQ(r.speed.particle, first.particle) << n << " threads";
    EXPECT_FALSE(s->guard().ranges()[1].seen);  // the floor
  }
  set_threads(0);
}

}  // namespace
}  // namespace courant
